#ifndef kedge_materials_principal_order_h
#define kedge_materials_principal_order_h

#include <kedge/base/pack.h>

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

  /** Three values brought into falling order, lane by lane, and what it takes to undo that. */
  template <typename Number>
  class FallingOrder
  {
  public:
    explicit FallingOrder(const Number (&values)[3])
      : value{values[0], values[1], values[2]}
    {
      for (int k = 0; k < 3; ++k)
        {
          swapped[k] = value[first[k] + 1] > value[first[k]];
          swap(swapped[k], value[first[k]], value[first[k] + 1]);
        }
    }

    /** From ranks to the places of the values. */
    void
    restore(Number (&of_rank)[3]) const
    {
      for (int k = 2; k >= 0; --k)
        swap(swapped[k], of_rank[first[k]], of_rank[first[k] + 1]);
    }

    /** Rows and columns. */
    void
    restore(Number (&of_ranks)[3][3]) const
    {
      for (int k = 2; k >= 0; --k)
        for (int j = 0; j < 3; ++j)
          swap(swapped[k], of_ranks[first[k]][j], of_ranks[first[k] + 1][j]);
      for (auto &row : of_ranks)
        restore(row);
    }

    Number value[3]; ///< the largest first

  private:
    static constexpr int first[3] = {0, 1, 0};

    static void
    swap(const Condition<Number> &condition, Number &a, Number &b)
    {
      const Number old = a;
      a                = select(condition, b, a);
      b                = select(condition, old, b);
    }

    Condition<Number> swapped[3];
  };
} // namespace kedge

#endif
