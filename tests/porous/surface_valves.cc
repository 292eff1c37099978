// The valves of seepage faces: free at first, then held, and turned over a few times at most.
#include <kedge/porous/surface_valves.h>

#include <gtest/gtest.h>

using namespace kedge;

TEST(PorousSurfaceValves, AreFreeThenHeldAndTurnedOver)
{
  SurfaceValves valves;
  valves.reinit({true, false, true});
  const std::vector<SurfaceFlow> free = {SurfaceFlow::one_way,
                                         SurfaceFlow::both_ways,
                                         SurfaceFlow::one_way};
  EXPECT_EQ(valves.flows(), free);
  for (unsigned int k = 1; k < SurfaceValves::free_tangents; ++k)
    EXPECT_FALSE(valves.count_tangent());
  EXPECT_FALSE(valves.may_turn()); // it has settled by itself
  EXPECT_TRUE(valves.count_tangent());
  EXPECT_TRUE(valves.hold({-1., -1., 2.})); // what is no valve stays as it is
  const std::vector<SurfaceFlow> held = {SurfaceFlow::closed,
                                         SurfaceFlow::both_ways,
                                         SurfaceFlow::both_ways};
  EXPECT_EQ(valves.flows(), held);
  EXPECT_FALSE(valves.count_tangent()); // they are held once
  EXPECT_TRUE(valves.may_turn());
  EXPECT_FALSE(valves.hold({-2., 1., 1.}));
  EXPECT_TRUE(valves.hold({2., 1., 1.}));
  // places that turn over and over end the step with what there is
  unsigned int n = 3;
  for (double sign = -1.; valves.may_turn(); sign = -sign, ++n)
    valves.hold({sign, 1., sign});
  EXPECT_EQ(n, SurfaceValves::most_passes);
  valves.start();
  EXPECT_EQ(valves.flows(), free);
  EXPECT_FALSE(valves.may_turn());
}
