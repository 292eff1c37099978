#include <kedge/porous/porous_ghost_term.h>
#include <kedge/porous/pressure_projection.h>

namespace kedge
{
  template <int dim>
  PorousGhostTerm<dim>::PorousGhostTerm(const unsigned int             field,
                                        const Patch<dim>              &patch,
                                        const GhostTerm<dim>          &ghosts,
                                        const PorousTerm<dim>         &soil,
                                        const StabilisationParameters &parameters,
                                        const PoreFluidParameters     &fluid)
    : field(field)
    , patch(patch)
    , ghosts(ghosts)
    , soil(soil)
    , parameters(parameters)
    , fluid(fluid)
    , theta(soil.force().scheme().theta)
  {}



  template <int dim>
  void
  PorousGhostTerm<dim>::declare_books(Ledger &ledger)
  {
    energy = ledger.declare({"stabilisation_energy",
                             "J",
                             Ledger::Section::energy,
                             Ledger::Kind::total,
                             Ledger::Role::lost,
                             "energy"});
  }



  template <int dim>
  void
  PorousGhostTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    const auto start = [&](NodeMatrix<dim> &matrix) -> NodeMatrix<dim> & {
      if (patch.new_pattern())
        matrix.reinit(patch.nodes.n_local(), 1, GhostTerm<dim>::radius);
      matrix.set_zero();
      return matrix;
    };
    ghosts.penalty().add_gradient_penalty(patch,
                                          parameters.ghost_conductivity_factor *
                                            fluid.hydraulic_conductivity /
                                            (fluid.fluid_density * fluid.reference_gravity),
                                          start(conductance));
    ghosts.penalty().add_value_penalty(patch,
                                       parameters.ghost_storage_factor / fluid.fluid_bulk_modulus,
                                       start(storage));
  }



  template <int dim>
  void
  PorousGhostTerm<dim>::start(Trial<dim> &trial)
  {
    if (parameters.ghost_storage_factor == 0.)
      return;
    const std::vector<double>      &unknowns = trial.unknowns.fields[field];
    const std::vector<NodalStatus> &status   = patch.constraints.status();
    std::vector<double>             nodal(unknowns.size(), 0.);
    pressure_n.resize(patch.nodes.n_local());
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      {
        const std::size_t k = std::size_t(i) * (dim + 1) + dim;
        nodal[k]            = status[k] == NodalStatus::prescribed
                                ? patch.conditions.pressure(i, trial.times.t_n)
                                : unknowns[k];
      }
    project_pressure(patch, soil.pore_points().pressure, fluid.fluid_bulk_modulus, storage, nodal);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      pressure_n[i] = nodal[std::size_t(i) * (dim + 1) + dim];
  }



  /** The volume of fluid that the ghosts move in the step, at the nodes; partial sums. */
  template <int dim>
  std::vector<double>
  PorousGhostTerm<dim>::flow(const Trial<dim> &trial) const
  {
    const unsigned int  n = patch.nodes.n_local();
    std::vector<double> pressure(n), change(n), product(n), result(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        pressure[i] = trial.unknowns.fields[field][std::size_t(i) * (dim + 1) + dim];
        if (parameters.ghost_storage_factor > 0.)
          change[i] = (pressure[i] - pressure_n[i]) / theta;
      }
    multiply(conductance, patch, 1, pressure, product);
    multiply(storage, patch, 1, change, result);
    for (unsigned int i = 0; i < n; ++i)
      result[i] += trial.times.dt * product[i];
    return result;
  }



  template <int dim>
  Answer
  PorousGhostTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    std::vector<double>      &sums   = residual.partial(field);
    const std::vector<double> volume = flow(trial);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      sums[std::size_t(i) * (dim + 1) + dim] += volume[i];
    return {};
  }



  template <int dim>
  void
  PorousGhostTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    tangent.add_to_diagonal_blocks(field, trial.times.dt, conductance, dim, dim + 1);
    tangent.add_to_diagonal_blocks(field, 1. / theta, storage, dim, dim + 1);
  }



  template <int dim>
  void
  PorousGhostTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    const std::vector<double> volume = flow(trial);
    double                    work   = 0.;
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      work += trial.unknowns.fields[field][std::size_t(i) * (dim + 1) + dim] * volume[i];
    ledger.book(energy, work);
  }

  template class PorousGhostTerm<2>;
  template class PorousGhostTerm<3>;
} // namespace kedge
