#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/points/held_material.h>
#include <kedge/simulation/attachments.h>
#include <kedge/simulation/support_watch.h>

#include <cmath>
#include <iomanip>

namespace kedge
{
  namespace
  {
    constexpr std::size_t most_lines = 20; ///< for each kind of entry

    const std::string &
    side_name(const unsigned int side)
    {
      static const std::array<std::string, 6> names = {
        {"left, -x", "right, +x", "bottom, -y", "top, +y", "back, -z", "front, +z"}};
      return names[side];
    }

    /** "Node conditions/base (bottom, -y)" */
    template <int dim>
    std::string
    title(const NodeConditionParameters<dim> &condition)
    {
      return "Node conditions/" + condition.name +
             (condition.on_side ? " (" + side_name(condition.side) + ")" : "");
    }

    template <int dim>
    void
    describe_conditions(const Model<dim> &model, std::ostream &out)
    {
      const auto &conditions = model.scene.node_conditions;
      const auto  n_held     = count_held_nodes(conditions,
                                           model.scene.constants,
                                           model.points.grid().levels(),
                                           model.generated_points());
      bool        any        = false;
      std::string idle;
      for (std::size_t i = 0; i < conditions.size(); ++i)
        {
          any = any || n_held[i] > 0;
          if (n_held[i] == 0)
            idle += (idle.empty() ? "" : ", ") + title(conditions[i]);
          if (i < most_lines)
            out << "  " << title(conditions[i]) << ": "
                << (n_held[i] == 0 ? "no node of a cell with material points at the start"
                                   : std::to_string(n_held[i]) + " nodes")
                << "\n";
        }
      if (conditions.size() > most_lines)
        out << "  and " << conditions.size() - most_lines << " more node conditions\n";
      if (!any && !conditions.empty() && model.scene.body_conditions.empty() &&
          !model.scheme.dynamic)
        throw UserError("No node condition holds a node of a cell with material points (" + idle +
                        "), and without inertia nothing else keeps the bodies from moving." +
                        (dim == 3 ? " In 3D bottom and top are the sides -y and +y, back and front "
                                    "are -z and +z."
                                  : ""));
    }

    /** Whether a side of a body is not along the axes: a condition acts on facets there. */
    template <int dim>
    bool
    is_on_facets(const Model<dim> &model, const SurfaceParameters &surface)
    {
      for (const auto &point : model.generated_points())
        if (model.bodies.names[point.body] == surface.body && model.scene.bodies[point.body].clip &&
            ((point.exposed_sides >> surface.side) & 1u) != 0 &&
            lies_off_the_surface(point, surface.side, *model.scene.bodies[point.body].geometry))
          return true;
      return false;
    }

    /** How many faces each body condition holds, where the middles of the faces are, and their
     * size. */
    template <int dim>
    void
    describe_body_conditions(const Model<dim> &model, std::ostream &out)
    {
      for (const auto &condition : model.scene.body_conditions)
        {
          const std::string what =
            "  Body conditions/" + condition.name + " ('" + condition.body + "', ";
          if (condition.side >= 2 * dim)
            {
              out << what << "all sides): facets of the body's surface\n";
              continue;
            }
          if (condition.section)
            {
              out << what << "section "
                  << "xyz"[condition.side / 2] << " = " << *condition.section << " m)\n";
              continue;
            }
          if (is_on_facets(model, condition))
            {
              out << what << side_name(condition.side) << "): facets of the body's surface\n";
              continue;
            }
          const Expression where(condition.where.empty() ? "1" : condition.where,
                                 {"x", "y", "z", "nx", "ny", "nz"},
                                 model.scene.constants);
          const auto   direction = static_cast<int>(condition.side / 2);
          const double sign      = condition.side % 2 == 0 ? -1. : 1.;
          unsigned int n         = 0;
          double       area      = 0.;
          for (const auto &point : model.generated_points())
            {
              if (model.bodies.names[point.body] != condition.body ||
                  ((point.exposed_sides >> condition.side) & 1u) == 0)
                continue;
              double values[6] = {0., 0., 0., 0., 0., 0.}, size = 1.;
              for (int d = 0; d < dim; ++d)
                {
                  values[d] = point.location[d];
                  size *= d == direction ? 1. : 2. * point.half_lengths[d];
                }
              values[direction] += sign * point.half_lengths[direction];
              values[3 + direction] = sign;
              if (where(values) == 0.)
                continue;
              ++n;
              area += size;
            }
          out << what << side_name(condition.side) << "): " << n << " faces of material points, "
              << area << (dim == 2 ? " m long\n" : " m^2\n");
        }
    }

    /** How far a condition moves what it holds from the start to the end of the run [m]. */
    template <int dim>
    dealii::Tensor<1, dim>
    travel_of(const NodeConditionParameters<dim>  &condition,
              const std::map<std::string, double> &constants,
              const double                         start,
              const double                         end)
    {
      constexpr int          n_samples = 1000; // of velocities: midpoint rule
      dealii::Tensor<1, dim> travel;
      for (int d = 0; d < dim; ++d)
        {
          const ComponentCondition &component = condition.components[d];
          if (component.kind != ConditionKind::displacement &&
              component.kind != ConditionKind::velocity)
            continue;
          const Expression motion(component.expression, {"t"}, constants);
          if (component.kind == ConditionKind::displacement)
            travel[d] = motion({end}) - motion({start});
          else
            for (int i = 0; i < n_samples; ++i)
              travel[d] +=
                motion({start + (i + 0.5) / n_samples * (end - start)}) * (end - start) / n_samples;
        }
      return travel;
    }

    /** Notes conditions that leave what they hold behind, or that end where no node is. */
    template <int dim>
    void
    describe_regions(const Model<dim> &model, std::ostream &out)
    {
      const Lattice<dim> &lattice = model.points.grid().levels().finest();
      const auto          nodes =
        nodes_of_cells_with_points<dim>(model.points.grid().levels(), model.generated_points());
      for (const auto &condition : model.scene.node_conditions)
        {
          const NodeRegion<dim> region(condition, model.scene.constants);
          if (region.follows_time())
            continue;
          const auto   travel = travel_of(condition,
                                        model.scene.constants,
                                        model.scene.time.start,
                                        model.scene.time.end);
          const double cells  = travel.norm() / lattice.smallest_cell_size();
          if (cells > 1. && part_carried_away<dim>(region, lattice, nodes, travel) > 0.5)
            out << "  note: " << title(condition) << " moves what it holds by " << cells
                << " cells, but its nodes stay where they are and hold whatever comes there next; "
                << entries_that_follow(condition) << "\n";
          if (const double beyond = reach_beyond_nodes<dim>(region, lattice, nodes); beyond > 0.)
            out << "  note: " << title(condition) << ": Where ends between nodes, up to "
                << std::setprecision(3) << beyond << std::setprecision(6)
                << " of a cell beyond those that it holds; it acts as if it ended at them. "
                << entries_that_follow(condition) << "\n";
        }
    }

    /** The point of a body (of any, if there is no name) that is nearest to a place. */
    template <int dim>
    const PointOrigin<dim> *
    nearest_point(const Model<dim> &model, const std::string &body, const dealii::Point<dim> &place)
    {
      const PointOrigin<dim> *nearest  = nullptr;
      double                  smallest = std::numeric_limits<double>::max();
      for (const auto &point : model.generated_points())
        if (body.empty() || model.bodies.names[point.body] == body)
          if (const double distance = point.location.distance_square(place); distance < smallest)
            {
              smallest = distance;
              nearest  = &point;
            }
      return nearest;
    }

    template <int dim>
    void
    describe_place(const Model<dim>         &model,
                   const std::string        &what,
                   const std::string        &body,
                   const dealii::Point<dim> &place,
                   std::ostream             &out)
    {
      if (const auto *point = nearest_point(model, body, place))
        out << "  " << what << ": the material point at (" << point->location << "), "
            << point->location.distance(place) << " m from its Place\n";
    }

    template <int dim>
    void
    describe_places(const Model<dim> &model, std::ostream &out)
    {
      std::size_t n = 0;
      for (const auto &load : model.scene.point_loads)
        if (n++ < most_lines)
          describe_place(model,
                         "Point loads/" + load.name +
                           (load.n_points > 1 ? ", first of " + std::to_string(load.n_points) : ""),
                         load.body,
                         load.place,
                         out);
      n = 0;
      for (const auto &probe : model.scene.probes)
        if (!probe.face_mean && n++ < most_lines)
          describe_place(model, "Probes/" + probe.name, probe.body, probe.place, out);
    }

    template <int dim>
    void
    describe_loads(const Model<dim> &model, Step<dim> &step, std::ostream &out)
    {
      const std::string unit  = dim == 2 ? ") N/m" : ") N";
      const double      start = model.scene.time.start, end = model.scene.time.end;
      auto              first = step.total_load(start), last = step.total_load(end);
      for (auto *sum : {&first, &last}) // internal forces cancel but for round-off
        for (int d = 0; d < dim; ++d)
          if (std::abs((*sum)[d]) < 1e-12 * sum->norm())
            (*sum)[d] = 0.;
      if (first.norm() + last.norm() == 0.)
        return;
      out << "  sum of all loads: (" << first << unit;
      if ((first - last).norm() > 1e-12 * (first.norm() + last.norm()))
        out << " at t = " << start << " s, (" << last << unit << " at t = " << end << " s";
      out << "\n";
    }
  } // namespace



  template <int dim>
  std::string
  hint_on_points(const Scene<dim> &scene)
  {
    for (const auto &body : scene.bodies)
      for (const unsigned int n : body.points_per_cell)
        if (n < 2)
          return "body '" + body.name +
                 "' has one material point per cell in some direction, which cannot hold all "
                 "motions of its nodes: take two or more (Points per cell), or damp them "
                 "(Mapping/Lumping > 0)";
    return "";
  }



  namespace
  {
    /** Bodies in which the linear u-p equations grow without bound (theory_mixture.md 1). */
    template <int dim>
    void
    describe_growth(const Model<dim> &model, std::ostream &out)
    {
      if (!model.scheme.dynamic || model.scheme.carries_fluid_velocity())
        return;
      for (std::size_t b = 0; b < model.bodies.soils.size(); ++b)
        {
          const Soil      &soil  = model.bodies.soils[b];
          const PoreFluid &fluid = soil.fluid;
          const double     n     = fluid.initial_porosity;
          const double     excess =
            (1. - n) * (soil.grain_density - fluid.reference_density); // rho - rho_f
          if (soil.dry_storage == 0. && excess < fluid.reference_density *
                                                   p_wave_modulus(model.bodies.materials[b]) * n /
                                                   fluid.bulk_modulus)
            out << "  note: body '" << model.bodies.names[b]
                << "' is so stiff against its fluid that waves grow in the u-p equations, which "
                   "leave out the fluid's own acceleration: take Time/Scheme = clc-midpoint\n";
        }
    }
  } // namespace



  template <int dim>
  void
  describe_attachments(const Model<dim> &model, Step<dim> &step, std::ostream &out)
  {
    const std::string hint = hint_on_points(model.scene);
    if (!hint.empty())
      out << "  note: " << hint << "\n";
    describe_growth(model, out);
    for (const std::string &note : model.initial_stress_notes())
      out << "  note: " << note << "\n";
    describe_conditions(model, out);
    describe_body_conditions(model, out);
    describe_regions(model, out);
    describe_places(model, out);
    if (!model.scene.load_control)
      describe_loads(model, step, out);
    out << std::flush;
  }

  template std::string
  hint_on_points(const Scene<2> &);
  template std::string
  hint_on_points(const Scene<3> &);
  template void
  describe_attachments(const Model<2> &, Step<2> &, std::ostream &);
  template void
  describe_attachments(const Model<3> &, Step<3> &, std::ostream &);
} // namespace kedge
