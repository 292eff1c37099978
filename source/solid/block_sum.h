#ifndef kedge_solid_block_sum_h
#define kedge_solid_block_sum_h

#include <kedge/base/pack.h>
#include <kedge/equations/node_matrix.h>

#include <cstring>

namespace kedge
{
  namespace internal
  {
    /**
     * The sum of dN_A/dx_R D_pRmS dN_B/dx_S over points with the same nodes,
     * stored as the rows of a NodeMatrix are: [A][p][B][m], B and m together in
     * packs. The sum of a point that has its nodes for itself is never stored.
     */
    template <int dim, unsigned int pattern>
    class BlockSum
    {
    public:
      static constexpr int n       = stencil_size<dim>(pattern);
      static constexpr int width   = static_cast<int>(pack_width);
      static constexpr int n_packs = (n * dim + width - 1) / width;
      using Row                    = std::array<Pack, n_packs>; ///< B and m

      /** Adds the point in a lane of @p tangent, times its volume. */
      void
      add_point(const unsigned int lane,
                const double       volume,
                const Pack (&tangent)[dim][dim][dim][dim],
                const BasisValues<dim, n> &basis)
      {
        for_rows(lane, volume, tangent, basis, [this](const int A, const int p, const Row &row) {
          value[A][p] = row;
        });
        empty = false;
      }

      /**
       * Adds the last point with the nodes @p local and with it the sum to the
       * rows of these nodes; see row_slots().
       */
      void
      add_last_point(const unsigned int lane,
                     const double       volume,
                     const Pack (&tangent)[dim][dim][dim][dim],
                     const BasisValues<dim, n>    &basis,
                     const RowSlots<dim, pattern> &rows,
                     const std::array<int, n>     &local,
                     NodeMatrix<dim>              &matrix)
      {
        for_rows(lane, volume, tangent, basis, [&](const int A, const int p, const Row &row) {
          add_to_row<dim, pattern>(rows[A],
                                   reinterpret_cast<const double *>(row.data()),
                                   matrix.row(local[A], p));
        });
        empty = true;
      }

    private:
      /** column[B][m] = volume sum_S D_mS dN_B/dx_S. */
      static void
      contract(const unsigned int lane,
               const double       volume,
               const Pack (&D)[dim][dim],
               const BasisValues<dim, n> &basis,
               Row                       &column)
      {
        double of_node[dim][n], together[n_packs * width] = {};
        for (int m = 0; m < dim; ++m)
          {
            double weight[dim];
            for (int S = 0; S < dim; ++S)
              weight[S] = volume * D[m][S][lane];
            for (int B = 0; B < n; ++B)
              {
                of_node[m][B] = weight[0] * basis.gradient[0][B];
                for (int S = 1; S < dim; ++S)
                  of_node[m][B] += weight[S] * basis.gradient[S][B];
              }
          }
        for (int B = 0; B < n; ++B)
          for (int m = 0; m < dim; ++m)
            together[B * dim + m] = of_node[m][B];
        std::memcpy(column.data(), together, sizeof(together));
      }

      /** Calls use(A, p, row) with the rows of the sum and the point. */
      template <typename Use>
      void
      for_rows(const unsigned int lane,
               const double       volume,
               const Pack (&tangent)[dim][dim][dim][dim],
               const BasisValues<dim, n> &basis,
               const Use                 &use)
      {
        Row column[dim]; // [R]
        for (int p = 0; p < dim; ++p)
          {
            for (int R = 0; R < dim; ++R)
              contract(lane, volume, tangent[p][R], basis, column[R]);
            for (int A = 0; A < n; ++A)
              {
                Row row;
                for (int v = 0; v < n_packs; ++v)
                  {
                    row[v] = Pack(basis.gradient[0][A]) * column[0][v];
                    for (int R = 1; R < dim; ++R)
                      row[v] += Pack(basis.gradient[R][A]) * column[R][v];
                  }
                if (!empty)
                  for (int v = 0; v < n_packs; ++v)
                    row[v] += value[A][p][v];
                use(A, p, row);
              }
          }
      }

      Row  value[n][dim];
      bool empty = true;
    };
  } // namespace internal
} // namespace kedge

#endif
