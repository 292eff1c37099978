// The sums of the u-p balance over the points: slopes by differences, and what must not change.
#include "../basis/direct.h"
#include "../transfer/cloud.h"

#include <kedge/porous/porous_force.h>

#include <kedge/surfaces/face_functions.h>

#include <gtest/gtest.h>

#include <numeric>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class PorousForceTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::vector<std::vector<BasisKind>> all_bases = {{BasisKind::linear},
                                                         {BasisKind::gimp},
                                                         {BasisKind::gimp, BasisKind::linear},
                                                         {BasisKind::spline},
                                                         {BasisKind::spline, BasisKind::gimp}};

  /** Soil in which all terms count: stresses and pressures of order one. */
  Soil
  some_soil(const unsigned int body, const double dry_storage = 0.)
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = body == 0 ? 0.8 : 0.75;
    parameters.fluid_density          = 1.1;
    parameters.fluid_bulk_modulus     = 3.;
    parameters.hydraulic_conductivity = 0.4;
    parameters.kozeny_carman          = body == 0;
    parameters.reference_gravity      = 9.;
    return {PoreFluid(parameters), 2.4, body == 0 ? 0.7 : 0., true, dry_storage};
  }

  /** A scheme and what goes with it. */
  struct Setting
  {
    std::string    name;
    TimeParameters time;
    double         alpha;
    double         inertia;
  };

  std::vector<Setting>
  settings()
  {
    Setting quasi_static{"quasi-static", {}, 1., 0.}, newmark{"newmark", {}, 1., 3.},
      midpoint{"midpoint", {}, 0.5, 2.};
    quasi_static.time.scheme   = SchemeKind::quasi_static;
    newmark.time.scheme        = SchemeKind::newmark;
    newmark.time.newmark_beta  = 0.3;
    newmark.time.newmark_gamma = 0.6;
    midpoint.time.scheme       = SchemeKind::midpoint;
    midpoint.time.pore_theta   = 0.6;
    return {quasi_static, newmark, midpoint};
  }

  template <int dim>
  struct Problem
  {
    Problem(const Cloud<dim> &cloud,
            const Setting    &setting,
            const bool        plastic,
            const double      dry_storage = 0.) // of the second body
      : cloud(cloud)
      , setting(setting)
      , patch(cloud.patch)
      , points(patch.points)
      , force(materials(plastic),
              {some_soil(0), some_soil(1, dry_storage)},
              setting.alpha,
              PoreScheme(setting.time))
    {
      RandomStates<dim> random(7);
      for (unsigned int slot = 0; slot < points.size(); ++slot)
        {
          pores.pressure.push_back(random.uniform(-1., 1.));
          pores.fluctuation.push_back(random.uniform(-1., 1.));
          if (force.scheme().carries_rates)
            {
              pores.rate.push_back(random.uniform(-1., 1.));
              pores.rate_change.push_back(random.uniform(-1., 1.));
            }
        }
      points.n_history = n_columns<VonMises>;
      for (unsigned int slot = 0; slot < points.size(); ++slot)
        points.history.insert(points.history.end(), {0., 0.4}); // alpha, sigma_y
      constant = cloud.random_nodal(1., 3);
      for (unsigned int slot = 0; slot < points.size(); slot += 5)
        {
          SurfacePoint<dim> face{slot, slot % 2, {}, {}, 0., {}, {}, {}, {}};
          for (int d = 0; d < dim; ++d)
            {
              face.offset[d] = random.uniform(-0.1, 0.1);
              face.area[d]   = random.uniform(-0.1, 0.1);
            }
          const auto body =
            std::find_if(points.batches.begin(), points.batches.end(), [&](const auto &batch) {
              return slot < batch.end;
            })->body;
          const BasisKind    basis = patch.basis_of(body);
          dealii::Point<dim> x     = points.location[slot];
          for (int d = 0; d < dim; ++d)
            x[d] += face.offset[d];
          if (slot % 2 == 0)
            {
              face.functions = functions_at_face(patch, slot, basis, face.offset, face.area);
              face.gradients = points.stencil[slot];
            }
          else // on a facet: the functions of the grid in the point's cell
            face.functions = face.gradients =
              *functions_of_cell<dim>(patch,
                                      basis,
                                      patch.grid().lattice().cell_of(points.location[slot]),
                                      x);
          pressures.push_back(random.uniform(-0.3, 0.3));
          flows.push_back(slot % 4 == 0 ? SurfaceFlow::one_way : SurfaceFlow::both_ways);
          faces.push_back(face);
        }
    }

    static std::vector<Material>
    materials(const bool plastic)
    {
      std::vector<Material> result;
      for (const unsigned int body : {0, 1})
        {
          MaterialParameters parameters;
          parameters.young_modulus     = body == 0 ? 2.6 : 5.;
          parameters.poisson_ratio     = body == 0 ? 0.3 : 0.;
          parameters.yield_stress      = 0.4;
          parameters.hardening_modulus = 0.5;
          if (plastic)
            result.emplace_back(VonMises(parameters));
          else
            result.emplace_back(Hencky(parameters));
        }
      return result;
    }

    /** a = inertia u + constant, as all schemes have it. */
    std::vector<double>
    acceleration(const std::vector<double> &x) const
    {
      std::vector<double> result;
      if (setting.inertia > 0.)
        for (unsigned int i = 0; i < constant.size(); ++i)
          result.push_back(constant[i] + setting.inertia * x[i / dim * (dim + 1) + i % dim]);
      return result;
    }

    std::vector<double>
    residual(const std::vector<double> &x) const
    {
      return force_at(x, acceleration(x));
    }

    std::vector<double>
    force_at(const std::vector<double> &x, const std::vector<double> &a) const
    {
      std::vector<double> result(x.size(), 0.);
      PorousSize          size;
      outflow.assign(faces.size(), 0.);
      EXPECT_TRUE(force.add_residual(patch, pores, trial(x, a), result, outflow, size).ok());
      // the terms bound what is left of them
      double left = 0.;
      for (unsigned int i = 0; i < result.size(); ++i)
        left += i % (dim + 1) < dim ? result[i] * result[i] : 0.;
      EXPECT_LT(left, 4. * size.momentum);
      return result;
    }

    PorousTrial<dim>
    trial(const std::vector<double> &x, const std::vector<double> &a) const
    {
      PorousTrial<dim> result{x, a, setting.inertia, 0.3, 0.5, {}, faces, pressures, flows, 4.};
      for (int d = 0; d < dim; ++d)
        result.body_force[d] = 0.5 - d;
      return result;
    }

    /** Displacements of 0.03, pressures of order one. */
    std::vector<double>
    some_state() const
    {
      auto x = cloud.random_nodal(0.03, 1, dim + 1);
      for (unsigned int i = dim; i < x.size(); i += dim + 1)
        x[i] *= 30.;
      return x;
    }

    const Cloud<dim>              &cloud;
    const Setting                 &setting;
    Patch<dim>                     patch; ///< with histories
    StepPoints<dim>               &points;
    PorousForce<dim>               force;
    PorePoints<dim>                pores;
    std::vector<double>            constant; ///< of the nodal accelerations
    std::vector<SurfacePoint<dim>> faces;
    std::vector<double>            pressures; ///< prescribed there
    std::vector<SurfaceFlow>       flows;
    mutable std::vector<double>    outflow; ///< of the last force_at()
  };

  /** Each of the four blocks against central differences. */
  template <int dim>
  void
  check_tangent(const Problem<dim> &problem)
  {
    const Cloud<dim>         &cloud = problem.cloud;
    const std::vector<double> x     = problem.some_state();
    NodeMatrix<dim>           tangent;
    tangent.reinit(cloud.nodes.n_local(), dim + 1, 3);
    tangent.set_zero();
    const auto a = problem.acceleration(x);
    problem.force.add_tangent(problem.patch, problem.pores, problem.trial(x, a), tangent);
    const std::vector<int> strides = tangent.slot_strides(cloud.window());

    const double h             = 1e-5;
    double       largest[2][2] = {}, error[2][2] = {};
    for (unsigned int k = 0; k < x.size(); k += dim == 2 ? 1 : 17) // some columns of many
      {
        std::vector<double> plus = x, minus = x;
        plus[k] += h;
        minus[k] -= h;
        const auto         r_plus = problem.residual(plus), r_minus = problem.residual(minus);
        const unsigned int j = k / (dim + 1), m = k % (dim + 1);
        for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
          for (unsigned int c = 0; c <= dim; ++c)
            {
              double entry = 0.;
              for (unsigned int s = 0; s < tangent.n_slots(); ++s)
                if (static_cast<int>(cloud.nodes.window_node(i)) + strides[s] ==
                    static_cast<int>(cloud.nodes.window_node(j)))
                  entry = tangent.row(i, c)[s * (dim + 1) + m];
              const unsigned int row        = i * (dim + 1) + c;
              const double       difference = (r_plus[row] - r_minus[row]) / (2. * h);
              const bool         p = c == dim, q = m == dim;
              largest[p][q] = std::max(largest[p][q], std::abs(entry));
              error[p][q]   = std::max(error[p][q], std::abs(entry - difference));
            }
      }
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        {
          // differences: round-off 1e-16/h and curvature h^2 of residuals of 0.1, both 1e-11
          EXPECT_GT(largest[p][q], 1e-4);
          EXPECT_LT(error[p][q], 1e-7 * largest[p][q]) << "block " << p << q;
        }
  }

  template <int dim>
  void
  check_all_tangents(const bool plastic)
  {
    for (unsigned int b = 0; b < all_bases.size(); ++b)
      for (const Setting &setting : settings())
        {
          SCOPED_TRACE(setting.name + ", basis " + std::to_string(b));
          const Cloud<dim> cloud(all_bases[b], 2, 31 + b);
          check_tangent(Problem<dim>(cloud, setting, plastic));
        }
  }
} // namespace

TYPED_TEST_SUITE(PorousForceTest, Dimensions);

TYPED_TEST(PorousForceTest, TangentIsTheResidualsSlope)
{
  check_all_tangents<TypeParam::value>(false);
}

TYPED_TEST(PorousForceTest, TangentIsTheResidualsSlopeWhereItYields)
{
  check_all_tangents<TypeParam::value>(true);
}

// a dry body beside a saturated one, with a storage that counts
TYPED_TEST(PorousForceTest, TangentIsTheResidualsSlopeBesideADryBody)
{
  constexpr int dim = TypeParam::value;
  for (const Setting &setting : settings())
    {
      SCOPED_TRACE(setting.name);
      const Cloud<dim> cloud(all_bases[2], 2, 33);
      check_tangent(Problem<dim>(cloud, setting, false, 0.3));
    }
}

// N - N^0: no constant has a share in it, and of a linear pressure it is what the point's has
// beside the means of the cells that its domain touches, by its lengths in them
TYPED_TEST(PorousForceTest, FluctuationsAreThoseBesideTheMeansOfCells)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int b = 0; b < all_bases.size(); ++b)
    {
      SCOPED_TRACE("basis " + std::to_string(b));
      const Cloud<dim>          cloud(all_bases[b], 2, 31 + b);
      const auto               &lattice = cloud.grid.lattice();
      const std::vector<double> one(cloud.nodes.n_local(), 1.);
      for (const double value : PorousForce<dim>::fluctuations(cloud.patch, one))
        EXPECT_NEAR(value, 0., 1e-14); // 64 roundings of values below 1
      for (int d = 0; d < dim; ++d)
        {
          std::vector<double> x(cloud.nodes.n_local());
          for (unsigned int i = 0; i < x.size(); ++i)
            x[i] = cloud.node_position(i)[d];
          const auto values = PorousForce<dim>::fluctuations(cloud.patch, x);
          for (const auto &batch : cloud.step.batches)
            for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
              {
                const double at   = cloud.step.location[slot][d];
                const auto   low  = lattice.cell_of(cloud.step.location[slot]);
                const double half = all_bases[b][batch.body] == BasisKind::linear
                                      ? 0.
                                      : effective_half_length(
                                          lattice,
                                          at,
                                          cloud.records[cloud.step.id[slot]].state.half_lengths[d],
                                          d);
                double       mean = 0.;
                for (int cell = low[d] - 1; cell <= low[d] + 1; ++cell)
                  {
                    const double begin = lattice.origin[d] + cell * lattice.h[d];
                    const double part =
                      std::min(at + half, begin + lattice.h[d]) - std::max(at - half, begin);
                    const double share = half > 0.        ? std::max(0., part) / (2. * half)
                                         : cell == low[d] ? 1.
                                                          : 0.;
                    mean += share * (begin + 0.5 * lattice.h[d]);
                  }
                // domains that pass a line or a kink by 1e-4 h at most are shortened to it
                EXPECT_NEAR(values[slot], at - mean, 1e-3 * lattice.h[d]);
              }
        }
    }
}

TYPED_TEST(PorousForceTest, VolumeOfFluidChangesByItsContentAlone)
{
  constexpr int dim = TypeParam::value;
  for (const Setting &setting : settings())
    {
      const Cloud<dim>   cloud({BasisKind::gimp, BasisKind::linear}, 2, 5);
      const Problem<dim> problem(cloud, setting, false);
      const auto         x = problem.some_state(), a = problem.acceleration(x);
      const auto         residual = problem.residual(x);
      double             sum = 0., expected = 0., terms = 0.;
      for (unsigned int i = dim; i < residual.size(); i += dim + 1)
        {
          sum += residual[i];
          terms += std::abs(residual[i]);
        }
      // fluxes and stabilisation only move fluid: what is left is V0 dt m'/rho_0, and what
      // leaves through the surfaces
      expected       = std::accumulate(problem.outflow.begin(), problem.outflow.end(), 0.);
      double through = 0.;
      for (const double volume : problem.outflow)
        through += std::abs(volume);
      EXPECT_GT(through, 1e-3);
      std::vector<PoreUpdate<dim>> updates;
      problem.force.evaluate_updates(problem.patch, problem.pores, problem.trial(x, a), updates);
      for (const auto &batch : problem.points.batches)
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const Soil  &soil      = problem.force.soils()[batch.body];
            const auto  &fluid     = soil.fluid;
            const double V         = problem.points.volume[slot];
            const double grains    = 1. - fluid.initial_porosity;
            const double content_n = fluid.density(problem.pores.pressure[slot]) *
                                     (problem.points.determinant[slot] - grains);
            const double content =
              updates[slot].mass / V - soil.grain_density * grains; // at the end
            double rate = (content - content_n) / 0.3;
            if (problem.force.scheme().carries_rates)
              rate = problem.force.scheme().end_rate(content - content_n,
                                                     problem.pores.rate[slot],
                                                     problem.pores.rate_change[slot],
                                                     0.3);
            expected += V * 0.3 * rate / fluid.reference_density;
          }
      // a hundred terms, each good to 1e-16; mass less mass loses another digit
      EXPECT_NEAR(sum, expected, 1e-14 * terms) << setting.name;
      EXPECT_GT(terms, 0.02);
    }
}

// of a seepage face what would leave leaves, what would come in does not
TYPED_TEST(PorousForceTest, SeepageFacesLetNothingIn)
{
  constexpr int    dim     = TypeParam::value;
  const Setting    setting = settings()[0];
  const Cloud<dim> cloud({BasisKind::gimp, BasisKind::linear}, 2, 5);
  Problem<dim>     problem(cloud, setting, false);
  for (std::size_t f = 0; f < problem.pressures.size(); f += 2)
    problem.pressures[f] = -10.; // sucks fluid out, the others let some in
  const auto x            = problem.some_state();
  const auto outflow_with = [&](const SurfaceFlow flow) {
    problem.flows.assign(problem.faces.size(), flow);
    problem.residual(x);
    return problem.outflow;
  };
  const auto open    = outflow_with(SurfaceFlow::both_ways),
             seepage = outflow_with(SurfaceFlow::one_way),
             closed  = outflow_with(SurfaceFlow::closed);
  unsigned int n_in  = 0;
  for (std::size_t f = 0; f < open.size(); ++f)
    {
      n_in += open[f] < 0.;
      EXPECT_EQ(seepage[f], std::max(open[f], 0.));
      EXPECT_EQ(closed[f], 0.);
    }
  EXPECT_GT(n_in, 0u);
  EXPECT_LT(n_in, open.size());
}

TYPED_TEST(PorousForceTest, NothingMovesInAFreeFall)
{
  constexpr int    dim     = TypeParam::value;
  const Setting    setting = settings()[1];
  const Cloud<dim> cloud({BasisKind::gimp, BasisKind::linear}, 2, 5);
  Problem<dim>     problem(cloud, setting, false);
  problem.faces.clear();
  std::vector<double> x(cloud.nodes.n_local() * (dim + 1), 0.), a;
  for (auto &state : problem.points.stress_state)
    {
      state = {};
      for (int d = 0; d < dim; ++d)
        {
          state.elastic_frame[d][d] = state.squared_stretch[d]        = 1.;
          state.elastic_left_cauchy_green[symmetric_index<dim>(d, d)] = 1.;
        }
    }
  std::fill(problem.pores.pressure.begin(), problem.pores.pressure.end(), 0.);
  std::fill(problem.pores.fluctuation.begin(), problem.pores.fluctuation.end(), 0.);
  std::fill(problem.pores.rate.begin(), problem.pores.rate.end(), 0.);
  std::fill(problem.pores.rate_change.begin(), problem.pores.rate_change.end(), 0.);
  for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
    for (int d = 0; d < dim; ++d)
      {
        x[i * (dim + 1) + d] = 0.2 + 0.1 * d;
        a.push_back(problem.trial(x, {}).body_force[d]);
      }
  const auto residual = problem.force_at(x, a);
  // a = f, u the same everywhere, p = 0: round-off of u/h times stiffness and volume
  for (const double r : residual)
    EXPECT_NEAR(r, 0., 1e-15);
}
