#ifndef kedge_simulation_session_h
#define kedge_simulation_session_h

#include <kedge/scene/parameter_file.h>
#include <kedge/simulation/run_options.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace kedge
{
  /** A field of material points: for each of them, in the order of ids, @p shape numbers. */
  struct FieldValues
  {
    std::vector<double>      values;
    std::vector<std::size_t> shape; ///< of one point; empty: a number
  };

  /** What the points remember, where it lies: nothing is copied or owned. */
  struct StoredValues
  {
    const double            *first    = nullptr;
    std::size_t              n_points = 0;
    std::size_t              stride   = 0; ///< numbers from one point to the next
    std::vector<std::size_t> shape;        ///< of one point; empty: a number
  };

  /**
   * A run of a scene of either dimension, step by step, with its books and points as plain
   * numbers: what other languages are bound to. Points are those of this rank. Calls of
   * open(), run(), step() and write_checkpoint() are collective.
   */
  class Session
  {
  public:
    /**
     * Builds the scene and writes its first row, or goes on with an earlier run.
     *
     * @throws UserError for what the scene or the folder do not allow
     */
    static std::unique_ptr<Session>
    open(const ParameterFile &file, const RunOptions &options, const MPI_Comm communicator);

    virtual ~Session() = default;

    /** Runs to the end (or the stop, which SIGINT and the like ask for). */
    virtual RunEnd
    run() = 0;

    /** One accepted step, or the end; likewise. Not to be called again after the end. */
    virtual std::optional<RunEnd>
    step() = 0;

    virtual void
    write_checkpoint() = 0;

    virtual unsigned int
    dimension() const = 0;

    /** Simulated time [s]. */
    virtual double
    time() const = 0;

    /** The columns of history.csv and its last row. */
    virtual std::vector<std::string>
    columns() const = 0;
    virtual std::vector<double>
    row() const = 0;

    /** Names of fields that pictures can show, those without meaning here included. */
    virtual std::vector<std::string>
    field_names() const = 0;

    /** @throws UserError with the nearest name */
    virtual FieldValues
    field(const std::string &name) const = 0;

    /** Ids of the points in their order: that of fields, or that in which they are stored. */
    virtual std::vector<std::uint64_t>
    ids(const bool as_stored) const = 0;

    /** Names of what this scene's points remember. */
    virtual std::vector<std::string>
    stored_names() const = 0;

    /**
     * Where that lies until the next step. Tensors are of the dimension; symmetric ones hold
     * xx, yy, xy or xx, yy, zz, xy, xz, yz.
     *
     * @throws UserError with the nearest name, or if the memory has gaps, as it may on
     * several ranks
     */
    virtual StoredValues
    stored(const std::string &name) const = 0;
  };

  /** What `kedge --validate` prints of a scene or a path, on rank 0 (collective). */
  void
  validate(const ParameterFile &file, std::ostream &out, const MPI_Comm communicator);

  /** Whether a file is the path of a single material point, see drive(). */
  bool
  is_path(const ParameterFile &file);

  /** Drives a single material point along a path; see drive_point(). */
  ExitCode
  drive(const ParameterFile         &file,
        const std::filesystem::path &output,
        const bool                   strict,
        const MPI_Comm               communicator);
} // namespace kedge

#endif
