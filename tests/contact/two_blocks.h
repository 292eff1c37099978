// Two blocks that meet obliquely, as a scene and as a model whose steps are taken one by one.
#ifndef kedge_tests_contact_two_blocks_h
#define kedge_tests_contact_two_blocks_h

#include "../scene/scene_text.h"

#include <kedge/equations/step_equations.h>
#include <kedge/simulation/step.h>

#include <gtest/gtest.h>

namespace contact_tests
{
  using namespace kedge;
  using namespace scene_tests;

  inline std::string
  repeated(const std::string &a, const std::string &b, const std::string &c, const int dim)
  {
    return a + b + (dim == 3 ? c : "");
  }

  /** Two blocks one above the other that meet obliquely; the lower one stands askew to the grid. */
  template <int dim>
  std::string
  two_blocks(const std::string &law, const std::string &scheme, const std::string &gap = "0.01")
  {
    const std::string box_a =
      dim == 2 ? "box(0.13, 0.1; 1.4, 0.6)" : "box(0.13, 0.1, 0.2; 1.4, 0.6, 1.1)";
    const std::string box_b =
      dim == 2 ? "box(0.4, 0.6 + gap; 1.1, 1.2)" : "box(0.4, 0.6 + gap, 0.3; 1.1, 1.2, 0.9)";
    return "set Dimension = " + std::to_string(dim) + R"(
subsection Constants
  set gap = )" +
           gap + R"(
end
subsection Grid
  set Extent = )" +
           repeated("2", ", 1.6", ", 1.6", dim) + R"(
  set Cells  = )" +
           repeated("10", ", 8", ", 8", dim) + R"(
end
subsection Materials
  subsection soft
    set Density         = 1000
    set Young's modulus = 1e5
    set Poisson's ratio = 0.3
  end
  subsection stiff
    set Density         = 2000
    set Young's modulus = 4e5
    set Poisson's ratio = 0.2
  end
end
subsection Bodies
  subsection lower
    set Geometry = )" +
           box_a + R"(
    set Material = soft
    set Initial velocity = )" +
           repeated("0.3", "; 0.5 + 0.3*x", "; 0.1", dim) + R"(
    set Points per cell = 2
  end
  subsection upper
    set Geometry = )" +
           box_b + R"(
    set Material = stiff
    set Initial velocity = )" +
           repeated("-0.5 + 0.1*y", "; -1", "; 0.4*x", dim) + R"(
    set Points per cell = 2
  end
end
subsection Contact
  subsection blocks
    set First  = lower
    set Second = upper
)" + law + R"(
  end
end
subsection Time
  set Scheme = )" +
           scheme + R"(
  set End    = 1
  set Step   = 0.01
end
)";
  }

  template <int dim>
  struct Setting
  {
    explicit Setting(const std::string &text)
      : model(read_scene<dim>(parse(text)), MPI_COMM_SELF)
      , step(model)
    {
      model.create_points();
      step.initialise_points(0., false);
      step.book_state();
      model.ledger.set_start();
    }

    void
    run(const unsigned int n, const double dt)
    {
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto report = step.attempt({time, dt});
          ASSERT_TRUE(report.accepted) << report.cause;
          step.commit();
          time += dt;
        }
    }

    /** The same up to @p end, in steps that are halved as a run does. */
    void
    run_until(const double end, const double dt)
    {
      double size = dt;
      while (time < end - 1e-12 && size > 1e-4 * dt)
        {
          if (!step.attempt({time, std::min(size, end - time)}).accepted)
            {
              size *= 0.5;
              continue;
            }
          step.commit();
          time += std::min(size, end - time);
        }
      ASSERT_NEAR(time, end, 1e-12);
    }

    /** The equations of the step after those that were run, and its trial state. */
    void
    start_step(const double dt)
    {
      step.activate();
      equations = std::make_unique<StepEquations<dim>>(model.patches(),
                                                       model.unknowns,
                                                       model.terms,
                                                       model.scheme,
                                                       model.scene.linear_solver);
      std::vector<unsigned int> n_nodes;
      std::vector<int>          radius;
      for (const auto &field : model.fields)
        {
          n_nodes.push_back(field->patch.nodes.n_local());
          radius.push_back(field->tangent_radius);
        }
      equations->reinit(radius);
      trial.begin({time, dt}, model.unknowns, n_nodes);
      for (const auto &field : model.fields)
        ASSERT_TRUE(field->transfer->to_nodes(trial).success);
      for (auto &term : model.terms)
        term->start(trial);
      equations->start(trial, 0.);
      equations->evaluate();
    }

    /** Parts of Newton's corrections. */
    void
    correct(const std::vector<double> &parts)
    {
      double norm = 0.;
      for (const double part : parts)
        {
          ASSERT_TRUE(equations->solve_correction(norm, false).success);
          equations->retract(part);
          equations->evaluate();
        }
    }

    Model<dim>                          model;
    Step<dim>                           step;
    std::unique_ptr<StepEquations<dim>> equations;
    Trial<dim>                          trial;
    double                              time = 0.;
  };
} // namespace contact_tests

#endif
