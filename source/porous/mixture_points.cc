#include <kedge/porous/mixture_points.h>

namespace kedge
{
  template <int dim>
  void
  MixturePoints<dim>::reinit(const MaterialPoints<dim> &cloud, const StepPoints<dim> &points)
  {
    pressure.resize(points.size());
    end_pressure.resize(points.size());
    fluctuation.resize(points.size());
    fluid_velocity.resize(points.size());
    cloud.for_each([&](const unsigned int number,
                       const std::uint64_t,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      const unsigned int slot = points.slot_of[number];
      if (slot == StepPoints<dim>::no_slot)
        return;
      pressure[slot]       = state.pore_pressure;
      end_pressure[slot]   = state.end_pore_pressure;
      fluctuation[slot]    = state.pore_pressure_fluctuation;
      fluid_velocity[slot] = state.fluid_velocity;
    });
  }



  template <int dim>
  void
  apply_mixture_update(const MixtureUpdate<dim> &update, PointState<dim> &state)
  {
    state.pore_pressure             = update.pressure;
    state.end_pore_pressure         = update.end_pressure;
    state.pore_pressure_fluctuation = update.fluctuation;
    state.porosity                  = update.porosity;
    state.fluid_velocity            = update.fluid_velocity;
    state.velocity += update.skeleton_change;
    state.darcy_velocity = update.darcy_velocity;
  }

  template struct MixturePoints<2>;
  template struct MixturePoints<3>;
  template void
  apply_mixture_update(const MixtureUpdate<2> &, PointState<2> &);
  template void
  apply_mixture_update(const MixtureUpdate<3> &, PointState<3> &);
} // namespace kedge
