#ifndef kedge_solvers_distributed_matrix_h
#define kedge_solvers_distributed_matrix_h

#include <kedge/solvers/sparse_system.h>

namespace kedge
{
  /**
   * The matrix S A S of Krylov methods, S = 1/sqrt|diagonal of A|. Refers to
   * the values of a SparseSystem, which must outlive it. On several ranks each
   * multiplies its rows, after it has got the parts of the vector that it
   * lacks from their owners.
   */
  class DistributedMatrix
  {
  public:
    /** Takes a new pattern: numbers the columns, plans the exchange (collective). */
    void
    reinit(const SparseSystem &system);

    /** Takes new values of the same pattern: refers to them, scales (collective). */
    void
    set_values(const SparseSystem &system);

    /** y = S A S x for this rank's rows (collective). */
    void
    multiply(const double *x, double *y) const;

    unsigned int
    n_rows() const
    {
      return system->n_rows();
    }

    /** S for this rank's rows, then for the other columns that it needs. */
    const std::vector<double> &
    scaling() const
    {
      return scale;
    }

    const SparseSystem &
    values() const
    {
      return *system;
    }

    /** Local columns of the entries: own ones, then those of other ranks. */
    const int *
    columns() const
    {
      return local_column.empty() ? system->column.data() : local_column.data();
    }

  private:
    /** Another rank and what the two exchange. */
    struct Neighbour
    {
      int              rank;
      std::vector<int> rows_to_send;
      int              first_received, n_received; ///< local columns
    };

    void
    plan_exchange(const std::vector<int> &foreign_columns);
    void
    find_row_groups();
    void
    exchange(double *x) const;
    template <int n_together>
    void
    multiply_rows(const unsigned int first, double *y) const;

    const SparseSystem         *system = nullptr;
    std::vector<int>            local_column; ///< empty on one rank
    std::vector<Neighbour>      neighbours;
    std::vector<unsigned char>  rows_together; ///< rows of the same columns, from each first one on
    std::vector<double>         scale;
    mutable std::vector<double> scaled; ///< S x, other ranks' parts included
    mutable std::vector<double> buffer; ///< of what is sent
  };
} // namespace kedge

#endif
