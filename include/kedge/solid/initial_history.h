#ifndef kedge_solid_initial_history_h
#define kedge_solid_initial_history_h

#include <kedge/materials/material.h>
#include <kedge/points/generation.h>

namespace kedge
{
  /**
   * Gives newly made points the constants of their laws that depend on the
   * place, evaluated once, at their reference places.
   *
   * @param parameters of the material of each body
   *
   * @throws UserError where a constant is not what it may be, with the place
   */
  template <int dim>
  void
  set_initial_history(const std::vector<MaterialParameters> &parameters,
                      const std::map<std::string, double>   &constants,
                      std::vector<GeneratedPoint<dim>>      &points);
} // namespace kedge

#endif
