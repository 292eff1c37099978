#ifndef kedge_materials_history_h
#define kedge_materials_history_h

#include <kedge/base/pack.h>

#include <array>
#include <cstring>
#include <type_traits>

namespace kedge
{
  /** What a column of a law's history is. */
  enum class ColumnKind
  {
    remembered,    ///< changes with the steps
    of_place,      ///< a constant of the law that may differ from place to place
    volume_strain, ///< ln det F; not stored, the deformation gradient gives it
    time_step      ///< that of the present step [s]; not stored
  };

  /** A number that a law answers by beside the elastic strain, as committed. */
  struct Column
  {
    const char *name;
    const char *unit;
    const char *meaning;
    ColumnKind  kind = ColumnKind::remembered;
  };

  /** Instead of a memory_index(): the column is ln det F. */
  constexpr unsigned int not_in_memory = static_cast<unsigned int>(-1);

  /** Instead of a memory_index(): the column is the present time step. */
  constexpr unsigned int is_time_step = static_cast<unsigned int>(-2);

  /** Columns that a single law may have. */
  constexpr unsigned int most_law_columns = 8;

  /**
   * The history of a law: a structure of Numbers, one for each of Law::columns
   * and in their order; empty if the law has none.
   */
  template <class Law, typename Number = double>
  using HistoryOf = typename Law::template History<Number>;

  template <class Law>
  constexpr unsigned int n_columns = Law::columns.size();

  /** Whether the points of a law have to carry or work out anything for it. */
  template <class Law>
  constexpr bool has_columns = n_columns<Law> > 0;

  /** A history from the numbers of its columns. */
  template <class Law>
  inline HistoryOf<Law>
  read_history(const double *values)
  {
    static_assert(n_columns<Law> <= most_law_columns);
    HistoryOf<Law> history{};
    if constexpr (has_columns<Law>)
      {
        static_assert(sizeof(history) == n_columns<Law> * sizeof(double), "a Number per column");
        std::memcpy(static_cast<void *>(&history), values, sizeof(history));
      }
    return history;
  }

  /** The numbers of a history's columns. */
  template <class Law, typename Number>
  inline void
  write_history(const HistoryOf<Law, Number> &history, Number *values)
  {
    if constexpr (has_columns<Law>)
      {
        static_assert(sizeof(history) == n_columns<Law> * sizeof(Number), "a Number per column");
        std::memcpy(static_cast<void *>(values), &history, sizeof(history));
      }
    else
      {
        (void)history;
        (void)values;
      }
  }
} // namespace kedge

#endif
