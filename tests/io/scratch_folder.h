#ifndef kedge_tests_io_scratch_folder_h
#define kedge_tests_io_scratch_folder_h

#include <kedge/points/point_state.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace kedge::test
{
  /** A folder of one test, alike on all ranks, gone afterwards. */
  class ScratchFolder
  {
  public:
    ScratchFolder()
    {
      static int n = 0;
      const int  process =
        dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, static_cast<int>(getpid()));
      folder = std::filesystem::temp_directory_path() /
               ("kedge-test-" + std::to_string(process) + "-" + std::to_string(n++));
    }

    ~ScratchFolder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::error_code ignored;
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::filesystem::remove_all(folder, ignored);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    const std::filesystem::path &
    path() const
    {
      return folder;
    }

    std::filesystem::path
    operator/(const std::string &name) const
    {
      return folder / name;
    }

  private:
    std::filesystem::path folder;
  };

  /** Material points that differ in every value; F = diag(2, 1[, 1]) plus a shear. */
  template <int dim>
  std::vector<PointRecord<dim>>
  make_points(const unsigned int n, const std::uint64_t first_id = 0)
  {
    std::vector<PointRecord<dim>> points(n);
    for (unsigned int p = 0; p < n; ++p)
      {
        PointRecord<dim> &point = points[p];
        double           *value = &point.state.body;
        for (unsigned int i = 0; i < n_state_values<dim>; ++i)
          value[i] = 0.1 * (i + 1) + static_cast<double>(first_id + p);
        point.id                         = first_id + p;
        point.state.body                 = 0;
        point.state.deformation_gradient = 0;
        for (unsigned int d = 0; d < dim; ++d)
          {
            point.location[d]                      = 0.25 * d + static_cast<double>(first_id + p);
            point.state.deformation_gradient[d][d] = d == 0 ? 2. : 1.;
          }
        point.state.deformation_gradient[0][1] = 0.5;
      }
    return points;
  }
} // namespace kedge::test

#endif
