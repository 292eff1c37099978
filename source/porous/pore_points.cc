#include <kedge/porous/pore_points.h>

namespace kedge
{
  template <int dim>
  void
  PorePoints<dim>::reinit(const MaterialPoints<dim> &cloud,
                          const StepPoints<dim>     &points,
                          const PoreScheme          &scheme)
  {
    pressure.resize(points.size());
    fluctuation.resize(points.size());
    rate.resize(scheme.carries_rates ? points.size() : 0);
    rate_change.resize(rate.size());
    cloud.for_each([&](const unsigned int number,
                       const std::uint64_t,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      const unsigned int slot = points.slot_of[number];
      if (slot == StepPoints<dim>::no_slot)
        return;
      pressure[slot]    = state.pore_pressure;
      fluctuation[slot] = state.pore_pressure_fluctuation;
      if (!scheme.carries_rates)
        return;
      rate[slot]        = state.fluid_content_rate;
      rate_change[slot] = state.fluid_content_rate_change;
    });
  }

  template struct PorePoints<2>;
  template struct PorePoints<3>;
} // namespace kedge
