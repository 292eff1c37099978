#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>
#include <kedge/io/history_writer.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  /** Some columns of a ledger; the last but one is a count. */
  std::vector<Ledger::Column>
  some_columns()
  {
    return {{"kinetic_energy", "J", Ledger::Section::energy, false},
            {"external_work", "J", Ledger::Section::work, false},
            {"n_points", "", Ledger::Section::state, true},
            {"mass", "kg", Ledger::Section::state, false}};
  }

  HistoryRow
  make_row(const std::uint64_t step)
  {
    HistoryRow row;
    row.step              = step;
    row.time              = 0.1 * static_cast<double>(step);
    row.time_step         = 0.1;
    row.newton_iterations = 3;
    row.books             = {1. / 3., 0., 400., 12.};
    return row;
  }
} // namespace

TEST(IoHistoryWriter, ShowsTheStepAndTheBooks)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    HistoryWriter writer(run, some_columns());
    writer.write(make_row(1));
  }
  // written out by hand; the shortest text that is the same number
  EXPECT_EQ(read_file(scratch / "history.csv"),
            "step,time,time_step,newton_iterations,linear_iterations,rejected_attempts,"
            "kinetic_energy,external_work,n_points,mass,wall_time\n"
            "1,0.1,0.1,3,0,0,0.3333333333333333,0,400,12,0\n");
  const CsvTable table = read_csv(scratch / "history.csv");
  EXPECT_EQ(table.find("kinetic_energy")->at(0), 1. / 3.); // bit for bit
  EXPECT_EQ(table.find("no_such"), nullptr);
}

TEST(IoHistoryWriter, RowsAreThereAtOnce)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  HistoryWriter             writer(run, some_columns());
  writer.write(make_row(1));
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 1u);
  writer.write(make_row(2));
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 2u);
}

TEST(IoHistoryWriter, ResumedFileEqualsTheUninterruptedOne)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  CsvPosition               position;
  {
    HistoryWriter writer(run, some_columns());
    for (const std::uint64_t step : {1, 2, 3, 4, 5})
      {
        writer.write(make_row(step));
        if (step == 3)
          position = writer.position();
      }
  }
  const std::string whole = read_file(scratch / "history.csv");
  // A kill in the middle of a row.
  write_file(scratch / "history.csv", whole.substr(0, whole.size() - 4));
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 4u);
  {
    HistoryWriter writer(run, some_columns(), position);
    EXPECT_EQ(read_file(scratch / "history.csv").size(), position.n_bytes);
    writer.write(make_row(4));
    writer.write(make_row(5));
    EXPECT_EQ(writer.position().n_bytes, whole.size());
  }
  EXPECT_EQ(read_file(scratch / "history.csv"), whole);
}

TEST(IoHistoryWriter, RefusesToResumeAnotherFile)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  CsvPosition               position;
  {
    HistoryWriter writer(run, some_columns());
    writer.write(make_row(1));
    position = writer.position();
  }
  EXPECT_THROW(HistoryWriter(run, {}, position), UserError); // other columns
  const auto at = [&](const std::uint64_t n_bytes) {
    return CsvPosition{n_bytes};
  };
  const std::uint64_t n = position.n_bytes;
  EXPECT_THROW(HistoryWriter(run, some_columns(), at(n + 1)), UserError); // too short
  EXPECT_THROW(HistoryWriter(run, some_columns(), at(n - 1)), UserError); // inside a row
  EXPECT_THROW(HistoryWriter(run, some_columns(), at(3)), UserError);     // inside the header
  // a digit of a row before the checkpoint, changed by hand
  const std::string whole      = read_file(scratch / "history.csv");
  std::string       forged     = whole;
  forged[forged.find("0.333")] = '9';
  write_file(scratch / "history.csv", forged);
  EXPECT_THROW(HistoryWriter(run, some_columns(), position), UserError);
  write_file(scratch / "history.csv", whole);
  EXPECT_NO_THROW(HistoryWriter(run, some_columns(), position));
  std::filesystem::remove(scratch / "history.csv");
  EXPECT_THROW(HistoryWriter(run, some_columns(), position), UserError);
}

TEST(IoHistoryWriter, FullDiskIsTheUsersError)
{
  if (!std::filesystem::exists("/dev/full")) // a file on a full disk, on Linux
    GTEST_SKIP() << "this system has no /dev/full to stand for a full disk";
  EXPECT_THROW(CsvFile("/dev/full", {"a"}), UserError);
}

TEST(IoHistoryWriterMpi, RankZeroWrites)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  HistoryWriter             writer(run, some_columns());
  writer.write(make_row(1));
  EXPECT_EQ(writer.position().n_bytes > 0, run.is_root());
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 1u);
}
