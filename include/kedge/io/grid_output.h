#ifndef kedge_io_grid_output_h
#define kedge_io_grid_output_h

#include <kedge/io/run_folder.h>
#include <kedge/io/time_series.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace kedge
{
  /** This rank's active cells as plain arrays; nodes that ranks share may stand on each. */
  template <int dim>
  struct GridSnapshot
  {
    std::vector<dealii::Point<dim>> nodes;
    /** Vertices of each cell in deal.II's order (x runs fastest). */
    std::vector<std::array<unsigned int, (1 << dim)>>          cells;
    std::map<std::string, std::vector<double>>                 nodal_scalars;
    std::map<std::string, std::vector<dealii::Tensor<1, dim>>> nodal_vectors;
  };

  /** The background grid's active cells at chosen times: grid/grid-NNNNNN.vtu and grid.pvd. */
  template <int dim>
  class GridOutput
  {
  public:
    /** @p n_kept as in PointsOutput. Collective. */
    explicit GridOutput(const RunFolder &folder, const unsigned int n_kept = 0);

    /** All ranks give the same names of nodal fields. Collective. */
    void
    write(const double time, const GridSnapshot<dim> &snapshot);

    unsigned int
    n_written() const;

    /** Forces the index files to the disk. Collective. */
    void
    flush() const;

  private:
    const RunFolder &folder;
    unsigned int     n_done;
    TimeSeries       pvd;
  };
} // namespace kedge

#endif
