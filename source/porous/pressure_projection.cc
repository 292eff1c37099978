#include <kedge/porous/pressure_projection.h>

namespace kedge
{
  namespace
  {
    /** Of the scaled residual: the ghosts' storage, a small number itself, needs no more. */
    constexpr double       tolerance       = 1e-9;
    constexpr unsigned int most_iterations = 1000;

    /** C^T (M + K_f M_G) C, on vectors of dim + 1 values per node of which the last counts. */
    template <int dim>
    class Projection
    {
    public:
      Projection(const BackgroundGrid<dim>      &grid,
                 const ActiveNodes<dim>         &nodes,
                 const NodeTies<dim>            &ties,
                 const StepPoints<dim>          &points,
                 const double                    bulk_modulus,
                 const std::vector<NodalStatus> &status,
                 const NodeMatrix<dim>          &storage)
        : grid(grid)
        , nodes(nodes)
        , ties(ties)
        , volumes(points.size())
        , inverse_lumped(status.size(), 0.)
      {
        for (unsigned int slot = 0; slot < points.size(); ++slot)
          volumes[slot] = points.volume[slot] * points.determinant[slot];
        matrix.reinit(nodes.n_local(), 1, storage.radius());
        assemble_mass(points, grid.window(), nodes, volumes, matrix);
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          {
            double &lumped = inverse_lumped[std::size_t(i) * (dim + 1) + dim];
            for (unsigned int s = 0; s < matrix.n_slots(); ++s)
              {
                matrix.row(i, 0)[s] += bulk_modulus * storage.row(i, 0)[s];
                lumped += std::abs(matrix.row(i, 0)[s]);
              }
          }
        ties.restrict_sums(inverse_lumped, dim + 1);
        nodes.add_to_owners(inverse_lumped, dim + 1);
        for (std::size_t k = 0; k < status.size(); ++k)
          inverse_lumped[k] =
            k < n_owned() && status[k] == NodalStatus::free && inverse_lumped[k] > 0.
              ? 1. / inverse_lumped[k]
              : 0.;
      }

      std::size_t
      n_owned() const
      {
        return std::size_t(nodes.n_owned()) * (dim + 1);
      }

      /** sum_p V J N p_p, at the owned nodes. */
      std::vector<double>
      right_side(const StepPoints<dim> &points, const std::vector<double> &pressures) const
      {
        std::vector<double> at_points(points.size()), sums(nodes.n_local(), 0.),
          result(inverse_lumped.size(), 0.);
        for (unsigned int slot = 0; slot < points.size(); ++slot)
          at_points[slot] = volumes[slot] * pressures[slot];
        add_scalars_to_nodes(points, grid.window(), nodes, at_points, 1, sums);
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          result[std::size_t(i) * (dim + 1) + dim] = sums[i];
        ties.restrict_sums(result, dim + 1);
        nodes.add_to_owners(result, dim + 1);
        return result;
      }

      /** The product; what is tied or a ghost in @p x is set here. */
      void
      apply(std::vector<double> &x, std::vector<double> &product) const
      {
        nodes.update_ghosts(x, dim + 1);
        ties.prolong(x, dim + 1);
        multiply(matrix, grid.window(), nodes, dim + 1, x, product);
        ties.restrict_sums(product, dim + 1);
        nodes.add_to_owners(product, dim + 1);
      }

      /** Sum of x y over the free pressures, divided by the lumped matrix if @p scaled. */
      double
      dot(const std::vector<double> &x, const std::vector<double> &y, const bool scaled) const
      {
        double sum = 0.;
        for (std::size_t k = dim; k < n_owned(); k += dim + 1)
          if (inverse_lumped[k] != 0.)
            sum += x[k] * y[k] * (scaled ? inverse_lumped[k] : 1.);
        return dealii::Utilities::MPI::sum(sum, nodes.communicator());
      }

      /** Conjugate gradients, scaled by the lumped matrix. */
      void
      solve(const std::vector<double> &right_side, std::vector<double> &x) const
      {
        std::vector<double> product(x.size()), residual(right_side), direction(x.size(), 0.);
        apply(x, product);
        for (std::size_t k = 0; k < x.size(); ++k)
          residual[k] -= product[k];
        const double size = dot(right_side, right_side, true);
        double       norm = dot(residual, residual, true), before = 1.;
        for (unsigned int n = 0; n < most_iterations && norm > tolerance * tolerance * size; ++n)
          {
            const double beta = n == 0 ? 0. : norm / before;
            for (std::size_t k = 0; k < n_owned(); ++k)
              direction[k] = inverse_lumped[k] * residual[k] + beta * direction[k];
            apply(direction, product);
            const double curvature = dot(direction, product, false);
            if (!(curvature > 0.))
              break;
            const double alpha = norm / curvature;
            for (std::size_t k = 0; k < n_owned(); ++k)
              if (inverse_lumped[k] != 0.)
                {
                  x[k] += alpha * direction[k];
                  residual[k] -= alpha * product[k];
                }
            before = norm;
            norm   = dot(residual, residual, true);
          }
        nodes.update_ghosts(x, dim + 1);
        ties.prolong(x, dim + 1);
      }

    private:
      const BackgroundGrid<dim> &grid;
      const ActiveNodes<dim>    &nodes;
      const NodeTies<dim>       &ties;
      std::vector<double>        volumes; ///< of the points, now
      NodeMatrix<dim>            matrix;
      std::vector<double>        inverse_lumped; ///< 0 where not a free pressure of this rank
    };
  } // namespace



  template <int dim>
  void
  project_pressure(const BackgroundGrid<dim>      &grid,
                   const ActiveNodes<dim>         &nodes,
                   const NodeTies<dim>            &ties,
                   const StepPoints<dim>          &points,
                   const std::vector<double>      &pressures,
                   const double                    bulk_modulus,
                   const std::vector<NodalStatus> &status,
                   const NodeMatrix<dim>          &storage,
                   std::vector<double>            &nodal)
  {
    const Projection<dim> projection(grid, nodes, ties, points, bulk_modulus, status, storage);
    projection.solve(projection.right_side(points, pressures), nodal);
  }

#define KEDGE_INSTANTIATE(dim)                                     \
  template void project_pressure(const BackgroundGrid<dim> &,      \
                                 const ActiveNodes<dim> &,         \
                                 const NodeTies<dim> &,            \
                                 const StepPoints<dim> &,          \
                                 const std::vector<double> &,      \
                                 const double,                     \
                                 const std::vector<NodalStatus> &, \
                                 const NodeMatrix<dim> &,          \
                                 std::vector<double> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
