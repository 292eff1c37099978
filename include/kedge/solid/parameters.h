#ifndef kedge_solid_parameters_h
#define kedge_solid_parameters_h

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace kedge
{
  /** A dead force shared equally by the material points nearest to a place. */
  template <int dim>
  struct PointLoadParameters
  {
    std::string                  name;
    std::string                  body;
    dealii::Point<dim>           place; ///< in the initial configuration [m]
    unsigned int                 n_points = 1;
    std::array<std::string, dim> force; ///< expressions of t [N; N/m in 2D]
  };

  /**
   * A dead traction on the exposed faces of a body: all material points in
   * the region whose sub-cell has no neighbour of the same body in direction
   * @p side carry traction times the face's reference area.
   */
  template <int dim>
  struct TractionParameters
  {
    std::string                  name;
    std::string                  body;
    unsigned int                 side = 0; ///< 2*direction + (0: low, 1: high)
    std::string                  where;    ///< expression of x, y, z; empty: everywhere
    std::array<std::string, dim> traction; ///< expressions of t, per reference area [Pa]
  };
} // namespace kedge

#endif
