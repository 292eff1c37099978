#include <kedge/fields/prescribed_motion.h>
#include <kedge/solid/body_condition_term.h>
#include <kedge/solid/load_columns.h>
#include <kedge/surfaces/face_nodes.h>

#include <algorithm>
#include <tuple>

namespace kedge
{
  template <int dim>
  BodyConditionTerm<dim>::BodyConditionTerm(
    const unsigned int                               field,
    const Patch<dim>                                &patch,
    const std::vector<BodyConditionParameters<dim>> &conditions,
    const std::vector<double>                       &stiffness,
    const std::vector<std::string>                  &body_names,
    const std::map<std::string, double>             &constants,
    const LoadProgram                               &program,
    const Scheme                                    &scheme,
    const std::vector<const SurfaceTerm<dim> *>     &surfaces)
    : field(field)
    , patch(patch)
    , conditions(conditions)
    , stiffness(stiffness)
    , body_names(body_names)
    , program(program)
    , scheme(scheme)
    , faces("Body condition", {conditions.begin(), conditions.end()}, constants, surfaces)
  {
    for (unsigned int c = 0; c < conditions.size(); ++c)
      for (const PrescribedLine<dim> &given : conditions[c].lines)
        {
          Line line;
          line.condition = c;
          line.direction = given.direction;
          line.kind      = given.motion.kind;
          line.by_force  = !given.force.empty();
          if (line.by_force)
            line.force = Expression(given.force, {"t"}, constants);
          else if (line.kind != ConditionKind::fixed)
            line.motion =
              Expression(given.motion.expression,
                         line.kind == ConditionKind::motion ? motion_variables()
                                                            : std::vector<std::string>{"t"},
                         constants);
          lines.push_back(line);
        }
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    this->unknowns = &unknowns;
    if (!lines.empty())
      unknowns.traits.multipliers = true;
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    if (lines.empty())
      return;
    faces.attach(points, body_names);
    const Lattice<dim>    &lattice = patch.grid().lattice();
    dealii::Tensor<1, dim> cell_size;
    for (int d = 0; d < dim; ++d)
      cell_size[d] = lattice.h[d] * lattice.node_intervals;
    functions.clear();
    for (unsigned int c = 0; c < conditions.size(); ++c)
      functions.push_back(
        faces.start_of_facets(c).empty()
          ? FaceMultipliers<dim>(faces.extent(c), conditions[c].side / 2, cell_size)
          : FaceMultipliers<dim>(faces.start_of_facets(c), cell_size));
    unsigned int n = 0;
    for (Line &line : lines)
      {
        line.first = n;
        n += faces.any(line.condition) ? functions[line.condition].size() : 0;
        line.end = n;
      }
    area.assign(n, 0.);
    AssertThrow(unknowns != nullptr, dealii::ExcInternalError());
    first_unknown = unknowns->add_others(n);
    for (Line &line : lines)
      {
        line.by_force = line.by_force && line.first < line.end; // Where = 0 switches it off
        if (line.by_force)
          line.common = unknowns->add_others(1);
      }
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::declare_books(Ledger &ledger)
  {
    work      = ledger.declare(external_work);
    reactions = declare_reactions<dim>(ledger, conditions);
  }



  /** Calls visit(line, face, multiplier, s A phi) for what acts on a face. */
  template <int dim>
  template <typename Visit>
  void
  BodyConditionTerm<dim>::for_faces(const Visit &visit) const
  {
    for (const Line &line : lines)
      for (const SurfacePoint<dim> &face : faces.points())
        if (face.surface == line.condition)
          functions[line.condition].for_functions(face.reference_place,
                                                  [&](const unsigned int k, const double phi) {
                                                    visit(line,
                                                          face,
                                                          line.first + k,
                                                          stiffness[line.condition] *
                                                            face.reference_area * phi);
                                                  });
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    if (lines.empty())
      return;
    faces.reinit(cloud, patch);
    std::fill(area.begin(), area.end(), 0.);
    couplings.clear();
    for_faces([&](const Line              &line,
                  const SurfacePoint<dim> &face,
                  const unsigned int       multiplier,
                  const double             weight) {
      area[multiplier] += weight;
      for_nodes_of_face(patch, face, [&](const unsigned int node, const double N) {
        for (unsigned int d = 0; d < dim; ++d)
          if (line.direction[d] != 0. && N != 0.)
            couplings.push_back({multiplier, node, d, weight * N * line.direction[d]});
      });
    });
    std::stable_sort(couplings.begin(), couplings.end(), [](const auto &a, const auto &b) {
      return std::tie(a.multiplier, a.node, a.component) <
             std::tie(b.multiplier, b.node, b.component);
    });
    std::size_t n = 0;
    for (const Coupling &next : couplings)
      if (n > 0 && couplings[n - 1].multiplier == next.multiplier &&
          couplings[n - 1].node == next.node && couplings[n - 1].component == next.component)
        couplings[n - 1].value += next.value;
      else
        couplings[n++] = next;
    couplings.resize(n);
    std::vector<double> of_all(area.size());
    dealii::Utilities::MPI::sum(area, patch.nodes.communicator(), of_all);
    is_idle.assign(area.size(), false);
    for (std::size_t k = 0; k < area.size(); ++k)
      is_idle[k] = of_all[k] <= 0.;
  }



  template <int dim>
  typename BodyConditionTerm<dim>::Place
  BodyConditionTerm<dim>::place(const SurfacePoint<dim> &face) const
  {
    Place result{{0., 0., 0.}};
    for (int d = 0; d < dim; ++d)
      result.coordinates[d] = patch.points.location[face.slot][d] + face.offset[d];
    return result;
  }



  /** g_f: how far a face is to move in the step. */
  template <int dim>
  double
  BodyConditionTerm<dim>::demand(const Line                        &line,
                                 const SurfacePoint<dim>           &face,
                                 const StepTimes                   &times,
                                 const typename Trial<dim>::Motion &motion) const
  {
    const Place  x = place(face);
    const double t = times.t_n, dt = times.dt;
    const double result =
      line.by_force ? 0. : prescribed_increment(line.kind, line.motion, x.coordinates, t, t + dt);
    const double catching_up = scheme.catching_up(dt);
    if (catching_up == 0.)
      return result;
    double off =
      line.by_force ? 0. : -prescribed_velocity(line.kind, line.motion, x.coordinates, t, dt);
    for_nodes_of_face(patch, face, [&](const unsigned int node, const double N) {
      for (int d = 0; d < dim && N != 0.; ++d)
        off += N * line.direction[d] * motion.velocity_n[std::size_t(node) * dim + d];
    });
    return result + catching_up * off;
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::start(Trial<dim> &trial)
  {
    load_time = scheme.load_time(trial.times.t_n, trial.times.dt);
    demanded.assign(area.size(), 0.);
    for_faces([&](const Line              &line,
                  const SurfacePoint<dim> &face,
                  const unsigned int       multiplier,
                  const double             weight) {
      demanded[multiplier] += weight * demand(line, face, trial.times, trial.motion[field]);
    });
  }



  /** Means of a nodal vector over the faces: B v, this rank's share. */
  template <int dim>
  std::vector<double>
  BodyConditionTerm<dim>::weighted_means(const std::vector<double> &nodal) const
  {
    std::vector<double> result(area.size(), 0.);
    for (const Coupling &entry : couplings)
      result[entry.multiplier] +=
        entry.value * nodal[std::size_t(entry.node) * dim + entry.component];
    return result;
  }



  template <int dim>
  Answer
  BodyConditionTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    if (lines.empty())
      return {};
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(patch.nodes.communicator()) == 0;
    const std::vector<double> &x            = trial.unknowns.others;
    std::vector<double>       &sums         = residual.partial(field);
    std::vector<double>       &others       = residual.others();
    const std::size_t          n_components = patch.n_components();
    for (const Coupling &entry : couplings)
      sums[entry.node * n_components + entry.component] -=
        entry.value * x[first_unknown + entry.multiplier];
    const std::vector<double> moved = weighted_means(trial.displacement(field));
    for (const Line &line : lines)
      {
        for (unsigned int k = line.first; k < line.end; ++k)
          {
            double &row = others[first_unknown + k];
            row += demanded[k] - moved[k];
            if (line.by_force)
              {
                row += area[k] * x[line.common];
                others[line.common] += area[k] * x[first_unknown + k];
              }
            if (is_first && is_idle[k])
              row -= x[first_unknown + k];
          }
        if (line.by_force && is_first)
          others[line.common] -= program.factor(load_time) * line.force({program.time(load_time)});
      }
    return {};
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::add_tangent(const Trial<dim> &, Tangent<dim> &tangent)
  {
    const auto add_both = [&](const UnknownIndex &a, const UnknownIndex &b, const double value) {
      tangent.add(a, b, value);
      tangent.add(b, a, value);
    };
    for (const Coupling &entry : couplings)
      add_both(unknown(entry.multiplier), {field, entry.node, entry.component}, -entry.value);
    for (const Line &line : lines)
      {
        for (unsigned int k = line.first; line.by_force && k < line.end; ++k)
          add_both(unknown(k), UnknownIndex::other(line.common), area[k]);
      }
    if (dealii::Utilities::MPI::this_mpi_process(patch.nodes.communicator()) == 0)
      for (unsigned int k = 0; k < is_idle.size(); ++k)
        if (is_idle[k])
          tangent.add(unknown(k), unknown(k), -1.);
  }



  template <int dim>
  void
  BodyConditionTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (lines.empty())
      return;
    const std::vector<double> &x     = trial.unknowns.others;
    const std::vector<double>  moved = weighted_means(trial.displacement(field));
    std::vector<double>        forces(conditions.size() * dim, 0.);
    double                     sum = 0.;
    for (const Line &line : lines)
      {
        for (unsigned int k = line.first; k < line.end; ++k)
          {
            sum += x[first_unknown + k] * moved[k];
            for (int d = 0; d < dim; ++d)
              forces[line.condition * dim + d] +=
                x[first_unknown + k] * area[k] * line.direction[d];
          }
      }
    ledger.book(work, sum);
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (int d = 0; d < dim && conditions[c].reaction; ++d)
        ledger.book(reactions[c * dim + d], forces[c * dim + d]);
  }

  template class BodyConditionTerm<2>;
  template class BodyConditionTerm<3>;
} // namespace kedge
