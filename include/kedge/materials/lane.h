#ifndef kedge_materials_lane_h
#define kedge_materials_lane_h

#include <kedge/base/pack.h>

namespace kedge
{
  template <typename Number>
  struct LaneOf
  {
    using Type = Number;
  };
  template <>
  struct LaneOf<Pack>
  {
    using Type = double;
  };

  /** The number in each lane of a Pack; of a single number itself. */
  template <typename Number>
  using Lane = typename LaneOf<Number>::Type;
} // namespace kedge

#endif
