#ifndef kedge_points_split_points_h
#define kedge_points_split_points_h

#include <kedge/grid/lattice.h>
#include <kedge/points/point_state.h>

#include <algorithm>
#include <vector>

namespace kedge
{
  /** Into how many parts a point is split in each direction. */
  template <int dim>
  using PointParts = std::array<unsigned int, dim>;

  /**
   * The parts of which none is larger than a cell of a lattice: one if there is no lattice, and of
   * points that loads act on, which stay as they are.
   */
  template <int dim>
  PointParts<dim>
  parts_for_cell(const PointCore<dim> &state, const Lattice<dim> *lattice)
  {
    constexpr double slack = 1e-6; // of a cell
    PointParts<dim>  parts;
    for (int d = 0; d < dim; ++d)
      parts[d] = lattice == nullptr || state.loaded != 0.
                   ? 1
                   : std::max(1u,
                              static_cast<unsigned int>(
                                std::ceil(2. * state.half_lengths[d] / lattice->h[d] - slack)));
    return parts;
  }

  template <std::size_t dim>
  bool
  is_many(const std::array<unsigned int, dim> &parts)
  {
    return std::any_of(parts.begin(), parts.end(), [](const unsigned int n) {
      return n > 1;
    });
  }

  /**
   * Appends the parts of a point: equal boxes that fill its domain, with equal shares of mass and
   * volume and all else as the point has it. Mass, momentum, angular momentum, the energies and
   * the potential of a uniform gravity are those of the point. The first part keeps its id;
   * the others count on from @p last_id, which becomes the last id given.
   */
  template <int dim>
  void
  split_point(const PointRecord<dim>        &point,
              const PointParts<dim>         &parts,
              std::uint64_t                 &last_id,
              std::vector<PointRecord<dim>> &result);
} // namespace kedge

#endif
