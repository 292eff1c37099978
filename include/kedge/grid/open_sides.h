#ifndef kedge_grid_open_sides_h
#define kedge_grid_open_sides_h

#include <kedge/grid/lattice.h>

#include <vector>

namespace kedge
{
  /** Sides of the background grid through which material leaves it for good. */
  template <int dim>
  class OpenSides
  {
  public:
    /** @param sides 2*direction + (0: low, 1: high) of each */
    explicit OpenSides(const std::vector<unsigned int> &sides = {})
    {
      is_open.fill(false);
      for (const unsigned int side : sides)
        is_open[side] = true;
    }

    bool
    any() const
    {
      for (const bool open : is_open)
        if (open)
          return true;
      return false;
    }

    /** Whether a place is outside the grid, and beyond open sides only. */
    bool
    let_out(const Lattice<dim> &lattice, const dealii::Point<dim> &x) const
    {
      bool outside = false;
      for (int d = 0; d < dim; ++d)
        {
          const bool below = !(x[d] >= lattice.origin[d]), above = !(x[d] <= lattice.upper(d));
          if ((below && !is_open[2 * d]) || (above && !is_open[2 * d + 1]))
            return false;
          outside = outside || below || above;
        }
      return outside;
    }

  private:
    std::array<bool, 2 * dim> is_open;
  };
} // namespace kedge

#endif
