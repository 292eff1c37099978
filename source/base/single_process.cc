#include <kedge/base/single_process.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace kedge
{
  void
  hasten_single_process_start()
  {
    // What the launchers leave in the environment of each process.
    constexpr std::array<const char *, 5> marks = {
      {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_PROCID"}};
    if (std::any_of(marks.begin(), marks.end(), [](const char *name) {
          return std::getenv(name) != nullptr;
        }))
      return;

    constexpr int keep_what_is_set = 0;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", keep_what_is_set);
    setenv("OMPI_MCA_pml", "ob1", keep_what_is_set);
    setenv("OMPI_MCA_btl", "self", keep_what_is_set);
    // a folder in /tmp shared by all processes of a user: those that start as
    // another ends may find it gone, and fail
    setenv("OMPI_MCA_orte_create_session_dirs", "0", keep_what_is_set);
    // a file pointer shared in that folder, which HDF5 does not need: without the folder Open MPI
    // complains of every file
    setenv("OMPI_MCA_sharedfp", "^sm", keep_what_is_set);
  }
} // namespace kedge
