#ifndef kedge_io_checkpoint_h
#define kedge_io_checkpoint_h

#include <kedge/io/run_folder.h>
#include <kedge/io/scene_settings.h>
#include <kedge/points/point_state.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** All that a run needs to go on bit for bit: what one rank holds of it. */
  template <int dim>
  struct CheckpointData
  {
    SceneSettings                              settings; ///< of the scene, alike on all ranks
    unsigned int                               n_ranks = 1;
    std::map<std::string, double>              scalars;  ///< clock, books
    std::map<std::string, std::uint64_t>       counters; ///< steps, file positions
    std::map<std::string, std::vector<double>> arrays;
    std::vector<PointRecord<dim>>              points; ///< rank-local, in the order of iteration
  };

  /**
   * The folder `checkpoint/`: the two newest states, each in a folder
   * `state-NNNNNN` with one file per rank and a manifest of their lengths and
   * CRC-32 sums. A state is written under another name, forced to the disk
   * and renamed, so a kill at any moment leaves whole states only.
   */
  template <int dim>
  class CheckpointStore
  {
  public:
    /** Collective. */
    explicit CheckpointStore(const RunFolder &folder);

    /** Writes a state and removes all but the two newest good ones. Collective. Throws UserError if
     * it cannot. */
    void
    write(const CheckpointData<dim> &data);

    /**
     * The newest whole state. Says in the log which one it took and why it
     * passed over newer ones. Collective. Throws UserError if there is none,
     * all are damaged, it has another dimension or number of ranks, or belongs to a scene
     * that differs from @p settings in more than may_change_on_resume().
     */
    CheckpointData<dim>
    read_latest(const SceneSettings &settings);

  private:
    void
    remove_old(const std::uint64_t newest) const;

    const RunFolder             &folder;
    std::filesystem::path        location;
    std::uint64_t                next = 1;
    std::optional<std::uint64_t> last_good;
  };
} // namespace kedge

#endif
