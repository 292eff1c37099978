#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/points/held_material.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  check_nearness(const std::string            &what,
                 const dealii::Point<dim>     &place,
                 const dealii::Point<dim>     &nearest,
                 const dealii::Tensor<1, dim> &half_lengths)
  {
    const double distance = place.distance(nearest), reach = 4. * half_lengths.norm();
    if (distance <= reach)
      return;
    std::ostringstream message;
    message << what << " is to act at (" << place << "), " << distance
            << " m from the nearest material point, at (" << nearest << "); it may be " << reach
            << " m away at most. Change its Place.";
    throw UserError(message.str());
  }



  template <int dim>
  bool
  lies_off_the_surface(const PointOrigin<dim> &point,
                       const unsigned int      side,
                       const Geometry<dim>    &geometry)
  {
    const unsigned int direction = side / 2;
    const double       half = point.half_lengths[direction], length = 4. * half;
    dealii::Point<dim> start = point.location;
    if (side % 2 == 0)
      start[direction] -= length;
    const auto parts = geometry.inside(start, direction, length);
    if (parts.empty())
      return true;
    const double end = side % 2 == 0 ? length - parts.back().first : parts.front().second;
    return std::abs(end - half) > 1e-6 * half;
  }



  template <int dim>
  void
  check_node_conditions(const std::vector<NodeConditionParameters<dim>> &conditions,
                        const std::map<std::string, double>             &constants,
                        const Lattice<dim>                              &lattice)
  {
    const LatticeWindow<dim> window{{}, lattice.n_cells};
    for (const auto &condition : conditions)
      {
        const NodeRegion<dim> region(condition, constants);
        // an expression without x, y, z switches it on or off, as one of the time may
        if (!region.has_limits() || region.follows_time())
          continue;
        bool any = false;
        for (unsigned int i = 0; i < window.n_nodes_total() && !any; ++i)
          any = region.holds(lattice, window.node_index(i));
        if (any)
          continue;
        std::ostringstream message;
        message << "Node conditions/" << condition.name << "/Where = " << condition.where
                << ": it is true at none of the grid's nodes, which stand every (" << lattice.h
                << ") m from (" << lattice.origin
                << ") on. Write an interval around a row of nodes.";
        throw UserError(message.str());
      }
  }



  template <int dim>
  std::vector<std::size_t>
  count_held_nodes(const std::vector<NodeConditionParameters<dim>> &conditions,
                   const std::map<std::string, double>             &constants,
                   const GridLevels<dim>                           &levels,
                   const std::vector<PointOrigin<dim>>             &points)
  {
    const auto               nodes = nodes_of_cells_with_points<dim>(levels, points);
    std::vector<std::size_t> n_held;
    for (const auto &condition : conditions)
      {
        const NodeRegion<dim> region(condition, constants);
        n_held.push_back(
          std::count_if(nodes.begin(), nodes.end(), [&](const LatticeIndex<dim> &node) {
            return region.holds(levels.finest(), node);
          }));
      }
    return n_held;
  }

  template void
  check_nearness(const std::string &,
                 const dealii::Point<2> &,
                 const dealii::Point<2> &,
                 const dealii::Tensor<1, 2> &);
  template bool
  lies_off_the_surface(const PointOrigin<2> &, const unsigned int, const Geometry<2> &);
  template bool
  lies_off_the_surface(const PointOrigin<3> &, const unsigned int, const Geometry<3> &);
  template void
  check_node_conditions(const std::vector<NodeConditionParameters<2>> &,
                        const std::map<std::string, double> &,
                        const Lattice<2> &);
  template std::vector<std::size_t>
  count_held_nodes(const std::vector<NodeConditionParameters<2>> &,
                   const std::map<std::string, double> &,
                   const GridLevels<2> &,
                   const std::vector<PointOrigin<2>> &);
  template void
  check_nearness(const std::string &,
                 const dealii::Point<3> &,
                 const dealii::Point<3> &,
                 const dealii::Tensor<1, 3> &);
  template void
  check_node_conditions(const std::vector<NodeConditionParameters<3>> &,
                        const std::map<std::string, double> &,
                        const Lattice<3> &);
  template std::vector<std::size_t>
  count_held_nodes(const std::vector<NodeConditionParameters<3>> &,
                   const std::map<std::string, double> &,
                   const GridLevels<3> &,
                   const std::vector<PointOrigin<3>> &);
} // namespace kedge
