#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace kedge;

TEST(IoFiles, ReplaceLeavesTheNewTextAndNothingElse)
{
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path());
  replace_file(scratch / "a.txt", "first, and longer");
  replace_file(scratch / "a.txt", "second");
  EXPECT_EQ(read_file(scratch / "a.txt"), "second");
  const std::filesystem::directory_iterator files(scratch.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1); // no temporary file left
}

TEST(IoFiles, UnwritablePlaceIsTheUsersError)
{
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path());
  try
    {
      replace_file(scratch / "no_such_folder/a.txt", "text");
      FAIL() << "no error";
    }
  catch (const UserError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("no_such_folder"), std::string::npos) << message;
      EXPECT_NE(message.find("No such file"), std::string::npos) << message;
    }
  EXPECT_THROW(read_file(scratch / "missing"), UserError);
  EXPECT_THROW(read_file(scratch.path()), UserError); // a folder
}

TEST(IoFiles, ExactTextReadsBackAsTheSameDouble)
{
  // Bit for bit: the promise of the function. 0.1 shows that the text is the short one.
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(std::numeric_limits<double>::signaling_NaN()), "nan");
  for (const double value : {1. / 3., 1e-310, -2.5e300, std::nextafter(1., 2.), M_PI})
    EXPECT_EQ(std::strtod(exact_text(value).c_str(), nullptr), value);
}

TEST(IoCollectiveMpi, AllRanksThrowWhatOneThrows)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int last = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  const auto         only = [&](const unsigned int r) {
    if (rank == r)
      throw UserError("cause");
  };
  EXPECT_THROW(run_on_root(MPI_COMM_WORLD,
                           [&]() {
                             only(0);
                           }),
               UserError);
  EXPECT_THROW(run_on_all(MPI_COMM_WORLD,
                          [&]() {
                            only(last);
                          }),
               UserError);
  EXPECT_NO_THROW(run_on_all(MPI_COMM_WORLD, [&]() {
    only(last + 1);
  }));
  try
    {
      run_on_all(MPI_COMM_WORLD, [&]() {
        if (rank == last)
          throw std::logic_error("ours");
      });
      FAIL() << "no error";
    }
  catch (const UserError &)
    {
      FAIL() << "not the user's error";
    }
  catch (const std::runtime_error &error)
    {
      EXPECT_STREQ(error.what(), "ours");
    }
}
