#include <kedge/rigid/rigid_distance.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  /** A box of edges 2 about the centre (3, 1, 0), turned by 45 degrees about z. */
  template <int dim>
  RigidBodies<dim>
  turned_box()
  {
    dealii::Point<dim> low, high;
    for (int d = 0; d < dim; ++d)
      {
        low[d]  = -1.;
        high[d] = 1.;
      }
    const double half = std::atan(1.) / 2.; // of the angle
    RigidBody    body;
    body.state.centre   = dealii::Point<3>(3., 1., 0.);
    body.state.attitude = {{std::cos(half), 0., 0., std::sin(half)}};
    RigidBodies<dim> bodies(1., MPI_COMM_SELF);
    bodies.append(body, mesh_of_box<dim>(low, high, 0.5));
    return bodies;
  }
} // namespace

// Expected values are those of the square with corners sqrt(2) from its centre along x and y.
TEST(RigidDistance, IsThatFromTheNearestFacetWhereTheBodyStands)
{
  const double root = std::sqrt(2.);
  const auto   distance =
    distances_to_surfaces<2>(turned_box<2>(),
                             {dealii::Point<2>(3. + root + 0.7, 1.), // off a corner
                              dealii::Point<2>(5., 3.),              // off the middle of an edge
                              dealii::Point<2>(3., 1.)});            // its centre
  EXPECT_NEAR(distance[0], 0.7, 1e-14);
  EXPECT_NEAR(distance[1], 2. * root - 1., 1e-14);
  EXPECT_NEAR(distance[2], 1., 1e-14);

  const auto in_space = distances_to_surfaces<3>(turned_box<3>(),
                                                 {dealii::Point<3>(3. + root + 0.3, 1., 1.4),
                                                  dealii::Point<3>(3.1, 1.1, -4.)});
  EXPECT_NEAR(in_space[0], 0.5, 1e-14); // 0.3 and 0.4 off a corner
  EXPECT_NEAR(in_space[1], 3., 1e-14);
}

TEST(RigidDistance, WithoutShapesItIsAsFarAsCanBe)
{
  const RigidBodies<2> none(1., MPI_COMM_SELF);
  EXPECT_EQ(distances_to_surfaces<2>(none, {dealii::Point<2>(1., 2.)})[0],
            std::numeric_limits<double>::max());
}
