#include <kedge/equations/ledger.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  using Section = Ledger::Section;
  using Kind    = Ledger::Kind;
  using Role    = Ledger::Role;

  /** Books of a body that falls on a damper, with numbers made up. */
  struct Books
  {
    Books()
      : kinetic(ledger.declare(
          {"kinetic_energy", "J", Section::energy, Kind::present, Role::stored, "energy"}))
      , heat(ledger.declare({"heat", "J", Section::energy, Kind::total, Role::lost, "energy"}))
      , work(ledger.declare({"work", "J", Section::work, Kind::total, Role::supplied, "energy"}))
      , lowest(ledger.declare({"lowest", "", Section::state, Kind::lowest}))
      , force(ledger.declare({"force", "N", Section::force, Kind::of_step}))
    {
      ledger.declare_stored("total_energy", "J", Section::work, "energy");
      ledger.declare_error("energy_error", "J", Section::work, "energy");
    }

    void
    close_with(const std::vector<std::pair<Ledger::Index, double>> &shares)
    {
      ledger.open();
      for (const auto &[entry, share] : shares)
        ledger.book(entry, share);
      ledger.close(MPI_COMM_WORLD);
    }

    Ledger        ledger;
    Ledger::Index kinetic, heat, work, lowest, force;
  };

  unsigned int
  n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }
} // namespace

TEST(EquationsLedgerMpi, SumsOverRanksAndSteps)
{
  Books        books;
  const double n = n_ranks();
  books.close_with({{books.kinetic, 2.}, {books.kinetic, 1.}, {books.lowest, 5.}});
  books.ledger.set_start();
  books.close_with({{books.kinetic, 4.}, {books.heat, .5}, {books.work, 1.}, {books.force, 7.}});
  books.close_with({{books.kinetic, 6.}, {books.heat, .25}, {books.work, 2.}, {books.lowest, -3.}});
  // sums by hand; every rank books the same
  EXPECT_EQ(books.ledger.value("kinetic_energy"), 6. * n);
  EXPECT_EQ(books.ledger.value("heat"), .75 * n);
  EXPECT_EQ(books.ledger.value("work"), 3. * n);
  EXPECT_EQ(books.ledger.value("lowest"), -3.);
  books.close_with({{books.kinetic, 6.}});
  EXPECT_EQ(books.ledger.value("lowest"), 0.); // nobody had anything
  EXPECT_EQ(books.ledger.value("force"), 0.); // none in the last steps
  EXPECT_EQ(books.ledger.value("total_energy"), 6. * n);
  EXPECT_EQ(books.ledger.value("energy_error"), (6. - 3. + .75 - 3.) * n);
  EXPECT_EQ(books.ledger.value_or("none", 2.), 2.);
}

TEST(EquationsLedger, ColumnsStandBySection)
{
  Books                    books;
  std::vector<std::string> names;
  for (const auto &column : books.ledger.columns())
    names.push_back(column.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"kinetic_energy",
                                      "heat",
                                      "work",
                                      "total_energy",
                                      "energy_error",
                                      "force",
                                      "lowest"}));
  EXPECT_EQ(books.ledger.values().size(), names.size());
}

TEST(EquationsLedger, OneNameIsOneEntry)
{
  Books books;
  EXPECT_EQ(books.ledger.declare({"work", "J", Section::work}), books.work);
  EXPECT_EQ(books.ledger.columns().size(), 7u);
}

TEST(EquationsLedger, ARestoredLedgerGoesOnAsIfNothingWere)
{
  Books books, resumed;
  books.close_with({{books.kinetic, 3.}});
  books.ledger.set_start();
  books.close_with({{books.kinetic, 4.}, {books.heat, .5}, {books.work, 2.}});
  resumed.ledger.restore(books.ledger.save());
  for (Books *each : {&books, &resumed})
    each->close_with({{books.kinetic, 5.}, {books.heat, .5}, {books.work, 1.}});
  EXPECT_EQ(resumed.ledger.values(), books.ledger.values());
  EXPECT_THROW(resumed.ledger.restore({}), dealii::ExceptionBase);
}

TEST(EquationsLedger, PartsHaveBalancesOfTheirOwn)
{
  Ledger        ledger;
  Ledger::Index kinetic[2], work[2];
  for (int k : {0, 1})
    {
      ledger.open_part(k == 0 ? "left" : "right");
      kinetic[k] = ledger.declare(
        {"kinetic_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
      work[k] = ledger.declare({"work", "J", Section::work, Kind::total, Role::supplied, "energy"});
      ledger.close_part();
    }
  ledger.declare_error("energy_error", "J", Section::work, "energy");
  ledger.open();
  ledger.close(MPI_COMM_SELF);
  ledger.set_start();
  ledger.open();
  ledger.book(kinetic[0], 3.);
  ledger.book(kinetic[1], 4.);
  ledger.book(work[0], 1.);
  ledger.close(MPI_COMM_SELF);
  EXPECT_EQ(ledger.value("kinetic_energy"), 7.);
  EXPECT_EQ(ledger.value("kinetic_energy_right"), 4.);
  EXPECT_EQ(ledger.value("energy_error"), 6.);
  EXPECT_EQ(ledger.value("energy_error_left"), 2.);
  EXPECT_EQ(ledger.value("total_energy_right"), 4.);
}
