#ifndef kedge_solid_parameters_h
#define kedge_solid_parameters_h

#include <kedge/surfaces/parameters.h>

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

  /** A dead traction on outer faces of a body. */
  template <int dim>
  struct TractionParameters : SurfaceParameters
  {
    std::array<std::string, dim> traction; ///< expressions of t, per reference area [Pa]
  };
} // namespace kedge

#endif
