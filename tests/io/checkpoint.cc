#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/checkpoint.h>
#include <kedge/io/files.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

using namespace kedge;
namespace fs = std::filesystem;

namespace
{
  unsigned int
  rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  template <int dim>
  CheckpointData<dim>
  make_data(const double time)
  {
    CheckpointData<dim> data;
    data.settings = {{"Title", "a"}, {"Time/Step", "0.1"}, {"Materials/Output/Density", "1"}};
    data.n_ranks  = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    data.scalars["time"]  = time;
    data.counters["step"] = (std::uint64_t(1) << 63) + 1;
    data.arrays["empty"]  = {};
    data.arrays["values"] = {1. / 3., -0., std::nan("")};
    data.points           = test::make_points<dim>(5 + rank(), 100 * rank());
    std::swap(data.points[0], data.points[3]); // an order of its own
    return data;
  }

  /** Equal bit for bit, NaN and signed zeros included. */
  template <typename T>
  bool
  same_bits(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() && (a.empty() || std::memcmp(static_cast<const void *>(a.data()),
                                                             static_cast<const void *>(b.data()),
                                                             a.size() * sizeof(T)) == 0);
  }

  template <int dim>
  void
  expect_same(const CheckpointData<dim> &a, const CheckpointData<dim> &b)
  {
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.n_ranks, b.n_ranks);
    EXPECT_EQ(a.scalars, b.scalars);
    EXPECT_EQ(a.counters, b.counters);
    EXPECT_EQ(a.arrays.size(), b.arrays.size());
    for (const auto &[name, values] : a.arrays)
      EXPECT_TRUE(same_bits(values, b.arrays.at(name))) << name;
    EXPECT_TRUE(same_bits(a.points, b.points));
  }

  void
  damage(const fs::path &file, const std::string &content)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0)
      write_file(file, content);
    MPI_Barrier(MPI_COMM_WORLD);
  }

  /** What read_latest says; the time it read if it succeeds. */
  std::string
  outcome(const RunFolder &run, const SceneSettings &settings = make_data<2>(0).settings)
  {
    try
      {
        const auto data = CheckpointStore<2>(run).read_latest(settings);
        return exact_text(data.scalars.at("time"));
      }
    catch (const UserError &error)
      {
        return error.what();
      }
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

template <int dim>
void
test_round_trip()
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  const auto                data = make_data<dim>(0.1);
  CheckpointStore<dim>(run).write(data);
  expect_same(CheckpointStore<dim>(run).read_latest(make_data<2>(0).settings), data);
}

TEST(IoCheckpointMpi, ComesBackBitForBit)
{
  test_round_trip<2>();
  test_round_trip<3>();
}

TEST(IoCheckpointMpi, TheTwoNewestAreKept)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  CheckpointStore<2>        store(run);
  for (const double time : {1., 2., 3., 4.})
    store.write(make_data<2>(time));
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(scratch / "checkpoint/state-000002"));
  EXPECT_TRUE(fs::exists(scratch / "checkpoint/state-000003"));
  EXPECT_TRUE(fs::exists(scratch / "checkpoint/state-000004"));
  EXPECT_EQ(outcome(run), "4");
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoCheckpointMpi, FallsBackFromADamagedOne)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    CheckpointStore<2> store(run);
    store.write(make_data<2>(1));
    store.write(make_data<2>(2));
  }
  const fs::path    last     = scratch / ("checkpoint/state-000002/rank-000" +
                                   std::to_string(make_data<2>(0).n_ranks - 1) + ".bin");
  const std::string whole    = read_file(last);
  const fs::path    manifest = scratch / "checkpoint/state-000002/manifest.txt";

  damage(last, whole.substr(0, whole.size() / 2)); // truncated
  EXPECT_EQ(outcome(run), "1");
  std::string flipped = whole; // one bit
  flipped[whole.size() - 9] ^= 4;
  damage(last, flipped);
  EXPECT_EQ(outcome(run), "1");
  damage(last, whole);
  EXPECT_EQ(outcome(run), "2");

  const std::string text = read_file(manifest);
  damage(manifest, text.substr(0, text.size() - 3));
  EXPECT_EQ(outcome(run), "1");
  damage(manifest, "");
  EXPECT_EQ(outcome(run), "1");

  // ranks that no file could have, under a checksum that is right
  const std::size_t ranks = text.find("ranks ");
  std::string       forged =
    text.substr(0, ranks) + "ranks 99999999999999" +
    text.substr(text.find('\n', ranks), text.rfind("crc ") - text.find('\n', ranks));
  forged += "crc " + std::to_string(crc32_of(forged)) + '\n';
  damage(manifest, forged);
  EXPECT_EQ(outcome(run), "1");

  // The next one written replaces the damaged one, not the one resumed from.
  CheckpointStore<2> store(run);
  store.read_latest(make_data<2>(0).settings);
  store.write(make_data<2>(3));
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(scratch / "checkpoint/state-000001"));
  EXPECT_FALSE(fs::exists(scratch / "checkpoint/state-000002"));
  EXPECT_EQ(outcome(run), "3");

  damage(scratch / "checkpoint/state-000001/manifest.txt", "x");
  damage(scratch / "checkpoint/state-000003/manifest.txt", "x");
  const std::string message = outcome(run);
  EXPECT_TRUE(contains(message, "No whole checkpoint is left")) << message;
  EXPECT_TRUE(contains(message, "afresh without --resume")) << message;
}

TEST(IoCheckpointMpi, AKillWhileWritingLeavesTheOlderOne)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    CheckpointStore<2> store(run);
    store.write(make_data<2>(1));
  }
  if (rank() == 0)
    fs::create_directories(scratch / "checkpoint/unfinished-000002");
  damage(scratch / "checkpoint/unfinished-000002/rank-0000.bin", "half of it");
  EXPECT_EQ(outcome(run), "1");
  CheckpointStore<2>(run).write(make_data<2>(2));
  EXPECT_EQ(outcome(run), "2");
  EXPECT_FALSE(fs::exists(scratch / "checkpoint/unfinished-000002"));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoCheckpointMpi, ForeignOnesAreTheUsersErrors)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  EXPECT_TRUE(contains(outcome(run), "There is no checkpoint"));
  CheckpointStore<2>(run).write(make_data<2>(1));
  // what concerns output and the end may change; a material named like a section may not
  SceneSettings settings = make_data<2>(0).settings;
  settings["Time/Step"]  = "0.2";
  settings["Title"]      = "b";
  EXPECT_EQ(outcome(run, settings), "1");
  settings["Materials/Output/Density"] = "2";
  settings["Newton/Tolerance"]         = "1e-9";
  const std::string message            = outcome(run, settings);
  EXPECT_TRUE(contains(message, "belongs to another scene")) << message;
  EXPECT_TRUE(contains(message, "Materials/Output/Density was '1', is '2'")) << message;
  EXPECT_TRUE(contains(message, "Newton/Tolerance was not there, is '1e-9'")) << message;
  EXPECT_FALSE(contains(message, "Time/Step")) << message;
  EXPECT_THROW(CheckpointStore<3>(run).read_latest(make_data<2>(0).settings), UserError);
}

TEST(IoCheckpointMpi, AnotherNumberOfRanks)
{
  const test::ScratchFolder scratch;
  {
    const RunFolder run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
    CheckpointStore<2>(run).write(make_data<2>(1));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() != 0 || make_data<2>(0).n_ranks == 1)
    return; // two ranks wrote, one reads
  const RunFolder alone(scratch.path(), RunFolder::Mode::resume, MPI_COMM_SELF);
  const auto      data = CheckpointStore<2>(alone).read_latest(make_data<2>(0).settings);
  EXPECT_EQ(data.n_ranks, 2u);
  EXPECT_EQ(data.scalars.at("time"), 1.);
  std::set<std::uint64_t> ids;
  for (const auto &point : data.points)
    ids.insert(point.id);
  EXPECT_EQ(data.points.size(), 5u + 6u); // what the two ranks had, see make_data
  EXPECT_EQ(ids.size(), 5u + 6u);
}

TEST(IoCheckpoint, ChangesThatResumingAllows)
{
  for (const char *name :
       {"Title", "Time/End", "Time/Step", "Output/Fields", "Checks/mass/Reference"})
    EXPECT_TRUE(may_change_on_resume(name)) << name;
  // names of the user's own: a material Checks, a body Output, a constant Step
  for (const char *name :
       {"Materials/Checks/Density", "Bodies/Output/Box", "Constants/Step", "Time/Alpha"})
    EXPECT_FALSE(may_change_on_resume(name)) << name;
  SceneSettings then, now;
  for (const char *name : {"a", "b", "c", "d", "e", "f", "g"})
    then[name] = "1";
  EXPECT_EQ(forbidden_changes(then, then), "");
  const std::string all = forbidden_changes(then, now); // names five of seven
  EXPECT_TRUE(contains(all, "e was '1', is not there, and 2 more")) << all;
}
