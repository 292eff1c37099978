// The same problems, laws and time schemes as kedge's, solved by finite
// elements on a mesh that is fixed to the body: what the material point method
// costs where the mesh would do. For the benchmarks only.

#include "output.h"

#include <kedge/base/exceptions.h>
#include <kedge/base/single_process.h>
#include <kedge/time_integration/clock.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace finite_element
{
  /** The time loop; a step that does not converge is halved. */
  kedge::ExitCode
  run(const Parameters &parameters, const std::string &folder)
  {
    Solid        solid(parameters);
    Output       output(parameters, solid, folder);
    kedge::Clock clock(parameters.time);
    clock.set_nominal_step(parameters.time.step);
    std::string cause;
    while (!clock.finished())
      {
        solid.start(clock.time(), clock.step_size());
        const kedge::NewtonReport report = kedge::solve_newton(solid, parameters.newton);
        if (!report.converged || !solid.accept())
          {
            ++output.n_rejected;
            if (clock.cut_step())
              continue;
            cause = "the smallest step was reached: " + report.cause;
            break;
          }
        const double dt = clock.step_size();
        clock.advance(report.iterations);
        output.write_step(solid, clock.n_steps(), clock.time(), dt, report.iterations);
      }
    output.write_summary(parameters, solid, cause);
    std::cout << (cause.empty() ? "finished" : cause) << " at t = " << clock.time() << " s\n";
    return cause.empty() ? kedge::ExitCode::finished : kedge::ExitCode::numerical_stop;
  }
} // namespace finite_element

int
main(int argc, char **argv)
{
  kedge::hasten_single_process_start();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      const auto command    = finite_element::read_command_line(argc, argv);
      const auto parameters = finite_element::read_parameters(command);
      return static_cast<int>(finite_element::run(parameters, command.output));
    }
  catch (const kedge::UserError &error)
    {
      std::cerr << error.what() << std::endl;
      return static_cast<int>(kedge::ExitCode::user_error);
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << std::endl;
      return static_cast<int>(kedge::ExitCode::internal_error);
    }
}
