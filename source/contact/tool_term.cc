#include <kedge/base/exceptions.h>
#include <kedge/contact/cell_multipliers.h>
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
    search      = std::make_unique<FacetSearch<dim>>(mesh, box_of(mesh));
    penetration = std::make_unique<ToolPenetration<dim>>(rigid, tool, *search, cell_size);
    for (const WallBody<dim> &body : touching)
      sides.emplace_back(
        body,
        contact_law_of(parameters, body.normal_stiffness, body.tangent_stiffness, scheme),
        rigid,
        tool,
        *search,
        shear_limit,
        reach * cell_size,
        largest_overlap * cell_size);
  }



  template <int dim>
  void
  ToolTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &)
  {
    for (ToolSamples<dim> &side : sides)
      {
        shear_limit.count_from(*side.body.surface);
        side.move({});
        const auto [overlap, place] = side.deepest();
        if (overlap <= largest_overlap * cell_size)
          continue;
        std::ostringstream message;
        message << "Contact '" << parameters.name << "': body '" << side.body.surface->body_name
                << "' reaches " << overlap << " m into the rigid body '" << rigid[tool].name
                << "' at (" << place << "), which is more than half a cell. Move it (Bodies/"
                << side.body.surface->body_name << "/Geometry) or the other (Rigid bodies/"
                << rigid[tool].name << "/Geometry).";
        throw UserError(message.str());
      }
    for (const ToolSamples<dim> &side : sides)
      shear_limit.check(*side.body.surface, side.body.clay != nullptr);
  }



  template <int dim>
  void
  ToolTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (shear_limit.is_of_place())
      for (ToolSamples<dim> &side : sides)
        side.read_strengths();
  }



  template <int dim>
  void
  ToolTerm<dim>::start(Trial<dim> &trial)
  {
    n_passes = n_updates = n_tangents = n_follows = 0;
    for (ToolSamples<dim> &side : sides)
      {
        side.begin_step();
        std::vector<double> predicted;
        if (!at_rest)
          predicted = trial.motion[side.body.surface->field].velocity_n;
        for (double &u : predicted)
          u *= trial.times.dt;
        side.move(predicted);
        side.find();
      }
  }



  template <int dim>
  void
  ToolTerm<dim>::move(const Trial<dim> &trial)
  {
    for (ToolSamples<dim> &side : sides)
      {
        side.move(trial.displacement(side.body.surface->field));
        side.read_pore_pressures(trial.unknowns.fields[side.body.surface->field]);
      }
  }



  template <int dim>
  bool
  ToolTerm<dim>::presses() const
  {
    for (const ToolSamples<dim> &side : sides)
      for (const Sample &sample : side.samples)
        if (side.response(sample).pressure > 0.)
          return true;
    return false;
  }



  template <int dim>
  Answer
  ToolTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    move(trial);
    // at rest nothing is predicted, and bodies that are barely held must not be pushed about
    if (!at_rest && n_follows < std::min(n_tangents, most_follows))
      {
        n_follows = n_tangents;
        for (ToolSamples<dim> &side : sides)
          side.find_anew();
      }
    for (const ToolSamples<dim> &side : sides)
      for (const Sample &sample : side.samples)
        {
          const dealii::Tensor<1, dim> force = sample.area * side.response(sample).traction;
          if (force == dealii::Tensor<1, dim>())
            continue;
          const BodySurface<dim> &surface = *side.body.surface;
          add_spread_force(surface,
                           side.functions(sample),
                           -force,
                           residual.partial(surface.field));
          rigid.add_force(side.point(sample), -in_space<dim>(force), residual.others());
        }
    return {};
  }



  template <int dim>
  void
  ToolTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    ++n_tangents;
    move(trial);
    const bool to_be_held = at_rest && !presses();
    for (const ToolSamples<dim> &side : sides)
      for (const Sample &sample : side.samples)
        if (side.body.surface->owns(side.body.surface->mesh().facets[sample.facet][0]))
          add_sample(side, sample, side.response(sample), to_be_held, tangent);
  }



  /** -A W^T (d traction / dD) M: M says how D follows the unknowns, W what forces do to them. */
  template <int dim>
  void
  ToolTerm<dim>::add_sample(const ToolSamples<dim>     &side,
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
    std::map<unsigned int, double> of_pressures; // where the law asks for them: at the middle
    if (side.body.carries_water)
      for (const unsigned int v : surface.mesh().facets[sample.facet])
        surface.for_nodes_anywhere(v, [&](const unsigned int node, const double N) {
          of_pressures[node] += N / dim;
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
  std::vector<std::vector<dealii::Tensor<1, dim>>>
  ToolTerm<dim>::forces() const
  {
    std::vector<std::vector<dealii::Tensor<1, dim>>> result;
    for (const ToolSamples<dim> &side : sides)
      {
        result.emplace_back(side.body.surface->n_facets());
        for (const Sample &sample : side.samples)
          result.back()[sample.facet] = sample.area * side.response(sample).traction;
      }
    return result;
  }



  /** Finds the samples anew; keeps those before if the forces are nearly the same. */
  template <int dim>
  bool
  ToolTerm<dim>::directions_have_changed()
  {
    const auto                       before = forces();
    std::vector<std::vector<Sample>> samples;
    for (ToolSamples<dim> &side : sides)
      {
        samples.push_back(side.samples);
        side.find_anew();
      }
    const auto after = forces();
    double     size = 0., change = 0.;
    for (std::size_t k = 0; k < before.size(); ++k)
      for (std::size_t f = 0; f < before[k].size(); ++f)
        {
          size += std::max(before[k][f].norm(), after[k][f].norm());
          change += (after[k][f] - before[k][f]).norm();
        }
    if (change > small_change * size)
      return true;
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k].samples.swap(samples[k]);
    return false;
  }



  /** Uzawa's step at rest; false if no cell has a large gap and nothing that sticks creeps. */
  template <int dim>
  bool
  ToolTerm<dim>::update_multipliers()
  {
    if (n_updates == most_updates)
      return false;
    const Lattice<dim> &lattice = sides.front().body.surface->patch.grid().lattice();
    if (!kedge::update_multipliers<dim>(sides,
                                        lattice,
                                        smallest_gap * cell_size,
                                        [](ToolSamples<dim> &side, CellMultipliers<dim> &cells) {
                                          for (Sample &sample : side.samples)
                                            cells.add(side.place_at_balance(sample),
                                                      sample.area,
                                                      side.law,
                                                      sample.multiplier,
                                                      sample.slip,
                                                      side.response(sample));
                                        }))
      return false;
    ++n_updates;
    return true;
  }



  template <int dim>
  bool
  ToolTerm<dim>::refresh(const Trial<dim> &trial)
  {
    move(trial);
    bool again = false;
    if (n_passes < most_passes && directions_have_changed())
      {
        ++n_passes;
        again = true;
      }
    if (at_rest)
      again = update_multipliers() || again;
    return again;
  }



  template <int dim>
  Answer
  ToolTerm<dim>::finish(const Trial<dim> &trial)
  {
    move(trial);
    released = 0.;
    places.clear();
    for (ToolSamples<dim> &side : sides)
      if (const Answer answer = finish(side, trial.times.dt); !answer.ok)
        return answer;
    return {};
  }



  template <int dim>
  Answer
  ToolTerm<dim>::finish(ToolSamples<dim> &side, const double dt)
  {
    side.end_of_step.clear();
    double taken_up = 0., left = 0.;
    for (const Sample &sample : side.samples)
      {
        const ContactResponse<dim> end      = side.response(sample);
        const double               true_gap = side.true_gap(sample);
        const double               overlap  = -std::min(true_gap, end.gap_end);
        if (overlap > largest_overlap * cell_size)
          {
            std::ostringstream cause;
            cause << name() << ": body '" << side.body.surface->body_name
                  << "' would come into the rigid body '" << rigid[tool].name << "' by " << overlap
                  << " m at (" << sample.place
                  << "), more than half a cell; stiffen the contact (Contact/" << parameters.name
                  << "/Penalty factor) or refine the grid";
            return Answer::failure(cause.str());
          }
        typename ToolSamples<dim>::Closed before, after;
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
        if (side.law.conserving ? end.gap_end < 0. || true_gap < 0. : end.pressure > 0.)
          side.end_of_step.emplace(sample.facet, after);
        if (books.are_kept_here())
          places.push_back(place_of(side, sample, dt));
      }
    // committed less taken up by samples; and at the end what samples had less what is kept
    released += side.stored(side.memory) - taken_up + left;
    side.end_of_step = side.handed_on(std::move(side.end_of_step));
    released -= stored_after_step<dim>(side.law, *side.body.surface, side.end_of_step);
    return {};
  }



  template <int dim>
  ContactPlace<dim>
  ToolTerm<dim>::place_of(const ToolSamples<dim> &side, const Sample &sample, const double dt) const
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
               sides.front().body.surface->patch.grid().lattice());
  }



  template <int dim>
  void
  ToolTerm<dim>::show(ContactPicture<dim> &picture) const
  {
    if (!books.are_kept_here())
      return;
    for (const ToolSamples<dim> &side : sides)
      picture.add_surface(*side.body.surface);
    picture.add(committed_places);
  }



  template <int dim>
  void
  ToolTerm<dim>::book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const
  {
    double                                sum = 0.;
    std::vector<const BodySurface<dim> *> surfaces;
    for (const ToolSamples<dim> &side : sides)
      {
        sum += side.stored(side.memory);
        surfaces.push_back(side.body.surface);
      }
    books.book_state(ledger, sum);
    penetration->book(ledger, surfaces, cloud);
  }



  template <int dim>
  void
  ToolTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    for (ToolSamples<dim> &side : sides)
      side.memory = std::move(side.end_of_step);
    committed_places = on_facets_after_step(std::move(places));
  }



  template <int dim>
  void
  ToolTerm<dim>::save(SavedState &state) const
  {
    for (std::size_t k = 0; k < sides.size(); ++k)
      state[name() + " " + std::to_string(k)] = sides[k].save();
  }



  template <int dim>
  void
  ToolTerm<dim>::restore(const SavedState &state)
  {
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k].restore(state.at(name() + " " + std::to_string(k)), !at_rest);
  }

  template class ToolTerm<2>;
  template class ToolTerm<3>;
} // namespace kedge
