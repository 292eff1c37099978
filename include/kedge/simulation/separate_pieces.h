#ifndef kedge_simulation_separate_pieces_h
#define kedge_simulation_separate_pieces_h

#include <kedge/scene/scene.h>

namespace kedge
{
  /**
   * The scene with the pieces of each body that is to have them apart as bodies of their own, NAME
   * 1, NAME 2 ..: in groups of Contact they stand where the body stood.
   *
   * @throws UserError if another entry names such a body, which is no more.
   */
  template <int dim>
  Scene<dim>
  with_separate_pieces(Scene<dim> scene);
} // namespace kedge

#endif
