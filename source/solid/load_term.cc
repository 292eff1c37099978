#include <kedge/solid/load_columns.h>
#include <kedge/solid/load_term.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  LoadTerm<dim>::LoadTerm(const unsigned int              field,
                          const Patch<dim>               &patch,
                          const ExternalLoads<dim>       &loads,
                          const SurfaceTractions<dim>    &tractions,
                          const std::vector<std::string> &body_names,
                          const MotionTerm<dim>          &motion,
                          const Scheme                   &scheme)
    : ControlledLoads<dim>(scheme)
    , field(field)
    , patch(patch)
    , loads(loads)
    , tractions(tractions)
    , body_names(body_names)
    , motion(motion)
    , on_faces{&this->tractions}
  {}



  template <int dim>
  void
  LoadTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    loads.attach(points, body_names);
    tractions.attach(points, body_names);
  }



  template <int dim>
  void
  LoadTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    tractions.reinit(cloud, patch);
  }



  template <int dim>
  void
  LoadTerm<dim>::declare_books(Ledger &ledger)
  {
    work = ledger.declare(external_work);
    resultants.assign(tractions.names().size() * dim, 0);
    for (std::size_t s = 0; s < tractions.names().size(); ++s)
      for (int d = 0; d < dim && tractions.shows_resultant(s); ++d)
        resultants[s * dim + d] = ledger.declare(force_column("load", tractions.names()[s], d));
  }



  template <int dim>
  bool
  LoadTerm<dim>::empty() const
  {
    return loads.empty() && std::all_of(on_faces.begin(), on_faces.end(), [](const auto *forces) {
             return forces->empty();
           });
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  LoadTerm<dim>::forces_at(const double t) const
  {
    std::vector<dealii::Tensor<1, dim>> forces(patch.points.size());
    loads.add_force(patch.points, t, forces);
    return forces;
  }



  /** The forces at the nodes, dim values each, complete at the owned ones. */
  template <int dim>
  std::vector<double>
  LoadTerm<dim>::at_nodes(const double t) const
  {
    std::vector<double>       sums(std::size_t(patch.nodes.n_local()) * dim, 0.);
    const std::vector<double> ones(patch.points.size(), 1.);
    add_to_nodes(patch, ones, forces_at(t), sums);
    for (const auto *surface : on_faces)
      add_face_forces(patch, surface->points(), surface->forces(t), sums);
    patch.ties.restrict_sums(sums);
    patch.nodes.add_to_owners(sums, dim);
    return sums;
  }



  /** df_ext/dl, complete at the owned nodes. */
  template <int dim>
  std::vector<double>
  LoadTerm<dim>::slope_at_nodes(const double l) const
  {
    if (empty())
      return {};
    const double              difference = this->small_difference(l);
    std::vector<double>       slope      = at_nodes(l + difference);
    const std::vector<double> before     = at_nodes(l - difference);
    for (std::size_t i = 0; i < slope.size(); ++i)
      slope[i] = (slope[i] - before[i]) / (2. * difference);
    return slope;
  }



  template <int dim>
  double
  LoadTerm<dim>::square_of_slope(const Trial<dim> &trial) const
  {
    const std::vector<double> slope = slope_at_nodes(this->balance_time(trial));
    double                    sum   = 0.;
    for (std::size_t i = 0; i < patch.nodes.n_owned() * dim && !slope.empty(); ++i)
      sum += slope[i] * slope[i];
    return sum;
  }



  template <int dim>
  void
  LoadTerm<dim>::add_slope(const Trial<dim>   &trial,
                           const double        s,
                           const UnknownIndex &x,
                           Tangent<dim>       &tangent) const
  {
    const std::vector<double> slope = slope_at_nodes(this->balance_time(trial));
    for (unsigned int node = 0; node < patch.nodes.n_owned() && !slope.empty(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (const double value = slope[std::size_t(node) * dim + d]; value != 0.)
          tangent.add({field, node, d}, x, -s * value);
  }



  template <int dim>
  void
  LoadTerm<dim>::start(Trial<dim> &trial)
  {
    external_force.clear();
    if (!empty())
      external_force = at_nodes(this->balance_time(trial));
  }



  template <int dim>
  Answer
  LoadTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    if (external_force.empty())
      return {};
    if (this->is_controlled())
      external_force = at_nodes(this->balance_time(trial));
    add_external_force(residual);
    return {};
  }



  template <int dim>
  void
  LoadTerm<dim>::add_external_force(Residual<dim> &residual) const
  {
    std::vector<double> &sums         = residual.complete(field);
    const std::size_t    n_components = patch.n_components();
    for (std::size_t i = 0; i < patch.nodes.n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        sums[i * n_components + d] = -external_force[i * dim + d];
  }



  template <int dim>
  void
  LoadTerm<dim>::add_residual_at_rest(const double t, Residual<dim> &residual)
  {
    if (empty())
      return;
    external_force = at_nodes(t);
    add_external_force(residual);
  }



  template <int dim>
  void
  LoadTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (empty())
      return;
    double       sum    = 0.;
    const double middle = this->middle_time(trial);
    const auto   forces = forces_at(middle);
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      sum += forces[slot] * motion.displacements()[slot];
    for (const auto *surface : on_faces)
      sum += work_of_face_forces(patch,
                                 surface->points(),
                                 surface->forces(middle),
                                 trial.displacement(field));
    ledger.book(work, sum);
    const auto on_tractions = tractions.forces(this->balance_time(trial));
    for (std::size_t f = 0; f < on_tractions.size(); ++f)
      {
        const unsigned int surface = tractions.points()[f].surface;
        for (int d = 0; d < dim && tractions.shows_resultant(surface); ++d)
          ledger.book(resultants[surface * dim + d], on_tractions[f][d]);
      }
  }

  template class LoadTerm<2>;
  template class LoadTerm<3>;
} // namespace kedge
