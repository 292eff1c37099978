#ifndef kedge_surfaces_parameters_h
#define kedge_surfaces_parameters_h

#include <string>

namespace kedge
{
  /** Outer faces of a body that look to one side; they move with it. */
  struct SurfaceParameters
  {
    std::string  name;
    std::string  body;
    unsigned int side = 0; ///< 2*direction + (0: low, 1: high)
    std::string  where;    ///< expression of x, y, z; empty: everywhere
  };
} // namespace kedge

#endif
