#ifndef kedge_solid_point_forces_h
#define kedge_solid_point_forces_h

#include <kedge/fields/step_points.h>

namespace kedge
{
  /** Something that pulls at material points: body force, point loads, tractions, water. */
  template <int dim>
  class PointForces
  {
  public:
    virtual ~PointForces() = default;

    /** True if it never pulls at any point. */
    virtual bool
    empty() const = 0;

    /** Adds the force on each slot at time @p t [N]. */
    virtual void
    add_force(const StepPoints<dim>               &points,
              const double                         t,
              std::vector<dealii::Tensor<1, dim>> &forces) const = 0;
  };
} // namespace kedge

#endif
