#ifndef kedge_simulation_field_h
#define kedge_simulation_field_h

#include <kedge/transfer/motion_term.h>

namespace kedge
{
  /** Bodies that move as one, with what a step needs of them beside the terms. */
  template <int dim>
  struct Field
  {
    std::string                          name;
    Patch<dim>                           patch;
    std::unique_ptr<MotionTransfer<dim>> transfer;       ///< none in quasi-static runs
    std::vector<const Term<dim> *>       mapping_terms;  ///< that add to the mapping's mass
    int                                  tangent_radius; ///< how far the tangent couples nodes

    Field(const std::string         &name,
          const BackgroundGrid<dim> &grid,
          const PatchParameters     &parameters,
          const NodeConditions<dim> &conditions,
          const int                  tangent_radius)
      : name(name)
      , patch(grid, parameters, conditions)
      , tangent_radius(tangent_radius)
    {}
  };
} // namespace kedge

#endif
