#ifndef kedge_io_points_output_h
#define kedge_io_points_output_h

#include <kedge/io/parameters.h>
#include <kedge/io/point_fields.h>
#include <kedge/io/run_folder.h>
#include <kedge/io/time_series.h>

#include <optional>
#include <vector>

namespace kedge
{
  /**
   * The material points at chosen times, for ParaView: points/points-NNNNNN.vtu
   * (on several ranks one piece each and a .pvtu) with points.pvd, and, when
   * asked for, points/points-NNNNNN.h5 with points.xdmf. Doubles throughout;
   * whole numbers as 64-bit
   * integers in the vtu. Symmetric tensors have six values in the vtu (the order of
   * VTK), nine in HDF5.
   */
  template <int dim>
  class PointsOutput
  {
  public:
    /**
     * @p n_kept is what n_written() gave at the checkpoint from which the run
     * resumes. Throws UserError for an unknown field. Collective.
     */
    PointsOutput(const RunFolder        &folder,
                 const OutputParameters &parameters,
                 const unsigned int      n_kept = 0);

    /** Collective. Throws UserError if a file cannot be written. */
    void
    write(const double time, const std::vector<PointRecord<dim>> &local_points);

    /** Number of output times so far: store it in checkpoints. */
    unsigned int
    n_written() const;

    /** Forces the index files to the disk. Collective. */
    void
    flush() const;

  private:
    void
    write_vtu(const double time, const std::vector<PointRecord<dim>> &local_points);
    void
    write_hdf5(const double time, const std::vector<PointRecord<dim>> &local_points);

    const RunFolder                     &folder;
    std::vector<const PointField<dim> *> fields;
    unsigned int                         n_done;
    std::optional<TimeSeries>            pvd;
    std::optional<TimeSeries>            xdmf;
  };
} // namespace kedge

#endif
