#include <kedge/base/exceptions.h>
#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/coupling_sum.h>
#include <kedge/contact/wall_term.h>
#include <kedge/equations/external_work.h>

#include <cmath>
#include <sstream>

namespace kedge
{
  template <int dim>
  WallTerm<dim>::WallTerm(const ContactParameters             &parameters,
                          const WallPlane<dim>                &plane,
                          const WallMotion<dim>               &motion,
                          const std::vector<WallBody<dim>>    &bodies,
                          const std::map<std::string, double> &constants,
                          const Scheme                        &scheme,
                          const double                         cell_size)
    : parameters(parameters)
    , plane_at_rest(plane)
    , motion(motion)
    , plane(plane)
    , cell_size(cell_size)
    , alpha(scheme.contact_alpha())
    , at_rest(!scheme.dynamic)
    , shear_limit(parameters, constants)
    , books(bodies.front().surface->patch.grid().communicator())
  {
    for (const WallBody<dim> &body : bodies)
      {
        Side side;
        side.surface       = body.surface;
        side.carries_water = body.carries_water;
        side.clay          = body.clay;
        side.law =
          contact_law_of(parameters, body.normal_stiffness, body.tangent_stiffness, scheme);
        sides.push_back(side);
      }
  }



  template <int dim>
  dealii::Point<dim>
  WallTerm<dim>::middle(const Side &side, const unsigned int facet) const
  {
    dealii::Point<dim> x;
    for (const auto &corner : side.surface->mesh().corners(facet))
      x += corner / dim;
    return x;
  }



  template <int dim>
  void
  WallTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &)
  {
    plane = plane_at(0.);
    if (!std::isfinite(plane.point.norm()))
      throw UserError("Contact/" + parameters.name +
                      "/Wall displacement has no finite value at the start.");
    for (const Side &side : sides)
      shear_limit.count_from(*side.surface);
    for (const Side &side : sides)
      shear_limit.check(*side.surface, side.clay != nullptr);
    for (const Side &side : sides)
      for (unsigned int f = 0; f < side.surface->n_facets(); ++f)
        {
          const double gap = plane.gap(middle(side, f));
          if (gap >= -largest_overlap * cell_size)
            continue;
          std::ostringstream message;
          message << "Contact '" << parameters.name << "': body '" << side.surface->body_name
                  << "' reaches " << -gap << " m behind the wall at (" << middle(side, f)
                  << "), which is more than half a cell. Move it (Bodies/"
                  << side.surface->body_name << "/Geometry) or the wall (Contact/"
                  << parameters.name << "/Wall).";
          throw UserError(message.str());
        }
  }



  /** The samples of a step: facets near the wall that look towards it. */
  template <int dim>
  void
  WallTerm<dim>::find(Side &side) const
  {
    side.samples.clear();
    for (unsigned int f = 0; f < side.surface->n_facets(); ++f)
      {
        const dealii::Point<dim> x   = middle(side, f);
        const double             gap = plane.gap(x);
        if (gap > reach * cell_size || side.surface->mesh().has_left(f))
          continue;
        const auto outward = area_vector<dim>(side.surface->mesh().corners(f));
        if (plane.normal * outward > -towards * outward.norm())
          continue;
        Sample     sample{f, x, {}, side.surface->reference_area(f)};
        const auto known = side.memory.find(f);
        if (known != side.memory.end())
          sample.start = known->second;
        // one that is first seen inside begins as if it touched
        if (!side.law.conserving)
          sample.start.gap = gap;
        else if (known == side.memory.end())
          sample.start.gap = std::max(gap, 0.);
        double strength = std::numeric_limits<double>::quiet_NaN();
        if (!side.strengths.empty())
          {
            strength = 0.;
            for (const unsigned int v : side.surface->mesh().facets[f])
              strength += side.strengths[v] / dim;
          }
        sample.stretch     = side.surface->stretch(f);
        sample.shear_limit = sample.stretch * shear_limit(x, strength);
        side.samples.push_back(sample);
      }
  }



  template <int dim>
  void
  WallTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (!shear_limit.is_of_place())
      return;
    for (Side &side : sides)
      if (side.clay != nullptr)
        side.strengths = undrained_strengths(*side.surface, *side.clay);
  }



  template <int dim>
  void
  WallTerm<dim>::start(Trial<dim> &trial)
  {
    const double t_n = trial.times.t_n;
    plane            = plane_at(t_n);
    moves_by         = motion.displacement(t_n + trial.times.dt) - motion.displacement(t_n);
    uzawa.start();
    for (Side &side : sides)
      {
        side.means.reset(*side.surface);
        find(side);
      }
  }



  template <int dim>
  void
  WallTerm<dim>::move(const Trial<dim> &trial)
  {
    for (Side &side : sides)
      if (!side.samples.empty())
        {
          std::vector<dealii::Tensor<1, dim>> of_samples;
          for (const Sample &sample : side.samples)
            of_samples.push_back(own_part_of_mean<dim>(side.means.of(sample.facet),
                                                       trial.displacement(side.surface->field)));
          sum_over_ranks<dim>(side.surface->patch, of_samples);
          for (std::size_t n = 0; n < of_samples.size(); ++n)
            side.samples[n].D = of_samples[n];
          if (side.carries_water)
            side.surface->interpolate_pressure(trial.unknowns.fields[side.surface->field],
                                               side.pore_pressures);
        }
  }



  template <int dim>
  ContactResponse<dim>
  WallTerm<dim>::response(const Side &side, const Sample &sample) const
  {
    double pore_pressure = 0.;
    if (!side.pore_pressures.empty())
      for (const unsigned int v : side.surface->mesh().facets[sample.facet])
        pore_pressure += side.pore_pressures[v] / dim;
    ContactLaw law  = side.law;
    law.shear_limit = sample.shear_limit;
    law.adhesion *= sample.stretch;
    return contact_response(law,
                            plane.normal,
                            plane.normal,
                            sample.start.gap,
                            sample.start.slip,
                            sample.start.multiplier,
                            sample.D - moves_by,
                            pore_pressure);
  }



  template <int dim>
  bool
  WallTerm<dim>::presses() const
  {
    for (const Side &side : sides)
      for (const Sample &sample : side.samples)
        if (response(side, sample).pressure > 0.)
          return true;
    return false;
  }



  template <int dim>
  Answer
  WallTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    if (!std::isfinite(moves_by.norm()) || !std::isfinite(plane.point.norm()))
      return Answer::failure("Contact/" + parameters.name +
                             "/Wall displacement has no finite value at t = " +
                             std::to_string(trial.times.t_n) + " s or at the end of the step");
    move(trial);
    for (const Side &side : sides)
      for (const Sample &sample : side.samples)
        {
          const dealii::Tensor<1, dim> force = sample.area * response(side, sample).traction;
          if (force != dealii::Tensor<1, dim>())
            add_spread_force(*side.surface,
                             side.means.of(sample.facet),
                             -force,
                             residual.partial(side.surface->field));
        }
    return {};
  }



  /** The pore pressure at a sample is the sum of these times those of the nodes. */
  template <int dim>
  typename CouplingSum<dim>::Coefficients
  WallTerm<dim>::pressure_functions(const Side &side, const Sample &sample) const
  {
    typename CouplingSum<dim>::Coefficients result;
    for (const unsigned int v : side.surface->mesh().facets[sample.facet])
      side.surface->for_nodes_anywhere(v, [&](const unsigned int node, const double N) {
        result[{side.surface->field, node}] += N / dim;
      });
    return result;
  }



  template <int dim>
  void
  WallTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    move(trial);
    CouplingSum<dim> sum;
    const bool       to_be_held = at_rest && !presses();
    for (const Side &side : sides)
      for (const Sample &sample : side.samples)
        {
          if (!side.surface->owns(side.surface->mesh().facets[sample.facet][0]))
            continue; // another rank adds it
          const ContactResponse<dim>   here = response(side, sample);
          const dealii::Tensor<2, dim> slope =
            to_be_held && here.gap_end < nearly_closed * cell_size
              ? stiffness_when_closed(side.law, plane.normal)
              : here.slope;
          if (slope == dealii::Tensor<2, dim>())
            continue;
          typename CouplingSum<dim>::Coefficients coefficients;
          for (const MeanFunction &of : side.means.of(sample.facet))
            coefficients[{side.surface->field, of.node}] = of.all;
          sum.add(coefficients, -sample.area * slope);
          if (side.carries_water && here.traction_by_pore_pressure != dealii::Tensor<1, dim>())
            sum.add_by_pressure(coefficients,
                                pressure_functions(side, sample),
                                -sample.area * here.traction_by_pore_pressure);
        }
    sum.add_to(tangent);
  }



  template <int dim>
  Answer
  WallTerm<dim>::finish(const Trial<dim> &trial)
  {
    if (const std::string left = uzawa.failure(); !left.empty())
      return Answer::failure(name() + ": " + left);
    move(trial);
    released = 0.;
    places.clear();
    for (Side &side : sides)
      {
        side.end_of_step.clear();
        double taken_up = 0., left = 0.;
        for (const Sample &sample : side.samples)
          {
            const ContactResponse<dim> end      = response(side, sample);
            const double               true_gap = plane.gap(sample.place + sample.D - moves_by);
            const double               overlap  = -std::min(true_gap, end.gap_end);
            if (overlap > largest_overlap * cell_size)
              {
                std::ostringstream cause;
                cause << name() << ": body '" << side.surface->body_name
                      << "' would come behind the wall by " << overlap << " m at (" << sample.place
                      << "), more than half a cell; stiffen the contact (Contact/"
                      << parameters.name << "/Penalty factor) or refine the grid";
                if (moves_by != dealii::Tensor<1, dim>())
                  cause << "; the wall itself moves by " << moves_by.norm() << " m in the step";
                return Answer::failure(cause.str());
              }
            const Closed after{end.gap_end, sample.start.multiplier, end.slip_end};
            taken_up += sample.area * stored(side.law, sample.start);
            left += sample.area * stored(side.law, after);
            if (side.law.conserving ? end.gap_end < 0. || true_gap < 0. : end.pressure > 0.)
              side.end_of_step[sample.facet] = after;
            if (books.are_kept_here())
              places.push_back(place_of(side, sample, trial.times.dt));
          }
        // committed less taken up by samples; and at the end what samples had less what is kept
        released += stored(side, side.memory) - taken_up + left;
        if (!side.surface->heritage().empty())
          side.end_of_step =
            side.surface->heritage().hand_on(side.end_of_step, [](const auto &parts) {
              return mean_of_parts<dim>(parts);
            });
        released -= stored_after_step<dim>(side.law, *side.surface, side.end_of_step);
      }
    return {};
  }



  template <int dim>
  ContactPlace<dim>
  WallTerm<dim>::place_of(const Side &side, const Sample &sample, const double dt) const
  {
    ContactPlace<dim> place;
    place.surface = side.surface;
    place.facet   = sample.facet;
    place.partner = ContactPicture<dim>::wall;
    place.at      = sample.place + alpha * sample.D;
    place.area    = sample.area;
    place.set_response(response(side, sample), plane.normal, sample.D - moves_by, dt);
    return place;
  }



  template <int dim>
  void
  WallTerm<dim>::declare_books(Ledger &ledger)
  {
    books.declare(ledger, parameters.name);
    if (motion.moves())
      work = ledger.declare(external_work);
  }



  template <int dim>
  void
  WallTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    books.book(ledger,
               places,
               released,
               trial.times.dt,
               sides.front().surface->patch.grid().levels().finest());
    if (!motion.moves())
      return;
    dealii::Tensor<1, dim> force;
    for (const ContactPlace<dim> &place : places)
      force += place.force;
    ledger.book(work, force * moves_by);
  }



  template <int dim>
  void
  WallTerm<dim>::show(ContactPicture<dim> &picture) const
  {
    if (!books.are_kept_here())
      return;
    for (const Side &side : sides)
      picture.add_surface(*side.surface);
    picture.add(committed_places);
  }



  template <int dim>
  void
  WallTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    double sum = 0.;
    for (const Side &side : sides)
      sum += stored(side, side.memory);
    books.book_state(ledger, sum);
  }



  template <int dim>
  void
  WallTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    for (Side &side : sides)
      side.memory = std::move(side.end_of_step);
    committed_places = on_facets_after_step(std::move(places));
  }



  template <int dim>
  double
  WallTerm<dim>::stored(const ContactLaw &law, const Closed &closed)
  {
    return stored_in_contact(law, closed.gap, closed.multiplier, closed.slip);
  }



  template <int dim>
  double
  WallTerm<dim>::stored(const Side &side, const Memory &memory)
  {
    return stored_by_facets(side.law, memory, [&](const unsigned int facet) {
      return side.surface->reference_area(facet);
    });
  }



  template <int dim>
  void
  WallTerm<dim>::save(SavedState &state) const
  {
    state[name() + " top"] = {shear_limit.top};
    for (std::size_t k = 0; k < sides.size(); ++k)
      {
        auto &values = state[name() + " " + std::to_string(k)];
        values       = {double(width_of_record)};
        for (const auto &[facet, closed] : sides[k].memory)
          {
            values.insert(values.end(), {double(facet), closed.gap, closed.multiplier});
            values.insert(values.end(), closed.slip.begin_raw(), closed.slip.end_raw());
          }
      }
  }



  template <int dim>
  void
  WallTerm<dim>::restore(const SavedState &state)
  {
    shear_limit.top = state.at(name() + " top").front();
    for (std::size_t k = 0; k < sides.size(); ++k)
      {
        Side       &side   = sides[k];
        const auto &values = state.at(name() + " " + std::to_string(k));
        side.memory.clear();
        for (auto next = first_record(values, width_of_record); next != values.end();
             next += width_of_record)
          {
            Closed closed{next[1], next[2], {}};
            for (int d = 0; d < dim; ++d)
              closed.slip[d] = next[3 + d];
            if (!at_rest) // multipliers of a state of rest become gaps that press as hard
              {
                closed.gap -= closed.multiplier / side.law.normal_stiffness;
                closed.multiplier = 0.;
              }
            side.memory[static_cast<unsigned int>(next[0])] = closed;
          }
      }
  }

  template class WallTerm<2>;
  template class WallTerm<3>;
} // namespace kedge
