#ifndef kedge_base_process_h
#define kedge_base_process_h

namespace kedge
{
  /** Threads of OpenBLAS, which direct solvers use; does nothing to other libraries. */
  void
  set_blas_threads(const unsigned int n_threads);

  /**
   * Call before MPI is initialised: ranks that wait give way to others. Without it two ranks
   * that share their cores with other programs take ten times as long. Of Open MPI; mpirun
   * sets it to 0 for as many ranks as cores, however busy these are.
   */
  void
  give_way_while_waiting();

  /**
   * Starts MPI, once, for programs whose main() is not kedge's, such as Python. What it
   * holds lasts until stop_mpi().
   *
   * @throws UserError if somebody else has started MPI, or it has been stopped
   */
  void
  start_mpi();

  /** Ends what start_mpi() has begun, if it has; no run may be left. */
  void
  stop_mpi();
} // namespace kedge

#endif
