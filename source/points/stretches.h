#ifndef kedge_source_points_stretches_h
#define kedge_source_points_stretches_h

#include <kedge/points/geometry.h>

#include <algorithm>

namespace kedge
{
  /** The part of [begin, end] within [0, length], if there is any. */
  inline Stretches
  one_stretch(const double begin, const double end, const double length)
  {
    const double from = std::max(0., begin), to = std::min(length, end);
    return from < to ? Stretches{{from, to}} : Stretches();
  }

  /** What lies in @p a or in @p b. */
  inline Stretches
  unite(const Stretches &a, const Stretches &b)
  {
    Stretches all(a);
    all.insert(all.end(), b.begin(), b.end());
    std::sort(all.begin(), all.end());
    Stretches result;
    for (const auto &stretch : all)
      if (!result.empty() && stretch.first <= result.back().second)
        result.back().second = std::max(result.back().second, stretch.second);
      else
        result.push_back(stretch);
    return result;
  }

  /** What lies in @p a but not in @p b. */
  inline Stretches
  subtract(const Stretches &a, const Stretches &b)
  {
    Stretches result;
    for (const auto &[begin, end] : a)
      {
        double from = begin;
        for (const auto &[hole_begin, hole_end] : b)
          {
            if (hole_end <= from || hole_begin >= end)
              continue;
            if (hole_begin > from)
              result.emplace_back(from, hole_begin);
            from = hole_end;
          }
        if (from < end)
          result.emplace_back(from, end);
      }
    return result;
  }

  /**
   * The stretches of [0, length] between @p cuts, in any order, whose middles
   * fulfil @p contains(distance).
   */
  template <typename Contains>
  Stretches
  stretches_between(std::vector<double> cuts, const double length, const Contains &contains)
  {
    cuts.push_back(length);
    std::sort(cuts.begin(), cuts.end());
    Stretches result;
    double    from = 0;
    for (const double cut : cuts)
      {
        if (cut <= from || cut > length)
          continue;
        if (contains(0.5 * (from + cut)))
          {
            if (!result.empty() && result.back().second == from)
              result.back().second = cut;
            else
              result.emplace_back(from, cut);
          }
        from = cut;
      }
    return result;
  }
} // namespace kedge

#endif
