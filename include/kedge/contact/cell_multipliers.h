#ifndef kedge_contact_cell_multipliers_h
#define kedge_contact_cell_multipliers_h

#include <kedge/contact/contact_law.h>
#include <kedge/grid/lattice.h>

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
     * @param multiplier lambda [Pa]
     * @param slip_n     e_0 [m]
     */
    void
    add(const dealii::Point<dim>     &place,
        const double                  area,
        const ContactLaw             &law,
        const double                  multiplier,
        const dealii::Tensor<1, dim> &slip_n,
        const ContactResponse<dim>   &response);

    /** The largest mean gap of a cell, or creep of a place that sticks [m]. */
    double
    largest_violation() const;

    /** The multiplier of the place that was added as number @p n [Pa]. */
    double
    updated(const std::size_t n) const;

  private:
    struct Place
    {
      LatticeIndex<dim> cell;
      bool              presses;
      double            multiplier, stiffness;
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
} // namespace kedge

#endif
