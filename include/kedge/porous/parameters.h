#ifndef kedge_porous_parameters_h
#define kedge_porous_parameters_h

#include <kedge/materials/pore_fluid.h>

#include <string>

namespace kedge
{
  /** The fluid that saturates all bodies of a scene, and how its pressure is stabilised. */
  struct PorousParameters
  {
    PoreFluidParameters fluid;                   ///< but the initial porosity, which a material has
    bool                coarse_pressure = false; ///< whether it lives at the cells' corners alone
    double              stabilisation   = 1;     ///< of (4.179): tau = stabilisation/(2 G) [-]
    double surface_penalty = 10; ///< of SurfacePressures, times conductivity over cell size [-]
  };

  /** A pore pressure on the outer faces of a body that look to one side; moves with them. */
  struct SurfacePressureParameters
  {
    std::string  name;
    std::string  body;
    unsigned int side = 0; ///< 2*direction + (0: low, 1: high)
    std::string  where;    ///< expression of x, y, z; empty: everywhere
    std::string  pressure; ///< expression of t [Pa]
  };
} // namespace kedge

#endif
