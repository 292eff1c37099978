#ifndef kedge_porous_parameters_h
#define kedge_porous_parameters_h

#include <kedge/materials/pore_fluid.h>

#include <string>

namespace kedge
{
  /** How pressures go from points to nodes, see PressureMapping. */
  enum class PressureMap
  {
    consistent,
    lumped
  };

  /** The fluid that saturates all bodies of a scene, and how its pressure is stabilised. */
  struct PorousParameters
  {
    PoreFluidParameters fluid;                   ///< but the initial porosity, which a material has
    bool                coarse_pressure = false; ///< whether it lives at the cells' corners alone
    double              stabilisation   = 1;     ///< of (4.179): tau = stabilisation/(2 G) [-]
    PressureMap         pressure_map    = PressureMap::consistent;
    double surface_penalty = 10; ///< of SurfacePressures, times conductivity over cell size [-]
  };

  /** Outer faces of a body that look to one side; they move with it. */
  struct SurfaceParameters
  {
    std::string  name;
    std::string  body;
    unsigned int side = 0; ///< 2*direction + (0: low, 1: high)
    std::string  where;    ///< expression of x, y, z; empty: everywhere
  };

  /** The pore pressure there. */
  struct SurfacePressureParameters : SurfaceParameters
  {
    std::string pressure; ///< expression of t [Pa]
  };

  /** What fluid enters there. */
  struct SurfaceFluxParameters : SurfaceParameters
  {
    std::string flux; ///< expression of x, y, z, t [m/s]
  };
} // namespace kedge

#endif
