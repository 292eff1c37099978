#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>
#include <kedge/io/probe_writer.h>

#include <gtest/gtest.h>

using namespace kedge;

TEST(IoProbeWriter, ColumnsOfThePlane)
{
  const std::vector<std::string> expected = {"position_x",
                                             "position_y",
                                             "displacement_x",
                                             "displacement_y",
                                             "velocity_x",
                                             "velocity_y",
                                             "cauchy_stress_xx",
                                             "cauchy_stress_yy",
                                             "cauchy_stress_zz",
                                             "cauchy_stress_xy",
                                             "pressure"};
  EXPECT_EQ(ProbeWriter<2>::quantity_names(), expected);
  EXPECT_EQ(ProbeWriter<3>::quantity_names().size(), 3u + 3u + 3u + 6u + 1u);
}

TEST(IoProbeWriterMpi, FollowsPointsAndMeansOverTheRanks)
{
  // Each rank holds 10 points: ids 0.. on rank 0, 1000.. on the last.
  const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int last   = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const auto         points = test::make_points<2>(10, 1000 * rank);

  const std::uint64_t       far = 1000 * last + 4;
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    // Weights are scaled to a sum of 1; point 3 is followed twice.
    ProbeWriter<2> probes(run, {{"tip", {{3, 7.}}}, {"face", {{3, 1.}, {far, 3.}}}});
    EXPECT_TRUE(probes.tracks(3));
    EXPECT_FALSE(probes.tracks(2));
    EXPECT_FALSE(probes.tracks(3 + 64)); // same bit of the mask
    probes.write(0.5, points);
    probes.write(1.5, points);
  }
  MPI_Barrier(MPI_COMM_WORLD); // rank 0 has written
  const CsvTable table = read_csv(scratch / "probes.csv");
  EXPECT_EQ(*table.find("time"), (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(table.find("tip.position_x")->at(0), 3.); // make_points: x = id
  EXPECT_EQ(table.find("tip.displacement_y")->at(1),
            test::make_points<2>(1, 3)[0].state.displacement[1]); // one point: exact
  // Exact in binary: quarters of small integers.
  EXPECT_EQ(table.find("face.position_x")->at(0), 0.25 * 3. + 0.75 * static_cast<double>(far));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoProbeWriterMpi, OneByOneEqualsAllAtOnce)
{
  const unsigned int        rank   = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const auto                points = test::make_points<3>(20, 20 * rank);
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  ProbeWriter<3>            probes(run, {{"a", {{5, 1.}, {7, 1.}}}});
  probes.write(1, points);
  probes.begin();
  for (const auto &point : points)
    if (probes.tracks(point.id))
      probes.add(point);
  probes.end_row(1);
  MPI_Barrier(MPI_COMM_WORLD);
  for (const std::vector<double> &column : read_csv(scratch / "probes.csv").values)
    EXPECT_EQ(column.at(0), column.at(1));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoProbeWriterMpi, LostPointIsAnError)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  ProbeWriter<2>            probes(run, {{"tip", {{99, 1.}}}});
  EXPECT_ANY_THROW(probes.write(0, test::make_points<2>(3)));
}

TEST(IoProbeWriter, WithoutProbesThereIsNoFile)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  ProbeWriter<2>            probes(run, {});
  EXPECT_TRUE(probes.empty());
  EXPECT_FALSE(probes.tracks(0));
  probes.write(0, test::make_points<2>(3));
  EXPECT_EQ(probes.position().n_bytes, 0u);
  EXPECT_FALSE(std::filesystem::exists(scratch / "probes.csv"));
}

TEST(IoProbeWriter, BadProbesAreTheUsersErrors)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  using Writer = ProbeWriter<2>;
  EXPECT_THROW(Writer(run, {{"tip", {}}}), UserError);
  EXPECT_THROW(Writer(run, {{"a,b", {{0, 1.}}}}), UserError);
  EXPECT_THROW(Writer(run, {{"", {{0, 1.}}}}), UserError);
  EXPECT_THROW(Writer(run, {{"a", {{0, 1.}}}, {"a", {{1, 1.}}}}), UserError);
}

TEST(IoProbeWriter, ResumedFileEqualsTheUninterruptedOne)
{
  const auto                points = test::make_points<2>(3);
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  CsvPosition               position;
  {
    ProbeWriter<2> probes(run, {{"tip", {{1, 1.}}}});
    probes.write(1, points);
    position = probes.position();
    probes.write(2, points);
  }
  const std::string whole = read_file(scratch / "probes.csv");
  {
    ProbeWriter<2> probes(run, {{"tip", {{1, 1.}}}}, position);
    probes.write(2, points);
  }
  EXPECT_EQ(read_file(scratch / "probes.csv"), whole);
}
