#ifndef kedge_materials_friction_h
#define kedge_materials_friction_h

#include <kedge/materials/parameters.h>

#include <cmath>

namespace kedge
{
  constexpr double radians_per_degree = 3.14159265358979323846 / 180.;

  /**
   * The cone of Drucker and Prager, f = alpha I_1 + sqrt(J_2) - k and
   * g = beta I_1 + sqrt(J_2), that bears what Mohr and Coulomb's law of the
   * angles phi and psi and the cohesion c does:
   *   plane strain (while it flows, s = sqrt(1 - 3 beta^2)):
   *     beta = sin psi/sqrt(9 + 3 sin^2 psi),
   *     alpha = sin phi/(3 s + 3 beta sin phi), k = c cos phi (1 - 3 alpha beta)/s;
   *   triaxial compression: alpha = 2 sin phi/(sqrt(3) (3 - sin phi)),
   *     k = 6 c cos phi/(sqrt(3) (3 - sin phi)), beta as alpha with psi;
   *   triaxial extension: the same with 3 + sin.
   */
  struct MatchedCone
  {
    double friction; ///< alpha [-]
    double dilation; ///< beta [-]
    double strength; ///< k/c [-]

    explicit MatchedCone(const MaterialParameters &parameters)
    {
      const double phi     = parameters.friction_angle * radians_per_degree;
      const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
      const double sin_psi = std::sin(parameters.dilation_angle * radians_per_degree);
      if (parameters.cone_match == ConeMatch::plane_strain)
        {
          dilation       = sin_psi / std::sqrt(9. + 3. * sin_psi * sin_psi);
          const double s = std::sqrt(1. - 3. * dilation * dilation);
          friction       = sin_phi / (3. * s + 3. * dilation * sin_phi);
          strength       = cos_phi * (1. - 3. * friction * dilation) / s;
          return;
        }
      const double sign = parameters.cone_match == ConeMatch::compression ? -1. : 1.;
      friction          = 2. * sin_phi / (std::sqrt(3.) * (3. + sign * sin_phi));
      dilation          = 2. * sin_psi / (std::sqrt(3.) * (3. + sign * sin_psi));
      strength          = 6. * cos_phi / (std::sqrt(3.) * (3. + sign * sin_phi));
    }
  };
} // namespace kedge

#endif
