// Pore pressures from points to nodes.
#include "../transfer/cloud.h"

#include <kedge/porous/pressure_mapping.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  /** Largest difference from a linear pressure of what a mapping makes of its values. */
  template <int dim>
  double
  error_of_linear(const PressureMap kind, const BasisKind basis, const double slope)
  {
    const Cloud<dim> cloud({basis}, 3, 5, 3, 0.3); // badly filled nodes follow others
    const auto       exact = [&](const dealii::Point<dim> &x) {
      double p = 2.;
      for (int d = 0; d < dim; ++d)
        p += slope * (d + 1) * x[d];
      return p;
    };
    std::vector<double> pressure, unknowns(std::size_t(cloud.nodes.n_local()) * (dim + 1), 7.);
    for (unsigned int slot = 0; slot < cloud.step.size(); ++slot)
      pressure.push_back(exact(cloud.step.location[slot]));
    PressureMapping<dim> mapping(kind);
    mapping.map(cloud.patch, pressure, 3, unknowns);
    double error = 0.;
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      {
        const double *x = &unknowns[std::size_t(i) * (dim + 1)];
        for (int d = 0; d < dim; ++d)
          EXPECT_EQ(x[d], 7.); // displacements are none of its business
        error = std::max(error, std::abs(x[dim] - exact(cloud.node_position(i))));
      }
    return dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
  }
} // namespace

TEST(PorousPressureMappingMpi, ConsistentIsExactForLinearPressures)
{
  // pressures of size 10; conjugate gradients stop at 1e-12 of their residual, which a
  // condition number of some 1e2 of the scaled matrix makes 1e-10 of the pressure; that of splines'
  // is 15 times as high in space (7.5 per direction within a body, where linear functions have 3)
  for (const auto basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    {
      const double tolerance = basis == BasisKind::spline ? 1.5e-7 : 1e-8;
      EXPECT_LT(error_of_linear<2>(PressureMap::consistent, basis, 1.), tolerance);
      EXPECT_LT(error_of_linear<3>(PressureMap::consistent, basis, 1.), tolerance);
    }
}

TEST(PorousPressureMappingMpi, LumpedIsExactForConstantPressuresAlone)
{
  for (const auto basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    {
      EXPECT_LT(error_of_linear<2>(PressureMap::lumped, basis, 0.), 1e-12);
      // at the rim it is the mean over half a cell or more: a quarter of 0.5 m off at least
      EXPECT_GT(error_of_linear<2>(PressureMap::lumped, basis, 1.), 0.125);
    }
}
