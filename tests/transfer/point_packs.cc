// Histories of points in the lanes of packs: by the schema, whatever the law.
#include <kedge/fields/point_packs.h>
#include <kedge/materials/material.h>

#include <gtest/gtest.h>

using namespace kedge;

TEST(TransferPointPacks, AllColumnsOfAHistoryGetIntoTheLanes)
{
  // more slots than lanes, rows wider than the law's history, as in a scene of several laws
  using Law = CriticalState<Hencky>;
  StepPoints<2> points;
  points.n_history     = n_columns<Law> + 1;
  const unsigned int n = pack_width + 1;
  for (unsigned int i = 0; i < n * points.n_history; ++i)
    points.history.push_back(i);
  for (const unsigned int begin : {0u, pack_width})
    {
      const PackOfSlots slots(begin, n);
      const auto        history = pack_of_histories<Law>(points, slots);
      for (unsigned int lane = 0; lane < pack_width; ++lane)
        {
          const auto one = points.history_of<Law>(slots.slot(lane));
          EXPECT_EQ(one.equivalent_plastic_strain, slots.slot(lane) * points.n_history);
          EXPECT_EQ(history.equivalent_plastic_strain[lane], one.equivalent_plastic_strain);
          EXPECT_EQ(history.plastic_volume_strain[lane], one.plastic_volume_strain);
          EXPECT_EQ(history.volume_strain[lane], one.volume_strain);
        }
    }
}
