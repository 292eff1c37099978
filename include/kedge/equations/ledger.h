#ifndef kedge_equations_ledger_h
#define kedge_equations_ledger_h

#include <deal.II/base/mpi.h>

#include <map>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * The books of a run: every energy, work, dissipation, mass and force that
   * history.csv shows. Whoever makes a quantity declares it once, with its name, unit,
   * place in the file and part in a balance, and books this rank's share of it;
   * columns, sums over ranks and steps, checkpoints, errors of balance, checks and
   * plots follow from the declaration.
   *
   * A *balance* says what is conserved: with the stored amounts S, the losses L and
   * the supplies W so far,
   *   error = sum S - sum S(start) + sum L - sum W,
   * which is round-off where the method conserves.
   */
  class Ledger
  {
  public:
    /** Where a column stands in history.csv; within a section in the order of declaration. */
    enum class Section
    {
      energy,
      work,
      momentum,
      force,
      content, ///< of fluid and grains
      part,    ///< what the parts of a run have of the energies and momenta, see open_part()
      state    ///< mass, counts, extremes
    };

    /** How a value comes about. */
    enum class Kind
    {
      present, ///< of the present state: booked anew for each state, shares of ranks added up
      lowest,  ///< of the present state: the smallest of what is booked, of all ranks
      highest, ///< likewise the largest
      of_step, ///< of the last accepted step; shares added up
      total    ///< added up over all accepted steps of the run
    };

    /** Part of an entry in its balance. */
    enum class Role
    {
      none,
      stored,
      lost,
      supplied
    };

    struct Entry
    {
      std::string name;
      std::string unit;
      Section     section = Section::state;
      Kind        kind    = Kind::present;
      Role        role    = Role::none;
      std::string balance = {};    ///< name of the balance, if it has a role
      bool        whole   = false; ///< a count
    };

    /** A column of the file. */
    struct Column
    {
      std::string name, unit;
      Section     section;
      bool        whole;
    };

    using Index = unsigned int;

    /** Declares an entry, or finds the one of this name: several may book on it. */
    Index
    declare(const Entry &entry);

    /** Declares a column with the sum of what a balance has stored. */
    void
    declare_stored(const std::string &name,
                   const std::string &unit,
                   const Section      section,
                   const std::string &balance);

    /** Declares a column with the error of a balance. */
    void
    declare_error(const std::string &name,
                  const std::string &unit,
                  const Section      section,
                  const std::string &balance);

    /**
     * Until close_part(): energies, works and momenta that are declared belong to a part
     * of the run, such as one of several fields. What is booked on them counts in columns
     * of their own too, NAME_PART, with a balance of their own.
     */
    void
    open_part(const std::string &name);

    void
    close_part();

    /** Adds this rank's share to an entry of the present state, or of the last step. */
    void
    book(const Index entry, const double share);

    /** Forgets what was booked since the last close(). */
    void
    open();

    /** Adds up the shares of all ranks, and the totals (collective). */
    void
    close(const MPI_Comm communicator);

    /** Takes the present state as the start of all balances. */
    void
    set_start();

    /** Value of a column. */
    double
    value(const std::string &column) const;

    /** Value of a column; @p otherwise if there is none of this name. */
    double
    value_or(const std::string &column, const double otherwise) const;

    /** What the balance of this name has stored. */
    double
    stored(const std::string &balance) const;

    /** Its error. */
    double
    error(const std::string &balance) const;

    /** In the order of the file. */
    std::vector<Column>
    columns() const;

    /** Values of columns(). */
    std::vector<double>
    values() const;

    /** What a checkpoint keeps: totals and starts, by name. */
    std::map<std::string, double>
    save() const;

    /** @throws dealii::ExceptionBase for a value that is missing. */
    void
    restore(const std::map<std::string, double> &saved);

  private:
    /** What a column shows beside the entries themselves. */
    enum class Derived
    {
      no,
      stored,
      error
    };
    static constexpr Index no_entry = static_cast<Index>(-1);
    struct Item
    {
      Entry   entry;
      Derived derived     = Derived::no;
      double  booked      = 0.; ///< this rank's share since open()
      double  value       = 0.;
      double  start       = 0.;       ///< of stored ones
      Index   whole_entry = no_entry; ///< what this is a part of
    };

    Index
    find_or_add(const Entry &entry);

    static bool
    is_extreme(const Item &item)
    {
      return item.entry.kind == Kind::lowest || item.entry.kind == Kind::highest;
    }
    /** With which an extreme is the smallest of what is booked. */
    static double
    sign_of_extreme(const Item &item)
    {
      return item.entry.kind == Kind::lowest ? 1. : -1.;
    }

    double
    value(const Item &item) const;
    std::vector<const Item *>
    in_order() const;
    const Item *
    find(const std::string &name) const;

    std::vector<Item> items;
    std::string       part; ///< open one; empty: none
  };
} // namespace kedge

#endif
