#ifndef kedge_equations_tied_rows_h
#define kedge_equations_tied_rows_h

#include <kedge/equations/node_matrix.h>
#include <kedge/fields/constraints.h>

namespace kedge
{
  /**
   * The first half of C^T A C: the rows of A C that differ from those of A,
   * and which nodes they belong to in C^T. A row of tied components is whole, one
   * of others holds only what comes from tied neighbours. Only this rank's share
   * of A is multiplied.
   */
  template <int dim>
  class TiedRows
  {
  public:
    /** A row of A C: nodal blocks at the given columns (local nodes). */
    struct Row
    {
      unsigned int node;
      unsigned int components; ///< bit p: of component p
      unsigned int first_column, end_column;
      unsigned int first_coupling, end_coupling;
    };

    /** A row of A C that a node receives through C^T. */
    struct Feed
    {
      unsigned int node; ///< that receives
      unsigned int row;
      double       weight;
    };

    /** Finds rows, columns and feeds; linear in the couplings of tied nodes. */
    void
    reinit(const Patch<dim>               &patch,
           const std::vector<NodalStatus> &status,
           const NodeMatrix<dim>          &matrix);

    /** Computes the rows from the values of A. */
    void
    multiply(const NodeMatrix<dim> &matrix);

    const Row &
    row(const unsigned int number) const
    {
      return rows[number];
    }

    /** Local node of a column, first_column <= number < end_column of its row. */
    unsigned int
    column(const unsigned int number) const
    {
      return columns[number];
    }

    /** Values of component @p p of a row: n_components for each column. */
    const double *
    values(const Row &row, const unsigned int p) const
    {
      return product.data() + first_value(row, p);
    }

    /** Sorted by the receiving nodes. */
    const std::vector<Feed> &
    feeds() const
    {
      return all_feeds;
    }

  private:
    /** An entry of A that is added to a column of its row in A C. */
    struct Coupling
    {
      unsigned int slot;
      unsigned int column;     ///< counted from the row's first
      unsigned int components; ///< bit m: of component m of the neighbour
      double       weight;
    };

    /** Components of a node with one tie, or the free ones (tie -1). */
    struct Part
    {
      int          tie;
      unsigned int components;
    };
    using Parts = std::array<Part, 3>; ///< more are not: the free ones and those of two ties

    std::size_t
    first_value(const Row &row, const unsigned int p) const
    {
      const std::size_t n_columns = row.end_column - row.first_column;
      return (std::size_t(row.first_column) * n_components + p * n_columns) * n_components;
    }

    void
    add_row(const Patch<dim>         &patch,
            const std::vector<Parts> &parts,
            const NodeMatrix<dim>    &matrix,
            const unsigned int        node,
            const Part               &part);
    void
    add_couplings(const NodeTies<dim> &ties,
                  const unsigned int   slot,
                  const unsigned int   neighbour,
                  const Part          &part);

    unsigned int              n_components = 0;
    std::vector<Row>          rows;
    std::vector<unsigned int> columns;
    std::vector<Coupling>     couplings;
    std::vector<Feed>         all_feeds;
    std::vector<double>       product;
    std::vector<unsigned int> mark,
      place_of_column; ///< of the last row that has a local node as a column
  };
} // namespace kedge

#endif
