#ifndef kedge_solid_parameters_h
#define kedge_solid_parameters_h

#include <kedge/grid/parameters.h>
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

  /** A load on outer faces of a body: dead, or a pressure that follows them. */
  template <int dim>
  struct TractionParameters : SurfaceParameters
  {
    /** Expressions of the place at the start and t, per reference area [Pa]; empty: none. */
    std::array<std::string, dim> traction;
    std::string                  pressure; ///< expression of the place now and t [Pa]; empty: none
    bool                         resultant = false; ///< the force is a column of the history
  };

  /** Dead loads that are found from the motion of a material point. */
  template <int dim>
  struct LoadControlParameters
  {
    std::string            body;
    dealii::Point<dim>     place;        ///< nearest to the point at the start [m]
    dealii::Tensor<1, dim> direction;    ///< of length one
    std::string            displacement; ///< of the point along it, expression of t [m]
  };

  /** What a body condition prescribes along one direction. */
  template <int dim>
  struct PrescribedLine
  {
    dealii::Tensor<1, dim> direction; ///< of length one
    ComponentCondition     motion;    ///< of the faces along it
    /** Expression of t: the whole force along it [N; N/m in 2D], under which all faces move
     * alike; empty: the motion is prescribed. */
    std::string force;
  };

  /** How a body moves at its outer faces on one side, or at a section within it. */
  template <int dim>
  struct BodyConditionParameters : SurfaceParameters
  {
    std::vector<PrescribedLine<dim>> lines;
    bool                             reaction = false; ///< the history shows its force
  };
} // namespace kedge

#endif
