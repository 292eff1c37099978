#ifndef kedge_materials_initial_strain_h
#define kedge_materials_initial_strain_h

#include <kedge/materials/material.h>

#include <array>

namespace kedge
{
  /**
   * The inverse of the laws: the elastic Hencky strain [-] at which an
   * undeformed (ln J = 0) material of this @p history (in its columns) bears the principal
   * Kirchhoff stresses @p stress [Pa], effective ones of a soil. It stands in the axes of the
   * stress, e_i = s_i/(2 G), and eps_v from p' = K eps_v or, at n = n_0, from (4.101): eps_v = 2
   * p'/(K_0 (1 + sqrt(1 - 2 (1 - n_0)/n_0 p'/K_0))).
   *
   * @throws UserError for a stress beyond the yield surface, and for a tension that
   * the improved Hencky law does not reach
   */
  std::array<double, 3>
  initial_elastic_strain(const Material              &material,
                         const std::array<double, 3> &stress,
                         const std::vector<double>   &history);
} // namespace kedge

#endif
