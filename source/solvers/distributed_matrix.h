#ifndef kedge_solvers_distributed_matrix_h
#define kedge_solvers_distributed_matrix_h

#include <kedge/solvers/sparse_system.h>

namespace kedge
{
  /**
   * The matrix S A S of Krylov methods; S see scale_by_diagonal(). Refers to
   * the values of a SparseSystem, which must outlive it. On several ranks each
   * multiplies its rows, after it has got the parts of the vector that it
   * lacks from their owners. Columns come in runs, five nodes of three components
   * in 3D GIMP, so that indices and gathered loads are few and memory sets the pace.
   */
  class DistributedMatrix
  {
  public:
    /** Rows with the same columns, and these as runs. */
    struct RowGroup
    {
      unsigned int first_row, n_rows;
      std::size_t  first_run, end_run;
    };

    /** Another rank and what the two exchange. */
    struct Neighbour
    {
      int              rank;
      std::vector<int> rows_to_send;
      int              first_received, n_received; ///< local columns
    };

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

    /** The local columns that other ranks own. */
    unsigned int
    n_foreign() const
    {
      return static_cast<unsigned int>(foreign.size());
    }

    /** Of a global column, or -1 if this rank does not know it. */
    int
    local_number(const int column) const;

    const std::vector<Neighbour> &
    neighbours() const
    {
      return neighbours_;
    }

    /** Fills the entries of @p x at foreign columns, behind the own ones (collective). */
    void
    exchange(double *x) const;

    const std::vector<RowGroup> &
    row_groups() const
    {
      return groups;
    }

  private:
    /** Local columns that follow each other. */
    struct Run
    {
      int first, length;
    };

    void
    plan_exchange();
    void
    find_row_groups();
    void
    find_runs(RowGroup &group);
    void
    multiply_rows(const RowGroup &group, double *y) const;

    const SparseSystem         *system = nullptr;
    std::vector<int>            local_column; ///< empty on one rank
    std::vector<int>            foreign;      ///< global columns, ascending
    std::vector<Neighbour>      neighbours_;
    std::vector<RowGroup>       groups;
    std::vector<Run>            runs;
    std::vector<double>         scale;
    mutable std::vector<double> scaled; ///< S x, other ranks' parts included
    mutable std::vector<double> buffer; ///< of what is sent
  };
} // namespace kedge

#endif
