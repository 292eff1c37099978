#ifndef kedge_solid_external_loads_h
#define kedge_solid_external_loads_h

#include <kedge/base/expression.h>
#include <kedge/base/load_program.h>
#include <kedge/fields/step_points.h>
#include <kedge/points/generation.h>
#include <kedge/solid/parameters.h>

#include <unordered_map>

namespace kedge
{
  /**
   * The forces that act on material points from outside: body force and point
   * loads. All are dead loads that move with their points.
   */
  template <int dim>
  class ExternalLoads
  {
  public:
    /**
     * @param body_force       expressions of t [m/s^2]
     * @param has_body_force   one per body
     */
    ExternalLoads(const std::array<std::string, dim>          &body_force,
                  const std::vector<bool>                     &has_body_force,
                  const std::vector<PointLoadParameters<dim>> &point_loads,
                  const std::map<std::string, double>         &constants,
                  const LoadProgram                           &program = {});

    /**
     * Finds the points that carry loads among those just generated (all of
     * them, on all ranks) and marks their state as loaded.
     *
     * @param body_names one per body
     * @throws UserError if a point load lies outside of its body
     */
    void
    attach(std::vector<GeneratedPoint<dim>> &points, const std::vector<std::string> &body_names);

    /** True if there is no load at all: add_force() need not be called. */
    bool
    empty() const;

    /** The acceleration of the body force at time @p t [m/s^2]. */
    std::array<double, std::size_t(dim)>
    body_acceleration(const double t) const;

    /** Adds the force on each slot at time @p t [N]. */
    void
    add_force(const StepPoints<dim>               &points,
              const double                         t,
              std::vector<dealii::Tensor<1, dim>> &forces) const;

  private:
    struct Share
    {
      unsigned int load;   ///< index into force_expressions
      double       factor; ///< part of the force
    };

    void
    attach_point_load(const unsigned int                load,
                      std::vector<GeneratedPoint<dim>> &points,
                      const std::vector<std::string>   &body_names);

    std::array<Expression, std::size_t(dim)>              body_force;
    std::vector<bool>                                     has_body_force;
    std::vector<PointLoadParameters<dim>>                 point_loads;
    std::vector<std::array<Expression, std::size_t(dim)>> load_expressions;
    std::unordered_map<std::uint64_t, std::vector<Share>> shares; ///< by id of the point
    LoadProgram                                           program;
  };
} // namespace kedge

#endif
