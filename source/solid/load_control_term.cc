#include <kedge/points/attachment_checks.h>
#include <kedge/solid/load_control_term.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  LoadControlTerm<dim>::LoadControlTerm(const LoadControlParameters<dim>          &control,
                                        const std::map<std::string, double>       &constants,
                                        const std::vector<std::string>            &body_names,
                                        const unsigned int                         field,
                                        const Patch<dim>                          &patch,
                                        const double                               stiffness,
                                        const double                               start,
                                        const std::vector<ControlledLoads<dim> *> &loads)
    : control(control)
    , displacement(control.displacement, {"t"}, constants)
    , body_names(body_names)
    , field(field)
    , patch(patch)
    , stiffness(stiffness)
    , loads(loads)
    , factor_n(start)
  {
    for (ControlledLoads<dim> *term : loads)
      term->follow(*this);
  }



  template <int dim>
  void
  LoadControlTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    GeneratedPoint<dim> *nearest = nullptr;
    double               least   = std::numeric_limits<double>::max();
    for (auto &candidate : points)
      {
        const double square = candidate.record.location.distance_square(control.place);
        if (square < least &&
            body_names[static_cast<unsigned int>(candidate.record.state.body)] == control.body)
          {
            least   = square;
            nearest = &candidate;
          }
      }
    AssertThrow(nearest != nullptr, dealii::ExcInternalError());
    check_nearness<dim>("Load control",
                        control.place,
                        nearest->record.location,
                        nearest->record.state.reference_half_lengths);
    point                        = nearest->record.id;
    nearest->record.state.loaded = 1.; // by which it is found again
  }



  template <int dim>
  void
  LoadControlTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    unknown                     = unknowns.add_others(1);
    unknowns.traits.multipliers = true;
  }



  template <int dim>
  void
  LoadControlTerm<dim>::declare_books(Ledger &ledger)
  {
    load_factor =
      ledger.declare({"load_factor", "", Ledger::Section::force, Ledger::Kind::of_step});
    point_displacement =
      ledger.declare({"control_displacement", "m", Ledger::Section::force, Ledger::Kind::total});
  }



  template <int dim>
  bool
  LoadControlTerm<dim>::is_first() const
  {
    return dealii::Utilities::MPI::this_mpi_process(patch.nodes.communicator()) == 0;
  }



  template <int dim>
  void
  LoadControlTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    std::vector<dealii::Tensor<1, dim>> directions(patch.points.size());
    for (const unsigned int slot : patch.points.loaded)
      if (patch.points.id[slot] == point)
        directions[slot] = control.direction;
    weights.assign(std::size_t(patch.nodes.n_local()) * dim, 0.);
    const std::vector<double> ones(patch.points.size(), 1.);
    add_to_nodes(patch, ones, directions, weights);
  }



  template <int dim>
  double
  LoadControlTerm<dim>::norm_of_slope(const Trial<dim> &trial) const
  {
    double square = 0.;
    for (const ControlledLoads<dim> *term : loads)
      square += term->square_of_slope(trial);
    return std::sqrt(dealii::Utilities::MPI::sum(square, patch.nodes.communicator()));
  }



  template <int dim>
  void
  LoadControlTerm<dim>::start(Trial<dim> &trial)
  {
    scale             = 0.; // at which the loads are those of the last step
    const double norm = norm_of_slope(trial);
    scale             = norm > 0. ? stiffness / norm : 0.;
    demand = displacement({trial.times.t_n + trial.times.dt}) - displacement({trial.times.t_n});
  }



  template <int dim>
  double
  LoadControlTerm<dim>::at_balance(const Trial<dim> &trial) const
  {
    return factor_n + scale * trial.unknowns.others[unknown];
  }



  template <int dim>
  double
  LoadControlTerm<dim>::moved(const Trial<dim> &trial) const
  {
    const std::vector<double> &u   = trial.displacement(field);
    double                     sum = 0.;
    for (std::size_t i = 0; i < weights.size(); ++i)
      sum += weights[i] * u[i];
    return sum;
  }



  template <int dim>
  Answer
  LoadControlTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    if (scale == 0.)
      return Answer::failure(
        "Load control: no Body force, Point load, Traction or Pressure changes with t "
        "at the load factor " +
        std::to_string(factor_n));
    residual.others()[unknown] += stiffness * ((is_first() ? demand : 0.) - moved(trial));
    return {};
  }



  template <int dim>
  void
  LoadControlTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    const UnknownIndex x = UnknownIndex::other(unknown);
    for (unsigned int node = 0; node < patch.nodes.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (const double weight = weights[std::size_t(node) * dim + d]; weight != 0.)
          tangent.add(x, {field, node, d}, -stiffness * weight);
    for (const ControlledLoads<dim> *term : loads)
      term->add_slope(trial, scale, x, tangent);
  }



  template <int dim>
  void
  LoadControlTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    ledger.book(load_factor, is_first() ? at_balance(trial) : 0.);
    ledger.book(point_displacement, moved(trial));
  }



  template <int dim>
  void
  LoadControlTerm<dim>::commit(const Trial<dim> &trial, MaterialPoints<dim> &)
  {
    factor_n = at_balance(trial);
  }



  template <int dim>
  void
  LoadControlTerm<dim>::save(SavedState &state) const
  {
    state["load factor"] = {factor_n};
  }



  template <int dim>
  void
  LoadControlTerm<dim>::restore(const SavedState &state)
  {
    if (const auto found = state.find("load factor"); found != state.end()) // none after a stage
      factor_n = found->second.at(0);
  }

  template class LoadControlTerm<2>;
  template class LoadControlTerm<3>;
} // namespace kedge
