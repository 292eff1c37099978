#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>
#include <kedge/io/run_folder.h>

#include <gtest/gtest.h>

using namespace kedge;
namespace fs = std::filesystem;

namespace
{
  std::string
  message_of(const fs::path &folder, const RunFolder::Mode mode)
  {
    try
      {
        RunFolder run(folder, mode, MPI_COMM_WORLD);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace

TEST(IoRunFolder, FreshRunReplacesKedgesFilesOnly)
{
  const test::ScratchFolder scratch;
  const fs::path            folder = scratch / "deep/er";
  {
    const RunFolder first(folder, RunFolder::Mode::fresh, MPI_COMM_WORLD);
  }
  fs::create_directories(folder / "points");
  fs::create_directories(folder / "checkpoint/state-000003");
  fs::create_directories(folder / "checkpoint/unfinished-000004");
  const std::vector<std::string> ours   = {"history.csv",
                                           "summary.json",
                                           "summary.json.new",
                                           "points/points-000001.vtu",
                                           "points/points-000001.0001.vtu",
                                           "points/points-000001.h5",
                                           "checkpoint/state-000003/manifest.txt",
                                           "checkpoint/state-000003/rank-0000.bin",
                                           "checkpoint/unfinished-000004/rank-0000.bin"};
  const std::vector<std::string> theirs = {"notes.txt",
                                           "points/mine.vtu",
                                           "points/points-1.vtu.bak",
                                           "history.csv.gz"};
  for (const std::string &name : ours)
    write_file(folder / name, "x");
  for (const std::string &name : theirs)
    write_file(folder / name, "x");

  const RunFolder second(folder, RunFolder::Mode::fresh, MPI_COMM_WORLD);
  for (const std::string &name : ours)
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const std::string &name : theirs)
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "checkpoint")); // was empty
}

TEST(IoRunFolder, FollowsNoLinks)
{
  const test::ScratchFolder scratch;
  const fs::path            folder = scratch / "run";
  {
    const RunFolder first(folder, RunFolder::Mode::fresh, MPI_COMM_WORLD);
  }
  fs::create_directories(scratch / "elsewhere");
  write_file(scratch / "elsewhere/points-000001.vtu", "x");
  fs::create_directory_symlink(scratch / "elsewhere", folder / "points");
  const RunFolder second(folder, RunFolder::Mode::fresh, MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(scratch / "elsewhere/points-000001.vtu"));
}

TEST(IoRunFolder, RefusesToReplaceForeignFiles)
{
  const test::ScratchFolder scratch;
  fs::create_directories(scratch.path());
  write_file(scratch / "notes.txt", "x");
  EXPECT_EQ(message_of(scratch.path(), RunFolder::Mode::fresh), "no error");

  const test::ScratchFolder other;
  fs::create_directories(other.path());
  write_file(other / "parameters.prm", "precious");
  const std::string message = message_of(other.path(), RunFolder::Mode::fresh);
  EXPECT_NE(message.find("parameters.prm"), std::string::npos) << message;
  EXPECT_EQ(read_file(other / "parameters.prm"), "precious");
}

TEST(IoRunFolder, OneRunAtATime)
{
  const test::ScratchFolder scratch;
  {
    const RunFolder first(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
    write_file(scratch / "history.csv", "x");
    for (const auto mode : {RunFolder::Mode::fresh, RunFolder::Mode::resume})
      {
        const std::string message = message_of(scratch.path(), mode);
        EXPECT_NE(message.find("process " + std::to_string(getpid())), std::string::npos)
          << message;
        EXPECT_NE(message.find("--output"), std::string::npos) << message;
      }
    EXPECT_TRUE(fs::exists(scratch / "history.csv"));
  }
  {
    // one that resumes keeps others out, too
    const RunFolder first(scratch.path(), RunFolder::Mode::resume, MPI_COMM_WORLD);
    EXPECT_NE(message_of(scratch.path(), RunFolder::Mode::fresh), "no error");
  }
  // who was killed has left a mark and holds nothing
  write_file(scratch / ".kedge", "Last written by process 1 on nowhere.\n");
  EXPECT_EQ(message_of(scratch.path(), RunFolder::Mode::resume), "no error");
}

TEST(IoRunFolder, AKillWhileClearingLeavesNoHalfRun)
{
  const test::ScratchFolder scratch;
  {
    const RunFolder first(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  }
  // states retired by a run that was killed then, and one that a later run has written
  for (const char *state : {"cleared-000003", "cleared-000004", "state-000004"})
    {
      fs::create_directories(scratch / ("checkpoint/" + std::string(state)));
      write_file(scratch / ("checkpoint/" + std::string(state) + "/manifest.txt"), "x");
    }
  const RunFolder second(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(scratch / "checkpoint"));
}

TEST(IoRunFolder, LongNamesAreTheUsersErrors)
{
  const test::ScratchFolder scratch;
  for (const auto mode : {RunFolder::Mode::fresh, RunFolder::Mode::resume})
    EXPECT_NE(message_of(scratch / std::string(300, 'a'), mode), "no error");
}

TEST(IoRunFolder, NamesCauseAndRemedy)
{
  const test::ScratchFolder scratch;
  fs::create_directories(scratch.path());
  write_file(scratch / "file", "x");
  // Below a file no folder can be made, whoever one is (root may write anywhere else).
  const std::string message = message_of(scratch / "file/run", RunFolder::Mode::fresh);
  EXPECT_NE(message.find("Cannot make the output folder"), std::string::npos) << message;
  EXPECT_NE(message.find("--output"), std::string::npos) << message;
  EXPECT_NE(message_of(scratch / "file", RunFolder::Mode::fresh).find("Cannot make"),
            std::string::npos);
  const std::string no_run = message_of(scratch / "empty", RunFolder::Mode::resume);
  EXPECT_NE(no_run.find("no run to resume"), std::string::npos) << no_run;
  EXPECT_FALSE(fs::exists(scratch / "empty"));
}

TEST(IoRunFolderMpi, LogStandsOnTheTerminalAndInTheFileOnce)
{
  const test::ScratchFolder scratch;
  testing::internal::CaptureStdout();
  {
    const RunFolder run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
    run.log() << "one " << 1 << std::endl;
    if (run.is_root())
      {
        EXPECT_EQ(read_file(scratch / "log.txt"), "one 1\n"); // flushed by endl
      }
  }
  {
    const RunFolder run(scratch.path(), RunFolder::Mode::resume, MPI_COMM_WORLD);
    run.log() << "two\n";
  }
  const std::string printed = testing::internal::GetCapturedStdout();
  const bool        root    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  EXPECT_EQ(printed, root ? "one 1\ntwo\n" : "");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(read_file(scratch / "log.txt"), "one 1\ntwo\n");
}

TEST(IoRunFolderMpi, AllRanksSeeTheError)
{
  const test::ScratchFolder scratch;
  EXPECT_NE(message_of(scratch.path(), RunFolder::Mode::resume), "no error");
}
