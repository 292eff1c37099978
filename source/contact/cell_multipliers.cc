#include <kedge/contact/cell_multipliers.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  template <int dim>
  void
  CellMultipliers<dim>::add(const dealii::Point<dim>     &place,
                            const double                  area,
                            const ContactLaw             &law,
                            const double                  multiplier,
                            const dealii::Tensor<1, dim> &slip_n,
                            const ContactResponse<dim>   &response)
  {
    const bool presses = response.pressure > 0.;
    places.push_back({lattice.cell_of(place), presses, multiplier, law.normal_stiffness});
    if (!presses)
      return;
    Sums &here = sums[places.back().cell];
    here.area += area;
    here.gap += area * (multiplier - response.pressure) / law.normal_stiffness;
    if (response.sticks)
      largest_creep = std::max(largest_creep, (response.slip_end - slip_n).norm());
  }



  template <int dim>
  double
  CellMultipliers<dim>::largest_violation() const
  {
    double largest = largest_creep;
    for (const auto &[cell, here] : sums)
      largest = std::max(largest, std::abs(here.gap) / here.area);
    return largest;
  }



  template <int dim>
  double
  CellMultipliers<dim>::updated(const std::size_t n) const
  {
    const Place &place = places[n];
    if (!place.presses)
      return 0.;
    const Sums &here = sums.at(place.cell);
    return std::max(place.multiplier - place.stiffness * here.gap / here.area, 0.);
  }

  template class CellMultipliers<2>;
  template class CellMultipliers<3>;
} // namespace kedge
