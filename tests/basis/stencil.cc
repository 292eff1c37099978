#include "direct.h"

#include <gtest/gtest.h>

#include <random>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class BasisStencil : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Five cells of 0.7 x 0.5 x 0.6 m; @p n_cells of them in y and z. */
  template <int dim>
  Lattice<dim>
  make_lattice(const unsigned int n_cells = 4)
  {
    const double        h[3] = {0.7, 0.5, 0.6}, origin[3] = {-0.3, 0.2, 1.1};
    GridParameters<dim> parameters;
    for (int d = 0; d < dim; ++d)
      {
        parameters.n_cells[d] = d == 0 ? 5 : n_cells;
        parameters.origin[d]  = origin[d];
        parameters.extent[d]  = h[d] * parameters.n_cells[d];
      }
    return Lattice<dim>(parameters);
  }

  /** The window of the whole box. */
  template <int dim>
  LatticeWindow<dim>
  whole(const Lattice<dim> &lattice)
  {
    LatticeWindow<dim> window;
    for (int d = 0; d < dim; ++d)
      window.n_cells[d] = std::max(2, lattice.n_cells[d]);
    return window;
  }

  struct Sampler
  {
    std::mt19937 generator{3};

    double
    operator()(const double low, const double high)
    {
      return std::uniform_real_distribution<double>(low, high)(generator);
    }
  };

  /** Random places in the box and half lengths of up to 0.7 cells (0.5 counts). */
  template <int dim, typename Check>
  void
  for_many_points(const unsigned int n_cells, const Check &check)
  {
    const auto lattice = make_lattice<dim>(n_cells);
    Sampler    random;
    for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
      for (int repeat = 0; repeat < 500; ++repeat)
        {
          dealii::Point<dim>     x;
          dealii::Tensor<1, dim> half;
          for (int d = 0; d < dim; ++d)
            {
              x[d]    = random(lattice.origin[d], lattice.upper(d));
              half[d] = random(0., 0.7) * lattice.h[d];
            }
          check(lattice, basis, x, half, make_stencil(basis, lattice, whole(lattice), x, half));
        }
  }

  /** Lattice index of the stencil's lowest node. */
  template <int dim>
  LatticeIndex<dim>
  first_index(const Lattice<dim> &lattice, const Stencil<dim> &stencil)
  {
    return whole(lattice).node_index(stencil.first_node);
  }
} // namespace

TYPED_TEST_SUITE(BasisStencil, Dimensions);

TYPED_TEST(BasisStencil, SumsToOneAndReproducesLinearFields)
{
  constexpr int dim = TypeParam::value;
  for (const unsigned int n_cells : {4u, 1u}) // 1: grids one cell wide
    for_many_points<dim>(
      n_cells,
      [](const auto &lattice, BasisKind, const auto &x, const auto &, const auto &stencil) {
        const auto first = first_index<dim>(lattice, stencil);
        for (int d = 0; d < dim; ++d)
          {
            double one = 0., zero = 0., position = 0., slope = 0.;
            for (int i = 0; i < stencil_width(stencil.pattern, d); ++i)
              {
                const double node = lattice.origin[d] + (first[d] + i) * lattice.h[d];
                one += stencil.value[d][i];
                zero += stencil.slope[d][i];
                position += stencil.value[d][i] * node;
                slope += stencil.slope[d][i] * node;
                EXPECT_GE(stencil.value[d][i], -1e-16); // splines: a difference of 1/8s at a side
                EXPECT_GE(first[d], 0);
                EXPECT_LE(first[d] + i, lattice.n_cells[d]);
              }
            // a few roundings of values of order 1
            EXPECT_NEAR(one, 1., 1e-15);
            EXPECT_NEAR(zero, 0., 2e-15);
            EXPECT_NEAR(position, x[d], 5e-15);
            EXPECT_NEAR(slope, 1., 2e-14);
          }
      });
}

TYPED_TEST(BasisStencil, IsTheMeanOfItsFunctionOverTheDomain)
{
  constexpr int dim = TypeParam::value;
  for_many_points<dim>(4,
                       [](const auto     &lattice,
                          const BasisKind basis,
                          const auto     &x,
                          const auto     &half,
                          const auto     &stencil) {
                         const auto first = first_index<dim>(lattice, stencil);
                         for (int d = 0; d < dim; ++d)
                           for (int node = 0; node <= lattice.n_cells[d]; ++node)
                             {
                               const int  i      = node - first[d];
                               const bool inside = i >= 0 && i < stencil_width(stencil.pattern, d);
                               // roundings; the mean divides by l >= 1e-3/2 where it is used
                               EXPECT_NEAR(
                                 inside ? stencil.value[d][i] : 0.,
                                 direct_factor<dim>(basis, lattice, x[d], half[d], node, d),
                                 1e-12);
                             }
                       });
}

TYPED_TEST(BasisStencil, SlopeIsTheDifferenceOfValues)
{
  constexpr int dim       = TypeParam::value;
  int           n_checked = 0;
  for_many_points<dim>(
    4,
    [&](const auto &lattice, const BasisKind basis, const auto &x, auto half, const auto &stencil) {
      for (int d = 0; d < dim; ++d)
        {
          const double h = 1e-6;
          if (effective_half_length(lattice, x[d], half[d], d) <
              std::min(half[d], 0.5 * lattice.h[d]))
            continue; // clipped at the box: its length changes with x
          dealii::Point<dim> low = x, high = x;
          low[d] -= h;
          high[d] += h;
          const auto below = make_stencil(basis, lattice, whole(lattice), low, half);
          const auto above = make_stencil(basis, lattice, whole(lattice), high, half);
          if (below.first_node != stencil.first_node || above.first_node != stencil.first_node ||
              below.pattern != stencil.pattern || above.pattern != stencil.pattern)
            continue; // a kink, or where the stencil is snapped to a grid line
          ++n_checked;
          for (int i = 0; i < stencil_width(stencil.pattern, d); ++i)
            // values are at most cubic in x: h^2 and round-off of 1e-16/h
            EXPECT_NEAR((above.value[d][i] - below.value[d][i]) / (2. * h),
                        stencil.slope[d][i],
                        1e-8);
        }
    });
  EXPECT_GT(n_checked, 500);
}

TYPED_TEST(BasisStencil, HasTheCorrectedCentralBranch)
{
  constexpr int      dim     = TypeParam::value;
  const auto         lattice = make_lattice<dim>();
  dealii::Point<dim> x       = lattice.node_position(LatticeIndex<dim>{});
  auto               half    = 0.25 * lattice.h;
  for (int d = 0; d < dim; ++d)
    x[d] += 2.1 * lattice.h[d];
  const auto stencil = gimp_stencil(lattice, whole(lattice), x, half);
  EXPECT_EQ(stencil.pattern, uniform_pattern<dim>(3));
  for (int d = 0; d < dim; ++d)
    {
      EXPECT_EQ(first_index(lattice, stencil)[d], 1);
      // xi = 0.1 h, l = h/4: 1 - xi^2/(2 h l) - l/(2 h) = 1 - 0.02 - 0.125; the print has + xi^2
      EXPECT_NEAR(stencil.value[d][1], 0.855, 1e-14);
      // outer branch (h + l - |xi|)^2/(4 h l) at |xi| = 1.1 h and 0.9 h
      EXPECT_NEAR(stencil.value[d][0], 0.0225, 1e-14);
      EXPECT_NEAR(stencil.value[d][2], 0.1225, 1e-14);
      // slopes: -xi/(h l), -+(h + l - |xi|)/(2 h l)
      EXPECT_NEAR(stencil.slope[d][1] * lattice.h[d], -0.4, 1e-13);
      EXPECT_NEAR(stencil.slope[d][0] * lattice.h[d], -0.3, 1e-13);
      EXPECT_NEAR(stencil.slope[d][2] * lattice.h[d], 0.7, 1e-13);
    }
}

TYPED_TEST(BasisStencil, ShrinksDomainsAtTheBoxsBorder)
{
  constexpr int dim     = TypeParam::value;
  const auto    lattice = make_lattice<dim>();
  for (const bool high : {false, true})
    for (const double distance : {0., 1e-14, 0.1, 0.3})
      {
        dealii::Point<dim> x;
        for (int d = 0; d < dim; ++d)
          x[d] = high ? lattice.upper(d) - distance * lattice.h[d]
                      : lattice.origin[d] + distance * lattice.h[d];
        const auto gimp   = gimp_stencil(lattice, whole(lattice), x, 0.5 * lattice.h);
        const auto linear = linear_stencil(lattice, whole(lattice), x);
        // a domain of half length = distance stays in the border cell, where N is linear
        EXPECT_EQ(gimp.pattern, 0u);
        EXPECT_EQ(gimp.first_node, linear.first_node);
        for (int d = 0; d < dim; ++d)
          {
            EXPECT_EQ(first_index(lattice, gimp)[d], high ? lattice.n_cells[d] - 1 : 0);
            EXPECT_NEAR(gimp.value[d][high ? 1 : 0], 1. - distance, 2e-14);
          }
      }
}

TYPED_TEST(BasisStencil, SnapsToGridLinesThatItHardlyPasses)
{
  constexpr int      dim     = TypeParam::value;
  const auto         lattice = make_lattice<dim>();
  dealii::Point<dim> x       = lattice.node_position(LatticeIndex<dim>{});
  for (int d = 0; d < dim; ++d)
    x[d] += 2.2 * lattice.h[d];
  const auto linear = linear_stencil(lattice, whole(lattice), x);
  const auto less =
    gimp_stencil(lattice, whole(lattice), x, (0.2 + 0.999 * gimp_smallest_overlap) * lattice.h);
  const auto more =
    gimp_stencil(lattice, whole(lattice), x, (0.2 + 1.001 * gimp_smallest_overlap) * lattice.h);
  EXPECT_EQ(less.pattern, 0u);
  EXPECT_EQ(more.pattern, uniform_pattern<dim>(3));
  for (int d = 0; d < dim; ++d)
    {
      EXPECT_EQ(less.value[d][0], linear.value[d][0]);
      EXPECT_EQ(less.slope[d][1], linear.slope[d][1]);
      // the jump at the limit: an overlap s gives the far node s^2/(4 l), l = 0.2, and slope
      // s/(2 l), here within the 0.1 % by which s passes the limit, and the change of l
      const double s = gimp_smallest_overlap;
      EXPECT_NEAR(more.value[d][0], s * s / 0.8, 0.01 * s * s / 0.8);
      EXPECT_NEAR(more.slope[d][0] * lattice.h[d], -s / 0.4, 0.01 * s / 0.4);
    }
}

TYPED_TEST(BasisStencil, SplinesReproduceQuadraticFieldsAwayFromTheSides)
{
  constexpr int dim     = TypeParam::value;
  const auto    lattice = make_lattice<dim>();
  Sampler       random;
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      dealii::Point<dim>     x;
      dealii::Tensor<1, dim> half;
      for (int d = 0; d < dim; ++d)
        {
          x[d]    = lattice.origin[d] + random(1.2, lattice.n_cells[d] - 1.2) * lattice.h[d];
          half[d] = random(0., 0.5) * lattice.h[d];
        }
      const auto stencil = spline_stencil(lattice, whole(lattice), x, half);
      const auto first   = first_index<dim>(lattice, stencil);
      for (int d = 0; d < dim; ++d)
        {
          // sum_i (i^2 - 1/4) N(t - i) = t^2: the coefficients of quadratics by Marsden's identity;
          // its mean over the domain is x^2 + l^2/3, its mean slope 2 x
          double       value = 0., slope = 0.;
          const double h = lattice.h[d];
          for (int i = 0; i < stencil_width(stencil.pattern, d); ++i)
            {
              const double s           = lattice.origin[d] + (first[d] + i) * h - x[d];
              const double coefficient = s * s - 0.25 * h * h;
              value += stencil.value[d][i] * coefficient;
              slope += stencil.slope[d][i] * coefficient;
            }
          EXPECT_NEAR(value / (h * h), half[d] * half[d] / (3. * h * h), 1e-4 / 3.); // snapped
          EXPECT_NEAR(slope / h, 0., 1e-13);
        }
    }
}

TYPED_TEST(BasisStencil, SplinesAtASideAreThoseOfItsNodes)
{
  constexpr int dim     = TypeParam::value;
  const auto    lattice = make_lattice<dim>();
  for (const bool high : {false, true})
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = high ? lattice.upper(d) : lattice.origin[d];
      const auto stencil = spline_stencil(lattice, whole(lattice), x, 0.3 * lattice.h);
      EXPECT_EQ(stencil.pattern, 0u); // straight over half a cell, by u_{-1} = 2 u_0 - u_1
      for (int d = 0; d < dim; ++d)
        EXPECT_NEAR(stencil.value[d][high ? 1 : 0], 1., 1e-14);
    }
}

TYPED_TEST(BasisStencil, QuadraticElementsReproduceQuadraticFieldsAndAreOneAtTheirNodes)
{
  constexpr int       dim = TypeParam::value;
  GridParameters<dim> parameters;
  for (int d = 0; d < dim; ++d)
    {
      parameters.n_cells[d] = 3;
      parameters.origin[d]  = -0.4;
      parameters.extent[d]  = 2.1;
    }
  parameters.node_intervals = 2;
  const Lattice<dim> lattice(parameters);
  Sampler            random;
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = sample == 0 ? lattice.origin[d] + lattice.h[d]
                           : random(lattice.origin[d], lattice.upper(d));
      const auto stencil = quadratic_stencil(lattice, whole(lattice), x);
      const auto first   = first_index<dim>(lattice, stencil);
      for (int d = 0; d < dim; ++d)
        {
          // moments of 1, x, x^2 and their derivatives, about the place itself
          double value[3] = {0., 0., 0.}, slope[3] = {0., 0., 0.};
          for (int i = 0; i < 3; ++i)
            {
              const double s = lattice.origin[d] + (first[d] + i) * lattice.h[d] - x[d];
              for (int k = 0; k < 3; ++k)
                {
                  value[k] += stencil.value[d][i] * std::pow(s, k);
                  slope[k] += stencil.slope[d][i] * std::pow(s, k);
                }
              if (sample == 0) // the middle node of the first element
                {
                  EXPECT_NEAR(stencil.value[d][i], i == 1 ? 1. : 0., 1e-15);
                }
            }
          EXPECT_EQ(first[d] % 2, 0);
          // a few roundings of values of order 1 and of slopes up to 4/0.7
          for (int k = 0; k < 3; ++k)
            {
              EXPECT_NEAR(value[k], k == 0 ? 1. : 0., 5e-15);
              EXPECT_NEAR(slope[k], k == 1 ? 1. : 0., 2e-14);
            }
        }
    }
}
