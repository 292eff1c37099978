#ifndef kedge_points_node_region_h
#define kedge_points_node_region_h

#include <kedge/base/expression.h>
#include <kedge/grid/lattice.h>

#include <cmath>

namespace kedge
{
  /** Whether a Where of x, y, z and t depends on the time t. */
  inline bool
  depends_on_time(const std::string &where, std::map<std::string, double> constants)
  {
    for (const char *coordinate : {"x", "y", "z"})
      constants[coordinate] = 0.;
    return !Expression(where, {"t"}, constants).is_constant();
  }

  /** Whether the value of a Where says yes: what is no number does not. */
  inline bool
  is_true(const double value)
  {
    return value != 0. && !std::isnan(value);
  }

  /** The time at which a Where is asked for the step that starts at @p t [s]: the time of a step is
   * a sum, whose round-off must not decide. */
  inline double
  just_after(const double t)
  {
    return t + 1e-9 * std::abs(t);
  }

  /** The nodes of the grid that a node condition holds: those on a side, or where its Where is
   * true; at the start of the run, if that depends on time. */
  template <int dim>
  class NodeRegion
  {
  public:
    /** @throws UserError for a Where that cannot be read. */
    NodeRegion(const NodeConditionParameters<dim>  &condition,
               const std::map<std::string, double> &constants)
      : on_side(condition.on_side)
      , side(condition.side)
      , where(condition.on_side ? Expression(1.)
                                : Expression(condition.where, {"x", "y", "z", "t"}, constants))
      , follows_time_(!on_side && depends_on_time(condition.where, constants))
    {}

    /** Whether a place may be in it and another not, other than by being on a side. */
    bool
    has_limits() const
    {
      return !on_side && !where.is_constant();
    }

    /** Whether it changes as time goes on. */
    bool
    follows_time() const
    {
      return follows_time_;
    }

    /** Whether its Where is true at a place; on a side: always. */
    bool
    holds_place(const dealii::Point<dim> &x) const
    {
      double values[4] = {0, 0, 0, 0};
      for (int d = 0; d < dim; ++d)
        values[d] = x[d];
      return is_true(where(values));
    }

    bool
    holds(const Lattice<dim> &lattice, const LatticeIndex<dim> &node) const
    {
      if (!on_side)
        return holds_place(lattice.node_position(node));
      const int direction = static_cast<int>(side / 2);
      return node[direction] == (side % 2 == 0 ? 0 : lattice.n_cells[direction]);
    }

  private:
    bool         on_side;
    unsigned int side; ///< 2*direction + (0: low, 1: high)
    Expression   where;
    bool         follows_time_;
  };
} // namespace kedge

#endif
