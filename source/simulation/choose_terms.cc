// Which terms a scene has: the only place that asks which physics is on.
#include <kedge/base/exceptions.h>
#include <kedge/contact/contact_term.h>
#include <kedge/contact/contact_velocity_term.h>
#include <kedge/contact/nodal_law_term.h>
#include <kedge/contact/ray_contact_term.h>
#include <kedge/contact/tool_term.h>
#include <kedge/contact/wall_term.h>
#include <kedge/simulation/model.h>
#include <kedge/solid/body_condition_term.h>
#include <kedge/solid/follower_term.h>
#include <kedge/solid/history_term.h>
#include <kedge/solid/inertia_term.h>
#include <kedge/solid/load_term.h>
#include <kedge/solid/solid_term.h>
#include <kedge/solid/support_term.h>
#include <kedge/surfaces/surface_term.h>

#include <algorithm>
#include <limits>
#include <set>

#include "wall_plane.h"

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
  const MotionTerm<dim> &
  Model<dim>::choose_terms(const unsigned int field, const LoadProgram &program)
  {
    Field<dim>       &here  = *fields[field];
    const Patch<dim> &patch = here.patch;

    const OpenSides<dim> open_sides(scene.open_sides);
    auto                &motion =
      add_term(std::make_unique<MotionTerm<dim>>(field, patch, here.transfer.get(), open_sides));
    add_term(std::make_unique<HistoryTerm<dim>>(field, patch, bodies.materials, bodies.columns));
    if (!scene.pore_fluid)
      add_term(std::make_unique<SolidTerm<dim>>(field,
                                                patch,
                                                bodies.materials,
                                                scheme,
                                                bodies.viscosities));
    LoadTerm<dim> &loads   = choose_loads(field, motion, program);
    const bool     mixture = scene.pore_fluid && scheme.carries_fluid_velocity();
    if (mixture)
      choose_mixture_term(field, loads, program); // the first that has a tangent
    if (here.transfer && (!scene.pore_fluid || mixture))
      add_term(std::make_unique<InertiaTerm<dim>>(field, patch, here.transfer->mass(), scheme));
    add_term(std::make_unique<SupportTerm<dim>>(field, patch, conditions_of(field), scheme));
    if (!scene.body_conditions.empty())
      choose_body_conditions(field, program);

    const GhostTerm<dim> *ghosts = nullptr;
    if (scene.stabilisation.method == StabilisationKind::ghost)
      {
        ghosts = &add_term(std::make_unique<GhostTerm<dim>>(field,
                                                            patch,
                                                            scene.stabilisation,
                                                            bodies.young_moduli,
                                                            scheme));
        if (here.transfer)
          here.mapping_terms.push_back(
            &add_term(std::make_unique<GhostInertiaTerm<dim>>(field,
                                                              patch,
                                                              *ghosts,
                                                              scene.stabilisation,
                                                              scheme)));
      }
    if (scene.pore_fluid && !mixture)
      choose_porous_terms(field, loads, ghosts, program);
    return motion;
  }



  template <int dim>
  LoadTerm<dim> &
  Model<dim>::choose_loads(const unsigned int field,
                           MotionTerm<dim>   &motion,
                           const LoadProgram &program)
  {
    const Patch<dim>                    &patch = fields[field]->patch;
    std::vector<TractionParameters<dim>> dead, following;
    for (const auto &traction : scene.tractions)
      {
        if (!traction.traction[0].empty())
          dead.push_back(traction);
        if (!traction.pressure.empty())
          following.push_back(traction);
      }
    LoadTerm<dim> &loads = add_term(std::make_unique<LoadTerm<dim>>(
      field,
      patch,
      ExternalLoads<dim>(scene.body_force,
                         bodies.has_body_force,
                         scene.point_loads,
                         scene.constants,
                         program),
      SurfaceTractions<dim>(dead, scene.constants, program, surface_terms),
      bodies.names,
      motion,
      scheme));
    load_terms.push_back(&loads);
    if (!following.empty())
      load_terms.push_back(&add_term(std::make_unique<FollowerTerm<dim>>(
        field,
        patch,
        FollowerPressures<dim>(following, scene.constants, program, surface_terms),
        bodies.names,
        scheme)));
    return loads;
  }



  template <int dim>
  void
  Model<dim>::choose_body_conditions(const unsigned int field, const LoadProgram &program)
  {
    std::vector<BodyConditionParameters<dim>> here;
    std::vector<double>                       stiffness;
    for (const auto &condition : scene.body_conditions)
      for (unsigned int b = 0; b < bodies.names.size(); ++b)
        if (bodies.names[b] == condition.body && bodies.field[b] == field)
          {
            here.push_back(condition);
            stiffness.push_back(p_wave_modulus(bodies.materials[b]) /
                                points.grid().lattice().smallest_cell_size());
          }
    add_term(std::make_unique<BodyConditionTerm<dim>>(field,
                                                      fields[field]->patch,
                                                      here,
                                                      stiffness,
                                                      bodies.names,
                                                      scene.constants,
                                                      program,
                                                      scheme,
                                                      surface_terms));
  }



  namespace
  {
    /** Of the bodies' surfaces, where no contact asks for another: parts of a cell. */
    constexpr double default_spacing = 0.2;

    /** The smallest one that is allowed, in cells: finer surfaces tell nothing that cells could
     * follow. */
    constexpr double smallest_spacing = 0.005;

    bool
    with_law(const ContactParameters &contact)
    {
      return contact.method == ContactMethod::surface_points;
    }

    template <int dim>
    bool
    carries_water(const Scene<dim> &scene, const unsigned int body)
    {
      return scene.pore_fluid && !scene.pore_fluid->bodies[body].is_dry;
    }

    /** The material of a body if it has an undrained strength. */
    const Material *
    clay_of(const Bodies &bodies, const unsigned int body)
    {
      const Material &material = bodies.materials[body];
      return has_undrained_strength(material) ? &material : nullptr;
    }

    /** How stiff the contact of two bodies is: eps = beta M / h, and tangent_ratio(). */
    template <int dim>
    ContactBodies<dim>
    contact_of(const BodySurface<dim>  &first,
               const BodySurface<dim>  &second,
               const Scene<dim>        &scene,
               const Bodies            &bodies,
               const ContactParameters &contact,
               const double             cell_size)
    {
      double softness = 0., poisson = 0.;
      for (const unsigned int body : {first.body, second.body})
        {
          softness += 0.5 / p_wave_modulus(bodies.materials[body]);
          poisson += 0.5 * scene.materials[scene.bodies[body].material].poisson_ratio;
        }
      const double stiffness = contact.penalty_factor / (softness * cell_size);
      return {&first,
              &second,
              stiffness,
              stiffness * tangent_ratio(poisson),
              {{carries_water(scene, first.body), carries_water(scene, second.body)}},
              {{clay_of(bodies, first.body), clay_of(bodies, second.body)}}};
    }

    /** The same against a wall, which gives nothing: the harmonic mean is twice the body's. */
    template <int dim>
    WallBody<dim>
    wall_body_of(const BodySurface<dim>  &surface,
                 const Scene<dim>        &scene,
                 const Bodies            &bodies,
                 const ContactParameters &contact,
                 const double             cell_size)
    {
      const double poisson = scene.materials[scene.bodies[surface.body].material].poisson_ratio;
      const double stiffness =
        2. * contact.penalty_factor * p_wave_modulus(bodies.materials[surface.body]) / cell_size;
      return {&surface,
              stiffness,
              stiffness * tangent_ratio(poisson),
              carries_water(scene, surface.body),
              clay_of(bodies, surface.body)};
    }

    template <int dim>
    WallMotion<dim>
    wall_motion_of(const ContactParameters             &contact,
                   const std::map<std::string, double> &constants,
                   const LoadProgram                   &program)
    {
      WallMotion<dim> motion{{}, program};
      for (const std::string &component : contact.wall_displacement)
        motion.components.emplace_back(component, std::vector<std::string>{"t"}, constants);
      return motion;
    }

    /** Parts of a cell's diagonal where the non-linear penalty bends, and its final stiffness over
     * that at the start: those of the thesis's section 5.5.1.2. */
    constexpr double first_bend = -0.01, last_bend = -0.03, stiffening = 100.;

    /** The law at nodes: r = beta (sum of Young's moduli), in space times the size of a cell. */
    template <int dim>
    NodalLaw
    nodal_law_of(const ContactParameters &contact,
                 const double             moduli,
                 const Lattice<dim>      &lattice,
                 const double             alpha)
    {
      const double h = lattice.smallest_cell_size() * lattice.node_intervals;
      NodalLaw     law;
      law.stiffness       = contact.penalty_factor * moduli * (dim == 3 ? h : 1.);
      law.friction        = contact.friction;
      law.alpha           = alpha;
      const double size   = lattice.h.norm() * lattice.node_intervals;
      law.first_bend      = first_bend * size;
      law.last_bend       = last_bend * size;
      law.final_stiffness = stiffening * law.stiffness;
      return law;
    }
  } // namespace



  /** A surface for each body that asks for one, as fine as the finest that is asked for. */
  template <int dim>
  void
  Model<dim>::choose_surface_terms()
  {
    const double h = smallest_cell_size();
    for (unsigned int b = 0; b < bodies.names.size(); ++b)
      {
        constexpr double none    = std::numeric_limits<double>::max();
        double           spacing = none;
        for (const ContactParameters &contact : scene.contacts)
          for (const auto *group : {&contact.first, &contact.second})
            if (with_law(contact) &&
                std::find(group->begin(), group->end(), bodies.names[b]) != group->end())
              spacing =
                std::min(spacing, contact.spacing > 0. ? contact.spacing : default_spacing * h);
        if (spacing < smallest_spacing * h)
          throw UserError("Contact: a Surface spacing of " + std::to_string(spacing / h) +
                          " cells gives body '" + bodies.names[b] +
                          "' more surface points than can be followed. Allowed: from " +
                          std::to_string(smallest_spacing) + " of a cell on.");
        const bool contact = spacing < none;
        if (contact && bodies.bases[b] == BasisKind::spline &&
            dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
          throw UserError(
            "Bodies/" + bodies.names[b] +
            "/Basis = spline: bodies of splines are in contact on one process, not on "
            "several. Start kedge without mpirun, or take gimp.");
        std::vector<unsigned int> sides; // that something is prescribed on
        const auto                add = [&](const auto &prescribed) {
          for (const auto &surface : prescribed)
            if (surface.body == bodies.names[b])
              sides.push_back(surface.side);
        };
        add(scene.tractions);
        add(scene.surface_pressures);
        add(scene.surface_fluxes);
        for (const auto &condition : scene.body_conditions)
          if (condition.body == bodies.names[b] && !condition.section)
            sides.push_back(condition.side);
        if (contact || !sides.empty())
          surface_terms.push_back(
            &add_term(std::make_unique<SurfaceTerm<dim>>(scene.bodies[b],
                                                         b,
                                                         bodies.field[b],
                                                         fields[bodies.field[b]]->patch,
                                                         contact ? spacing : default_spacing * h,
                                                         contact,
                                                         sides,
                                                         OpenSides<dim>(scene.open_sides))));
      }
  }



  template <int dim>
  void
  Model<dim>::choose_contact_terms(const LoadProgram &program)
  {
    const double                                    h = smallest_cell_size();
    std::map<std::string, const BodySurface<dim> *> surfaces;
    for (const SurfaceTerm<dim> *term : surface_terms)
      surfaces[term->surface().body_name] = &term->surface();
    for (const ContactParameters &contact : scene.contacts)
      if (with_law(contact))
        {
          if (contact.has_wall || contact.tool)
            {
              std::vector<WallBody<dim>> touching;
              for (const std::string &first : contact.first)
                touching.push_back(wall_body_of(*surfaces.at(first), scene, bodies, contact, h));
              if (contact.tool)
                {
                  add_term(std::make_unique<ToolTerm<dim>>(contact,
                                                           touching,
                                                           *rigid_bodies,
                                                           *contact.tool,
                                                           scene.constants,
                                                           scheme,
                                                           h));
                  continue;
                }
              add_term(std::make_unique<WallTerm<dim>>(
                contact,
                plane_of(contact, points.grid().lattice()),
                wall_motion_of<dim>(contact, scene.constants, program),
                touching,
                scene.constants,
                scheme,
                h));
              continue;
            }
          std::vector<ContactBodies<dim>> pairs;
          for (const std::string &first : contact.first)
            for (const std::string &second : contact.second)
              pairs.push_back(
                contact_of(*surfaces.at(first), *surfaces.at(second), scene, bodies, contact, h));
          add_term(std::make_unique<ContactTerm<dim>>(contact, pairs, scene.constants, scheme, h));
        }
      else if (is_nodal(contact.method))
        choose_nodal_contact_term(contact);
  }



  template <int dim>
  void
  Model<dim>::choose_nodal_contact_term(const ContactParameters &contact)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw UserError("Contact/" + contact.name +
                      ": Methods at nodes run on one process, not on several. Start kedge without "
                      "mpirun, or take Method = surface points.");
    if (scene.pore_fluid)
      throw UserError("Contact/" + contact.name +
                      ": Methods at nodes know dry bodies only. Leave the Pore fluid out, or take "
                      "Method = surface points.");
    double                                moduli = 0.; // the means of both groups
    std::array<std::vector<bool>, 2>      takes_part;
    std::array<std::set<unsigned int>, 2> fields_of;
    for (const unsigned int k : {0u, 1u})
      {
        const auto &group = k == 0 ? contact.first : contact.second;
        for (unsigned int b = 0; b < bodies.names.size(); ++b)
          {
            takes_part[k].push_back(std::find(group.begin(), group.end(), bodies.names[b]) !=
                                    group.end());
            if (!takes_part[k].back())
              continue;
            moduli += bodies.young_moduli[b] / static_cast<double>(group.size());
            fields_of[k].insert(bodies.field[b]);
          }
      }
    const NodalLaw law =
      nodal_law_of(contact, moduli, points.grid().lattice(), scheme.contact_alpha());
    for (const unsigned int a : fields_of[0])
      for (const unsigned int b : fields_of[1])
        add_nodal_contact(contact,
                          law,
                          {{{a, b}}, {{&fields[a]->patch, &fields[b]->patch}}, takes_part});
  }



  template <int dim>
  void
  Model<dim>::add_nodal_contact(const ContactParameters  &contact,
                                const NodalLaw           &law,
                                const ContactFields<dim> &pair)
  {
    if (contact.method == ContactMethod::ray_tracing)
      {
        // r of a surface: the force at a node over the part of the surface that it has
        const double h =
          points.grid().lattice().smallest_cell_size() * points.grid().lattice().node_intervals;
        add_term(std::make_unique<RayContactTerm<dim>>(
          contact.name,
          pair,
          RayLaw{law.stiffness / (dim == 3 ? h * h : h), contact.friction, law.alpha}));
        return;
      }
    if (contact.method != ContactMethod::contact_velocity)
      {
        add_term(std::make_unique<NodalLawTerm<dim>>(contact, pair, law));
        return;
      }
    if (!scheme.dynamic)
      throw UserError("Contact/" + contact.name +
                      ": Method = contact velocity needs inertia (Time/Scheme).");
    add_term(std::make_unique<ContactVelocityTerm<dim>>(
      contact.name,
      pair,
      std::array<const NodeMatrix<dim> *, 2>{
        {&fields[pair.number[0]]->transfer->mass(), &fields[pair.number[1]]->transfer->mass()}},
      law.alpha,
      contact.friction));
  }

#define KEDGE_INSTANTIATE(dim)                                                   \
  template const MotionTerm<dim> &Model<dim>::choose_terms(const unsigned int,   \
                                                           const LoadProgram &); \
  template void                   Model<dim>::choose_surface_terms();            \
  template void                   Model<dim>::choose_contact_terms(const LoadProgram &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
