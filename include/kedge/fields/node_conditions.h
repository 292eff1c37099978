#ifndef kedge_fields_node_conditions_h
#define kedge_fields_node_conditions_h

#include <kedge/base/expression.h>
#include <kedge/base/load_program.h>
#include <kedge/fields/active_nodes.h>

#include <optional>

namespace kedge
{
  /**
   * Which displacement components of the active nodes are prescribed, and
   * what their motion is. Where two conditions meet in one component, the
   * later one in the scene wins.
   */
  template <int dim>
  class NodeConditions
  {
  public:
    /** @throws UserError for expressions that cannot be read. */
    NodeConditions(const std::vector<NodeConditionParameters<dim>> &parameters,
                   const std::map<std::string, double>             &constants,
                   const LoadProgram                               &program = {});

    /**
     * Sets the time at which a Where that depends on it is asked [s]: that of the start of the
     * step, over which nodes stay prescribed or free.
     *
     * @return whether that may change which components are prescribed
     */
    bool
    set_time(const double t);

    /** Whether which components are prescribed may change with time. */
    bool
    follows_time() const
    {
      return follows_time_;
    }

    /**
     * Finds the prescribed components of the active nodes.
     *
     * @return whether they are others than before
     */
    bool
    reinit(const BackgroundGrid<dim> &grid, const ActiveNodes<dim> &nodes);

    /** True if component @p d of local node @p node is prescribed. */
    bool
    prescribed(const unsigned int node, const int d) const
    {
      return condition_of[std::size_t(node) * dim + d] >= 0;
    }

    /** The condition that prescribes a component, by its number in the scene; -1: none. */
    int
    condition(const unsigned int node, const int d) const
    {
      return condition_of[std::size_t(node) * dim + d];
    }

    /** Displacement of a prescribed component over the step from @p t0 to @p t1 [m]. */
    double
    increment(const unsigned int node, const int d, const double t0, const double t1) const;

    /**
     * Velocity of a prescribed component at the start of the step from @p t to
     * @p t + @p dt [m/s]: what is prescribed as a velocity, and the slope from the right of
     * what is prescribed as a displacement, see slope_from_right().
     */
    double
    velocity(const unsigned int node, const int d, const double t, const double dt) const;

    /** True if the pore pressure of local node @p node is prescribed. */
    bool
    pressure_prescribed(const unsigned int node) const
    {
      return !pressure_condition_of.empty() && pressure_condition_of[node] >= 0;
    }

    /** The prescribed pore pressure of a node at time @p t [Pa]. */
    double
    pressure(const unsigned int node, const double t) const;

    bool
    any_moving() const
    {
      return any_moving_;
    }

    unsigned int
    size() const
    {
      return conditions.size();
    }

    bool
    empty() const
    {
      return conditions.empty();
    }

  private:
    struct Motion
    {
      ConditionKind             kind;
      std::optional<Expression> expression;
    };
    struct Condition
    {
      bool                      on_side;
      unsigned int              side;
      std::optional<Expression> where;
      std::array<Motion, dim>   motions;
      std::optional<Expression> pressure;
    };

    bool
    applies(const Condition         &condition,
            const Lattice<dim>      &lattice,
            const LatticeIndex<dim> &node) const;

    LoadProgram                     program; ///< of the pressures
    std::vector<Condition>          conditions;
    std::vector<dealii::Point<dim>> place;        ///< of each local node; empty without motions
    std::vector<short>              condition_of; ///< of each local node and component, or -1
    std::vector<short> pressure_condition_of; ///< of each local node, or -1; empty: no condition
    double             time          = 0.;    ///< at which a Where is asked [s]
    bool               any_moving_   = false;
    bool               any_pressure  = false;
    bool               follows_time_ = false;
    bool               needs_place   = false; ///< any motion or pressure
  };
} // namespace kedge

#endif
