// Points of bodies whose surface cuts cells: they weigh what the body weighs. Expected
// values are closed forms of the shapes; tolerances of mass and centre are what users are
// promised, 1e-6 of the body, at four cells across.
#include <kedge/base/exceptions.h>
#include <kedge/points/generation.h>

#include <gtest/gtest.h>

using namespace kedge;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  template <int dim>
  Lattice<dim>
  lattice_of(const unsigned int n_cells, const double edge = 1.)
  {
    GridParameters<dim> grid;
    for (unsigned int d = 0; d < dim; ++d)
      {
        grid.extent[d]  = edge;
        grid.n_cells[d] = n_cells;
      }
    return Lattice<dim>(grid);
  }

  template <int dim>
  BodyParameters<dim>
  body_of(const std::string &geometry, const unsigned int points_per_cell)
  {
    BodyParameters<dim> body;
    body.name     = "body";
    body.geometry = parse_geometry<dim>(geometry, {{"pi", pi}});
    body.points_per_cell.fill(points_per_cell);
    body.initial_velocity.fill("0");
    return body;
  }

  template <int dim>
  std::vector<GeneratedPoint<dim>>
  points_of(const BodyParameters<dim> &body, const unsigned int n_cells)
  {
    return generate_points<dim>(body, 0, 1., GridLevels<dim>(lattice_of<dim>(n_cells)), {}, 0);
  }

  /** Of all points, each like a box of its half-lengths; about the origin. */
  template <int dim>
  VolumeMoments<dim>
  moments_of(const std::vector<GeneratedPoint<dim>> &points)
  {
    VolumeMoments<dim> sum;
    for (const auto &point : points)
      {
        const auto &state = point.record.state;
        auto        box   = VolumeMoments<dim>::of_box(state.reference_half_lengths);
        // the domain has the point's volume, or less where its cell ends
        EXPECT_LT(box.volume / state.reference_volume, 1. + 1e-12);
        box.second *= state.reference_volume / box.volume;
        box.volume = state.reference_volume;
        EXPECT_EQ(state.mass, state.reference_volume); // density 1
        sum.add(box.about(-1. * Tensor<1, dim>(point.record.location)));
      }
    return sum;
  }

  template <int dim>
  void
  expect_body(const std::string             &geometry,
              const unsigned int             points_per_cell,
              const unsigned int             n_cells,
              const double                   volume,
              const Point<dim>              &centre,
              const std::array<double, dim> &second, // about the centre, per volume
              const double                   tolerance_of_inertia = 1e-3)
  {
    SCOPED_TRACE(geometry);
    const auto points  = points_of<dim>(body_of<dim>(geometry, points_per_cell), n_cells);
    const auto sum     = moments_of<dim>(points);
    const auto central = sum.about(sum.centre());
    EXPECT_NEAR(sum.volume / volume, 1., 1e-6);
    EXPECT_LT((Point<dim>(sum.centre()) - centre).norm(), 1e-6);
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(central.second[d][d] / sum.volume / second[d], 1., tolerance_of_inertia);
    // less than a tenth of its share of a cell weighs only what has no larger neighbour in its
    // cell; of up to two points per direction all are neighbours
    const double                        whole   = std::pow(1. / (n_cells * points_per_cell), dim);
    const auto                          lattice = lattice_of<dim>(n_cells);
    std::map<LatticeIndex<dim>, double> largest;
    for (const auto &point : points)
      {
        double &in_cell = largest[lattice.cell_of(point.record.location)];
        in_cell         = std::max(in_cell, point.record.state.reference_volume);
      }
    for (const auto &point : points)
      {
        if (points_per_cell <= 2 && largest[lattice.cell_of(point.record.location)] >= .1 * whole)
          {
            EXPECT_GE(point.record.state.reference_volume, .1 * whole);
          }
        EXPECT_LT(point.record.state.reference_volume, 2.5 * whole);
      }
  }
} // namespace

TEST(PointsGeneration, DiscsAndBallsFourCellsAcross)
{
  // r = 2 h, at a place without symmetry; second moments r^2/4 and r^2/5
  const double r = .25;
  for (const unsigned int points : {2u, 3u})
    {
      expect_body<2>("ball(0.46, 0.531; 0.25)",
                     points,
                     8,
                     pi * r * r,
                     {.46, .531},
                     {{r * r / 4, r * r / 4}});
      expect_body<3>("ball(0.46, 0.531, 0.487; 0.25)",
                     points,
                     8,
                     4 * pi / 3 * r * r * r,
                     {.46, .531, .487},
                     {{r * r / 5, r * r / 5, r * r / 5}});
    }
}

TEST(PointsGeneration, ADiscOfRadiusOneHalfWeighsAQuarterOfPi)
{
  const auto sum = moments_of<2>(generate_points<2>(body_of<2>("ball(0.805, 2.25; 0.5)", 3),
                                                    0,
                                                    1.,
                                                    GridLevels<2>(lattice_of<2>(32, 4.)),
                                                    {},
                                                    0));
  EXPECT_NEAR(sum.volume, pi / 4, 1e-6 * pi / 4);
}

TEST(PointsGeneration, CylindersAlongAnyAxis)
{
  // second moments: r^2/4 across, l^2/12 along; for a tilted axis a the tensor is
  // r^2/4 (1 - a a^T) + l^2/12 a a^T
  const double r = .25, l = .5;
  expect_body<3>("cylinder(0.47, 0.24, 0.52; 0.47, 0.74, 0.52; 0.25)",
                 2,
                 8,
                 pi * r * r * l,
                 {.47, .49, .52},
                 {{r * r / 4, l * l / 12, r * r / 4}});
  const double          a[3] = {.6, .64, .48};
  std::array<double, 3> second;
  std::string           ends[2];
  for (unsigned int d = 0; d < 3; ++d)
    {
      second[d] = r * r / 4 * (1 - a[d] * a[d]) + l * l / 12 * a[d] * a[d];
      for (const int end : {0, 1})
        ends[end] += (d > 0 ? ", " : "") + std::to_string(.5 + (end - .5) * l * a[d]);
    }
  expect_body<3>("cylinder(" + ends[0] + "; " + ends[1] + "; 0.25)",
                 2,
                 8,
                 pi * r * r * l,
                 {.5, .5, .5},
                 second);
}

TEST(PointsGeneration, BoxesThatEndWithinSubCells)
{
  expect_body<2>("box(0.213, 0.31; 0.713, 0.803)",
                 2,
                 8,
                 .5 * .493,
                 {.463, .5565},
                 {{.25 / 12, .493 * .493 / 12}});
  expect_body<3>("box(0.213, 0.31, 0.2; 0.713, 0.803, 0.71)",
                 2,
                 8,
                 .5 * .493 * .51,
                 {.463, .5565, .455},
                 {{.25 / 12, .493 * .493 / 12, .51 * .51 / 12}});
}

TEST(PointsGeneration, ShapesOutOfShapes)
{
  // a ring: R = .3, r = .15; a lens-free union of apart shapes; a box with a round notch
  const double R2 = .09, r2 = .0225;
  expect_body<2>("ball(0.48, 0.51; 0.3) - ball(0.48, 0.51; 0.15)",
                 2,
                 16,
                 pi * (R2 - r2),
                 {.48, .51},
                 {{(R2 + r2) / 4, (R2 + r2) / 4}});
  // two half balls: a ball cut by a box that covers a half of it, joined by the other half
  expect_body<3>("ball(0.46, 0.531, 0.487; 0.25) - box(0, 0, 0; 0.46, 1, 1) + "
                 "ball(0.46, 0.531, 0.487; 0.25)",
                 2,
                 8,
                 4 * pi / 3 / 64,
                 {.46, .531, .487},
                 {{.0125, .0125, .0125}});
  // a half disc: area pi r^2/2, centre 4 r/(3 pi) from the cut
  const double r = .25, offset = 4 * r / (3 * pi);
  expect_body<2>(
    "ball(0.4, 0.53; 0.25) - box(0, 0; 0.4, 1)",
    2,
    8,
    pi * r * r / 2,
    {.4 + offset, .53},
    {{r * r / 4 - offset * offset, r * r / 4}},
    1.3e-3); // two cells across; boxes that end with their cells lack inertia of their own
}

TEST(PointsGeneration, ImplicitFunctions)
{
  // an ellipse with half axes a, b and an ellipsoid: second moments a^2/4, a^2/5
  expect_body<2>("implicit(((x - 0.47)/0.3)^2 + ((y - 0.52)/0.25)^2 - 1)",
                 2,
                 8,
                 pi * .3 * .25,
                 {.47, .52},
                 {{.09 / 4, .0625 / 4}});
  expect_body<3>("implicit(((x - 0.47)/0.3)^2 + ((y - 0.52)/0.25)^2 + ((z - 0.5)/0.25)^2 - 1)",
                 2,
                 8,
                 4 * pi / 3 * .3 * .0625,
                 {.47, .52, .5},
                 {{.09 / 5, .0625 / 5, .0625 / 5}});
}

TEST(PointsGeneration, GroundBelowAHeightField)
{
  // y < f = 0.5 + 0.1 sin(2 pi x) over a unit square: area .5, static moments
  // int x f = 1/4 - .1/(2 pi), int f^2/2 = (.25 + .005)/2; int x^2 f = 1/6 - .1/(2 pi),
  // int f^3/3 = (.125 + 3*.5*.005)/3
  const double x = .5 - .2 / (2 * pi), y = .255;
  expect_body<2>("below(0.5 + 0.1*sin(2*pi*x))",
                 2,
                 8,
                 .5,
                 {x, y},
                 {{1. / 3 - .2 / (2 * pi) - x * x, (.125 + .0075) / 3 / .5 - y * y}});
  // a layer of thickness .3 between two such surfaces
  const auto layer = moments_of<2>(
    points_of<2>(body_of<2>("below(0.5 + 0.1*sin(2*pi*x)) - below(0.2 + 0.1*sin(2*pi*x))", 2), 8));
  EXPECT_NEAR(layer.volume, .3, 3e-7);
  // the rest lies above: together they are the square
  const auto rest = moments_of<2>(points_of<2>(body_of<2>("above(0.5 + 0.1*sin(2*pi*x))", 2), 8));
  EXPECT_NEAR(rest.volume, .5, 5e-7);
  // in 3D the height depends on x and z: f = .5 + .2 (x - .5)(z - .5) has the mean .5
  const auto hill =
    moments_of<3>(points_of<3>(body_of<3>("below(0.5 + 0.2*(x - 0.5)*(z - 0.5))", 2), 8));
  EXPECT_NEAR(hill.volume, .5, 5e-7);
}

TEST(PointsGeneration, Polygons)
{
  // an L: two boxes; and a triangle, whose second moments are those of its corners:
  // sum (x_i - c)^2/12
  expect_body<2>("polygon(0.2, 0.2; 0.8, 0.2; 0.8, 0.5; 0.5, 0.5; 0.5, 0.8; 0.2, 0.8)",
                 2,
                 8,
                 .27,
                 {.45, .45},
                 {{(.18 * (.36 / 12 + .0025) + .09 * (.09 / 12 + .01)) / .27,
                   (.18 * (.09 / 12 + .01) + .09 * (.09 / 12 + .04)) / .27}});
  const double          x[3] = {.13, .91, .35}, y[3] = {.12, .33, .87};
  const Point<2>        centre((x[0] + x[1] + x[2]) / 3, (y[0] + y[1] + y[2]) / 3);
  std::array<double, 2> second = {};
  for (unsigned int i = 0; i < 3; ++i)
    {
      second[0] += std::pow(x[i] - centre[0], 2) / 12;
      second[1] += std::pow(y[i] - centre[1], 2) / 12;
    }
  const double area = .5 * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
  for (const char *triangle : {"polygon(0.13, 0.12; 0.91, 0.33; 0.35, 0.87)",
                               "polygon(0.13, 0.12; 0.35, 0.87; 0.91, 0.33)"}) // clockwise
    expect_body<2>(triangle, 2, 8, area, centre, second);
}

TEST(PointsGeneration, WholeSubCellsAreAsTheyWere)
{
  // a body that ends where sub-cells end, up to round-off: bit for bit the centres, volumes
  // and half-lengths of whole sub-cells, in their order
  const std::string geometry = "box(1/16, 2/16; 10*0.1, 0.1*7.5)";
  auto              body     = body_of<2>(geometry, 2);
  const auto        clipped  = points_of<2>(body, 8);
  body.clip                  = false;
  const auto whole           = points_of<2>(body, 8);
  ASSERT_EQ(clipped.size(), whole.size());
  ASSERT_EQ(whole.size(), 15u * 10u);
  for (std::size_t i = 0; i < whole.size(); ++i)
    {
      const auto &a = clipped[i].record, &b = whole[i].record;
      EXPECT_EQ(a.location, b.location);
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.state.reference_volume, 1. / 256);
      EXPECT_EQ(a.state.reference_volume, b.state.reference_volume);
      EXPECT_EQ(a.state.half_lengths, b.state.half_lengths);
      EXPECT_EQ(clipped[i].exposed_sides, whole[i].exposed_sides);
    }
}

TEST(PointsGeneration, WithoutClippingCentresDecide)
{
  auto body = body_of<2>("box(0, 0; 0.3, 1)", 1); // ends at 1.2 cells of 1/4: one column
  body.clip = false;
  EXPECT_EQ(points_of<2>(body, 4).size(), 4u);
  body.geometry = parse_geometry<2>("box(0, 0; 0.1, 1)", {}); // no centre
  EXPECT_THROW(points_of<2>(body, 4), UserError);
  body.clip = true; // but a part of the cells
  EXPECT_NEAR(moments_of<2>(points_of<2>(body, 4)).volume, .1, 1e-14);
}

// By the divergence theorem linear functions integrate their slopes exactly in 2D: each cell's
// volume and first moment are those of the polygon in it, and the domains of cut points end with
// their cells. Held to the sum over cells of the polygon's moments in closed form.
TEST(PointsGeneration, WhatACellHoldsStaysThere)
{
  const auto body    = body_of<2>("polygon(0.131, 0.124; 0.913, 0.337; 0.352, 0.871)", 2);
  const auto lattice = lattice_of<2>(8);
  std::map<LatticeIndex<2>, std::pair<double, Tensor<1, 2>>> of_cell;
  for (const auto &point : points_of<2>(body, 8))
    {
      const auto &state = point.record.state;
      const auto  cell  = lattice.cell_of(point.record.location);
      of_cell[cell].first += state.reference_volume;
      of_cell[cell].second += state.reference_volume * Tensor<1, 2>(point.record.location);
      for (int d = 0; d < 2; ++d)
        {
          const double s = lattice.scaled(point.record.location[d], d) - cell[d],
                       l = state.half_lengths[d] / lattice.h[d];
          EXPECT_GE(s - l, -1e-12);
          EXPECT_LE(s + l, 1. + 1e-12);
        }
    }
  for (const auto &[cell, sums] : of_cell)
    {
      const Point<2>               low = lattice.node_position(cell);
      const dealii::BoundingBox<2> box({low, low + lattice.h});
      const auto                   exact = body.geometry->exact_moments(box);
      ASSERT_TRUE(exact);
      EXPECT_NEAR(sums.first, exact->volume, 1e-9 / 256.); // what is less than 1e-9 is left out
      EXPECT_LT((sums.second - exact->first - exact->volume * Tensor<1, 2>(box.center())).norm(),
                1e-9 / 256.);
    }
}

TEST(PointsGeneration, FacesOfCutPointsLieOnTheSurface)
{
  // the top at .713 cuts sub-cells of 1/16; at .69 it leaves slivers of 4 % that join below
  for (const double top : {.713, .69})
    {
      double area = 0;
      for (const auto &point :
           points_of<2>(body_of<2>("box(0.25, 0; 0.75, " + std::to_string(top) + ")", 2), 8))
        {
          if (((point.exposed_sides >> 3) & 1u) == 0)
            continue;
          const auto &state = point.record.state;
          EXPECT_NEAR(point.record.location[1] + state.half_lengths[1], top, 1e-14);
          area += state.reference_volume / (2 * state.half_lengths[1]);
        }
      EXPECT_NEAR(area, .5, 1e-14);
    }
}

TEST(PointsGeneration, BodiesSmallerThanASubCell)
{
  // smaller than a tenth of a sub-cell and without a neighbour: a point of its own
  const auto points = points_of<3>(body_of<3>("ball(0.3, 0.3, 0.3; 0.03)", 1), 4);
  ASSERT_EQ(points.size(), 1u);
  // the quadrature is good to about 1e-6 of the sub-cell, 1/64, which is 1.4e-4 of this ball
  EXPECT_NEAR(points[0].record.state.reference_volume, 4 * pi / 3 * 2.7e-5, 2e-6 / 64);
  EXPECT_LT(points[0].record.location.distance({.3, .3, .3}), 2e-4 * .03);
}
