#ifndef kedge_simulation_attachments_h
#define kedge_simulation_attachments_h

#include <kedge/simulation/step.h>

namespace kedge
{
  /**
   * Says what the entries of a scene have found: how many nodes of cells with
   * material points each node condition holds, where the points of point loads and
   * probes are, the sum of all loads at the start and at the end. To be called before the
   * first step and before Model::forget_generated_points() (collective).
   *
   * @throws UserError if no node is held in a scheme that cannot do without, with the
   * conditions that find none
   */
  template <int dim>
  void
  describe_attachments(const Model<dim> &model, Step<dim> &step, std::ostream &out);

  /** What to change if a body has too few points to hold its nodes; else empty. */
  template <int dim>
  std::string
  hint_on_points(const Scene<dim> &scene);
} // namespace kedge

#endif
