#include <kedge/base/exceptions.h>
#include <kedge/contact/tool_term.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    template <int dim>
    dealii::BoundingBox<dim>
    box_of(const SurfaceMesh<dim> &mesh)
    {
      dealii::BoundingBox<dim> box({mesh.vertices.front(), mesh.vertices.front()});
      for (const auto &x : mesh.vertices)
        box.merge_with(dealii::BoundingBox<dim>({x, x}));
      return box;
    }
  } // namespace



  template <int dim>
  ToolTerm<dim>::ToolTerm(const ContactParameters             &parameters,
                          const std::vector<WallBody<dim>>    &touching,
                          RigidBodies<dim>                    &rigid,
                          const unsigned int                   tool,
                          const std::map<std::string, double> &constants,
                          const Scheme                        &scheme,
                          const double                         cell_size)
    : parameters(parameters)
    , rigid(rigid)
    , tool(tool)
    , cell_size(cell_size)
    , at_rest(!scheme.dynamic)
    , shear_limit(parameters, constants)
    , books(touching.front().surface->patch.grid().communicator())
  {
    const SurfaceMesh<dim> &mesh = rigid.surface(tool);
    if (mesh.facets.empty())
      throw UserError("Contact/" + parameters.name + "/Tool = " + rigid[tool].name +
                      ": The rigid body has no shape (Rigid bodies/" + rigid[tool].name +
                      "/Geometry).");
    search               = std::make_unique<FacetSearch<dim>>(mesh, box_of(mesh));
    penetration          = std::make_unique<ToolPenetration<dim>>(rigid, tool, *search, cell_size);
    const double spacing = parameters.spacing > 0. ? parameters.spacing : 0.2 * cell_size;
    if (scheme.dynamic) // at rest Uzawa's iteration does not find how edges and faces share a load
      edges = sharp_places<dim>(mesh, spacing);
    for (const WallBody<dim> &body : touching)
      {
        const ContactLaw law =
          contact_law_of(parameters, body.normal_stiffness, body.tangent_stiffness, scheme);
        const double far = reach * cell_size, deep = largest_overlap * cell_size;
        sides.push_back(std::make_unique<
                        ToolSamples<dim>>(body, law, rigid, tool, *search, shear_limit, far, deep));
        sides.push_back(
          std::make_unique<
            ToolEdges<dim>>(body, law, rigid, tool, edges, spacing, shear_limit, far, deep));
      }
  }



  template <int dim>
  void
  ToolTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &)
  {
    for (const auto &side : sides)
      {
        shear_limit.count_from(*side->body.surface);
        side->move({});
        const auto [overlap, place] = side->deepest();
        if (overlap <= largest_overlap * cell_size)
          continue;
        std::ostringstream message;
        message << "Contact '" << parameters.name << "': body '" << side->body.surface->body_name
                << "' reaches " << overlap << " m into the rigid body '" << rigid[tool].name
                << "' at (" << place << "), which is more than half a cell. Move it (Bodies/"
                << side->body.surface->body_name << "/Geometry) or the other (Rigid bodies/"
                << rigid[tool].name << "/Geometry).";
        throw UserError(message.str());
      }
    for (const auto &side : sides)
      shear_limit.check(*side->body.surface, side->body.clay != nullptr);
  }



  template <int dim>
  void
  ToolTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (shear_limit.is_of_place())
      for (const auto &side : sides)
        side->read_strengths();
  }



  template <int dim>
  void
  ToolTerm<dim>::start(Trial<dim> &trial)
  {
    directions.start();
    uzawa.start();
    for (const auto &side : sides)
      {
        side->begin_step();
        std::vector<double> predicted;
        if (!at_rest)
          predicted = trial.motion[side->body.surface->field].velocity_n;
        for (double &u : predicted)
          u *= trial.times.dt;
        side->move(predicted);
        side->find();
      }
  }



  template <int dim>
  void
  ToolTerm<dim>::move(const Trial<dim> &trial)
  {
    for (const auto &side : sides)
      {
        side->move(trial.displacement(side->body.surface->field));
        side->read_pore_pressures(trial.unknowns.fields[side->body.surface->field]);
      }
  }



  template <int dim>
  bool
  ToolTerm<dim>::presses() const
  {
    for (const auto &side : sides)
      for (const Sample &sample : side->samples)
        if (side->response(sample).pressure > 0.)
          return true;
    return false;
  }



  template <int dim>
  Answer
  ToolTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    move(trial);
    // at rest nothing is predicted, and bodies that are barely held must not be pushed about
    if (!at_rest && directions.follow())
      for (const auto &side : sides)
        side->find_anew();
    for (const auto &side : sides)
      for (const Sample &sample : side->samples)
        {
          const dealii::Tensor<1, dim> force = sample.area * side->response(sample).traction;
          if (force == dealii::Tensor<1, dim>())
            continue;
          const BodySurface<dim> &surface = *side->body.surface;
          add_spread_force(surface,
                           side->functions(sample),
                           -force,
                           residual.partial(surface.field));
          rigid.add_force(side->point(sample), -in_space<dim>(force), residual.others());
        }
    return {};
  }



  template <int dim>
  void
  ToolTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    directions.count_tangent();
    move(trial);
    const bool to_be_held = at_rest && !presses();
    for (const auto &side : sides)
      for (const Sample &sample : side->samples)
        if (side->body.surface->owns(side->body.surface->mesh().facets[sample.facet][0]))
          add_sample(*side, sample, side->response(sample), to_be_held, tangent);
  }



  /** -A W^T (d traction / dD) M: M says how D follows the unknowns, W what forces do to them. */
  template <int dim>
  void
  ToolTerm<dim>::add_sample(const ToolSide<dim>        &side,
                            const Sample               &sample,
                            const ContactResponse<dim> &here,
                            const bool                  to_be_held,
                            Tangent<dim>               &tangent) const
  {
    using Vector = dealii::Tensor<1, dim>;
    struct Column
    {
      UnknownIndex unknown;
      Vector       motion, work;
    };
    const dealii::Tensor<2, dim> slope = to_be_held && here.gap_end < nearly_closed * cell_size
                                           ? stiffness_when_closed(side.law, sample.normal)
                                           : here.slope;
    if (slope == dealii::Tensor<2, dim>())
      return;
    const BodySurface<dim>        &surface = *side.body.surface;
    std::map<unsigned int, double> of_pressures; // where the law asks for them
    if (side.body.carries_water)
      side.for_vertices(sample, [&](const unsigned int v, const double weight) {
        surface.for_nodes_anywhere(v, [&](const unsigned int node, const double N) {
          of_pressures[node] += weight * N;
        });
      });
    std::vector<Column> columns;
    for (const MeanFunction &of : side.functions(sample))
      for (unsigned int d = 0; d < dim; ++d)
        {
          Vector motion;
          motion[d] = of.all;
          columns.push_back({{surface.field, of.node, d}, motion, motion});
        }
    const RigidPoint point = side.point(sample);
    rigid.for_unknowns(point,
                       [&](const UnknownIndex &unknown,
                           const Vector3      &motion,
                           const Vector3      &work) {
                         columns.push_back({unknown, -in_scene<dim>(motion), -in_scene<dim>(work)});
                       });
    for (const Column &row : columns)
      {
        const Vector by_motion = -sample.area * (row.work * slope);
        for (const Column &column : columns)
          tangent.add(row.unknown, column.unknown, by_motion * column.motion);
        if (here.traction_by_pore_pressure != Vector())
          for (const auto &[node, c] : of_pressures)
            tangent.add(row.unknown,
                        {surface.field, node, dim},
                        -sample.area * c * (row.work * here.traction_by_pore_pressure));
      }
    rigid.add_lever_slope(point, -sample.area * in_space<dim>(here.traction), tangent);
  }



  template <int dim>
  Answer
  ToolTerm<dim>::finish(const Trial<dim> &trial)
  {
    if (const std::string left = uzawa.failure(); !left.empty())
      return Answer::failure(name() + ": " + left);
    move(trial);
    released = 0.;
    places.clear();
    for (const auto &side : sides)
      if (const Answer answer = finish(*side, trial.times.dt); !answer.ok)
        return answer;
    return {};
  }



  template <int dim>
  Answer
  ToolTerm<dim>::too_deep(const ToolSide<dim> &side,
                          const Sample        &sample,
                          const double         overlap) const
  {
    std::ostringstream cause;
    cause << name() << ": body '" << side.body.surface->body_name
          << "' would come into the rigid body '" << rigid[tool].name << "' by " << overlap
          << " m at (" << sample.place << "), more than half a cell; stiffen the contact (Contact/"
          << parameters.name << "/Penalty factor) or refine the grid";
    return Answer::failure(cause.str());
  }



  template <int dim>
  Answer
  ToolTerm<dim>::finish(ToolSide<dim> &side, const double dt)
  {
    side.end_of_step.clear();
    double taken_up = 0., left = 0.;
    for (const Sample &sample : side.samples)
      {
        const ContactResponse<dim> end      = side.response(sample);
        const double               true_gap = side.true_gap(sample);
        const double               overlap  = -std::min(true_gap, end.gap_end);
        // what the step has not brought there, a shorter one does not keep out: it is let go
        const bool is_lost =
          overlap > largest_overlap * cell_size && -side.gap_at_start(sample) > 0.5 * overlap;
        if (overlap > largest_overlap * cell_size && !is_lost)
          return too_deep(side, sample, overlap);
        typename ToolSide<dim>::Closed before, after;
        before.gap        = sample.gap;
        before.multiplier = after.multiplier = sample.multiplier;
        before.slip                          = sample.slip;
        after.gap                            = end.gap_end;
        after.slip                           = end.slip_end;
        after.partner                        = sample.partner;
        after.normal                         = sample.normal;
        after.lead                           = side.lead_at_end(sample);
        taken_up += sample.area * side.stored(before);
        left += sample.area * side.stored(after);
        if (!is_lost &&
            (side.law.conserving ? end.gap_end < 0. || true_gap < 0. : end.pressure > 0.))
          side.end_of_step.emplace(sample.key, after);
        if (books.are_kept_here())
          places.push_back(place_of(side, sample, dt));
      }
    // committed less taken up by samples; and at the end what samples had less what is kept
    released += side.stored(side.memory) - taken_up + left;
    side.end_of_step = side.handed_on(std::move(side.end_of_step));
    released -= side.stored_after_step(side.end_of_step);
    return {};
  }



  template <int dim>
  ContactPlace<dim>
  ToolTerm<dim>::place_of(const ToolSide<dim> &side, const Sample &sample, const double dt) const
  {
    ContactPlace<dim> place;
    place.surface = side.body.surface;
    place.facet   = sample.facet;
    place.partner = ContactPicture<dim>::wall;
    place.at      = side.place_at_balance(sample);
    place.area    = sample.area;
    place.set_response(side.response(sample), sample.normal, side.displacement(sample), dt);
    return place;
  }



  template <int dim>
  void
  ToolTerm<dim>::declare_books(Ledger &ledger)
  {
    books.declare(ledger, parameters.name);
    penetration->declare(ledger, parameters.name);
  }



  template <int dim>
  void
  ToolTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    books.book(ledger,
               places,
               released,
               trial.times.dt,
               sides.front()->body.surface->patch.grid().levels().finest());
  }



  template <int dim>
  void
  ToolTerm<dim>::show(ContactPicture<dim> &picture) const
  {
    if (!books.are_kept_here())
      return;
    for (const auto &side : sides)
      picture.add_surface(*side->body.surface);
    picture.add(committed_places);
  }



  template <int dim>
  void
  ToolTerm<dim>::book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const
  {
    double                                sum = 0.;
    std::vector<const BodySurface<dim> *> surfaces;
    for (const auto &side : sides)
      {
        sum += side->stored(side->memory);
        if (surfaces.empty() || surfaces.back() != side->body.surface)
          surfaces.push_back(side->body.surface);
      }
    books.book_state(ledger, sum);
    penetration->book(ledger, surfaces, cloud);
  }



  template <int dim>
  void
  ToolTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    for (const auto &side : sides)
      side->memory = std::move(side->end_of_step);
    committed_places = on_facets_after_step(std::move(places));
  }



  template <int dim>
  void
  ToolTerm<dim>::save(SavedState &state) const
  {
    for (std::size_t k = 0; k < sides.size(); ++k)
      state[name() + " " + std::to_string(k)] = sides[k]->save();
  }



  template <int dim>
  void
  ToolTerm<dim>::restore(const SavedState &state)
  {
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k]->restore(state.at(name() + " " + std::to_string(k)), !at_rest);
  }

  template class ToolTerm<2>;
  template class ToolTerm<3>;
} // namespace kedge
