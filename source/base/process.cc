#include <kedge/base/exceptions.h>
#include <kedge/base/process.h>
#include <kedge/base/single_process.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <memory>

extern "C"
{
  /** Of OpenBLAS; absent from other libraries. */
  void
  openblas_set_num_threads(int) __attribute__((weak));
}

namespace kedge
{
  namespace
  {
    /** MPI, and what deal.II starts with it; no object with static storage: see stop_mpi(). */
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> &
    own_mpi()
    {
      static std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
      return mpi;
    }
  } // namespace



  void
  set_blas_threads(const unsigned int n_threads)
  {
    if (openblas_set_num_threads != nullptr)
      openblas_set_num_threads(static_cast<int>(n_threads));
  }



  void
  give_way_while_waiting()
  {
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
  }



  void
  start_mpi()
  {
    if (own_mpi())
      return;
    int is_running = 0, has_ended = 0;
    MPI_Initialized(&is_running);
    MPI_Finalized(&has_ended);
    if (is_running != 0 || has_ended != 0)
      throw UserError(has_ended != 0 ? "MPI has ended in this process; it cannot start again."
                                     : "Another library has started MPI in this process; kedge "
                                       "must start it (with mpi4py: set mpi4py.rc.initialize = "
                                       "False before mpi4py.MPI is imported, and import that "
                                       "after the first use of kedge).");
    hasten_single_process_start();
    give_way_while_waiting();
    int    argc = 0;
    char **argv = nullptr;
    own_mpi()   = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
  }



  void
  stop_mpi()
  {
    own_mpi().reset();
  }
} // namespace kedge
