#ifndef kedge_points_parameters_h
#define kedge_points_parameters_h

#include <kedge/points/geometry.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace kedge
{
  enum class BasisKind
  {
    linear,
    gimp,
    spline,
    quadratic
  };

  /** One body: where its material points stand and what they start with. */
  template <int dim>
  struct BodyParameters
  {
    std::string                    name;
    std::shared_ptr<Geometry<dim>> geometry;
    /** Parts of it that are to be bodies of their own; empty: it is one body. */
    std::vector<std::shared_ptr<Geometry<dim>>> pieces;
    std::string                   piece_of;     ///< the body that it was a piece of; empty: none
    unsigned int                  material = 0; ///< index into the scene's materials
    std::array<unsigned int, dim> points_per_cell;
    bool                          clip  = true; ///< points of cut sub-cells weigh what is in them
    BasisKind                     basis = BasisKind::gimp;
    std::array<std::string, dim>  initial_velocity; ///< expressions of x, y, z [m/s]
    bool                          body_force = true;
    std::vector<std::string>      initial_stress; ///< of x, y, z: xx; yy; zz; xy.. [Pa]; or none
    std::string initial_pore_pressure = "0"; ///< expression of x, y, z [Pa]; of saturated bodies
  };
} // namespace kedge

#endif
