#ifndef kedge_io_probe_writer_h
#define kedge_io_probe_writer_h

#include <kedge/io/csv_file.h>
#include <kedge/io/point_fields.h>
#include <kedge/io/run_folder.h>
#include <kedge/points/point_state.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kedge
{
  /** What is followed under a name: a weighted mean over material points (one point: one weight).
   */
  struct Probe
  {
    std::string                                   name;
    std::vector<std::pair<std::uint64_t, double>> points; ///< id and weight > 0, on all ranks alike
  };

  /**
   * probes.csv: time, then of each probe NAME.position_x.., displacement,
   * velocity, cauchy_stress (all components, zz of plane strain too) and
   * pressure; of saturated bodies pore_pressure, porosity and darcy_velocity
   * too. Written by rank 0; without probes there is no file.
   *
   * Either hand over all local points, or only those for which tracks() says
   * yes:
   * @code
   * if (!probes.empty())
   *   {
   *     probes.begin();
   *     for (p : local points)
   *       if (probes.tracks(id(p)))
   *         probes.add(record(p));
   *     probes.end_row(time);
   *   }
   * @endcode
   */
  template <int dim>
  class ProbeWriter
  {
  public:
    /**
     * Weights are divided by their sum. Throws UserError for a probe without
     * points, a name used twice or one that a table's header cannot hold, and
     * as CsvFile does. Collective.
     *
     * @param points_leave a probe is then the mean over those of its points that are there
     * still, and stays as it was last when all have gone
     */
    ProbeWriter(const RunFolder                  &folder,
                const std::vector<Probe>         &probes,
                const std::optional<CsvPosition> &resume_at    = {},
                const bool                        saturated    = false,
                const bool                        points_leave = false);

    bool
    empty() const;

    /** A mask and, if that says perhaps, a binary search. */
    bool
    tracks(const std::uint64_t id) const;

    void
    begin();

    void
    add(const PointRecord<dim> &point);

    /**
     * Sums over the ranks and writes the row, or says on all ranks which number of it is
     * not finite and writes nothing. Collective. Throws if a tracked point is on no rank,
     * unless points may leave.
     */
    std::string
    end_row(const double time);

    /** All three at once. Collective; returns at once if there are no probes. */
    void
    write(const double time, const std::vector<PointRecord<dim>> &local_points);

    /** The numbers of the last row, for a run that is resumed. */
    const std::vector<double> &
    last_row() const
    {
      return last;
    }

    void
    set_last_row(const std::vector<double> &row)
    {
      last = row;
    }

    /** Length in bytes of the file, all of it on the disk; 0 without probes and on ranks > 0. */
    CsvPosition
    position();

    /** The columns after `time` of one probe, without its name: position_x .. pressure. */
    static std::vector<std::string>
    quantity_names(const bool saturated = false);

  private:
    struct Tracked
    {
      std::uint64_t id;
      unsigned int  probe;
      double        weight;
    };

    /** Makes means of the sums over all ranks. */
    void
    divide_by_weights(std::vector<double> &total) const;

    MPI_Comm                              communicator;
    const std::vector<PointQuantity<dim>> all; ///< quantities of a probe
    std::vector<std::string>              names;
    std::vector<Tracked>                  tracked; ///< sorted by id
    std::vector<bool>                     mask;    ///< by the low bits of the id
    bool                                  points_leave;
    std::vector<double>      sums; ///< per probe: the quantities, then the weight found
    std::vector<double>      last; ///< of the last row, likewise
    std::unique_ptr<CsvFile> file;
  };
} // namespace kedge

#endif
