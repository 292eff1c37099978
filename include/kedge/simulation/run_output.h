#ifndef kedge_simulation_run_output_h
#define kedge_simulation_run_output_h

#include <kedge/base/stopwatch.h>
#include <kedge/io/audit_writer.h>
#include <kedge/io/checkpoint.h>
#include <kedge/io/grid_output.h>
#include <kedge/io/history_writer.h>
#include <kedge/io/newton_log.h>
#include <kedge/io/points_output.h>
#include <kedge/io/probe_writer.h>
#include <kedge/io/rigid_output.h>
#include <kedge/io/run_folder.h>
#include <kedge/io/surface_output.h>
#include <kedge/simulation/step.h>
#include <kedge/time_integration/clock.h>

namespace kedge
{
  /** The files that a run writes as it goes: tables, and pictures of points and grid. */
  template <int dim>
  class RunOutput
  {
  public:
    /**
     * Opens the files, as new ones or, with a checkpoint, at the ends that they had then. The
     * model's generated points must be there still. Collective.
     *
     * @throws UserError for probes that find nothing, and as CsvFile does
     */
    RunOutput(Model<dim>                &model,
              Step<dim>                 &step,
              const RunFolder           &folder,
              const CheckpointData<dim> *resumed);

    /**
     * Writes an accepted step, or says which of its probes is not finite and writes nothing.
     * Collective.
     */
    std::string
    write_step(const HistoryRow &row, const NewtonReport &report);

    /** The first row, of the state at the start. As write_step(). */
    std::string
    write_start(const HistoryRow &row);

    /** Notes an attempt that was rejected; it would have ended at @p time. */
    void
    write_rejected(const std::uint64_t step, const double time, const NewtonReport &report);

    /** Pictures of the points, of the grid, of surfaces in contact and of rigid bodies, if they are
     * due or forced. Collective. */
    void
    write_points(const Clock &clock, const bool force);

    /** Pictures of the start, also of a scene that draws its grid alone. Collective. */
    void
    write_first_pictures(const Clock &clock);

    /** Where the files end, and what is due next, for a checkpoint. Collective. */
    void
    save(CheckpointData<dim> &data);

    /** What all this has taken. */
    const PhaseTime &
    time() const
    {
      return spent;
    }

  private:
    void
    open(const CheckpointData<dim> *resumed);
    std::string
    write_probes(const double time);
    void
    write_grid(const double time);
    void
    write_surfaces(const double time);
    /** Whether pictures are due; sets the time of the next ones. */
    bool
    is_due(const Clock &clock);

    Model<dim>      &model;
    Step<dim>       &step;
    const RunFolder &folder;

    std::unique_ptr<HistoryWriter>      history;
    std::unique_ptr<ProbeWriter<dim>>   probes;
    std::unique_ptr<PointsOutput<dim>>  points;
    std::unique_ptr<GridOutput<dim>>    grid;
    std::unique_ptr<SurfaceOutput<dim>> surfaces;
    std::unique_ptr<RigidOutput<dim>>   rigid;
    std::unique_ptr<NewtonLog>          newton;
    std::unique_ptr<AuditWriter<dim>>   audit;
    double                              next_time; ///< of pictures [s]
    std::optional<std::uint64_t>        last_step; ///< of the last picture
    PhaseTime                           spent;
  };
} // namespace kedge

#endif
