#ifndef kedge_finite_element_parameters_h
#define kedge_finite_element_parameters_h

#include <kedge/base/expression.h>
#include <kedge/materials/parameters.h>
#include <kedge/solvers/parameters.h>
#include <kedge/time_integration/parameters.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace finite_element
{
  constexpr int dim = 2;

  /** What is followed: the mean over a face, or the place where a material point has gone. */
  struct ProbeParameters
  {
    std::string        name;
    int                side = -1; ///< deal.II's face number, or -1
    dealii::Point<dim> place;     ///< X, if there is no side
  };

  /** A rectangular body and what happens to it; SI units, per metre of thickness. */
  struct Parameters
  {
    dealii::Point<dim>           origin, extent;
    std::vector<unsigned int>    cells;
    unsigned int                 degree = 1;
    kedge::MaterialParameters    material;
    kedge::Expression            fixed[dim];            ///< of x, y: where a component is fixed
    kedge::Expression            acceleration[dim];     ///< of t [m/s^2]
    kedge::Expression            end_load[dim];         ///< of t, on the right side [N/m]
    kedge::Expression            initial_velocity[dim]; ///< of x, y [m/s]
    kedge::TimeParameters        time;
    kedge::NewtonParameters      newton;
    std::vector<ProbeParameters> probes;
    bool                         has_exact_stress = false;
    kedge::Expression            exact_stress; ///< Cauchy stress yy of x, y at the end [Pa]
    double                       stress_scale = 1.;
  };

  /** What the program is told on the command line. */
  struct CommandLine
  {
    std::string              file;
    std::string              output = "output/finite_element";
    std::vector<std::string> settings; ///< "Name = value", win over the file
  };

  /** @throws kedge::UserError */
  CommandLine
  read_command_line(const int argc, const char *const *argv);

  /** @throws kedge::UserError for a file or a setting that cannot be used. */
  Parameters
  read_parameters(const CommandLine &command);
} // namespace finite_element

#endif
