#ifndef kedge_porous_parameters_h
#define kedge_porous_parameters_h

#include <kedge/materials/pore_fluid.h>

namespace kedge
{
  /** The fluid that saturates all bodies of a scene, and how its pressure is stabilised. */
  struct PorousParameters
  {
    PoreFluidParameters fluid;
    double              stabilisation = 1; ///< of (4.179): tau = stabilisation/(2 G) [-]
  };
} // namespace kedge

#endif
