#ifndef kedge_contact_parameters_h
#define kedge_contact_parameters_h

#include <optional>
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
   * What the largest shear stress of a contact may depend on: the place in space at the start of
   * the step (x, y, z) and how far below the highest one that the bodies of the second group, with
   * a wall those of the first, had at the start of the run, along y, it is [m]; the undrained
   * strength of the soil there, of two soils the smaller one [Pa].
   */
  inline std::vector<std::string>
  shear_limit_variables()
  {
    return {"x", "y", "z", "depth", "s_u"};
  }

  /**
   * Two groups of bodies that may move apart: those of one group share no nodes
   * with those of the other. Without a law between them they pass through each other.
   */
  struct ContactParameters
  {
    std::string              name;
    std::vector<std::string> first, second; ///< bodies of each group
    ContactMethod            method   = ContactMethod::none;
    double                   friction = 0.;       ///< mu [-]
    double                   adhesion = 0.;       ///< [Pa]
    std::string              shear_limit;         ///< of shear_limit_variables() [Pa]; empty: none
    double                   penalty_factor = 2.; ///< beta of eps = beta M / h, or of (5.105) [-]
    double                   spacing        = 0.; ///< of the surfaces' points [m]; 0: h/5

    /** A section of Rigid bodies in place of the second group, by number. */
    std::optional<unsigned int> tool;

    /** A rigid plane in place of the second group: parallel to a side of the grid, or with a
     * normal. */
    bool                has_wall  = false;
    unsigned int        wall_side = 0;           ///< 2*direction + (0: low, 1: high)
    std::vector<double> wall_point, wall_normal; ///< empty: those of the side
    /** How far it has moved since the start, expressions of t [m]; empty: it stands. */
    std::vector<std::string> wall_displacement;
  };
} // namespace kedge

#endif
