#ifndef kedge_base_single_process_h
#define kedge_base_single_process_h

namespace kedge
{
  /**
   * Call before MPI is initialised. If this process was started by itself,
   * not by mpirun, srun or the like, it tells Open MPI that nobody will join:
   * no helper process, no search for networks, no session folder. That takes MPI's start from
   * 0.3 s to 0.02 s. Settings that the user made in the environment stand;
   * other MPI libraries take no notice.
   */
  void
  hasten_single_process_start();
} // namespace kedge

#endif
