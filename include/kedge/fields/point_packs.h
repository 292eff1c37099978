#ifndef kedge_fields_point_packs_h
#define kedge_fields_point_packs_h

#include <kedge/base/pack.h>
#include <kedge/fields/step_points.h>

namespace kedge
{
  /** Consecutive slots of StepPoints in the lanes of a Pack. */
  struct PackOfSlots
  {
    unsigned int begin; ///< slot of lane 0
    unsigned int count; ///< lanes in use, 1 to pack_width; the others repeat the last one

    PackOfSlots(const unsigned int begin, const unsigned int end)
      : begin(begin)
      , count(std::min(pack_width, end - begin))
    {}

    unsigned int
    slot(const unsigned int lane) const
    {
      return begin + std::min(lane, count - 1);
    }

    /** First slot where a condition on the lanes in use does not hold, or @p none. */
    template <class Mask>
    unsigned int
    first_failure(const Mask &condition, const unsigned int none) const
    {
      for (unsigned int lane = 0; lane < count; ++lane)
        if (!condition[lane])
          return begin + lane;
      return none;
    }
  };

  /**
   * Copies a structure of doubles into a lane of the same structure of Packs,
   * as in StressState<dim, double> and StressState<dim, Pack>.
   */
  template <template <int, typename> class Structure, int dim>
  inline void
  set_lane(const unsigned int lane, const Structure<dim, double> &from, Structure<dim, Pack> &to)
  {
    constexpr unsigned int n = sizeof(from) / sizeof(double);
    static_assert(sizeof(to) == n * sizeof(Pack), "nothing but numbers");
    const auto *source = reinterpret_cast<const double *>(&from);
    auto       *target = reinterpret_cast<double *>(&to);
    for (unsigned int i = 0; i < n; ++i)
      target[i * pack_width + lane] = source[i];
  }

  /** The reverse of set_lane(). */
  template <template <int, typename> class Structure, int dim>
  inline void
  get_lane(const unsigned int lane, const Structure<dim, Pack> &from, Structure<dim, double> &to)
  {
    constexpr unsigned int n = sizeof(to) / sizeof(double);
    static_assert(sizeof(from) == n * sizeof(Pack), "nothing but numbers");
    const auto *source = reinterpret_cast<const double *>(&from);
    auto       *target = reinterpret_cast<double *>(&to);
    for (unsigned int i = 0; i < n; ++i)
      target[i] = source[i * pack_width + lane];
  }

  template <int dim>
  inline StressState<dim, Pack>
  pack_of_states(const StepPoints<dim> &points, const PackOfSlots &slots)
  {
    StressState<dim, Pack> result;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      set_lane(lane, points.stress_state[slots.slot(lane)], result);
    return result;
  }

  /** Histories of the points, whose body is of this Material: all its columns. */
  template <class Material, int dim>
  inline HistoryOf<Material, Pack>
  pack_of_histories(const StepPoints<dim> &points, const PackOfSlots &slots)
  {
    HistoryOf<Material, Pack> result{};
    if constexpr (has_columns<Material>)
      {
        static_assert(sizeof(result) == n_columns<Material> * sizeof(Pack), "a Number per column");
        auto *target = reinterpret_cast<double *>(&result);
        for (unsigned int lane = 0; lane < pack_width; ++lane)
          {
            const double *values = points.history_values(slots.slot(lane));
            for (unsigned int c = 0; c < n_columns<Material>; ++c)
              target[c * pack_width + lane] = values[c];
          }
      }
    return result;
  }
} // namespace kedge

#endif
