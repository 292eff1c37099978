#ifndef kedge_io_rigid_output_h
#define kedge_io_rigid_output_h

#include <kedge/io/run_folder.h>
#include <kedge/io/time_series.h>
#include <kedge/rigid/rigid_bodies.h>

namespace kedge
{
  /**
   * The surfaces of rigid bodies where they are at chosen times:
   * rigid_bodies/rigid_bodies-NNNNNN.vtu and rigid_bodies.pvd. Facets hold the number of their
   * body, in the order of the scene, and their corners a velocity [m/s].
   */
  template <int dim>
  class RigidOutput
  {
  public:
    /** @p n_kept as in PointsOutput. Collective. */
    explicit RigidOutput(const RunFolder &folder, const unsigned int n_kept = 0);

    /** All ranks know all bodies; the first one writes them. Collective. */
    void
    write(const double time, const RigidBodies<dim> &bodies);

    unsigned int
    n_written() const;

    /** Forces the index file to the disk. Collective. */
    void
    flush() const;

  private:
    const RunFolder &folder;
    unsigned int     n_done;
    TimeSeries       pvd;
  };
} // namespace kedge

#endif
