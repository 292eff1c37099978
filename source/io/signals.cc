#include <kedge/io/signals.h>

#include <deal.II/base/exceptions.h>

#include <ctime>

namespace kedge
{
  namespace
  {
    volatile std::sig_atomic_t signal_seen = 0;
    volatile std::sig_atomic_t seen_at     = 0; ///< seconds of the monotonic clock
    bool                       in_use      = false;

    /** Calls only what a signal handler may call. */
    void
    handle(const int signal)
    {
      timespec now;
      clock_gettime(CLOCK_MONOTONIC, &now);
      if (signal_seen != 0 && now.tv_sec > seen_at + 1)
        {
          std::signal(signal, SIG_DFL);
          std::raise(signal); // delivered when the handler returns
        }
      else if (signal_seen == 0)
        {
          signal_seen = signal;
          seen_at     = static_cast<std::sig_atomic_t>(now.tv_sec);
        }
    }
  } // namespace



  StopSignals::StopSignals(const MPI_Comm communicator)
    : communicator(communicator)
  {
    AssertThrow(!in_use, dealii::ExcMessage("Two StopSignals at a time."));
    in_use                  = true;
    signal_seen             = 0;
    struct sigaction action = {};
    action.sa_handler       = handle;
    action.sa_flags         = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &previous_interrupt);
    sigaction(SIGTERM, &action, &previous_terminate);
    sigaction(SIGUSR1, &action, &previous_user);
  }



  StopSignals::~StopSignals()
  {
    sigaction(SIGINT, &previous_interrupt, nullptr);
    sigaction(SIGTERM, &previous_terminate, nullptr);
    sigaction(SIGUSR1, &previous_user, nullptr);
    in_use = false;
  }



  bool
  StopSignals::stop_requested() const
  {
    const int local = signal_seen != 0;
    int       any   = 0;
    MPI_Allreduce(&local, &any, 1, MPI_INT, MPI_MAX, communicator);
    return any != 0;
  }
} // namespace kedge
