#include <kedge/base/exceptions.h>
#include <kedge/contact/contact_term.h>

#include <algorithm>
#include <sstream>

namespace kedge
{
  template <int dim>
  ContactTerm<dim>::ContactTerm(const ContactParameters               &parameters,
                                const std::vector<ContactBodies<dim>> &bodies,
                                const std::map<std::string, double>   &constants,
                                const Scheme                          &scheme,
                                const double                           cell_size)
    : parameters(parameters)
    , cell_size(cell_size)
    , alpha(scheme.contact_alpha())
    , at_rest(!scheme.dynamic)
    , shear_limit(parameters, constants)
    , books(bodies.front().first->patch.grid().communicator())
  {
    for (const ContactBodies<dim> &pair : bodies)
      {
        const ContactLaw law =
          contact_law_of(parameters, pair.normal_stiffness, pair.tangent_stiffness, scheme);
        const auto &first = moving(pair, 0), &second = moving(pair, 1);
        for (const bool swapped : {false, true})
          passes.emplace_back(swapped ? second : first,
                              swapped ? first : second,
                              law,
                              shear_limit,
                              0.5,
                              reach * cell_size,
                              largest_overlap * cell_size);
      }
    end_of_step.resize(passes.size());
  }



  template <int dim>
  MovingSurface<dim> &
  ContactTerm<dim>::moving(const ContactBodies<dim> &pair, const unsigned int which)
  {
    const BodySurface<dim> &surface = which == 0 ? *pair.first : *pair.second;
    for (auto &known : surfaces)
      if (&known->surface == &surface)
        return *known;
    surfaces.push_back(
      std::make_unique<MovingSurface<dim>>(surface, pair.carry_water[which], pair.clay[which]));
    return *surfaces.back();
  }



  template <int dim>
  void
  ContactTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &)
  {
    for (auto &surface : surfaces)
      surface->move({}, 0., 0.);
    for (auto &half : passes)
      {
        if (std::find(parameters.second.begin(),
                      parameters.second.end(),
                      half.sampled.surface.body_name) != parameters.second.end())
          shear_limit.count_from(half.sampled.surface);
      }
    for (auto &half : passes)
      {
        shear_limit.check(half.sampled.surface,
                          half.sampled.clay != nullptr || half.other.clay != nullptr);
        // what is deeper than the samples take must be seen as well
        const FacetSearch<dim> search(half.other.mesh, half.box_of_samples());
        for (unsigned int f = 0; f < half.sampled.mesh.facets.size(); ++f)
          {
            const auto         corners = half.sampled.mesh.corners(f);
            const auto         area    = area_vector<dim>(corners);
            dealii::Point<dim> x;
            for (const auto &corner : corners)
              x += corner / dim;
            typename FacetSearch<dim>::Partner partner;
            if (!search.find(x, area / area.norm(), 2. * cell_size, search.no_facet, partner) ||
                partner.gap >= -largest_overlap * cell_size)
              continue;
            std::ostringstream message;
            message << "Contact '" << parameters.name << "': bodies '"
                    << half.sampled.surface.body_name << "' and '" << half.other.surface.body_name
                    << "' overlap by " << -partner.gap << " m at (" << x
                    << "), which is more than half a cell. Move them apart (Bodies/"
                    << half.sampled.surface.body_name << "/Geometry).";
            throw UserError(message.str());
          }
      }
  }



  template <int dim>
  void
  ContactTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (!shear_limit.is_of_place())
      return;
    for (auto &surface : surfaces)
      if (surface->clay != nullptr)
        surface->strengths = undrained_strengths(surface->surface, *surface->clay);
  }



  template <int dim>
  void
  ContactTerm<dim>::start(Trial<dim> &trial)
  {
    directions.start();
    uzawa.start();
    for (auto &surface : surfaces)
      {
        surface->means.reset(surface->surface);
        if (at_rest)
          surface->move({}, 0., alpha);
        else
          surface->move(trial.motion[surface->surface.field].velocity_n, trial.times.dt, alpha);
      }
    for (auto &half : passes)
      half.find();
  }



  template <int dim>
  bool
  ContactTerm<dim>::touches() const
  {
    for (const auto &half : passes)
      if (!half.samples().empty())
        return true;
    return false;
  }



  template <int dim>
  bool
  ContactTerm<dim>::presses() const
  {
    for (const auto &half : passes)
      for (const auto &sample : half.samples())
        if (half.response(sample).pressure > 0.)
          return true;
    return false;
  }



  template <int dim>
  void
  ContactTerm<dim>::move_surfaces(const Trial<dim> &trial)
  {
    for (auto &surface : surfaces)
      surface->move(trial.displacement(surface->surface.field), 1., alpha);
    for (auto &half : passes)
      half.read_displacements();
    read_pore_pressures(trial);
  }



  template <int dim>
  void
  ContactTerm<dim>::read_pore_pressures(const Trial<dim> &trial)
  {
    for (auto &surface : surfaces)
      if (surface->carries_water)
        surface->surface.interpolate_pressure(trial.unknowns.fields[surface->surface.field],
                                              surface->pore_pressures);
  }



  /** What a force that slides owes to the pore water: @p by_pressure times its sample's area. */
  template <int dim>
  void
  ContactTerm<dim>::add_pressure_slope(const SurfaceSamples<dim>                     &half,
                                       const typename SurfaceSamples<dim>::Sample    &sample,
                                       const typename CouplingSum<dim>::Coefficients &forces,
                                       const dealii::Tensor<1, dim>                  &by_pressure,
                                       CouplingSum<dim>                              &sum) const
  {
    if (!half.has_water() || by_pressure == dealii::Tensor<1, dim>())
      return;
    typename CouplingSum<dim>::Coefficients pressures;
    half.for_pore_pressures(
      sample,
      [&](const MovingSurface<dim> &side, const unsigned int v, const double e) {
        side.surface.for_nodes_anywhere(v, [&](const unsigned int node, const double N) {
          pressures[{side.surface.field, node}] += e * N;
        });
      });
    sum.add_by_pressure(forces, pressures, -sample.area * by_pressure);
  }



  template <int dim>
  Answer
  ContactTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    if (!touches())
      return {};
    move_surfaces(trial);
    // at rest nothing is predicted, and bodies that are barely held must not be pushed about
    if (!at_rest && directions.follow())
      for (auto &half : passes)
        half.find_anew();
    for (const auto &half : passes)
      {
        const BodySurface<dim> &sampled = half.sampled.surface, &other = half.other.surface;
        for (const auto &sample : half.samples())
          {
            const dealii::Tensor<1, dim> force = sample.area * half.response(sample).traction;
            if (force == dealii::Tensor<1, dim>())
              continue;
            add_spread_force(sampled,
                             half.on_sampled(sample),
                             -force,
                             residual.partial(sampled.field));
            add_spread_force(other, sample.on_partner, force, residual.partial(other.field));
          }
      }
    return {};
  }



  template <int dim>
  void
  ContactTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    directions.count_tangent();
    if (!touches())
      return;
    move_surfaces(trial);
    CouplingSum<dim> sum;
    const bool       to_be_held = at_rest && !presses();
    for (const auto &half : passes)
      for (const auto &sample : half.samples())
        {
          if (!half.is_added_here(sample))
            continue;
          const ContactResponse<dim>   response = half.response(sample);
          const dealii::Tensor<2, dim> slope =
            to_be_held && response.gap_end < nearly_closed * cell_size
              ? stiffness_when_closed(half.law, sample.partner.normal)
              : response.slope;
          if (slope == dealii::Tensor<2, dim>())
            continue;
          typename CouplingSum<dim>::Coefficients coefficients;
          for (const MeanFunction &of : half.on_sampled(sample))
            coefficients[{half.sampled.surface.field, of.node}] += of.all;
          for (const MeanFunction &of : sample.on_partner)
            coefficients[{half.other.surface.field, of.node}] -= of.all;
          sum.add(coefficients, -sample.area * slope);
          add_pressure_slope(half, sample, coefficients, response.traction_by_pore_pressure, sum);
        }
    sum.add_to(tangent);
  }



  template <int dim>
  Answer
  ContactTerm<dim>::finish(const Trial<dim> &trial)
  {
    if (const std::string left = uzawa.failure(); !left.empty())
      return Answer::failure(name() + ": " + left);
    move_surfaces(trial);
    released = 0.;
    for (std::size_t k = 0; k < passes.size(); ++k)
      {
        const auto &half = passes[k];
        for (const auto &sample : half.samples())
          {
            const auto   end     = half.outcome(sample);
            const double overlap = -std::min(end.true_gap, end.response.gap_end);
            if (overlap <= largest_overlap * cell_size)
              continue;
            std::ostringstream cause;
            cause << name() << ": bodies '" << half.sampled.surface.body_name << "' and '"
                  << half.other.surface.body_name << "' would overlap by " << overlap << " m at ("
                  << half.place(sample) << "), more than half a cell; stiffen the contact ("
                  << "Contact/" << parameters.name << "/Penalty factor) or refine the grid";
            return Answer::failure(cause.str());
          }
        double stored  = 0.;
        end_of_step[k] = half.handed_on(half.memory_of_step(stored));
        // committed less taken up by samples; and at the end what samples had less what is kept
        released += half.stored() - half.stored_at_start() + stored;
        released -= half.stored_after_step(end_of_step[k]);
      }
    places = places_of_step(trial.times.dt);
    return {};
  }



  template <int dim>
  void
  ContactTerm<dim>::declare_books(Ledger &ledger)
  {
    books.declare(ledger, parameters.name);
  }



  template <int dim>
  std::vector<ContactPlace<dim>>
  ContactTerm<dim>::places_of_step(const double dt) const
  {
    std::vector<ContactPlace<dim>> result;
    if (!books.are_kept_here())
      return result;
    for (std::size_t k = 0; k < passes.size(); ++k)
      for (const auto &sample : passes[k].samples())
        {
          const SurfaceSamples<dim> &half = passes[k];
          ContactPlace<dim>          place;
          place.surface  = &half.sampled.surface;
          place.facet    = sample.facet;
          place.partner  = static_cast<int>(half.other.surface.body);
          place.on_first = k % 2 == 0;
          // the force on the first body acts where that one is
          place.at =
            place.on_first ? half.place_at_balance(sample) : half.partner_at_balance(sample);
          place.area = sample.area;
          place.set_response(half.response(sample), sample.partner.normal, sample.D, dt);
          result.push_back(place);
        }
    return result;
  }



  template <int dim>
  void
  ContactTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    books.book(ledger,
               places,
               released,
               trial.times.dt,
               surfaces.front()->surface.patch.grid().levels().finest());
  }



  template <int dim>
  void
  ContactTerm<dim>::show(ContactPicture<dim> &picture) const
  {
    if (!books.are_kept_here())
      return;
    for (const auto &surface : surfaces)
      picture.add_surface(surface->surface);
    picture.add(committed_places);
  }



  template <int dim>
  void
  ContactTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    double stored = 0.;
    for (const auto &half : passes)
      stored += half.stored();
    books.book_state(ledger, stored);
  }



  template <int dim>
  void
  ContactTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    for (std::size_t k = 0; k < passes.size(); ++k)
      passes[k].commit(std::move(end_of_step[k]));
    committed_places = on_facets_after_step(std::move(places));
  }



  template <int dim>
  void
  ContactTerm<dim>::save(SavedState &state) const
  {
    state[name() + " top"] = {shear_limit.top};
    for (std::size_t k = 0; k < passes.size(); ++k)
      state[name() + " " + std::to_string(k)] = passes[k].save();
  }



  template <int dim>
  void
  ContactTerm<dim>::restore(const SavedState &state)
  {
    shear_limit.top = state.at(name() + " top").front();
    for (std::size_t k = 0; k < passes.size(); ++k)
      passes[k].restore(state.at(name() + " " + std::to_string(k)), !at_rest);
  }

  template class ContactTerm<2>;
  template class ContactTerm<3>;
} // namespace kedge
