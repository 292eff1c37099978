#ifndef kedge_contact_parameters_h
#define kedge_contact_parameters_h

#include <limits>
#include <string>
#include <vector>

namespace kedge
{
  /** How bodies of two groups act on each other. */
  enum class ContactMethod
  {
    none,                 ///< they pass through each other
    surface_points,       ///< points of their surfaces, discrete gradient of the gap's energy
    augmented_lagrangian, ///< at common nodes of the grid, as are all that follow
    lagrange_multipliers,
    penalty,
    nonlinear_penalty,
    contact_velocity,
    ray_tracing ///< from the faces of the first group's cells to those of the second
  };

  /** Whether a method finds contact at the nodes that the bodies share. */
  inline bool
  is_nodal(const ContactMethod method)
  {
    return method > ContactMethod::surface_points;
  }

  /**
   * Two groups of bodies that may move apart: those of one group share no nodes
   * with those of the other. Without a law between them they pass through each other.
   */
  struct ContactParameters
  {
    std::string              name;
    std::vector<std::string> first, second; ///< bodies of each group
    ContactMethod            method         = ContactMethod::none;
    double                   friction       = 0.;                                      ///< mu [-]
    double                   adhesion       = 0.;                                      ///< [Pa]
    double                   shear_limit    = std::numeric_limits<double>::infinity(); ///< [Pa]
    double                   penalty_factor = 2.; ///< beta of eps = beta M / h, or of (5.105) [-]
    double                   spacing        = 0.; ///< of the surfaces' points [m]; 0: h/5

    /** A rigid plane in place of the second group: parallel to a side of the grid, or with a
     * normal. */
    bool                has_wall  = false;
    unsigned int        wall_side = 0;           ///< 2*direction + (0: low, 1: high)
    std::vector<double> wall_point, wall_normal; ///< empty: those of the side
  };
} // namespace kedge

#endif
