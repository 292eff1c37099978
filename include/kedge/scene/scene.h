#ifndef kedge_scene_scene_h
#define kedge_scene_scene_h

#include <kedge/contact/parameters.h>
#include <kedge/grid/parameters.h>
#include <kedge/io/parameters.h>
#include <kedge/materials/parameters.h>
#include <kedge/points/parameters.h>
#include <kedge/porous/parameters.h>
#include <kedge/rigid/parameters.h>
#include <kedge/solid/parameters.h>
#include <kedge/solvers/parameters.h>
#include <kedge/time_integration/parameters.h>
#include <kedge/transfer/parameters.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** All that a scene file says, checked; owned by nobody else. */
  template <int dim>
  struct Scene
  {
    std::string                   name; ///< the file's name without folder and ending
    std::string                   title;
    std::map<std::string, double> constants; ///< of all expressions
    GridParameters<dim>           grid;
    std::vector<unsigned int>     open_sides; ///< of the grid, 2*direction + (0: low, 1: high)
    std::vector<NodeConditionParameters<dim>> node_conditions;
    std::vector<MaterialParameters>           materials;
    std::vector<BodyParameters<dim>>          bodies;
    std::vector<RigidBodyParameters<dim>>     rigid_bodies;
    std::vector<LineParameters>               lines;
    std::vector<JointParameters>              joints;
    std::vector<ContactParameters>            contacts;
    std::optional<PorousParameters>           pore_fluid; ///< saturates all bodies
    std::vector<SurfacePressureParameters>    surface_pressures;
    std::vector<SurfaceFluxParameters>        surface_fluxes;
    std::array<std::string, dim>              body_force; ///< expressions of t [m/s^2]
    std::vector<PointLoadParameters<dim>>     point_loads;
    std::vector<TractionParameters<dim>>      tractions;
    std::vector<BodyConditionParameters<dim>> body_conditions;
    std::optional<LoadControlParameters<dim>> load_control;
    TimeParameters                            time;
    EquilibriumParameters                     equilibrium;
    NewtonParameters                          newton;
    LinearSolverParameters                    linear_solver;
    TransferParameters                        transfer;
    StabilisationParameters                   stabilisation;
    OutputParameters                          output;
    std::vector<ProbeParameters<dim>>         probes;
    std::vector<CheckParameters>              checks;
    std::string parameters; ///< all values used, as a scene file that runs again as it is
    std::map<std::string, std::string> settings; ///< the same, by full names
  };
} // namespace kedge

#endif
