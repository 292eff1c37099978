#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>
#include <kedge/io/grid_output.h>
#include <kedge/io/points_output.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <cstring>
#include <zlib.h>

using namespace kedge;
namespace fs = std::filesystem;

namespace
{
  /** Reads an array of a .vtu by the description of the format; independent of the writer. */
  template <typename T>
  std::vector<T>
  read_array(const std::string &vtu, const std::string &name)
  {
    const std::size_t tag    = vtu.find("Name=\"" + name + '"');
    const std::size_t offset = vtu.find("offset=\"", tag) + 8;
    const std::size_t start =
      vtu.find("encoding=\"raw\">\n_") + 17 + std::stoull(vtu.substr(offset, 20));
    const auto word = [&](const std::size_t i) {
      std::uint64_t value;
      std::memcpy(&value, vtu.data() + start + 8 * i, 8);
      return value;
    };
    const std::uint64_t n_blocks = word(0), block_size = word(1), last = word(2);
    std::string         bytes;
    std::size_t         position = start + 8 * (3 + n_blocks);
    for (std::uint64_t b = 0; b < n_blocks; ++b)
      {
        uLongf      size = b + 1 == n_blocks && last > 0 ? last : block_size;
        std::string block(size, '\0');
        EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(block.data()),
                             &size,
                             reinterpret_cast<const Bytef *>(vtu.data() + position),
                             word(3 + b)),
                  Z_OK);
        bytes += block;
        position += word(3 + b);
      }
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!bytes.empty())
      std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  OutputParameters
  parameters(const bool hdf5 = false)
  {
    OutputParameters result;
    result.fields = {"displacement", "cauchy_stress", "id", "deformation_gradient"};
    result.hdf5   = hdf5;
    return result;
  }
} // namespace

TEST(IoPointsOutput, VtuHoldsTheValues)
{
  // 40000 points: several compressed blocks and a shorter last one.
  const auto                points = test::make_points<2>(40000, (std::uint64_t(1) << 40));
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  PointsOutput<2>           output(run, parameters());
  output.write(0.1, points);
  EXPECT_EQ(output.n_written(), 1u);

  const std::string vtu    = read_file(scratch / "points/points-000000.vtu");
  const auto        places = read_array<double>(vtu, "Points");
  const auto        ids    = read_array<std::int64_t>(vtu, "id");
  const auto        stress = read_array<double>(vtu, "cauchy_stress");
  ASSERT_EQ(places.size(), 3 * points.size());
  ASSERT_EQ(ids.size(), points.size());
  ASSERT_EQ(stress.size(), 6 * points.size());
  for (const std::size_t p : {std::size_t(0), std::size_t(20001), points.size() - 1})
    {
      EXPECT_EQ(places[3 * p], points[p].location[0]);
      EXPECT_EQ(places[3 * p + 2], 0.);
      EXPECT_EQ(static_cast<std::uint64_t>(ids[p]), points[p].id);
      EXPECT_EQ(stress[6 * p + 2], points[p].state.out_of_plane_kirchhoff_stress / 2.); // det F
    }
  EXPECT_NE(vtu.find("NumberOfPoints=\"40000\""), std::string::npos);
  const std::string pvd = read_file(scratch / "points.pvd");
  EXPECT_NE(pvd.find("timestep=\"0.1\""), std::string::npos) << pvd;
  EXPECT_NE(pvd.find("file=\"points/points-000000.vtu\""), std::string::npos) << pvd;
}

TEST(IoPointsOutput, UnknownFieldIsTheUsersError)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  OutputParameters          wrong;
  wrong.fields = {"displacment"};
  EXPECT_THROW(PointsOutput<2>(run, wrong), UserError);
}

TEST(IoPointsOutputMpi, PiecesAndHdf5OverTheRanks)
{
  // The last rank has no points: a piece may be empty.
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const bool         empty   = n_ranks > 1 && rank + 1 == n_ranks;
  const auto         points  = test::make_points<3>(empty ? 0 : 50, 50 * rank);

  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    PointsOutput<3> output(run, parameters(true));
    output.write(0.5, points);
    output.write(1.5, points);
  }
  {
    PointsOutput<3> resumed(run, parameters(true), 1);
    resumed.write(2.5, points);
    EXPECT_EQ(resumed.n_written(), 2u);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string pvd = read_file(scratch / "points.pvd");
  EXPECT_EQ(pvd.find("1.5"), std::string::npos) << pvd;
  EXPECT_NE(pvd.find("2.5"), std::string::npos) << pvd;
  EXPECT_NE(pvd.find(n_ranks > 1 ? "points-000001.pvtu" : "points-000001.vtu"), std::string::npos);
  const std::string xdmf = read_file(scratch / "points.xdmf");
  EXPECT_NE(xdmf.find("points/points-000001.h5:/cauchy_stress"), std::string::npos) << xdmf;

  const std::size_t  n_all = 50 * (n_ranks > 1 ? n_ranks - 1 : 1);
  dealii::HDF5::File file((scratch / "points/points-000001.h5").string(),
                          dealii::HDF5::File::FileAccessMode::open,
                          MPI_COMM_WORLD);
  const auto         ids = file.open_dataset("id").read<std::vector<double>>();
  ASSERT_EQ(ids.size(), n_all);
  for (std::size_t p = 0; p < n_all; ++p)
    EXPECT_EQ(ids[p], static_cast<double>(p));
  const auto stress = file.open_dataset("cauchy_stress").read<dealii::FullMatrix<double>>();
  ASSERT_EQ(stress.n(), 9u); // xx xy xz yx ..: all nine
  const auto tau = test::make_points<3>(1, 7)[0].state.kirchhoff_stress / 2.; // det F = 2
  for (unsigned int ij = 0; ij < 9; ++ij)
    EXPECT_EQ(stress(7, ij), tau[ij / 3][ij % 3]);
  EXPECT_EQ(file.open_dataset("deformation_gradient").get_dimensions()[1], 9u);
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoGridOutput, CellsInVtksOrder)
{
  GridSnapshot<2> snapshot;
  snapshot.nodes                 = {{0, 0}, {1, 0}, {0, 2}, {1, 2}};
  snapshot.cells                 = {{{0, 1, 2, 3}}};
  snapshot.nodal_scalars["mass"] = {1, 2, 3, 4};
  snapshot.nodal_vectors["velocity"].resize(4);
  snapshot.nodal_vectors["velocity"][3][1] = 7;

  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  GridOutput<2>             output(run);
  output.write(0.25, snapshot);
  const std::string vtu = read_file(scratch / "grid/grid-000000.vtu");
  // VTK goes round a quadrilateral, deal.II runs through x first.
  EXPECT_EQ(read_array<std::int64_t>(vtu, "connectivity"), (std::vector<std::int64_t>{0, 1, 3, 2}));
  EXPECT_EQ(read_array<double>(vtu, "velocity")[3 * 3 + 1], 7);
  EXPECT_EQ(read_array<std::uint8_t>(vtu, "types"), (std::vector<std::uint8_t>{9}));
  EXPECT_NE(read_file(scratch / "grid.pvd").find("timestep=\"0.25\""), std::string::npos);
}
