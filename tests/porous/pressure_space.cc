// Pore pressures that live at the corners of whole cells: their space, and the system's slopes.
#include "../stress/random_states.h"

#include <kedge/equations/equation_system.h>
#include <kedge/porous/porous_force.h>
#include <kedge/transfer/node_sums.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class PorousPressureSpaceTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(PorousPressureSpaceTest, Dimensions);

  template <int dim>
  GridParameters<dim>
  grid_parameters()
  {
    const double        h[3] = {1.4, 1., 1.2};
    GridParameters<dim> parameters;
    parameters.node_intervals = 2;
    for (int d = 0; d < dim; ++d)
      {
        parameters.n_cells[d] = 4;
        parameters.extent[d]  = h[d] * 4;
      }
    return parameters;
  }

  Hencky
  hencky()
  {
    MaterialParameters parameters;
    parameters.young_modulus = 2.6;
    parameters.poisson_ratio = 0.3;
    return Hencky(parameters);
  }

  VonMises
  von_mises()
  {
    MaterialParameters parameters;
    parameters.young_modulus     = 2.6;
    parameters.poisson_ratio     = 0.3;
    parameters.yield_stress      = 0.4;
    parameters.hardening_modulus = 0.5;
    return VonMises(parameters);
  }

  Soil
  some_soil()
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = 0.8;
    parameters.fluid_density          = 1.1;
    parameters.fluid_bulk_modulus     = 3.;
    parameters.hydraulic_conductivity = 0.4;
    parameters.kozeny_carman          = true;
    parameters.reference_gravity      = 9.;
    return {PoreFluid(parameters), 2.4, 0., true};
  }

  TimeParameters
  newmark()
  {
    TimeParameters time;
    time.scheme        = SchemeKind::newmark;
    time.newmark_beta  = 0.3;
    time.newmark_gamma = 0.6;
    return time;
  }

  /** Random points that fill two whole cells, and a corner of a third. */
  template <int dim>
  struct CoarseCloud
  {
    CoarseCloud(const BasisKind basis, const double threshold)
      : grid(grid_parameters<dim>(), MPI_COMM_WORLD)
      , patch(grid, parameters(basis, threshold), {top_pressure(), {}})
      , points(patch.points)
      , nodes(patch.nodes)
      , ties(patch.ties)
      , status(patch.constraints.status())
    {
      RandomStates<dim>             random(11);
      std::vector<PointRecord<dim>> records;
      const auto                   &lattice = grid.lattice();
      LatticeWindow<dim>            block;
      for (int d = 0; d < dim; ++d)
        {
          block.low[d]     = 2;
          block.n_cells[d] = d == 0 ? 5 : 2;
        }
      for (unsigned int c = 0; c < block.n_cells_total(); ++c)
        for (unsigned int k = 0; k < 4; ++k)
          {
            const auto cell = block.cell_index(c);
            if (cell[0] == 6 && (k > 0 || cell[1] == 2)) // far from the cell's corners above
              continue;
            PointRecord<dim> record;
            record.id    = records.size();
            record.state = random.point(Spectrum::apart, hencky());
            for (int d = 0; d < dim; ++d)
              {
                record.location[d] =
                  lattice.origin[d] + (cell[d] + random.uniform(0., 1.)) * lattice.h[d];
                record.state.half_lengths[d] = random.uniform(0.1, 0.4) * lattice.h[d];
              }
            record.state.mass             = random.uniform(0.5, 2.);
            record.state.reference_volume = random.uniform(0.05, 0.1);
            records.push_back(record);
          }
      grid.cover(block, std::vector<unsigned int>(block.n_cells_total(), 4));
      const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      cloud.distribute(grid, is_first ? records : std::vector<PointRecord<dim>>());
      patch.reinit(cloud, [](std::vector<unsigned char> &) {});
    }

    static PatchParameters
    parameters(const BasisKind basis, const double threshold)
    {
      PatchParameters result;
      result.basis_of_body    = {basis};
      result.smallest_filling = threshold;
      result.coarse_pressure  = true;
      result.n_components     = dim + 1;
      return result;
    }

    static std::vector<NodeConditionParameters<dim>>
    top_pressure()
    {
      std::vector<NodeConditionParameters<dim>> result(1);
      result[0].on_side       = false;
      result[0].where         = "y > 1.9";
      result[0].pore_pressure = "0.5";
      return result;
    }

    LatticeIndex<dim>
    node(const unsigned int local) const
    {
      return grid.window().node_index(nodes.window_node(local));
    }

    BackgroundGrid<dim>             grid;
    MaterialPoints<dim>             cloud;
    Patch<dim>                      patch;
    const StepPoints<dim>          &points;
    const ActiveNodes<dim>         &nodes;
    const NodeTies<dim>            &ties;
    const std::vector<NodalStatus> &status;
  };

  /** The residual at the free components, as a function of what they are. */
  template <int dim>
  struct System
  {
    System(const CoarseCloud<dim> &c, const Material &material)
      : c(c)
      , force({material}, {some_soil()}, 1., PoreScheme(newmark()))
      , patch(c.patch)
    {
      StepPoints<dim>  &points = patch.points;
      RandomStates<dim> random(3);
      for (unsigned int slot = 0; slot < points.size(); ++slot)
        {
          pores.pressure.push_back(random.uniform(-1., 1.));
          pores.fluctuation.push_back(0.);
          pores.rate.push_back(random.uniform(-1., 1.));
          pores.rate_change.push_back(random.uniform(-1., 1.));
        }
      points.n_history = n_columns<VonMises>;
      for (unsigned int slot = 0; slot < points.size(); ++slot)
        points.history.insert(points.history.end(), {0., 0.4}); // alpha, sigma_y
      matrix.reinit(c.nodes.n_local(), dim + 1, 3);
      equations.reinit(patch, c.status, matrix);
    }

    std::vector<double>
    nodal(const std::vector<double> &free) const
    {
      std::vector<double> x;
      equations.scatter(free, x);
      for (unsigned int i = 0; i < c.nodes.n_local(); ++i)
        if (c.status[i * (dim + 1) + dim] == NodalStatus::prescribed)
          x[i * (dim + 1) + dim] = 0.5;
      c.ties.prolong(x, dim + 1);
      return x;
    }

    static std::vector<double>
    acceleration(const std::vector<double> &x)
    {
      std::vector<double> a;
      for (unsigned int i = 0; i < x.size(); ++i)
        if (i % (dim + 1) < dim)
          a.push_back(0.3 * std::sin(i) + 3. * x[i]);
      return a;
    }

    PorousTrial<dim>
    trial(const std::vector<double> &x, const std::vector<double> &a) const
    {
      PorousTrial<dim> result{x, a, 3., 0.3, 0.5, {}, faces, {}, {}, 0.};
      result.body_force[0] = 0.5;
      return result;
    }

    std::vector<double>
    residual(const std::vector<double> &free) const
    {
      const auto          x = nodal(free), a = acceleration(x);
      std::vector<double> sums(x.size(), 0.), outflow, result;
      PorousSize          size;
      EXPECT_TRUE(force.add_residual(patch, pores, trial(x, a), sums, outflow, size).ok());
      c.ties.restrict_sums(sums, dim + 1);
      equations.gather(sums, result);
      return result;
    }

    void
    fill(const std::vector<double> &free)
    {
      const auto x = nodal(free), a = acceleration(x);
      matrix.set_zero();
      force.add_tangent(patch, pores, trial(x, a), matrix);
      equations.fill(patch, matrix);
    }

    const CoarseCloud<dim>        &c;
    PorousForce<dim>               force;
    Patch<dim>                     patch; ///< with histories
    PorePoints<dim>                pores;
    std::vector<SurfacePoint<dim>> faces;
    NodeMatrix<dim>                matrix;
    EquationSystem<dim>            equations;
  };

  /** Each of the four blocks against central differences. */
  template <int dim>
  void
  check_slopes(System<dim> system)
  {
    const unsigned int  n = system.equations.system().n_rows();
    std::vector<double> x(n);
    for (unsigned int e = 0; e < n; ++e)
      x[e] =
        std::sin(1. + 7. * e) * (system.equations.nodal_index(e) % (dim + 1) == dim ? 1. : 0.02);
    system.fill(x);
    const auto  &rows          = system.equations.system();
    const double h             = 1e-5;
    double       largest[2][2] = {}, error[2][2] = {};
    for (unsigned int k = 0; k < n; ++k)
      {
        const bool q = system.equations.nodal_index(k) % (dim + 1) == dim;
        if (dim == 3 && !q && k % 11 != 0) // some columns of many
          continue;
        auto plus = x, minus = x;
        plus[k] += h;
        minus[k] -= h;
        const auto r_plus = system.residual(plus), r_minus = system.residual(minus);
        for (unsigned int e = 0; e < n; ++e)
          {
            const bool p     = system.equations.nodal_index(e) % (dim + 1) == dim;
            double     entry = 0.;
            for (std::int64_t j = rows.row_start[e]; j < rows.row_start[e + 1]; ++j)
              if (rows.column[j] == static_cast<int>(k))
                entry += rows.value[j];
            largest[p][q] = std::max(largest[p][q], std::abs(entry));
            error[p][q] =
              std::max(error[p][q], std::abs(entry - (r_plus[e] - r_minus[e]) / (2. * h)));
          }
      }
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        {
          // round-off 1e-16/h and curvature h^2 of residuals of order one: 1e-10
          EXPECT_GT(largest[p][q], 1e-3);
          EXPECT_LT(error[p][q], 1e-7 * largest[p][q]) << "block " << p << q;
        }
  }

  template <int dim>
  void
  check_all_slopes(const Material &material)
  {
    for (const BasisKind basis :
         {BasisKind::linear, BasisKind::gimp, BasisKind::spline, BasisKind::quadratic})
      for (const double threshold : {0., 0.15})
        {
          SCOPED_TRACE("basis " + std::to_string(int(basis)) + ", threshold " +
                       std::to_string(threshold));
          const CoarseCloud<dim> cloud(basis, threshold);
          check_slopes(System<dim>(cloud, material));
        }
  }
} // namespace

TYPED_TEST(PorousPressureSpaceTest, SystemIsTheResidualsSlope)
{
  check_all_slopes<TypeParam::value>(hencky());
}

TYPED_TEST(PorousPressureSpaceTest, SystemIsTheResidualsSlopeWhereItYields)
{
  check_all_slopes<TypeParam::value>(von_mises());
}

TYPED_TEST(PorousPressureSpaceTest, PressureIsBilinearOverWholeCells)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::quadratic})
    {
      const CoarseCloud<dim> c(basis, 0.);
      // an arbitrary value at each corner, a function of its place
      const auto value = [](const LatticeIndex<dim> &node) {
        return std::sin(node[0] + 2.3 * node[1] + (dim == 3 ? 0.7 * node[dim - 1] : 0.));
      };
      std::vector<double> x(c.nodes.n_local() * (dim + 1), 1e3);
      unsigned int        n_corners = 0;
      for (unsigned int i = 0; i < c.nodes.n_local(); ++i)
        if (!c.ties.is_tied(i, dim))
          {
            ++n_corners;
            x[i * (dim + 1) + dim] = value(c.node(i));
          }
      EXPECT_EQ(n_corners, 4u * (dim == 3 ? 4u : 2u)); // of three cells in a row
      c.ties.prolong(x, dim + 1);

      const auto strides = c.grid.window().node_strides();
      for (unsigned int slot = 0; slot < c.points.size(); ++slot)
        {
          const Stencil<dim> &s      = c.points.stencil[slot];
          double              actual = 0., expected = 0.;
          for (int k = 0; k < (dim == 3 ? stencil_width(s.pattern, 2) : 1); ++k)
            for (int j = 0; j < stencil_width(s.pattern, 1); ++j)
              for (int i = 0; i < stencil_width(s.pattern, 0); ++i)
                {
                  const int node = c.nodes.local(s.first_node + i + j * strides[1] +
                                                 (dim == 3 ? k * strides[dim - 1] : 0));
                  actual += s.value[0][i] * s.value[1][j] * (dim == 3 ? s.value[dim - 1][k] : 1.) *
                            x[node * (dim + 1) + dim];
                }
          for (unsigned int v = 0; v < (1u << dim); ++v)
            {
              LatticeIndex<dim> corner;
              double            weight = 1.;
              for (int d = 0; d < dim; ++d)
                {
                  const double xi = (c.points.location[slot][d] - c.grid.lattice().origin[d]) /
                                    (2. * c.grid.lattice().h[d]);
                  const int cell = static_cast<int>(xi);
                  corner[d]      = 2 * (cell + int((v >> d) & 1u));
                  weight *= (v >> d) & 1u ? xi - cell : 1. - (xi - cell);
                }
              expected += weight * value(corner);
            }
          EXPECT_NEAR(actual, expected, 1e-14); // sums of up to 27 numbers of order one
        }
    }
}
