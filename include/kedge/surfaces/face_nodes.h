#ifndef kedge_surfaces_face_nodes_h
#define kedge_surfaces_face_nodes_h

#include <kedge/surfaces/surface_faces.h>

namespace kedge
{
  namespace internal
  {
    /** Calls visit(local node, N_A at the face) for the nodes of a face. */
    template <int dim, typename Visit>
    struct ForNodesOfFace
    {
      const Patch<dim>   &patch;
      const Stencil<dim> &functions;
      const Visit        &visit;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        const auto basis   = expand<dim, pattern>(functions);
        for (int A = 0; A < stencil_size<dim>(pattern); ++A)
          visit(static_cast<unsigned int>(patch.nodes.local(functions.first_node + offsets[A])),
                basis.value[A]);
      }
    };
  } // namespace internal

  /** Calls visit(local node, N_A at the face) for the nodes of a face. */
  template <int dim, typename Visit>
  void
  for_nodes_of_face(const Patch<dim> &patch, const SurfacePoint<dim> &face, const Visit &visit)
  {
    dispatch_pattern<dim>(face.functions.pattern,
                          internal::ForNodesOfFace<dim, Visit>{patch, face.functions, visit});
  }
} // namespace kedge

#endif
