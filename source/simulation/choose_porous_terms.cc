// The terms of saturated soil.
#include <kedge/porous/mixture_term.h>
#include <kedge/porous/porous_ghost_term.h>
#include <kedge/simulation/model.h>

#include <algorithm>
#include <limits>

namespace kedge
{
  template <int dim>
  SoilBodies
  Model<dim>::soil_bodies() const
  {
    return {bodies.materials,
            bodies.soils,
            bodies.names,
            bodies.initial_pore_pressure,
            scene.constants};
  }



  template <int dim>
  void
  Model<dim>::choose_mixture_term(const unsigned int field,
                                  LoadTerm<dim>     &loads,
                                  const LoadProgram &program)
  {
    pressure_fraction = 0.5;
    auto soil         = std::make_unique<MixtureTerm<dim>>(
      field,
      fields[field]->patch,
      soil_bodies(),
      loads.external_loads(),
      SurfacePressures<dim>(scene.surface_pressures, scene.constants, program, surface_terms),
      SurfaceFluxes<dim>(scene.surface_fluxes, scene.constants, program, surface_terms),
      *scene.pore_fluid,
      scheme,
      fields[field]->tangent_radius);
    loads.add_forces(soil->water_pressures());
    terms.push_back(std::move(soil));
  }



  namespace
  {
    /** The fluid as it flows in the body that lets least pass: what ghosts add is small in all. */
    PoreFluidParameters
    in_tightest_body(const PorousParameters &pores)
    {
      PoreFluidParameters fluid    = pores.fluid;
      fluid.hydraulic_conductivity = std::numeric_limits<double>::max();
      for (const BodyPores &body : pores.bodies)
        fluid.hydraulic_conductivity =
          std::min(fluid.hydraulic_conductivity, body.hydraulic_conductivity);
      return fluid;
    }
  } // namespace

  template <int dim>
  void
  Model<dim>::choose_porous_terms(const unsigned int    field,
                                  LoadTerm<dim>        &loads,
                                  const GhostTerm<dim> *ghosts,
                                  const LoadProgram    &program)
  {
    const Patch<dim> &patch = fields[field]->patch;
    const PoreScheme  pore_scheme(scene.time);
    pressure_fraction = pore_scheme.theta;
    auto added        = std::make_unique<PorousTerm<dim>>(
      field,
      patch,
      soil_bodies(),
      loads.external_loads(),
      SurfacePressures<dim>(scene.surface_pressures, scene.constants, program, surface_terms),
      SurfaceFluxes<dim>(scene.surface_fluxes, scene.constants, program, surface_terms),
      *scene.pore_fluid,
      scheme,
      pore_scheme,
      fields[field]->tangent_radius);
    const auto &soil = *added;
    terms.push_back(std::move(added));
    loads.add_forces(soil.water_pressures());
    if (ghosts != nullptr)
      terms.push_back(std::make_unique<PorousGhostTerm<dim>>(field,
                                                             patch,
                                                             *ghosts,
                                                             soil,
                                                             scene.stabilisation,
                                                             in_tightest_body(*scene.pore_fluid)));
  }

#define KEDGE_INSTANTIATE(dim)                                                \
  template SoilBodies Model<dim>::soil_bodies() const;                        \
  template void       Model<dim>::choose_mixture_term(const unsigned int,     \
                                                LoadTerm<dim> &,        \
                                                const LoadProgram &);   \
  template void       Model<dim>::choose_porous_terms(const unsigned int,     \
                                                LoadTerm<dim> &,        \
                                                const GhostTerm<dim> *, \
                                                const LoadProgram &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
