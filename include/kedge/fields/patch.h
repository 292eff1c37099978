#ifndef kedge_fields_patch_h
#define kedge_fields_patch_h

#include <kedge/fields/constraints.h>
#include <kedge/fields/step_points.h>

#include <functional>

namespace kedge
{
  /** What is the same in all steps of a field: its bodies and how they meet the grid. */
  struct PatchParameters
  {
    std::vector<std::string> body_names;    ///< of all bodies of the scene
    std::vector<bool>        holds_body;    ///< one per body; empty: all
    std::vector<BasisKind>   basis_of_body; ///< one per body
    std::vector<bool> shared_volume;   ///< bodies whose points in a cell share their dilatation
    MemoryColumns     columns_of_body; ///< of the laws' histories, in the points' memory
    double            smallest_filling = 0.;    ///< below, nodes are tied [cells]; 0: none is
    bool              coarse_pressure  = false; ///< the pore pressure lives at cells' corners
    unsigned int      n_components     = 2;     ///< values per node: displacement, pressure
  };

  /**
   * A field on the background grid: bodies that move as one, for they share the
   * nodes that they reach. In a step it is their material points, the nodes that
   * these reach, numbered compactly, and the constraints of what the nodes may do.
   * Several fields may lie on the same cells of the grid; each has nodes of its own.
   */
  template <int dim>
  class Patch
  {
  public:
    /** Flags nodes beyond those that the points reach, in @p reached, one entry per window node. */
    using Reach = std::function<void(std::vector<unsigned char> &reached)>;

    Patch(const BackgroundGrid<dim> &grid,
          const PatchParameters     &parameters,
          const NodeConditions<dim> &conditions);

    /**
     * Reads the points of a new configuration, finds ties, nodes and constraints
     * (collective). @p reach adds nodes that terms need although no point
     * reaches them, @p claim before that nodes that points of other ranks reach.
     */
    void
    reinit(const MaterialPoints<dim> &cloud, const Reach &reach, const Reach &claim = {});

    /** How long the step is, for laws that depend on the rate [s]. */
    void
    set_time_step(const double dt)
    {
      points.set_time_step(dt, parameters.columns_of_body);
    }

    const BackgroundGrid<dim> &
    grid() const
    {
      return background;
    }

    const LatticeWindow<dim> &
    window() const
    {
      return background.window();
    }

    unsigned int
    n_components() const
    {
      return parameters.n_components;
    }

    /** Whether a body belongs to the field. */
    bool
    holds(const unsigned int body) const
    {
      return parameters.holds_body.empty() || parameters.holds_body[body];
    }

    BasisKind
    basis_of(const unsigned int body) const
    {
      return parameters.basis_of_body[body];
    }

    /** True if the last reinit() has changed the nodes or their numbers (collective). */
    bool
    new_nodes() const
    {
      return new_nodes_;
    }

    /** True if it has changed nodes or ties, and with them the pattern of all matrices. */
    bool
    new_pattern() const
    {
      return new_pattern_;
    }

    /** "material point 7 of body 'b' at (1 2)" for messages. */
    std::string
    describe_point(const unsigned int slot) const;

    /** Place of a local node [m]. */
    dealii::Point<dim>
    node_position(const unsigned int node) const
    {
      return background.node_position(nodes.window_node(node));
    }

    StepPoints<dim>     points;
    ActiveNodes<dim>    nodes;
    NodeConditions<dim> conditions;
    NodeTies<dim>       ties;
    Constraints<dim>    constraints;

  private:
    const BackgroundGrid<dim> &background;
    const PatchParameters      parameters;
    bool                       new_nodes_ = false, new_pattern_ = false;
  };
} // namespace kedge

#endif
