#ifndef kedge_solid_points_in_lanes_h
#define kedge_solid_points_in_lanes_h

#include <kedge/solid/batch_law.h>

namespace kedge
{
  namespace internal
  {
    /**
     * The stage before the law: points in the lanes, their nodes, basis functions and the
     * gradients of the nodal fields, n_components values per node.
     */
    template <int dim, unsigned int pattern, int n_components = dim>
    class LanesOfPoints
    {
    public:
      static constexpr int n = stencil_size<dim>(pattern);

      LanesOfPoints(const BatchContext<dim> &context)
        : context(context)
        , offsets(node_offsets<dim, pattern>(context.patch.window().node_strides()))
      {}

      /** Reads the points; after each calls also(lane, whether nodal has changed). */
      template <typename Also>
      void
      read(const PackOfSlots &slots, const Also &also)
      {
        for (unsigned int lane = 0; lane < slots.count; ++lane)
          {
            const Stencil<dim> &stencil   = context.patch.points.stencil[slots.begin + lane];
            const bool          new_nodes = stencil.first_node != last_node;
            if (new_nodes)
              read_nodes(stencil.first_node);
            local[lane] = last_local;
            basis[lane] = expand<dim, pattern>(stencil);
            for (int i = 0; i < n_components; ++i)
              for (int j = 0; j < dim; ++j)
                gradient[i][j].set(lane, sum(nodal[i], basis[lane].gradient[j]));
            also(lane, new_nodes);
          }
        for (unsigned int lane = slots.count; lane < pack_width; ++lane)
          for (auto &row : gradient)
            for (Pack &value : row)
              value.set(lane, value[slots.count - 1]);
      }

      void
      read(const PackOfSlots &slots)
      {
        read(slots, [](const unsigned int, const bool) {});
      }

      static double
      sum(const double (&values)[n], const double (&weights)[n])
      {
        double result = 0.;
        for (int A = 0; A < n; ++A)
          result += values[A] * weights[A];
        return result;
      }

      /** Whether the point in a slot is the last one of those with its nodes. */
      bool
      is_last(const unsigned int slot) const
      {
        const auto &stencil = context.patch.points.stencil;
        return slot + 1 == context.batch.end ||
               stencil[slot + 1].first_node != stencil[slot].first_node;
      }

      std::array<int, n>  local[pack_width]; ///< node numbers
      BasisValues<dim, n> basis[pack_width];
      Pack                gradient[n_components][dim] = {}; ///< by x_n
      double              nodal[n_components][n];           ///< of the point read last

    private:
      void
      read_nodes(const unsigned int first_node)
      {
        last_node = first_node;
        for (int A = 0; A < n; ++A)
          {
            last_local[A]   = context.patch.nodes.local(first_node + offsets[A]);
            const double *u = &context.displacement[std::size_t(last_local[A]) * n_components];
            for (int d = 0; d < n_components; ++d)
              nodal[d][A] = u[d];
          }
      }

      const BatchContext<dim>          &context;
      const std::array<unsigned int, n> offsets;
      unsigned int                      last_node = static_cast<unsigned int>(-1);
      std::array<int, n>                last_local{};
    };
  } // namespace internal
} // namespace kedge

#endif
