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
     * The sum of blocks between the nodes of a stencil over points with the same
     * nodes, stored as the rows of a NodeMatrix are: [A][p][B][m], B and m together in
     * packs. A point's part of row p of node A is
     *   sum_T t_T(A) column_pT(B, m),
     * with test functions t_T: gradients or values of the basis. The sum of a point that
     * has its nodes for itself is never stored.
     *
     * A Point has n_tests(p), the number of test functions of row p, at most
     * max_tests; test(T), their values at the nodes; and contract(p, T, column), which
     * fills column_pT node by node, n_components values each.
     */
    template <int dim, unsigned int pattern, int n_components = dim>
    class BlockSum
    {
    public:
      static constexpr int n       = stencil_size<dim>(pattern);
      static constexpr int width   = static_cast<int>(pack_width);
      static constexpr int n_packs = (n * n_components + width - 1) / width;
      using Row                    = std::array<Pack, n_packs>; ///< B and m

      template <class Point>
      void
      add_point(const Point &point)
      {
        for_rows(point, [this](const int A, const int p, const Row &row) {
          value[A][p] = row;
        });
        empty = false;
      }

      /**
       * Adds the last point with the nodes @p local and with it the sum to the
       * rows of these nodes; see row_slots().
       */
      template <class Point>
      void
      add_last_point(const Point                  &point,
                     const RowSlots<dim, pattern> &rows,
                     const std::array<int, n>     &local,
                     NodeMatrix<dim>              &matrix)
      {
        for_rows(point, [&](const int A, const int p, const Row &row) {
          add_to_row<dim, pattern, n_components>(rows[A],
                                                 reinterpret_cast<const double *>(row.data()),
                                                 matrix.row(local[A], p));
        });
        empty = true;
      }

    private:
      /** Calls use(A, p, row) with the rows of the sum and the point. */
      template <class Point, typename Use>
      void
      for_rows(const Point &point, const Use &use)
      {
        Row column[Point::max_tests];
        for (int p = 0; p < n_components; ++p)
          {
            const int n_tests = point.n_tests(p);
            for (int T = 0; T < n_tests; ++T)
              {
                double of_node[n_components][n], together[n_packs * width] = {};
                point.contract(p, T, of_node);
                for (int B = 0; B < n; ++B)
                  for (int m = 0; m < n_components; ++m)
                    together[B * n_components + m] = of_node[m][B];
                std::memcpy(column[T].data(), together, sizeof(together));
              }
            for (int A = 0; A < n; ++A)
              {
                Row row;
                for (int v = 0; v < n_packs; ++v)
                  {
                    row[v] = Pack(point.test(0)[A]) * column[0][v];
                    for (int T = 1; T < n_tests; ++T)
                      row[v] += Pack(point.test(T)[A]) * column[T][v];
                  }
                if (!empty)
                  for (int v = 0; v < n_packs; ++v)
                    row[v] += value[A][p][v];
                use(A, p, row);
              }
          }
      }

      Row  value[n][n_components];
      bool empty = true;
    };
  } // namespace internal
} // namespace kedge

#endif
