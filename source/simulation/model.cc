#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/points/generation.h>
#include <kedge/points/node_region.h>
#include <kedge/porous/outflow_term.h>
#include <kedge/rigid/rigid_distance.h>
#include <kedge/simulation/model.h>
#include <kedge/simulation/separate_pieces.h>
#include <kedge/solid/initial_history.h>
#include <kedge/solid/initial_stress.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** The elements of a scene in the whole of its box, refined. */
    template <int dim>
    GridLevels<dim>
    levels_of(const Scene<dim> &scene)
    {
      GridParameters<dim> elements = scene.grid;
      elements.node_intervals      = 1;
      const Lattice<dim>        lattice(elements);
      GridLevels<dim>           levels(lattice);
      const RefinementRule<dim> rule(scene.grid.refinement, scene.constants);
      if (!rule.any())
        return levels;
      LatticeWindow<dim> all;
      all.n_cells = lattice.n_cells;
      levels.cover(all);
      RefinementState state;
      state.t = just_after(scene.time.start);
      if (rule.asks_distance())
        {
          RigidBodies<dim>               tools(1., MPI_COMM_SELF);
          const dealii::BoundingBox<dim> domain(
            {scene.grid.origin, scene.grid.origin + scene.grid.extent});
          make_rigid_bodies(scene.rigid_bodies, domain, tools);
          state.distance = distances_to_surfaces(tools, middles_of_cells(lattice, all));
        }
      levels.refine(rule.wanted(lattice, all, state));
      return levels;
    }
  } // namespace



  template <int dim>
  Model<dim>::Model(const Scene<dim>  &scene,
                    const MPI_Comm     communicator,
                    const LoadProgram &program)
    : scene(with_separate_pieces(scene))
    , communicator(communicator)
    , scheme(scene.time)
    , bodies(read_bodies(this->scene))
    , points(scene.grid,
             OpenSides<dim>(scene.open_sides),
             RefinementRule<dim>(scene.grid.refinement, scene.constants),
             layout_of_points<dim>(bodies, scene.pore_fluid.has_value(), scheme),
             communicator)
    , levels_at_start(levels_of(scene))
  {
    make_fields(program);
    choose_surface_terms();
    std::vector<const MotionTerm<dim> *> motions;
    for (unsigned int field = 0; field < fields.size(); ++field)
      motions.push_back(&choose_terms(field, program));
    n_field_terms = terms.size() - surface_terms.size();
    if (scene.load_control)
      choose_load_control();
    if (!scene.rigid_bodies.empty())
      choose_rigid_terms(program);
    choose_contact_terms(program);
    if (!scene.open_sides.empty())
      terms.push_back(std::make_unique<OutflowTerm<dim>>(bodies.soils,
                                                         motions,
                                                         scheme.carries_fluid_velocity(),
                                                         communicator));
    declare();
  }



  template <int dim>
  void
  Model<dim>::make_fields(const LoadProgram &program)
  {
    const bool ghosts = scene.stabilisation.method == StabilisationKind::ghost;
    const bool ties   = scene.stabilisation.method == StabilisationKind::aggregation;
    const int  stencil_radius =
      std::max(bodies.stencil_radius(), ghosts ? GhostTerm<dim>::radius : 0); // of the widest body

    PatchParameters parameters;
    parameters.body_names       = bodies.names;
    parameters.basis_of_body    = bodies.bases;
    parameters.shared_volume    = bodies.shared_volume;
    parameters.columns_of_body  = bodies.columns;
    parameters.smallest_filling = ties ? scene.stabilisation.smallest_filling : 0.;
    parameters.coarse_pressure  = scene.pore_fluid && scene.pore_fluid->coarse_pressure;
    parameters.n_components     = scene.pore_fluid ? dim + 1 : dim;
    for (unsigned int f = 0; f < bodies.field_names.size(); ++f)
      {
        if (bodies.field_names.size() > 1)
          {
            parameters.holds_body.assign(bodies.names.size(), false);
            for (std::size_t b = 0; b < bodies.names.size(); ++b)
              parameters.holds_body[b] = bodies.field[b] == f;
          }
        fields.push_back(std::make_unique<Field<dim>>(
          bodies.field_names[f],
          points.grid(),
          parameters,
          NodeConditions<dim>(conditions_of(f), scene.constants, program),
          std::max(stencil_radius, bodies.tangent_radius())));
        if (scheme.dynamic)
          fields.back()->transfer = std::make_unique<MotionTransfer<dim>>(f,
                                                                          fields.back()->patch,
                                                                          scene.transfer,
                                                                          scheme,
                                                                          stencil_radius);
      }
    unknowns.fields.resize(fields.size());
    unknowns.traits.space_dimension = dim;
  }



  template <int dim>
  std::vector<NodeConditionParameters<dim>>
  Model<dim>::conditions_of(const unsigned int field) const
  {
    std::vector<NodeConditionParameters<dim>> result;
    for (const auto &condition : scene.node_conditions)
      {
        bool holds = condition.body.empty();
        for (std::size_t b = 0; b < bodies.names.size(); ++b)
          holds = holds || (bodies.names[b] == condition.body && bodies.field[b] == field);
        if (holds)
          result.push_back(condition);
      }
    return result;
  }



  template <int dim>
  void
  Model<dim>::declare()
  {
    for (auto &term : terms)
      term->declare_unknowns(unknowns);
    const std::size_t n_terms = n_field_terms / fields.size(); // each field has the same ones
    for (std::size_t k = 0; k < n_field_terms; ++k)
      {
        const bool is_part = fields.size() > 1;
        if (is_part && k % n_terms == 0)
          ledger.open_part(fields[k / n_terms]->name);
        terms[surface_terms.size() + k]->declare_books(ledger);
        if (is_part && (k + 1) % n_terms == 0)
          ledger.close_part();
      }
    for (std::size_t k = surface_terms.size() + n_field_terms; k < terms.size(); ++k)
      terms[k]->declare_books(ledger);
    ledger.declare_stored("total_energy", "J", Ledger::Section::work, "energy");
    ledger.declare_error("energy_error", "J", Ledger::Section::work, "energy");
  }



  template <int dim>
  void
  Model<dim>::create_points()
  {
    check_node_conditions(scene.node_conditions,
                          scene.constants,
                          levels_at_start.size() > 1 ? levels_at_start.finest()
                                                     : points.grid().lattice());
    std::vector<GeneratedPoint<dim>> made;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        auto of_body = generate_points(scene.bodies[b],
                                       b,
                                       bodies.densities[b],
                                       levels_at_start,
                                       scene.constants,
                                       made.size());
        if (made.empty())
          made = std::move(of_body);
        else
          made.insert(made.end(), of_body.begin(), of_body.end());
      }
    std::vector<MaterialParameters> parameters;
    for (const auto &body : scene.bodies)
      parameters.push_back(scene.materials[body.material]);
    set_initial_history(parameters, scene.constants, made);
    stress_notes = set_initial_stress(scene.bodies, bodies.materials, scene.constants, made);
    for (auto &term : terms)
      term->attach(made);

    generated = std::vector<PointOrigin<dim>>(made.begin(), made.end());
    check_overlaps();
    std::vector<PointRecord<dim>> records;
    records.reserve(made.size());
    for (const auto &point : made)
      records.push_back(point.record);
    std::vector<GeneratedPoint<dim>>().swap(made); // as large as all that follows
    points.begin(std::move(records), scene.time.start);
  }



  /** Edge of the finest elements that the scene's rule makes [m]. */
  template <int dim>
  double
  Model<dim>::smallest_cell_size() const
  {
    return levels_at_start.finest().smallest_cell_size();
  }



  template <int dim>
  void
  Model<dim>::check_overlaps() const
  {
    for (const auto &point : generated)
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
        {
          if (b == point.body || bodies.field[b] != bodies.field[point.body] ||
              !scene.bodies[b].geometry->contains(point.location))
            continue;
          std::ostringstream message;
          message << "Bodies '" << scene.bodies[point.body].name << "' and '"
                  << scene.bodies[b].name << "' overlap: a material point of the first, at ("
                  << point.location << "), lies in the second. Change Bodies/"
                  << scene.bodies[b].name << "/Geometry.";
          throw UserError(message.str());
        }
  }



  template <int dim>
  void
  Model<dim>::forget_generated_points()
  {
    generated.clear();
    generated.shrink_to_fit();
  }



  template <int dim>
  std::vector<const Patch<dim> *>
  Model<dim>::patches() const
  {
    std::vector<const Patch<dim> *> result;
    for (const auto &field : fields)
      result.push_back(&field->patch);
    return result;
  }

  template class Model<2>;
  template class Model<3>;
} // namespace kedge
