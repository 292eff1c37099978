// Which terms a scene has: the only place that asks which physics is on.
#include <kedge/porous/porous_ghost_term.h>
#include <kedge/simulation/model.h>
#include <kedge/solid/follower_term.h>
#include <kedge/solid/history_term.h>
#include <kedge/solid/inertia_term.h>
#include <kedge/solid/load_term.h>
#include <kedge/solid/solid_term.h>
#include <kedge/solid/support_term.h>

namespace kedge
{
  template <int dim>
  template <class T>
  T &
  Model<dim>::add_term(std::unique_ptr<T> term)
  {
    T &result = *term;
    terms.push_back(std::move(term));
    return result;
  }



  template <int dim>
  void
  Model<dim>::choose_terms(const unsigned int field, const LoadProgram &program)
  {
    Field<dim>       &here  = *fields[field];
    const Patch<dim> &patch = here.patch;

    auto &motion = add_term(std::make_unique<MotionTerm<dim>>(field, patch, here.transfer.get()));
    add_term(std::make_unique<HistoryTerm<dim>>(field, patch, bodies.materials, bodies.columns));
    if (!scene.pore_fluid)
      {
        add_term(std::make_unique<SolidTerm<dim>>(field, patch, bodies.materials, scheme));
        if (here.transfer)
          add_term(std::make_unique<InertiaTerm<dim>>(field, patch, here.transfer->mass(), scheme));
      }
    std::vector<TractionParameters<dim>> dead, following;
    for (const auto &traction : scene.tractions)
      {
        if (!traction.traction[0].empty())
          dead.push_back(traction);
        if (!traction.pressure.empty())
          following.push_back(traction);
      }
    auto &loads = add_term(
      std::make_unique<LoadTerm<dim>>(field,
                                      patch,
                                      ExternalLoads<dim>(scene.body_force,
                                                         bodies.has_body_force,
                                                         scene.point_loads,
                                                         scene.constants,
                                                         program),
                                      SurfaceTractions<dim>(dead, scene.constants, program),
                                      bodies.names,
                                      motion,
                                      scheme));
    if (!following.empty())
      add_term(std::make_unique<FollowerTerm<dim>>(
        field,
        patch,
        FollowerPressures<dim>(following, scene.constants, program),
        bodies.names,
        scheme));
    add_term(std::make_unique<SupportTerm<dim>>(field, patch, scene.node_conditions));

    const GhostTerm<dim> *ghosts = nullptr;
    if (scene.stabilisation.method == StabilisationKind::ghost)
      {
        ghosts = &add_term(std::make_unique<GhostTerm<dim>>(field,
                                                            patch,
                                                            scene.stabilisation,
                                                            bodies.young_moduli,
                                                            scheme));
        here.mapping_terms.push_back(ghosts);
      }
    if (scene.pore_fluid)
      choose_porous_terms(field, loads, ghosts, program);
  }



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
    auto &soil        = add_term(std::make_unique<PorousTerm<dim>>(
      field,
      patch,
      SoilBodies{bodies.materials,
                 bodies.soils,
                 bodies.names,
                 bodies.initial_pore_pressure,
                 scene.constants},
      loads.external_loads(),
      SurfacePressures<dim>(scene.surface_pressures, scene.constants, program),
      SurfaceFluxes<dim>(scene.surface_fluxes, scene.constants, program),
      *scene.pore_fluid,
      scheme,
      pore_scheme,
      fields[field]->tangent_radius));
    loads.add_forces(soil.water_pressures());
    if (ghosts != nullptr)
      add_term(std::make_unique<PorousGhostTerm<dim>>(field,
                                                      patch,
                                                      *ghosts,
                                                      soil,
                                                      scene.stabilisation,
                                                      scene.pore_fluid->fluid));
  }

#define KEDGE_INSTANTIATE(dim) \
  template void Model<dim>::choose_terms(const unsigned int, const LoadProgram &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
