#ifndef kedge_grid_parameters_h
#define kedge_grid_parameters_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace kedge
{
  /** The Cartesian box in which the background grid lives [m]. */
  template <int dim>
  struct GridParameters
  {
    dealii::Point<dim>            origin;
    dealii::Tensor<1, dim>        extent;
    std::array<unsigned int, dim> n_cells;
    unsigned int                  node_intervals =
      1;                    ///< between the ends of a cell's edge; elements of second order: 2
    std::string refinement; ///< how often cells are halved, expression of x, y, z; empty: never
  };

  /** What a node condition does with one displacement component. */
  enum class ConditionKind
  {
    free,
    fixed,
    displacement, ///< total displacement since the start, expression of t [m]
    velocity,     ///< velocity, expression of t [m/s]
    motion        ///< displacement over a step, expression of x, y, z, t, dt [m]
  };

  /** What the expression of a ConditionKind::motion may hold, in this order. */
  inline std::vector<std::string>
  motion_variables()
  {
    return {"x", "y", "z", "t", "dt"};
  }

  struct ComponentCondition
  {
    ConditionKind kind = ConditionKind::free;
    std::string   expression; ///< for displacement, velocity, motion
  };

  /**
   * A condition on the displacement of grid nodes: either all nodes on one
   * side of the box, or all nodes where an expression of x, y, z is true
   * (non-zero).
   */
  template <int dim>
  struct NodeConditionParameters
  {
    std::string                         name;
    bool                                on_side = true;
    unsigned int                        side    = 0; ///< 2*direction + (0: low, 1: high)
    std::string                         where;       ///< used if !on_side
    std::array<ComponentCondition, dim> components;
    bool                                reaction = false; ///< history.csv shows its force
    std::string pore_pressure; ///< expression of x, y, z, t [Pa]; empty: no condition
    std::string body;          ///< whose field alone it holds; empty: all
  };
} // namespace kedge

#endif
