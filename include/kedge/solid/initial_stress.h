#ifndef kedge_solid_initial_stress_h
#define kedge_solid_initial_stress_h

#include <kedge/materials/material.h>
#include <kedge/points/generation.h>

#include <string>
#include <vector>

namespace kedge
{
  /**
   * Gives the points just generated the stress with which their bodies start:
   * expressions of the place for the Cauchy stress [Pa], the effective one of a
   * saturated body (BodyParameters::initial_stress). The configuration is the
   * reference one, F = I, where Kirchhoff's stress is the same; the elastic left
   * Cauchy-Green tensor is what the material's law says, b^e = exp(2 eps^e). A stress
   * beyond the yield surface is returned to it.
   *
   * @return for each body with such points a line that says which share of them it was, and by
   * how much their stress has changed
   * @throws UserError for a stress that the material cannot bear, with body and place
   */
  template <int dim>
  std::vector<std::string>
  set_initial_stress(const std::vector<BodyParameters<dim>> &bodies,
                     const std::vector<Material>            &material_of_body,
                     const std::map<std::string, double>    &constants,
                     std::vector<GeneratedPoint<dim>>       &points);
} // namespace kedge

#endif
