#include <kedge/transfer/motion_term.h>
#include <kedge/transfer/node_sums.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** Of the whole grid [m]. */
    template <int dim>
    double
    diagonal(const Lattice<dim> &lattice)
    {
      double square = 0.;
      for (int d = 0; d < dim; ++d)
        square += std::pow(lattice.upper(d) - lattice.origin[d], 2);
      return std::sqrt(square);
    }
  } // namespace



  template <int dim>
  MotionTerm<dim>::MotionTerm(const unsigned int    field,
                              const Patch<dim>     &patch,
                              MotionTransfer<dim>  *transfer,
                              const OpenSides<dim> &open_sides)
    : field(field)
    , patch(patch)
    , transfer(transfer)
    , open_sides(open_sides)
  {}



  template <int dim>
  void
  MotionTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section    = Ledger::Section;
    using Kind       = Ledger::Kind;
    using Role       = Ledger::Role;
    const auto count = [&](const std::string &name) {
      return ledger.declare({name, "", Section::state, Kind::present, Role::none, "", true});
    };
    columns.kinetic_energy = ledger.declare(
      {"kinetic_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    if (transfer != nullptr && transfer->is_lossy())
      columns.mapping_dissipation = ledger.declare(
        {"mapping_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    for (int d = 0; d < dim; ++d)
      columns.linear_momentum[d] =
        ledger.declare({std::string("linear_momentum_") + "xyz"[d], "kg m/s", Section::momentum});
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      columns.angular_momentum[d] = ledger.declare(
        {std::string("angular_momentum_") + "xyz"[d], "kg m^2/s", Section::momentum});
    columns.mass           = ledger.declare({"mass", "kg", Section::state});
    columns.n_points       = count("n_points");
    columns.n_active_cells = count("n_active_cells");
    count("n_dofs");
    columns.min_det_F = ledger.declare({"min_det_F", "", Section::state, Kind::lowest});
  }



  template <int dim>
  Answer
  MotionTerm<dim>::finish(const Trial<dim> &trial)
  {
    interpolate_to_points(patch, trial.displacement(field), point_displacements);
    Answer       failure;
    const double size = diagonal(patch.grid().lattice());
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      {
        const auto x   = patch.points.location[slot] + point_displacements[slot];
        const bool out = !patch.grid().lattice().contains(x);
        if (out && point_displacements[slot].norm_square() > size * size)
          {
            failure = Answer::failure(describe_jump(slot));
            break;
          }
        if (!out || open_sides.let_out(patch.grid().lattice(), dealii::Point<dim>(x)))
          continue;
        std::ostringstream cause;
        cause << "material point " << patch.points.id[slot] << " leaves the background grid at ("
              << x << "), displaced by (" << point_displacements[slot]
              << ") in this step; enlarge the grid (Grid/Origin, Grid/Extent) or let material "
                 "leave (Grid/Open sides)";
        failure = Answer::failure(cause.str());
        break;
      }
    if (open_sides.any())
      n_staying_ = count_staying();
    return failure;
  }



  template <int dim>
  std::string
  MotionTerm<dim>::describe_jump(const unsigned int slot) const
  {
    std::ostringstream cause;
    cause << "material point " << patch.points.id[slot] << " would move by ("
          << point_displacements[slot]
          << ") in this step, further than the whole grid: the equations have no sensible solution "
             "here (a body at its limit load, an instability, or one that nothing holds)";
    return cause.str();
  }



  template <int dim>
  unsigned int
  MotionTerm<dim>::count_staying() const
  {
    unsigned int n = 0;
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      if (!open_sides.let_out(patch.grid().lattice(),
                              dealii::Point<dim>(patch.points.location[slot] +
                                                 point_displacements[slot])))
        ++n;
    return n;
  }



  template <int dim>
  void
  MotionTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (transfer != nullptr && transfer->is_lossy())
      ledger.book(columns.mapping_dissipation, transfer->loss(trial));
  }



  template <int dim>
  void
  MotionTerm<dim>::commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud)
  {
    if (transfer != nullptr)
      transfer->to_points(trial);
    const auto move = [&](const unsigned int number, dealii::Point<dim> &location, auto &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot == StepPoints<dim>::no_slot)
        return;
      location += point_displacements[slot];
      state.displacement += point_displacements[slot];
      if (transfer != nullptr)
        transfer->update(slot, state);
    };
    if (transfer != nullptr && transfer->carries_acceleration())
      cloud.update_each(move);
    else
      cloud.update_each_core(move);
  }



  template <int dim>
  void
  MotionTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    // in the order of the slots, which does not depend on how the run got here
    const StepPoints<dim> &points  = patch.points;
    double                 kinetic = 0., mass = 0., linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0};
    double                 lowest = std::numeric_limits<double>::max();
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        const double m    = points.mass[slot];
        double       x[3] = {0, 0, 0}, p[3] = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          {
            x[d] = points.location[slot][d];
            p[d] = m * points.velocity[slot][d];
            linear[d] += p[d];
          }
        kinetic += 0.5 * m * points.velocity[slot].norm_square();
        mass += m;
        angular[0] += x[1] * p[2] - x[2] * p[1];
        angular[1] += x[2] * p[0] - x[0] * p[2];
        angular[2] += x[0] * p[1] - x[1] * p[0];
        lowest = std::min(lowest, points.determinant[slot]);
      }
    ledger.book(columns.kinetic_energy, kinetic);
    for (int d = 0; d < dim; ++d)
      ledger.book(columns.linear_momentum[d], linear[d]);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(columns.angular_momentum[d], angular[d]);
    ledger.book(columns.mass, mass);
    ledger.book(columns.n_points, points.size());
    ledger.book(columns.n_active_cells, points.n_cells);
    if (points.size() > 0)
      ledger.book(columns.min_det_F, lowest);
  }

  template class MotionTerm<2>;
  template class MotionTerm<3>;
} // namespace kedge
