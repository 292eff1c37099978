#ifndef kedge_points_point_layout_h
#define kedge_points_point_layout_h

#include <kedge/points/point_state.h>

#include <cstring>
#include <optional>
#include <vector>

namespace kedge
{
  /**
   * Which parts of PointState a cloud stores: what its scene does not use takes
   * no memory and reads as it is in a point at rest, 0.
   */
  template <int dim>
  class PointLayout
  {
  public:
    /** Everything. */
    PointLayout()
      : ranges({{0, n_state_values<dim>}})
    {}

    /**
     * What any point needs, and
     * @param memory         numbers of the columns of PointState::memory,
     * @param plastic        energies of hardening and dissipation,
     * @param pores          what belongs to saturated soil,
     * @param fluid_motion   the fluid's own velocity, that the scheme carries,
     * @param accelerations  those that the scheme carries
     */
    PointLayout(const std::vector<unsigned int> &memory,
                const bool                       plastic,
                const bool                       pores,
                const bool                       fluid_motion,
                const bool                       accelerations)
    {
      using S = PointExtras<dim>;
      ranges.push_back({0, n_core_values<dim>});
      if (accelerations)
        add(offsetof(S, acceleration), offsetof(S, memory));
      for (const unsigned int column : memory)
        add(offsetof(S, memory) + column * sizeof(double),
            offsetof(S, memory) + (column + 1) * sizeof(double));
      if (plastic)
        add(offsetof(S, hardening_energy), offsetof(S, pore_pressure));
      if (pores)
        add(offsetof(S, pore_pressure), offsetof(S, end_pore_pressure));
      if (fluid_motion)
        add(offsetof(S, end_pore_pressure), sizeof(S));
    }

    /** Whether anything is stored besides the core. */
    bool
    has_extras() const
    {
      return n_values() > n_core_values<dim>;
    }

    /** Doubles per point; the first of them are the core. */
    unsigned int
    n_values() const
    {
      unsigned int n = 0;
      for (const Range &range : ranges)
        n += range.count;
      return n;
    }

    /** The place among the stored values of a member of PointState, by its offset in bytes. */
    std::optional<unsigned int>
    place_of(const std::size_t offset) const
    {
      const unsigned int value = offset / sizeof(double);
      unsigned int       place = 0;
      for (const Range &range : ranges)
        {
          if (value >= range.begin && value < range.begin + range.count)
            return place + value - range.begin;
          place += range.count;
        }
      return {};
    }

    void
    store(const PointState<dim> &state, double *values) const
    {
      const auto *from = reinterpret_cast<const double *>(&state);
      for (const Range &range : ranges)
        {
          std::memcpy(values, from + range.begin, range.count * sizeof(double));
          values += range.count;
        }
    }

    /** The reverse of store(); what is not stored keeps its value. */
    void
    load(const double *values, PointState<dim> &state) const
    {
      auto *to = reinterpret_cast<double *>(&state);
      for (const Range &range : ranges)
        {
          std::memcpy(to + range.begin, values, range.count * sizeof(double));
          values += range.count;
        }
    }

  private:
    /** Doubles of PointState that stand together. */
    struct Range
    {
      unsigned int begin, count;
    };

    /** Adds a range of the extras. */
    void
    add(const std::size_t begin_bytes, const std::size_t end_bytes)
    {
      const unsigned int begin = n_core_values<dim> + begin_bytes / sizeof(double);
      const unsigned int end   = n_core_values<dim> + end_bytes / sizeof(double);
      if (ranges.back().begin + ranges.back().count == begin)
        ranges.back().count += end - begin;
      else
        ranges.push_back({begin, end - begin});
    }

    std::vector<Range> ranges;
  };
} // namespace kedge

#endif
