// The ghost terms of the u-p balance.
#include <kedge/porous/porous_problem.h>
#include <kedge/porous/pressure_projection.h>

namespace kedge
{
  /** The volume of fluid that the ghosts move in the step, at the nodes; partial sums. */
  template <int dim>
  std::vector<double>
  PorousProblem<dim>::ghost_flow() const
  {
    const double        theta = porous_force.scheme().theta;
    std::vector<double> pressure(nodes->n_local()), change(nodes->n_local()), product(pressure),
      flow(pressure);
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        pressure[i] = unknowns[std::size_t(i) * (dim + 1) + dim];
        if (ghosts->has_storage)
          change[i] = (pressure[i] - pressure_n[i]) / theta;
      }
    multiply(ghosts->conductance, grid->window(), *nodes, 1, pressure, product);
    multiply(ghosts->storage, grid->window(), *nodes, 1, change, flow);
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      flow[i] += dt * product[i];
    return flow;
  }



  template <int dim>
  void
  PorousProblem<dim>::add_ghosts(PorousSize &size)
  {
    std::vector<double> force(std::size_t(nodes->n_local()) * dim), inertia(force.size(), 0.);
    multiply(ghosts->stiffness, grid->window(), *nodes, dim, state->displacement, force);
    if (scheme.dynamic)
      multiply(ghosts->mass, grid->window(), *nodes, dim, acceleration, inertia);
    const std::vector<double> flow = ghost_flow();
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        double *r = &residual[std::size_t(i) * (dim + 1)];
        for (int d = 0; d < dim; ++d)
          {
            const std::size_t k = std::size_t(i) * dim + d;
            const double      f = scheme.alpha_f * force[k] + inertia[k];
            r[d] += f;
            size.momentum += f * f;
          }
        r[dim] += flow[i];
        size.fluid += flow[i] * flow[i];
      }
  }



  template <int dim>
  void
  PorousProblem<dim>::add_ghosts_to_tangent()
  {
    this->add_to_diagonal_blocks(scheme.alpha_f, ghosts->stiffness, 0, dim);
    if (scheme.dynamic)
      this->add_to_diagonal_blocks(scheme.inertia_coefficient(dt), ghosts->mass, 0, dim);
    this->add_to_diagonal_blocks(dt, ghosts->conductance, dim, dim + 1);
    this->add_to_diagonal_blocks(1. / porous_force.scheme().theta, ghosts->storage, dim, dim + 1);
  }



  template <int dim>
  double
  PorousProblem<dim>::work_against_ghosts() const
  {
    const std::vector<double> flow = ghost_flow();
    double                    work = 0.;
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      work += unknowns[std::size_t(i) * (dim + 1) + dim] * flow[i];
    return dealii::Utilities::MPI::sum(work, nodes->communicator());
  }



  template <int dim>
  void
  PorousProblem<dim>::project_pressure()
  {
    pressure_n.resize(nodes->n_local());
    std::vector<double> nodal(unknowns.size(), 0.);
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        const std::size_t k = std::size_t(i) * (dim + 1) + dim;
        nodal[k] =
          status[k] == NodalStatus::prescribed ? conditions->pressure(i, t_n) : unknowns[k];
      }
    const double bulk_modulus = porous_force.soils().front().fluid.bulk_modulus;
    kedge::project_pressure(*grid,
                            *nodes,
                            *ties,
                            *points,
                            pores.pressure,
                            bulk_modulus,
                            status,
                            ghosts->storage,
                            nodal);
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      pressure_n[i] = nodal[std::size_t(i) * (dim + 1) + dim];
  }

  template class PorousProblem<2>;
  template class PorousProblem<3>;
} // namespace kedge
