#ifndef kedge_io_checkpoint_format_h
#define kedge_io_checkpoint_format_h

#include <kedge/io/checkpoint.h>
#include <kedge/io/files.h>

#include <cstdint>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * What a rank's file of a checkpoint holds: all but the
   * number of ranks, doubles as they stand in memory.
   */
  template <int dim>
  std::string
  pack_checkpoint(const CheckpointData<dim> &data);

  /** The inverse. Throws std::runtime_error if @p content is not the whole of it. */
  template <int dim>
  CheckpointData<dim>
  unpack_checkpoint(const std::string &content);

  /** The manifest: written last, a checkpoint with a good one is whole. */
  struct CheckpointManifest
  {
    /** A rank's file. */
    struct File
    {
      std::uint64_t n_bytes = 0;
      std::uint64_t crc     = 0;
    };

    unsigned int      dim            = 0;
    unsigned int      n_state_values = 0; ///< of a material point: the layout of PointState
    std::vector<File> files;              ///< by rank

    std::string
    text() const;

    /** Throws std::runtime_error if @p text is not whole. */
    static CheckpointManifest
    parse(const std::string &text);
  };
} // namespace kedge

#endif
