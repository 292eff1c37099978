#ifndef kedge_surfaces_parameters_h
#define kedge_surfaces_parameters_h

#include <optional>
#include <string>

namespace kedge
{
  /** Outer faces of a body that look to one side, or a plane section of it; they move with it. */
  struct SurfaceParameters
  {
    std::string  name;
    std::string  body;
    unsigned int side = 0; ///< 2*direction + (0: low, 1: high); 2*dim: all sides
    std::string  where;    ///< expression of x, y, z, nx, ny, nz; empty: everywhere
    /** Place at the start of a section normal to the side's direction [m]; none: outer faces. */
    std::optional<double> section = {};
  };
} // namespace kedge

#endif
