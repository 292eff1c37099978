#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>
#include <kedge/io/history_writer.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  HistoryRow
  make_row(const std::uint64_t step)
  {
    HistoryRow row;
    row.step                = step;
    row.time                = 0.1 * static_cast<double>(step);
    row.time_step           = 0.1;
    row.newton_iterations   = 3;
    row.kinetic_energy      = 1. / 3.;
    row.strain_energy       = 2. / 3.;
    row.linear_momentum[1]  = -7;
    row.angular_momentum[0] = 5;
    row.angular_momentum[2] = 9;
    row.mass                = 12;
    row.n_points            = 400;
    row.min_det_F           = 0.99;
    return row;
  }

  std::string
  first_line(const std::string &text)
  {
    return text.substr(0, text.find('\n'));
  }
} // namespace

TEST(IoHistoryWriter, ColumnsAreThePromisedOnes)
{
  // The lists are those promised to users (see the user guide); order included.
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    HistoryWriter writer(run, {2, false, false});
    writer.write(make_row(1));
  }
  EXPECT_EQ(read_file(scratch / "history.csv"),
            "step,time,time_step,newton_iterations,linear_iterations,rejected_attempts,"
            "kinetic_energy,strain_energy,external_work,total_energy,energy_error,"
            "linear_momentum_x,linear_momentum_y,angular_momentum_z,mass,n_points,"
            "n_active_cells,n_dofs,min_det_F,wall_time\n"
            "1,0.1,0.1,3,0,0,0.3333333333333333,0.6666666666666666,0,1,0,0,-7,9,12,400,0,0,"
            "0.99,0\n");
  {
    HistoryWriter writer(run, {3, true, true});
    writer.write(make_row(1));
  }
  const std::string text = read_file(scratch / "history.csv");
  EXPECT_EQ(first_line(text),
            "step,time,time_step,newton_iterations,linear_iterations,rejected_attempts,"
            "kinetic_energy,strain_energy,hardening_energy,plastic_dissipation,"
            "stabilisation_energy,external_work,total_energy,energy_error,"
            "linear_momentum_x,linear_momentum_y,linear_momentum_z,"
            "angular_momentum_x,angular_momentum_y,angular_momentum_z,mass,n_points,"
            "n_active_cells,n_dofs,min_det_F,wall_time");
  const CsvTable table = read_csv(scratch / "history.csv");
  EXPECT_EQ(table.find("angular_momentum_x")->at(0), 5);
  EXPECT_EQ(table.find("kinetic_energy")->at(0), 1. / 3.); // bit for bit
  EXPECT_EQ(table.find("no_such"), nullptr);
}

TEST(IoHistoryWriter, ReactionsHaveTheColumnsThatAreAskedFor)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  HistoryWriter writer(run, {2, false, false, false, {"reaction_clamp_x", "reaction_clamp_y"}});
  HistoryRow    row = make_row(1);
  writer.write(row); // before the first step there are none
  row.reactions = {3., -1. / 7.};
  writer.write(row);
  const CsvTable table = read_csv(scratch / "history.csv");
  EXPECT_EQ(*table.find("reaction_clamp_x"), (std::vector<double>{0., 3.}));
  EXPECT_EQ(*table.find("reaction_clamp_y"), (std::vector<double>{0., -1. / 7.}));
  EXPECT_EQ(table.find("mass")->at(1), 12); // the columns after them
}

TEST(IoHistoryWriter, RowsAreThereAtOnce)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  HistoryWriter             writer(run, {});
  writer.write(make_row(1));
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 1u);
  writer.write(make_row(2));
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 2u);
}

TEST(IoHistoryWriter, ResumedFileEqualsTheUninterruptedOne)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  std::uint64_t             position = 0;
  {
    HistoryWriter writer(run, {});
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
    HistoryWriter writer(run, {}, position);
    EXPECT_EQ(read_file(scratch / "history.csv").size(), position);
    writer.write(make_row(4));
    writer.write(make_row(5));
    EXPECT_EQ(writer.position(), whole.size());
  }
  EXPECT_EQ(read_file(scratch / "history.csv"), whole);
}

TEST(IoHistoryWriter, RefusesToResumeAnotherFile)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  std::uint64_t             position = 0;
  {
    HistoryWriter writer(run, {});
    writer.write(make_row(1));
    position = writer.position();
  }
  EXPECT_THROW(HistoryWriter(run, {3, false, false}, position), UserError); // other columns
  EXPECT_THROW(HistoryWriter(run, {}, position + 1), UserError);            // too short
  EXPECT_THROW(HistoryWriter(run, {}, position - 1), UserError);            // inside a row
  EXPECT_THROW(HistoryWriter(run, {}, 3), UserError);                       // inside the header
  std::filesystem::remove(scratch / "history.csv");
  EXPECT_THROW(HistoryWriter(run, {}, position), UserError);
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
  HistoryWriter             writer(run, {});
  writer.write(make_row(1));
  EXPECT_EQ(writer.position() > 0, run.is_root());
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(read_csv(scratch / "history.csv").find("step")->size(), 1u);
}
