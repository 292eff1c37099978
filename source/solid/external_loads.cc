#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/solid/external_loads.h>

namespace kedge
{
  namespace
  {
    template <int dim>
    std::array<Expression, std::size_t(dim)>
    functions_of_time(const std::array<std::string, std::size_t(dim)> &texts,
                      const std::map<std::string, double>             &constants)
    {
      std::array<Expression, std::size_t(dim)> result;
      for (int d = 0; d < dim; ++d)
        result[d] = Expression(texts[d], {"t"}, constants);
      return result;
    }

    template <int dim>
    dealii::Tensor<1, dim>
    evaluate(const std::array<Expression, std::size_t(dim)> &expressions, const double t)
    {
      dealii::Tensor<1, dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = expressions[d]({t});
      return value;
    }

    /** True if the point belongs to the named body; an empty name means any. */
    template <int dim>
    bool
    belongs(const GeneratedPoint<dim>      &point,
            const std::string              &body,
            const std::vector<std::string> &body_names)
    {
      return body.empty() || body_names[static_cast<unsigned int>(point.record.state.body)] == body;
    }
  } // namespace



  template <int dim>
  ExternalLoads<dim>::ExternalLoads(const std::array<std::string, dim>          &body_force,
                                    const std::vector<bool>                     &has_body_force,
                                    const std::vector<PointLoadParameters<dim>> &point_loads,
                                    const std::map<std::string, double>         &constants,
                                    const LoadProgram                           &program)
    : body_force(functions_of_time<dim>(body_force, constants))
    , has_body_force(has_body_force)
    , point_loads(point_loads)
    , program(program)
  {
    for (const auto &load : point_loads)
      load_expressions.push_back(functions_of_time<dim>(load.force, constants));
  }



  template <int dim>
  void
  ExternalLoads<dim>::attach(std::vector<GeneratedPoint<dim>> &points,
                             const std::vector<std::string>   &body_names)
  {
    shares.clear();
    for (unsigned int i = 0; i < point_loads.size(); ++i)
      attach_point_load(i, points, body_names);
    for (auto &point : points)
      if (shares.count(point.record.id) > 0)
        point.record.state.loaded = 1.;
  }



  template <int dim>
  void
  ExternalLoads<dim>::attach_point_load(const unsigned int                load,
                                        std::vector<GeneratedPoint<dim>> &points,
                                        const std::vector<std::string>   &body_names)
  {
    const auto                                   &parameters = point_loads[load];
    std::vector<std::pair<double, std::uint64_t>> candidates;
    for (const auto &point : points)
      if (belongs(point, parameters.body, body_names))
        candidates.emplace_back(point.record.location.distance_square(parameters.place),
                                point.record.id);
    if (candidates.size() < parameters.n_points)
      throw UserError("Point load '" + parameters.name + "' is to act on " +
                      std::to_string(parameters.n_points) + " material points, but body '" +
                      parameters.body + "' has only " + std::to_string(candidates.size()) + ".");
    std::sort(candidates.begin(), candidates.end());
    const auto nearest =
      std::find_if(points.begin(), points.end(), [id = candidates[0].second](const auto &point) {
        return point.record.id == id;
      });
    check_nearness<dim>("Point load '" + parameters.name + "'",
                        parameters.place,
                        nearest->record.location,
                        nearest->record.state.reference_half_lengths);
    for (unsigned int i = 0; i < parameters.n_points; ++i)
      shares[candidates[i].second].push_back({load, 1. / parameters.n_points});
  }



  template <int dim>
  bool
  ExternalLoads<dim>::empty() const
  {
    bool no_body_force = true;
    for (const auto &component : body_force)
      no_body_force = no_body_force && component.is_constant() && component.value() == 0.;
    return no_body_force && load_expressions.empty();
  }



  template <int dim>
  std::array<double, std::size_t(dim)>
  ExternalLoads<dim>::body_acceleration(const double t) const
  {
    std::array<double, std::size_t(dim)> result;
    for (int d = 0; d < dim; ++d)
      result[d] = program.factor(t) * body_force[d]({program.time(t)});
    return result;
  }



  template <int dim>
  void
  ExternalLoads<dim>::add_force(const StepPoints<dim>               &points,
                                const double                         t,
                                std::vector<dealii::Tensor<1, dim>> &forces) const
  {
    const double                 load_time = program.time(t);
    const dealii::Tensor<1, dim> acceleration =
      program.factor(t) * evaluate<dim>(body_force, load_time);
    if (acceleration.norm_square() > 0.)
      for (const auto &batch : points.batches)
        if (has_body_force[batch.body])
          for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
            forces[slot] += points.mass[slot] * acceleration;

    std::vector<dealii::Tensor<1, dim>> loads;
    for (const auto &expressions : load_expressions)
      loads.push_back(program.factor(t) * evaluate<dim>(expressions, load_time));
    for (const unsigned int slot : points.loaded)
      {
        const auto found = shares.find(points.id[slot]);
        if (found != shares.end()) // another thing may act on it
          for (const Share &share : found->second)
            forces[slot] += share.factor * loads[share.load];
      }
  }

  template class ExternalLoads<2>;
  template class ExternalLoads<3>;
} // namespace kedge
