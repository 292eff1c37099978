#include <kedge/geometry/mesh_moments.h>

#include <gtest/gtest.h>

namespace kedge
{
  namespace
  {
    TEST(MeshMoments, OfABoxAboutItsCorner)
    {
      const dealii::Point<3>     corner(1., 2., 3.), size(1., 2., 4.);
      const SurfaceMesh<3>       mesh = mesh_of_box<3>(corner, corner + size, 0.7);
      const VolumeMoments<3>     from = moments_of(mesh, dealii::Point<3>(-3., 5., 0.));
      const dealii::Tensor<1, 3> centre =
        dealii::Point<3>(-3., 5., 0.) + from.centre() - corner - 0.5 * size;
      EXPECT_NEAR(from.volume, 8., 1e-12);
      EXPECT_NEAR(centre.norm(), 0., 1e-12);
      const auto about = from.about(from.centre()), exact = VolumeMoments<3>::of_box(0.5 * size);
      EXPECT_NEAR((about.second - exact.second).norm(), 0., 1e-11);
    }

    TEST(MeshMoments, OfATriangle)
    {
      const SurfaceMesh<2> mesh =
        mesh_of_polygon({dealii::Point<2>(0, 0), dealii::Point<2>(3, 0), dealii::Point<2>(0, 2)},
                        10.);
      const VolumeMoments<2> about = moments_of(mesh, dealii::Point<2>());
      EXPECT_NEAR(about.volume, 3., 1e-14);
      EXPECT_NEAR(about.centre()[0], 1., 1e-14);
      EXPECT_NEAR(about.second[0][0], 27. * 2. / 12., 1e-13); // b^3 h / 12
      EXPECT_NEAR(about.second[0][1], 9. * 4. / 24., 1e-13);  // b^2 h^2 / 24
    }
  } // namespace
} // namespace kedge
