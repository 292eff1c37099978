#include <kedge/points/split_points.h>

#include <gtest/gtest.h>

#include <set>

using namespace kedge;

namespace
{
  template <int dim>
  PointRecord<dim>
  moving_point()
  {
    PointRecord<dim> point{};
    point.id = 7;
    for (int d = 0; d < dim; ++d)
      {
        point.location[d]                            = 0.3 + d;
        point.state.reference_position[d]            = 0.1 - d;
        point.state.displacement[d]                  = point.location[d] - 0.1 + d;
        point.state.velocity[d]                      = 2. - 3. * d;
        point.state.reference_half_lengths[d]        = 0.25;
        point.state.half_lengths[d]                  = 0.25 * (1. + 0.3 * d);
        point.state.deformation_gradient[d][d]       = 1. + 0.3 * d;
        point.state.deformation_gradient[0][dim - 1] = 0.2;
      }
    point.state.mass             = 3.;
    point.state.reference_volume = 0.5;
    return point;
  }

  template <int dim>
  void
  expect_the_whole(const PointParts<dim> &parts)
  {
    const PointRecord<dim>        point = moving_point<dim>();
    std::vector<PointRecord<dim>> result;
    std::uint64_t                 last = 11;
    split_point<dim>(point, parts, last, result);

    double                  mass = 0., volume = 0.;
    dealii::Tensor<1, dim>  moment, momentum;
    dealii::Tensor<2, dim>  angular; // x (x) m v
    std::set<std::uint64_t> ids;
    for (const PointRecord<dim> &part : result)
      {
        ids.insert(part.id);
        mass += part.state.mass;
        volume += part.state.reference_volume;
        moment += part.state.mass * part.location;
        momentum += part.state.mass * part.state.velocity;
        angular += outer_product(dealii::Tensor<1, dim>(part.location),
                                 part.state.mass * part.state.velocity);
        // it comes from where the point's deformation gradient says
        const auto from_centre = part.state.reference_position - point.state.reference_position;
        EXPECT_LT(
          (part.location - point.location - point.state.deformation_gradient * from_centre).norm(),
          1e-15);
        EXPECT_LT((part.state.reference_position + part.state.displacement - part.location).norm(),
                  1e-15);
        for (int d = 0; d < dim; ++d)
          EXPECT_LE(std::abs(part.location[d] - point.location[d]) + part.state.half_lengths[d],
                    point.state.half_lengths[d] * (1. + 1e-15));
      }
    // sums of up to 12 shares: round-off
    EXPECT_NEAR(mass, 3., 1e-14);
    EXPECT_NEAR(volume, 0.5, 1e-14);
    EXPECT_LT((moment - 3. * point.location).norm(), 1e-14);
    EXPECT_LT((momentum - 3. * point.state.velocity).norm(), 1e-14);
    EXPECT_LT((angular -
               outer_product(dealii::Tensor<1, dim>(point.location), 3. * point.state.velocity))
                .norm(),
              1e-13);
    EXPECT_EQ(ids.size(), result.size());
    EXPECT_EQ(*ids.begin(), 7u);
    EXPECT_EQ(last, 11 + result.size() - 1);
  }
} // namespace

TEST(SplitPoints, PartsHaveMassMomentaAndPlaceOfTheWhole)
{
  expect_the_whole<2>({{2, 2}});
  expect_the_whole<2>({{1, 3}});
  expect_the_whole<3>({{2, 3, 2}});
}

TEST(SplitPoints, ThereAreAsManyAsTheCellAsksFor)
{
  GridParameters<2> parameters;
  parameters.extent[0] = parameters.extent[1] = 1.;
  parameters.n_cells                          = {{4, 4}};
  const Lattice<2> lattice(parameters);
  auto             state = moving_point<2>().state; // 0.5 by 0.65 m, cells of 0.25 m
  EXPECT_EQ(parts_for_cell<2>(state, &lattice), (PointParts<2>{{2, 3}}));
  EXPECT_FALSE(is_many(parts_for_cell<2>(state, nullptr)));
  state.half_lengths[0] = state.half_lengths[1] = 0.125 * (1. + 1e-7);
  EXPECT_FALSE(is_many(parts_for_cell<2>(state, &lattice)));
  state.half_lengths[0] = 1.;
  state.loaded          = 1.;
  EXPECT_FALSE(is_many(parts_for_cell<2>(state, &lattice)));
}
