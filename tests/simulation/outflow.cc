// Points that leave through open sides of the grid, and what the books say of them.
#include "../scene/scene_text.h"

#include <kedge/simulation/step.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace scene_tests;

namespace
{
  // A block that spins, stretches and flies over the corner of its grid: its parts go through
  // two sides and over the corner between them.
  const std::string flying_block = R"(set Dimension = 2
subsection Grid
  set Extent = 2, 2
  set Cells = 8, 8
  set Open sides = right, -y
end
subsection Materials
  subsection clay
    set Model = von_mises
    set Density = 1000
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
    set Uniaxial yield stress sigma_y = 2e4
  end
end
subsection Bodies
  subsection block
    set Geometry = box(0.75, 0.5; 1.75, 1.25)
    set Material = clay
    set Initial velocity = 3 - 4*(y - 0.875) + 2*(x - 1.25); -2 + 4*(x - 1.25)
  end
end
subsection Time
  set End = 1
  set Step = 0.01
end
)";

  const std::vector<std::string> saturated = {"Pore fluid/Density = 1000",
                                              "Pore fluid/Bulk modulus = 1e8",
                                              "Pore fluid/Hydraulic conductivity = 1e-3",
                                              "Materials/clay/Initial porosity = 0.4",
                                              "Materials/clay/Model = hencky",
                                              "Materials/clay/Uniaxial yield stress sigma_y =",
                                              "Time/Scheme = midpoint"};

  Scene<2>
  scene_of(const std::vector<std::string> &settings)
  {
    ParameterFile file = parse(flying_block);
    for (const std::string &setting : settings)
      file.set(setting);
    return read_scene<2>(file);
  }

  /** A run of the block; what it had at the start. */
  struct Flight
  {
    explicit Flight(const std::vector<std::string> &settings)
      : model(scene_of(settings), MPI_COMM_WORLD)
      , step(model)
    {
      model.create_points();
      step.initialise_points(0., false);
      step.book_state();
      model.ledger.set_start();
      for (const std::string name : {"mass", "n_points", "linear_momentum_x", "linear_momentum_y"})
        start[name] = model.ledger.value(name);
      energy = model.ledger.stored("energy");
    }

    /** Runs @p n steps of 0.01 s; the report of one that is not accepted. */
    StepReport
    fly(const unsigned int n)
    {
      StepReport report;
      for (unsigned int k = 0; k < n; ++k)
        {
          report = step.attempt({0.01 * k, 0.01});
          if (!report.accepted)
            return report;
          step.commit();
        }
      return report;
    }

    double
    operator()(const std::string &column) const
    {
      return model.ledger.value(column);
    }

    Model<2>                      model;
    Step<2>                       step;
    std::map<std::string, double> start;
    double                        energy = 0.;
  };
} // namespace



// Conservation: with what has left the sums are those of the start, to the round-off of some ten
// thousand additions and of Newton's method.
TEST(SimulationOutflowMpi, PointsTakeMassMomentumAndEnergyWithThem)
{
  Flight flight({});
  ASSERT_TRUE(flight.fly(30).accepted);
  const double n_gone = flight("outflow_points");
  EXPECT_GT(n_gone, 10.);
  EXPECT_EQ(n_gone + flight("n_points"), flight.start["n_points"]);
  EXPECT_EQ(flight.model.points.points().n_global(), flight("n_points"));
  EXPECT_NEAR(flight("outflow_mass") + flight("mass"), flight.start["mass"], 1e-9);
  for (const std::string component : {"x", "y"})
    EXPECT_NEAR(flight("outflow_momentum_" + component) + flight("linear_momentum_" + component),
                flight.start["linear_momentum_" + component],
                1e-9 * flight.start["mass"] * 4.);
  EXPECT_GT(flight("outflow_energy"), 0.1 * flight.energy);
  EXPECT_GT(flight("plastic_dissipation"), 1e-3 * flight.energy); // or it would not be tested
  EXPECT_NEAR(flight("energy_error"), 0., 1e-9 * flight.energy);
}



TEST(SimulationOutflowMpi, FluidLeavesWithItsSoil)
{
  Flight flight(saturated);
  ASSERT_TRUE(flight.fly(25).accepted);
  EXPECT_GT(flight("outflow_points"), 10.);
  // the fluid's mass but for its compression, of 1e-3 or less: porosity times volume
  const double per_point = 0.75 / flight.start["n_points"];
  EXPECT_NEAR(flight("outflow_fluid_mass"),
              0.4 * 1000. * per_point * flight("outflow_points"),
              0.05 * flight("outflow_fluid_mass"));
  EXPECT_NEAR(flight("fluid_error"), 0., 1e-9 * flight.start["mass"]);
  EXPECT_NEAR(flight("outflow_mass") + flight("mass") - flight("fluid_inflow"),
              flight.start["mass"],
              1e-9 * flight.start["mass"]);
}



TEST(SimulationOutflow, OtherSidesStayClosed)
{
  Flight           flight({"Grid/Open sides = top"});
  const StepReport report = flight.fly(100);
  EXPECT_FALSE(report.accepted);
  EXPECT_NE(report.cause.find("leaves the background grid"), std::string::npos) << report.cause;
}



TEST(SimulationOutflowMpi, TheLastPointsEndTheRun)
{
  Flight           flight({"Bodies/block/Initial velocity = 3; 0"});
  const StepReport report = flight.fly(100);
  EXPECT_FALSE(report.accepted);
  EXPECT_NE(report.cause.find("nothing is left to compute"), std::string::npos) << report.cause;
  EXPECT_GT(flight("n_points"), 0.);
}



TEST(SimulationOutflow, SidesHaveNames)
{
  expect_parts(message_of(flying_block, {"Grid/Open sides = lft"}), {"Grid/Open sides", "left"});
}
