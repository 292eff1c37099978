#ifndef kedge_contact_cell_multipliers_h
#define kedge_contact_cell_multipliers_h

#include <kedge/contact/contact_law.h>
#include <kedge/grid/lattice.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * Uzawa's step for the forces of places at rest,
   *   lambda <- <lambda - eps g^c>,   e_0 <- e_0 + sum_I N_I c_I of what sticks,
   * and e_1 of what slides. g^c is the mean of the gaps, by areas, of all places that press in the
   * same cell of the grid, c_I the mean, with the function N_I of a node of the grid, of the creep
   * e_1 - e_0 of those that stick; both of those alone whose normals point to the same side, for
   * a cell may hold a corner. A cell moves too simply to close each of many gaps by itself, and
   * forces that tried to would come to stand at single places. What gaps and slips differ within a
   * cell the contact's stiffness takes. Slips are held by nodes, because shear that changes its
   * sign from cell to cell moves no node: means of cells crept on with it. A place that does not
   * press has no multiplier.
   */
  template <int dim>
  class CellMultipliers
  {
  public:
    /**
     * What may be left, in parts of a cell. In partial slip the part that slides does so by a
     * thousandth of a cell or two, and 2e-4 is 10 % of that off: prm/cattaneo_mindlin.prm.
     */
    static constexpr double smallest_gap = 1e-3, smallest_creep = 1e-4;

    explicit CellMultipliers(const Lattice<dim> &lattice)
      : lattice(lattice)
    {}

    /**
     * Takes the answer of a place.
     *
     * @param area       that it stands for [m^2; m in 2D]
     * @param normal     from its partner to it
     * @param multiplier lambda; update() changes it [Pa]
     * @param slip       e_0, likewise [m]
     */
    void
    add(const dealii::Point<dim>     &place,
        const double                  area,
        const dealii::Tensor<1, dim> &normal,
        const ContactLaw             &law,
        double                       &multiplier,
        dealii::Tensor<1, dim>       &slip,
        const ContactResponse<dim>   &response);

    /** Of all cells the largest mean gap; of all nodes the largest sum of c_I A_I over the largest
     * A_I, the area that sticks: what little sticks at an edge counts for little [m]. */
    double
    largest_gap() const
    {
      return worst_gap().first;
    }
    double
    largest_creep() const
    {
      return worst_creep().first;
    }

    /** What is larger than it may be, and where; empty: nothing. */
    std::string
    left() const;

    /** Gives all places their new multipliers, and those that press the slips that hold them. */
    void
    update() const;

  private:
    /** A cell, and to which of its 2 dim sides the normal points. */
    using Key = std::pair<LatticeIndex<dim>, unsigned int>;

    struct Place
    {
      Key                     key;
      dealii::Point<dim>      at;
      bool                    presses, sticks;
      double                 *multiplier, stiffness;
      dealii::Tensor<1, dim> *slip, slip_end, normal;
    };

    /** Sums over the places of a cell that press. */
    struct Gap
    {
      double area = 0., sum = 0.; ///< [m^2], [m^3]
    };

    /** Sums over the places that stick, with the function of a node. */
    struct Creep
    {
      double                 area = 0.;
      dealii::Tensor<1, dim> sum; ///< [m^3]
    };

    /** The largest gap and its cell, the largest creep and its node. */
    std::pair<double, LatticeIndex<dim>>
    worst_gap() const;
    std::pair<double, LatticeIndex<dim>>
    worst_creep() const;

    /** Calls f(key, N) for the nodes of the cell of a place. */
    template <typename F>
    void
    for_nodes(const Place &place, const F &f) const;

    const Lattice<dim>  &lattice;
    std::vector<Place>   places;
    std::map<Key, Gap>   gaps;   ///< by cell
    std::map<Key, Creep> creeps; ///< by node
  };

  /** Uzawa's iteration of a contact at rest: a step of it after each solution of the equations. */
  template <int dim>
  class UzawaIteration
  {
  public:
    static constexpr unsigned int most_updates = 40;

    void
    start()
    {
      n_updates = 0;
      left.clear();
    }

    /**
     * @param sides     what may not be pressed by the same multipliers
     * @param bodies_of bodies_of(side) names the bodies that touch there
     * @param add_side  add_side(side, cells) adds the places of a side
     * @return false, and nothing is changed, if gaps and creep are as small as they must be or
     *         there were too many steps
     */
    template <class Sides, typename BodiesOf, typename AddSide>
    bool
    step(Sides              &sides,
         const Lattice<dim> &lattice,
         const BodiesOf     &bodies_of,
         const AddSide      &add_side)
    {
      std::vector<CellMultipliers<dim>> cells;
      left.clear();
      for (auto &side : sides)
        {
          cells.emplace_back(lattice);
          add_side(side, cells.back());
          if (const std::string here = cells.back().left(); left.empty() && !here.empty())
            left = bodies_of(side) + ": " + here;
        }
      if (left.empty() || n_updates == most_updates)
        return false;
      for (const auto &of_side : cells)
        of_side.update();
      ++n_updates;
      return true;
    }

    /** Why the step cannot be taken: what the last update has left, if it is too much. */
    std::string
    failure() const
    {
      return left.empty() ? ""
                          : left + ", are left after " + std::to_string(most_updates) +
                              " updates of the contact's forces";
    }

  private:
    unsigned int n_updates = 0;
    std::string  left;
  };
} // namespace kedge

#endif
