#ifndef kedge_porous_parameters_h
#define kedge_porous_parameters_h

#include <kedge/materials/pore_fluid.h>
#include <kedge/surfaces/parameters.h>

#include <string>
#include <vector>

namespace kedge
{
  /** How pressures go from points to nodes, see PressureMapping. */
  enum class PressureMap
  {
    consistent,
    lumped
  };

  /** How a body holds the fluid. */
  struct BodyPores
  {
    bool   is_dry                 = false; ///< the fluid is not in it
    double hydraulic_conductivity = 0;     ///< kappa_0 at the porosity of its material [m/s]
    bool   kozeny_carman          = false; ///< kappa follows the porosity, else constant
  };

  /** The fluid that saturates the bodies of a scene, and how its pressure is stabilised. */
  struct PorousParameters
  {
    PoreFluidParameters fluid;                   ///< but what differs from body to body
    bool                coarse_pressure = false; ///< whether it lives at the cells' corners alone
    double              stabilisation   = 1;     ///< of (4.179): tau = stabilisation/(2 G) [-]
    double              velocity_filter = 0;     ///< of the conserving scheme, see MixtureTerm [-]
    double              stabilisation_theta = 0.55; ///< of the conserving scheme, in [1/2, 1] [-]
    PressureMap         pressure_map        = PressureMap::consistent;
    double surface_penalty = 10;   ///< of SurfacePressures, times conductivity over cell size [-]
    std::vector<BodyPores> bodies; ///< one per body
  };

  /** A pore pressure on outer faces of a body. */
  struct SurfacePressureParameters : SurfaceParameters
  {
    std::string pressure;        ///< expression of x, y, z, t [Pa]
    bool        one_way = false; ///< fluid may leave, and none comes in: a seepage face
  };

  /** What fluid enters through outer faces of a body. */
  struct SurfaceFluxParameters : SurfaceParameters
  {
    std::string flux; ///< expression of x, y, z, t [m/s]
  };
} // namespace kedge

#endif
