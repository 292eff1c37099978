#ifndef kedge_io_signals_h
#define kedge_io_signals_h

#include <deal.II/base/mpi.h>

#include <csignal>

namespace kedge
{
  /**
   * While it lives, SIGINT, SIGTERM and SIGUSR1 only set a flag, so that the time loop
   * can write a checkpoint and end. (mpirun hands SIGUSR1 on and waits; at the others it
   * kills what has not ended a second later.) Another one, more than a second after the
   * first, ends the process at once. One object at a time.
   */
  class StopSignals
  {
  public:
    explicit StopSignals(const MPI_Comm communicator);
    StopSignals(const StopSignals &) = delete;
    StopSignals &
    operator=(const StopSignals &) = delete;
    ~StopSignals();

    /** True on all ranks once any rank got a signal. One reduction of an int; collective. */
    bool
    stop_requested() const;

  private:
    MPI_Comm         communicator;
    struct sigaction previous_interrupt;
    struct sigaction previous_terminate;
    struct sigaction previous_user;
  };
} // namespace kedge

#endif
