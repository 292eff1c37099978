#ifndef kedge_grid_refinement_rule_h
#define kedge_grid_refinement_rule_h

#include <kedge/base/expression.h>
#include <kedge/grid/grid_levels.h>

#include <optional>

namespace kedge
{
  /** Cells are halved no more often than this. */
  constexpr unsigned int most_refinements = 6;

  /** What a refinement may depend on, in this order. */
  inline std::vector<std::string>
  refinement_variables()
  {
    return {"x", "y", "z", "t", "plastic_strain", "distance"};
  }

  /** What wishes depend on beside the place. */
  struct RefinementState
  {
    double t = 0.; ///< [s]
    // one value per cell of the window
    std::vector<double> plastic_strain; ///< the largest of the points in it; empty: 0
    std::vector<double> distance; ///< of its middle from rigid bodies; empty: as far as can be [m]
  };

  /** The middles of the cells of a window. */
  template <int dim>
  std::vector<dealii::Point<dim>>
  middles_of_cells(const Lattice<dim> &lattice, const LatticeWindow<dim> &cells);

  /** How often the scene wants the cells of the grid to be refined. */
  template <int dim>
  class RefinementRule
  {
  public:
    /**
     * @param expression of refinement_variables(): how often a cell is halved; x, y, z are its
     * middle, t the time at the start of a step and just after it, plastic_strain the largest
     * equivalent plastic strain of the points in it, distance that of its middle from the
     * nearest surface of a rigid body; empty: never
     *
     * @throws UserError for an expression that cannot be read
     */
    RefinementRule(const std::string &expression, const std::map<std::string, double> &constants);

    bool
    any() const
    {
      return refinement.has_value();
    }

    /** Whether the wish for a cell may change in a run. */
    bool
    may_change() const
    {
      return follows_time || follows_strain || follows_distance;
    }

    bool
    asks_plastic_strain() const
    {
      return follows_strain;
    }

    bool
    asks_distance() const
    {
      return follows_distance;
    }

    /**
     * The wish for each cell of a window of the coarsest lattice.
     *
     * @throws UserError for values that are no number of refinements
     */
    std::vector<unsigned char>
    wanted(const Lattice<dim>       &lattice,
           const LatticeWindow<dim> &cells,
           const RefinementState    &state = {}) const;

  private:
    std::optional<Expression> refinement;
    bool follows_time = false, follows_strain = false, follows_distance = false;
  };
} // namespace kedge

#endif
