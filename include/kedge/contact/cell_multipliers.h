#ifndef kedge_contact_cell_multipliers_h
#define kedge_contact_cell_multipliers_h

#include <kedge/contact/contact_law.h>
#include <kedge/grid/lattice.h>

#include <algorithm>
#include <map>
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
    largest_gap() const;
    double
    largest_creep() const;

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

    /** Calls f(key, N) for the nodes of the cell of a place. */
    template <typename F>
    void
    for_nodes(const Place &place, const F &f) const;

    const Lattice<dim>  &lattice;
    std::vector<Place>   places;
    std::map<Key, Gap>   gaps;   ///< by cell
    std::map<Key, Creep> creeps; ///< by node
  };

  /**
   * Uzawa's step of a contact at rest.
   *
   * @param sides    what may not be pressed by the same multipliers
   * @param add_side add_side(side, cells) adds the places of a side
   * @return false, and nothing is changed, if gaps and creep are as small as they must be
   */
  template <int dim, class Sides, typename AddSide>
  bool
  update_multipliers(Sides &sides, const Lattice<dim> &lattice, const AddSide &add_side)
  {
    std::vector<CellMultipliers<dim>> cells(sides.size(), CellMultipliers<dim>(lattice));
    const double                      cell_size = lattice.smallest_cell_size();
    bool                              is_held   = true;
    for (std::size_t k = 0; k < cells.size(); ++k)
      {
        add_side(sides[k], cells[k]);
        is_held = is_held && cells[k].largest_gap() <= cells[k].smallest_gap * cell_size &&
                  cells[k].largest_creep() <= cells[k].smallest_creep * cell_size;
      }
    if (is_held)
      return false;
    for (const auto &of_side : cells)
      of_side.update();
    return true;
  }
} // namespace kedge

#endif
