#ifndef kedge_io_collective_h
#define kedge_io_collective_h

#include <deal.II/base/mpi.h>

#include <functional>

namespace kedge
{
  /**
   * Runs @p action on rank 0. What it throws there, every rank throws, with
   * the same message and the same kind (UserError or std::runtime_error), so
   * that no rank waits for one that gave up. Collective.
   */
  void
  run_on_root(const MPI_Comm communicator, const std::function<void()> &action);

  /**
   * Runs @p action on every rank. If it throws anywhere, every rank throws
   * the error of the lowest rank that failed. Collective; the action itself
   * may not communicate.
   */
  void
  run_on_all(const MPI_Comm communicator, const std::function<void()> &action);
} // namespace kedge

#endif
