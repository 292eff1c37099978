#ifndef kedge_io_surface_output_h
#define kedge_io_surface_output_h

#include <kedge/contact/contact_picture.h>
#include <kedge/io/run_folder.h>
#include <kedge/io/time_series.h>

namespace kedge
{
  /** Surfaces in contact at chosen times: surfaces/surfaces-NNNNNN.vtu and surfaces.pvd. */
  template <int dim>
  class SurfaceOutput
  {
  public:
    /** @p n_kept as in PointsOutput. Collective. */
    explicit SurfaceOutput(const RunFolder &folder, const unsigned int n_kept = 0);

    /** Each rank gives the facets that it has. Collective. */
    void
    write(const double time, const ContactPicture<dim> &picture);

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
