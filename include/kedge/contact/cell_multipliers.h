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
   * Uzawa's step for the pressures of places at rest,
   *   lambda <- <lambda - eps g^c>,
   * with g^c the mean of the gaps, by areas, of all places that press in the same cell of the grid:
   * a cell moves too simply to close each of many gaps by itself, and pressures that tried to would
   * come to stand at single places. What the gaps differ within a cell the contact's stiffness
   * takes. A place that does not press has no multiplier. Slips of what sticks are held place by
   * place.
   */
  template <int dim>
  class CellMultipliers
  {
  public:
    explicit CellMultipliers(const Lattice<dim> &lattice)
      : lattice(lattice)
    {}

    /**
     * Takes the answer of a place.
     *
     * @param area       that it stands for [m^2; m in 2D]
     * @param multiplier lambda; update() changes it [Pa]
     * @param slip       e_0, likewise [m]
     */
    void
    add(const dealii::Point<dim>   &place,
        const double                area,
        const ContactLaw           &law,
        double                     &multiplier,
        dealii::Tensor<1, dim>     &slip,
        const ContactResponse<dim> &response);

    /** The largest mean gap of a cell, or creep of a place that sticks [m]. */
    double
    largest_violation() const;

    /** Gives all places their new multipliers, and those that press the slips that hold them. */
    void
    update() const;

  private:
    struct Place
    {
      LatticeIndex<dim>       cell;
      bool                    presses;
      double                 *multiplier, stiffness;
      dealii::Tensor<1, dim> *slip, slip_end;
    };

    /** Sums over the places of a cell that press. */
    struct Sums
    {
      double area = 0., gap = 0.; ///< [m^2], [m^3]
    };

    const Lattice<dim>               &lattice;
    std::vector<Place>                places;
    std::map<LatticeIndex<dim>, Sums> sums;
    double                            largest_creep = 0.;
  };
  /**
   * Uzawa's step of a contact at rest.
   *
   * @param sides     what may not be pressed by the same multipliers
   * @param add_side  add_side(side, cells) adds the places of a side
   * @param tolerance of gaps and creep [m]
   * @return false, and nothing is changed, if no violation is larger than that
   */
  template <int dim, class Sides, typename AddSide>
  bool
  update_multipliers(Sides              &sides,
                     const Lattice<dim> &lattice,
                     const double        tolerance,
                     const AddSide      &add_side)
  {
    std::vector<CellMultipliers<dim>> cells(sides.size(), CellMultipliers<dim>(lattice));
    double                            largest = 0.;
    for (std::size_t k = 0; k < cells.size(); ++k)
      {
        add_side(sides[k], cells[k]);
        largest = std::max(largest, cells[k].largest_violation());
      }
    if (largest <= tolerance)
      return false;
    for (const auto &of_side : cells)
      of_side.update();
    return true;
  }
} // namespace kedge

#endif
