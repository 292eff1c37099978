#ifndef kedge_solvers_foreign_rows_h
#define kedge_solvers_foreign_rows_h

#include "distributed_matrix.h"

namespace kedge
{
  /**
   * Copies of the rows that belong to the columns of a DistributedMatrix which
   * other ranks own, in the order of these columns, without the entries whose
   * columns this rank does not know: the overlap of a Schwarz method.
   */
  class ForeignRows
  {
  public:
    /** Takes a new pattern (collective). */
    void
    reinit(const DistributedMatrix &matrix);

    /** Gets the values of the same pattern, not scaled (collective). */
    void
    get_values(const DistributedMatrix &matrix);

    std::vector<std::int64_t> row_start = {0};
    std::vector<int>          column; ///< local ones
    std::vector<double>       value;

  private:
    /** What one neighbour sends. */
    struct Message
    {
      std::vector<double> values;
      std::size_t         first_source, end_source; ///< in sources
    };

    std::vector<Message> received;
    std::vector<int>     sources; ///< of the entries, in the messages
  };
} // namespace kedge

#endif
