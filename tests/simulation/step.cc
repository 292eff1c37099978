// The algorithm of a step on small scenes: what an attempt may and may not change.
#include "../scene/scene_text.h"

#include <kedge/simulation/step.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace scene_tests;

namespace
{
  const std::string spinning_block = R"(set Dimension = 2
subsection Grid
  set Origin = -2, -2
  set Extent = 4, 4
  set Cells = 8, 8
end
subsection Materials
  subsection rubber
    set Density = 1000
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Geometry = box(-1, -1; 0.25, 0.75)
    set Material = rubber
    set Initial velocity = -3*y; 3*x + 2*x*y
  end
end
subsection Body force
  set Acceleration = 0; -1
end
subsection Time
  set End = 1
  set Step = 0.01
end
)";

  const std::string saturated_column = R"(set Dimension = 2
subsection Grid
  set Extent = 2, 2
  set Cells = 2, 4
end
subsection Materials
  subsection soil
    set Density = 2500
    set Young's modulus = 1e6
    set Poisson's ratio = 0.2
    set Initial porosity = 0.4
  end
end
subsection Bodies
  subsection column
    set Geometry = box(0, 0; 1, 1.5)
    set Material = soil
    set Points per cell = 2
  end
end
subsection Pore fluid
  set Density = 1000
  set Bulk modulus = 1e8
  set Hydraulic conductivity = 1e-3
end
subsection Node conditions
  subsection bottom
    set Side = y-
    set Component y = fixed
    set Reaction = true
  end
end
subsection Body force
  set Acceleration = 0; -1
end
subsection Time
  set Scheme = midpoint
  set End = 1
  set Step = 0.01
end
)";

  /** A model with its points and the books of the start. */
  struct Setting
  {
    explicit Setting(const std::string &text)
      : model(read_scene<2>(parse(text)), MPI_COMM_SELF)
      , step(model)
    {
      model.create_points();
      step.initialise_points(0., false);
      step.book_state();
      model.ledger.set_start();
    }

    /** All that is committed of the points, bit for bit. */
    std::vector<double>
    committed() const
    {
      std::vector<double> result;
      for (const auto &record : model.points.points().records())
        {
          for (int d = 0; d < 2; ++d)
            result.push_back(record.location[d]);
          const auto *values = reinterpret_cast<const double *>(&record.state);
          result.insert(result.end(), values, values + n_state_values<2>);
        }
      return result;
    }

    Model<2> model;
    Step<2>  step;
  };

  /** A term that refuses steps from a given time on, and longer ones than another. */
  class Refusal : public Term<2>
  {
  public:
    std::string
    name() const override
    {
      return "refusal";
    }

    Answer
    add_residual(const Trial<2> &trial, Residual<2> &) override
    {
      return trial.times.t_n < from && trial.times.dt < longest ? Answer()
                                                                : Answer::failure("it is too late");
    }

    double from    = 1e10;
    double longest = 1e10;
  };

  class SimulationStep : public testing::TestWithParam<std::string>
  {};
} // namespace

INSTANTIATE_TEST_SUITE_P(DryAndSaturated,
                         SimulationStep,
                         testing::Values(spinning_block, saturated_column));

TEST_P(SimulationStep, AnAttemptChangesNothingCommitted)
{
  Setting    setting(GetParam());
  const auto points = setting.committed(), books = setting.model.ledger.values();
  ASSERT_TRUE(setting.step.attempt({0., 0.01}).accepted);
  EXPECT_EQ(setting.committed(), points);
  EXPECT_EQ(setting.model.ledger.values(), books);
  setting.step.commit();
  EXPECT_NE(setting.committed(), points);
}

TEST_P(SimulationStep, ARejectedStepLeavesTheNextAsIfItHadNotBeen)
{
  Setting undisturbed(GetParam()), disturbed(GetParam());
  auto    refusal  = std::make_unique<Refusal>();
  refusal->longest = 0.1;
  disturbed.model.terms.push_back(std::move(refusal));
  EXPECT_FALSE(disturbed.step.attempt({0., 0.5}).accepted);
  for (Setting *each : {&undisturbed, &disturbed})
    for (int k = 0; k < 3; ++k)
      {
        ASSERT_TRUE(each->step.attempt({k * 0.01, 0.01}).accepted);
        each->step.commit();
      }
  EXPECT_EQ(disturbed.committed(), undisturbed.committed());
  EXPECT_EQ(disturbed.model.ledger.values(), undisturbed.model.ledger.values());
}

TEST_P(SimulationStep, ATermThatFailsNamesItself)
{
  Setting setting(GetParam());
  auto    refusal = std::make_unique<Refusal>();
  refusal->from   = 0.005;
  setting.model.terms.push_back(std::move(refusal));
  ASSERT_TRUE(setting.step.attempt({0., 0.01}).accepted);
  setting.step.commit();
  const StepReport report = setting.step.attempt({0.01, 0.01});
  EXPECT_FALSE(report.accepted);
  EXPECT_FALSE(report.hopeless);
  expect_parts(report.cause, {"refusal", "it is too late"});
}

TEST(SimulationStepBooks, EnergyOfAFreeBodyBalances)
{
  Setting setting(spinning_block);
  for (int k = 0; k < 5; ++k)
    {
      ASSERT_TRUE(setting.step.attempt({k * 0.01, 0.01}).accepted);
      setting.step.commit();
    }
  const Ledger &ledger = setting.model.ledger;
  // weight does the work m g . (displacement of the centre); the method conserves to round-off
  EXPECT_GT(ledger.value("strain_energy"), 0.);
  EXPECT_NE(ledger.value("external_work"), 0.);
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * ledger.value("total_energy"));
  EXPECT_NEAR(ledger.value("mass"), 1000. * 1.25 * 1.75, 1e-9);
}

TEST(SimulationStepBooks, SupportsAndFluidAppear)
{
  Setting setting(saturated_column);
  ASSERT_TRUE(setting.step.attempt({0., 0.01}).accepted);
  setting.step.commit();
  const Ledger &ledger = setting.model.ledger;
  // grains 0.6 * 2500, fluid 0.4 * 1000 at pressure 0, in 1.5 m^2
  EXPECT_NEAR(ledger.value("solid_mass"), 0.6 * 2500. * 1.5, 1e-9);
  EXPECT_NEAR(ledger.value("fluid_mass"), 0.4 * 1000. * 1.5, 1e-3);
  EXPECT_NEAR(ledger.value("fluid_error"), 0., 1e-10);
  EXPECT_GT(ledger.value("reaction_bottom_y"), 0.);
}

TEST(SimulationStepFields, BodiesOfTwoFieldsDoNotKnowEachOther)
{
  const std::string second = R"(subsection Bodies
  subsection second
    set Geometry = box(-1.1, -0.8; 0.3, 0.4)
    set Material = rubber
    set Initial velocity = 1; 0
    set Basis = linear
  end
end
)";
  const std::string apart  = R"(subsection Contact
  subsection free passage
    set First = block
    set Second = second
  end
end
)";
  Setting           alone(spinning_block), together(spinning_block + second + apart);
  EXPECT_EQ(together.model.fields.size(), 2u);
  for (Setting *each : {&alone, &together})
    for (int k = 0; k < 3; ++k)
      {
        ASSERT_TRUE(each->step.attempt({k * 0.01, 0.01}).accepted);
        each->step.commit();
      }
  const Ledger &one = alone.model.ledger, &two = together.model.ledger;
  // both are solved in one system, to Newton's tolerance of the whole
  for (const std::string column : {"kinetic_energy", "strain_energy", "linear_momentum_x"})
    EXPECT_NEAR(two.value(column + "_block"),
                one.value(column),
                1e-11 * one.value("kinetic_energy"))
      << column;
  EXPECT_NEAR(two.value("energy_error_second"), 0., 1e-11 * two.value("total_energy_second"));
}

TEST(SimulationStepStop, AnAttemptIsGivenUpBetweenIterations)
{
  Setting    setting(spinning_block), undisturbed(spinning_block);
  const auto before = setting.committed();
  int        n      = 0;
  // the second iteration is not begun
  const StepReport report = setting.step.attempt({0., 0.01}, [&]() {
    return ++n == 2;
  });
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(report.accepted);
  EXPECT_EQ(n, 2);
  EXPECT_EQ(setting.committed(), before); // bit for bit
  // and the step can be made afterwards as if nothing had been
  for (Setting *one : {&setting, &undisturbed})
    {
      ASSERT_TRUE(one->step
                    .attempt({0., 0.01},
                             []() {
                               return false;
                             })
                    .accepted);
      one->step.commit();
    }
  EXPECT_EQ(setting.committed(), undisturbed.committed());
}
