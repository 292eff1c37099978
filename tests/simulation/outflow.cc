// Points that leave through open sides of the grid, and what the books say of them.
#include "../scene/scene_text.h"

#include <kedge/contact/contact_picture.h>
#include <kedge/simulation/step.h>

#include <gtest/gtest.h>

#include <set>

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

  // Two blocks that collide while both fly out of the grid: the touching faces cross the open side
  // within the time that the wave takes through a block and back, 28 ms.
  const std::string flying_pair = R"(set Dimension = 2
subsection Grid
  set Extent = 2, 2
  set Cells = 8, 8
  set Open sides = right
end
subsection Materials
  subsection rubber
    set Density = 1000
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  subsection lower
    set Geometry = box(0.75, 0.3; 1.75, 0.8)
    set Material = rubber
    set Initial velocity = 5; 1
  end
  subsection upper
    set Geometry = box(0.65, 0.9; 1.7, 1.4)
    set Material = rubber
    set Initial velocity = 5; -1
  end
end
subsection Contact
  subsection pair
    set First = lower
    set Second = upper
    set Friction coefficient = 0.2
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
  scene_of(const std::string &text, const std::vector<std::string> &settings)
  {
    ParameterFile file = parse(text);
    for (const std::string &setting : settings)
      file.set(setting);
    return read_scene<2>(file);
  }

  /** A run of a scene; what it had at the start. */
  struct Flight
  {
    explicit Flight(const std::vector<std::string> &settings,
                    const std::string              &text = flying_block)
      : model(scene_of(text, settings), MPI_COMM_WORLD)
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



// As above, with facets that are in contact when they leave, and the work stored in them.
TEST(SimulationOutflow, SurfacesInContactLeaveWithTheirBodies)
{
  Flight flight({}, flying_pair);
  double pressed = 0.;
  for (unsigned int k = 0; k < 12; ++k)
    {
      ASSERT_TRUE(flight.fly(1).accepted);
      if (flight("outflow_points") > 0.)
        pressed = std::max(pressed, flight("contact_pressure_pair"));
      EXPECT_NEAR(flight("energy_error"), 0., 1e-9 * flight.energy) << k;
      for (const std::string component : {"x", "y"})
        EXPECT_NEAR(flight("outflow_momentum_" + component) +
                      flight("linear_momentum_" + component),
                    flight.start["linear_momentum_" + component],
                    1e-9 * flight.start["mass"] * 5.)
          << k;
    }
  EXPECT_GT(flight("outflow_points"), 10.);
  EXPECT_GT(pressed, 1e3); // or it would not be tested
  EXPECT_GT(flight("contact_energy_released"), 1e-6 * flight.energy);
}



// What is shown of surfaces is what is left of them: within the grid, but for the step that an
// accepted step may bring the corners of the last facets out.
TEST(SimulationOutflow, PicturesShowWhatIsLeftOfSurfaces)
{
  Flight     flight({}, flying_pair);
  const auto picture_of = [](const Flight &here) {
    ContactPicture<2> picture;
    for (const auto &term : here.model.terms)
      if (const auto *contact = dynamic_cast<const ShownContact<2> *>(term.get()))
        contact->show(picture);
    return picture;
  };
  const std::size_t n_at_start = picture_of(flight).facets().size();
  ASSERT_TRUE(flight.fly(12).accepted);
  const ContactPicture<2> picture = picture_of(flight);
  EXPECT_LT(picture.facets().size(), n_at_start - 10);
  EXPECT_GT(picture.facets().size(), 10u);
  std::set<unsigned int> used;
  for (const auto &facet : picture.facets())
    {
      used.insert(facet.corners.begin(), facet.corners.end());
      const auto middle =
        0.5 * (picture.vertices()[facet.corners[0]] + picture.vertices()[facet.corners[1]]);
      EXPECT_LE(middle[0], 2.);
    }
  EXPECT_EQ(used.size(), picture.vertices().size());
}



TEST(SimulationOutflow, OneBodyMayLeaveAltogetherAndNotBoth)
{
  Flight           flight({"Bodies/upper/Initial velocity = 1; 0"}, flying_pair);
  const StepReport first = flight.fly(40);
  ASSERT_TRUE(first.accepted) << first.cause;
  EXPECT_EQ(flight("kinetic_energy_lower"), 0.);
  EXPECT_GT(flight("mass"), 0.);
  EXPECT_EQ(flight("contact_energy"), 0.);
  const StepReport last = flight.fly(160);
  EXPECT_FALSE(last.accepted);
  EXPECT_NE(last.cause.find("nothing is left to compute"), std::string::npos) << last.cause;
}



TEST(SimulationOutflow, SidesHaveNames)
{
  expect_parts(message_of(flying_block, {"Grid/Open sides = lft"}), {"Grid/Open sides", "left"});
}
