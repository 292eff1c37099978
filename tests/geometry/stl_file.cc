#include "../io/scratch_folder.h"
#include "surface_shapes.h"

#include <kedge/geometry/stl_file.h>

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

using namespace surface_tests;

namespace
{
  const std::string ascii_facet = "facet normal 0 0 0\n outer loop\n  vertex 0 0 0\n"
                                  "  vertex 1.5e0 0 0\n  vertex 0 -2 .25\n endloop\nendfacet\n";

  std::string
  binary(const std::vector<Triangle> &triangles, const std::uint32_t announced)
  {
    std::string content(84 + 50 * triangles.size(), '\0');
    content.replace(0, 5, "solid"); // as some programs begin binary files
    std::memcpy(&content[80], &announced, 4);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (unsigned int corner = 0; corner < 3; ++corner)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const float value = static_cast<float>(triangles[i][corner][d]);
            std::memcpy(&content[84 + 50 * i + 12 + 12 * corner + 4 * d], &value, 4);
          }
    return content;
  }

  class GeometryStl : public testing::Test
  {
  protected:
    std::filesystem::path
    file(const std::string &content) const
    {
      const auto path = folder.path() / "part.stl";
      std::ofstream(path, std::ios::binary) << content;
      return path;
    }

    std::string
    message_of(const std::string &content) const
    {
      try
        {
          read_stl(file(content));
        }
      catch (const UserError &error)
        {
          return error.what();
        }
      return "";
    }

    void
    expect_refused(const std::string &content, const std::string &part) const
    {
      EXPECT_NE(message_of(content).find(part), std::string::npos) << message_of(content);
    }

    void
    SetUp() override
    {
      std::filesystem::create_directories(folder.path());
    }

    test::ScratchFolder folder;
  };
} // namespace

TEST_F(GeometryStl, BothKindsAreRead)
{
  const auto cube = box({0., -1., .5}, {1., 2., 4.}); // numbers that a float holds
  EXPECT_EQ(read_stl(file(binary(cube, 12))), cube);

  const auto triangles = read_stl(file("solid a part\n" + ascii_facet + "endsolid a part\n"));
  ASSERT_EQ(triangles.size(), 1u);
  EXPECT_EQ(triangles[0][1], Point<3>(1.5, 0., 0.));
  EXPECT_EQ(triangles[0][2], Point<3>(0., -2., .25));
}

TEST_F(GeometryStl, WrongFilesAreRefused)
{
  EXPECT_THROW(read_stl(folder.path() / "none.stl"), UserError);
  EXPECT_THROW(read_stl(folder.path()), UserError);
  expect_refused("", "no STL file");
  expect_refused("ply\n", "no STL file");
  expect_refused(binary(box({0., 0., 0.}, {1., 1., 1.}), 13), "no facet"); // cut short: text
  expect_refused("solid\nendsolid\n", "no facet");
  expect_refused("solid\n" + ascii_facet, "ends within facet 1");
  expect_refused("solid\n" + ascii_facet + "facet\nvertex 0 0\nendfacet\nendsolid", "Facet 2 of '");
  expect_refused("solid\nfacet\nvertex 0 0 0\nendfacet\nendsolid", "1 corners instead of 3");
  auto with_nan     = box({0., 0., 0.}, {1., 1., 1.});
  with_nan[4][1][2] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(binary(with_nan, 12), "Facet 5 of '");
}
