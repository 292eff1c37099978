#include <kedge/porous/outflow_term.h>

namespace kedge
{
  template <int dim>
  OutflowTerm<dim>::OutflowTerm(const std::vector<Soil>                    &soils,
                                const std::vector<const MotionTerm<dim> *> &motions,
                                const bool                                  fluid_moves,
                                const MPI_Comm                              communicator)
    : soils(soils)
    , motions(motions)
    , fluid_moves(fluid_moves)
    , communicator(communicator)
  {}



  template <int dim>
  void
  OutflowTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    energy =
      ledger.declare({"outflow_energy", "J", Section::work, Kind::total, Role::lost, "energy"});
    for (int d = 0; d < dim; ++d)
      momentum[d] = ledger.declare(
        {std::string("outflow_momentum_") + "xyz"[d], "kg m/s", Section::momentum, Kind::total});
    if (!soils.empty())
      fluid_mass = ledger.declare(
        {"outflow_fluid_mass", "kg", Section::content, Kind::total, Role::lost, "fluid"});
    mass = ledger.declare({"outflow_mass", "kg", Section::state, Kind::total});
    n_points =
      ledger.declare({"outflow_points", "", Section::state, Kind::total, Role::none, "", true});
  }



  template <int dim>
  Answer
  OutflowTerm<dim>::finish(const Trial<dim> &)
  {
    unsigned int n_staying = 0;
    for (const MotionTerm<dim> *motion : motions)
      n_staying += motion->n_staying();
    if (dealii::Utilities::MPI::max(n_staying, communicator) > 0)
      return {};
    return Answer::failure("the last material points leave the grid through its open sides; "
                           "nothing is left to compute (Time/End may be earlier)");
  }



  template <int dim>
  void
  OutflowTerm<dim>::book_outflow(const std::vector<PointRecord<dim>> &gone, Ledger &ledger) const
  {
    for (const auto &point : gone)
      {
        const PointState<dim> &state   = point.state;
        dealii::Tensor<1, dim> moving  = state.mass * state.velocity;
        double                 whole   = state.mass;
        double                 carried = 0.5 * state.mass * state.velocity.norm_square() +
                         state.reference_volume * (state.strain_energy + state.hardening_energy +
                                                   state.plastic_dissipation);
        const auto body = static_cast<unsigned int>(state.body);
        if (!soils.empty() && !(soils[body].dry_storage > 0.))
          {
            const PoreFluid &fluid = soils[body].fluid;
            const double     pores =
              state.porosity * determinant(state.deformation_gradient) * state.reference_volume;
            const double pressure = fluid_moves ? state.end_pore_pressure : state.pore_pressure;
            const double water    = fluid.density(pressure) * pores;
            carried += water * fluid.energy(pressure);
            ledger.book(fluid_mass, water);
            if (fluid_moves)
              {
                carried += 0.5 * water * state.fluid_velocity.norm_square() +
                           0.5 * state.reference_volume * soils[body].stabilisation *
                             state.pore_pressure_fluctuation * state.pore_pressure_fluctuation;
                moving += water * state.fluid_velocity;
                whole += water;
              }
          }
        ledger.book(energy, carried);
        for (int d = 0; d < dim; ++d)
          ledger.book(momentum[d], moving[d]);
        ledger.book(mass, whole);
        ledger.book(n_points, 1.);
      }
  }

  template class OutflowTerm<2>;
  template class OutflowTerm<3>;
} // namespace kedge
