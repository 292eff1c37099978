#include <kedge/contact/cell_multipliers.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  template <int dim>
  void
  CellMultipliers<dim>::add(const dealii::Point<dim>   &place,
                            const double                area,
                            const ContactLaw           &law,
                            double                     &multiplier,
                            dealii::Tensor<1, dim>     &slip,
                            const ContactResponse<dim> &response)
  {
    const bool presses = response.pressure > 0.;
    places.push_back({lattice.cell_of(place),
                      presses,
                      &multiplier,
                      law.normal_stiffness,
                      &slip,
                      response.slip_end});
    if (!presses)
      return;
    Sums &here = sums[places.back().cell];
    here.area += area;
    here.gap += area * (multiplier - response.pressure) / law.normal_stiffness;
    if (response.sticks)
      largest_creep = std::max(largest_creep, (response.slip_end - slip).norm());
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
  void
  CellMultipliers<dim>::update() const
  {
    for (const Place &place : places)
      {
        if (!place.presses)
          {
            *place.multiplier = 0.;
            continue;
          }
        const Sums &here = sums.at(place.cell);
        *place.multiplier =
          std::max(*place.multiplier - place.stiffness * here.gap / here.area, 0.);
        *place.slip = place.slip_end;
      }
  }

  template class CellMultipliers<2>;
  template class CellMultipliers<3>;
} // namespace kedge
