#ifndef kedge_materials_initial_strain_h
#define kedge_materials_initial_strain_h

#include <kedge/materials/material.h>

#include <array>
#include <vector>

namespace kedge
{
  /** How an undeformed material begins under a stress. */
  struct InitialState
  {
    std::array<double, 3> stress;  ///< principal, Kirchhoff's [Pa]: the one asked for, or returned
    std::array<double, 3> strain;  ///< elastic, Hencky's [-]
    std::vector<double>   history; ///< in the columns of the law
    double returned = 0.; ///< largest change of a principal stress by the return, over the largest
                          ///< of those asked for [-]; 0: it was not beyond the yield surface
  };

  /**
   * As initial_elastic_strain(), but a stress beyond the yield surface is returned to it by the
   * law. p_c of modified_cam_clay becomes what it is from its ratio to the surface through the
   * stress, if the law is given so.
   *
   * @throws UserError for a stress that has no return, and for a tension that the elastic law
   * does not reach
   */
  InitialState
  initial_state(const Material              &material,
                const std::array<double, 3> &stress,
                const std::vector<double>   &history);

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
