#ifndef kedge_materials_principal_order_h
#define kedge_materials_principal_order_h

#include <array>
#include <utility>

namespace kedge
{
  /** Indices of three values in falling order; of equal ones the lower index first. */
  template <typename Number>
  inline std::array<int, 3>
  falling_order(const Number (&values)[3])
  {
    std::array<int, 3> order{{0, 1, 2}};
    const auto         sort_pair = [&](const int a, const int b) {
      if (values[order[b]] > values[order[a]])
        std::swap(order[a], order[b]);
    };
    sort_pair(0, 1);
    sort_pair(1, 2);
    sort_pair(0, 1);
    return order;
  }
} // namespace kedge

#endif
