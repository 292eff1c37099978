#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/point_fields.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace kedge;

namespace
{
  template <int dim>
  double
  value(const std::string &name, const PointRecord<dim> &point)
  {
    return point_quantity<dim>(name)(point);
  }
} // namespace

TEST(IoPointFields, AllPromisedNamesExist)
{
  // The names a scene may ask for.
  for (const char *name : {"displacement",
                           "velocity",
                           "acceleration",
                           "kirchhoff_stress",
                           "cauchy_stress",
                           "pressure",
                           "von_mises_stress",
                           "deformation_gradient",
                           "det_F",
                           "strain_energy",
                           "kinetic_energy",
                           "mass",
                           "volume",
                           "half_lengths",
                           "body",
                           "id",
                           "equivalent_plastic_strain",
                           "plastic_dissipation"})
    {
      EXPECT_EQ(point_field<2>(name).name, name);
      EXPECT_EQ(point_field<3>(name).name, name);
    }
  std::set<std::string> seen;
  for (const auto &field : point_fields<3>())
    for (const auto &component : field.components())
      EXPECT_TRUE(seen.insert(field.component_name(component)).second);
}

TEST(IoPointFields, PlaneStrainStressHasAllItsParts)
{
  PointRecord<2> point                      = test::make_points<2>(1)[0]; // det F = 2
  point.state.kirchhoff_stress[0][0]        = 2;
  point.state.kirchhoff_stress[1][1]        = 4;
  point.state.kirchhoff_stress[0][1]        = 6;
  point.state.out_of_plane_kirchhoff_stress = 12;
  // Cauchy = Kirchhoff / 2: xx 1, yy 2, zz 6, xy 3; -tr/3 = -3;
  // 3/2 s:s with s = (-2, -1, 3, shear 3): 1.5 (4 + 1 + 9 + 2*9) = 48.
  // The tolerance is round-off of numbers of size 10.
  EXPECT_DOUBLE_EQ(value<2>("cauchy_stress_xx", point), 1);
  EXPECT_DOUBLE_EQ(value<2>("cauchy_stress_yy", point), 2);
  EXPECT_DOUBLE_EQ(value<2>("cauchy_stress_zz", point), 6);
  EXPECT_DOUBLE_EQ(value<2>("cauchy_stress_xy", point), 3);
  EXPECT_DOUBLE_EQ(value<2>("kirchhoff_stress_zz", point), 12);
  EXPECT_DOUBLE_EQ(value<2>("pressure", point), -3);
  EXPECT_NEAR(value<2>("von_mises_stress", point), std::sqrt(48.), 1e-14);
  EXPECT_THROW(point_quantity<2>("cauchy_stress_xz"), UserError); // constant in the plane
  EXPECT_THROW(point_quantity<2>("displacement_z"), UserError);
}

TEST(IoPointFields, ThreeDimensionalValues)
{
  PointRecord<3> point               = test::make_points<3>(1)[0]; // det F = 2
  point.state.kirchhoff_stress       = 0;
  point.state.kirchhoff_stress[1][2] = 2;
  point.state.kirchhoff_stress[0][2] = 4;
  point.state.kirchhoff_stress[2][2] = 6;
  EXPECT_DOUBLE_EQ(value<3>("cauchy_stress_yz", point), 1);
  EXPECT_DOUBLE_EQ(value<3>("cauchy_stress_xz", point), 2);
  EXPECT_DOUBLE_EQ(value<3>("cauchy_stress_zz", point), 3);
  // s = (-1, -1, 2), shears 1 and 2: 3/2 (6 + 2*(1 + 4)) = 24
  EXPECT_NEAR(value<3>("von_mises_stress", point), std::sqrt(24.), 1e-14);
  EXPECT_EQ(value<3>("displacement_z", point), point.state.displacement[2]);
  EXPECT_EQ(value<3>("deformation_gradient_xy", point), 0.5);
  EXPECT_DOUBLE_EQ(value<3>("volume", point), 2 * point.state.reference_volume);

  point.state.mass             = 3;
  point.state.reference_volume = 6;
  point.state.velocity[0]      = 2;
  point.state.velocity[1]      = 0;
  point.state.velocity[2]      = 0;
  EXPECT_DOUBLE_EQ(value<3>("kinetic_energy", point), 1); // 1/2 * 3 * 4 / 6
}

TEST(IoPointFields, UnknownNameNamesTheNearest)
{
  try
    {
      point_quantity<2>("cauchy_stres_yy");
      FAIL() << "no error";
    }
  catch (const UserError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("Did you mean 'cauchy_stress_yy'"), std::string::npos) << message;
    }
  EXPECT_THROW(point_field<2>("cauchy_stress_yy"), UserError); // fields go whole into files
}
