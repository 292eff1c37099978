#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/porous/porous_force.h>
#include <kedge/porous/soil_bodies.h>

#include <cmath>
#include <sstream>

namespace kedge
{
  template <int dim>
  void
  saturate(const SoilBodies                 &bodies,
           const Patch<dim>                 &patch,
           std::vector<GeneratedPoint<dim>> &points)
  {
    std::vector<Expression> pressure;
    for (const auto &text : bodies.initial_pore_pressure)
      pressure.emplace_back(text, std::vector<std::string>{"x", "y", "z"}, bodies.constants);
    for (auto &point : points)
      {
        PointState<dim> &state = point.record.state;
        const auto       body  = static_cast<unsigned int>(state.body);
        if (!patch.holds(body))
          continue;
        const PoreFluid &fluid = bodies.soils[body].fluid;
        double           x[3]  = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          x[d] = point.record.location[d];
        state.pore_pressure = pressure[body](x);
        if (!(std::abs(state.pore_pressure) <= fluid.bulk_modulus))
          {
            std::ostringstream message;
            message << "Bodies/" << bodies.names[body]
                    << "/Initial pore pressure: " << state.pore_pressure << " Pa at ("
                    << point.record.location
                    << "), but a fluid of Pore fluid/Bulk modulus = " << fluid.bulk_modulus
                    << " Pa stands no more than that.";
            throw UserError(message.str());
          }
        state.porosity = fluid.initial_porosity;
        state.mass *= 1. - state.porosity;
        if (bodies.soils[body].dry_storage == 0.)
          state.mass +=
            state.porosity * fluid.density(state.pore_pressure) * state.reference_volume;
      }
  }



  template <int dim>
  void
  begin_motion(const SoilBodies &bodies, PointState<dim> &state)
  {
    const Soil &soil = bodies.soils[static_cast<unsigned int>(state.body)];
    state.mass = (1. - soil.fluid.initial_porosity) * soil.grain_density * state.reference_volume;
    state.end_pore_pressure = state.pore_pressure;
    state.fluid_velocity    = state.velocity;
  }



  template <int dim>
  std::vector<double>
  fluctuations_of(const SoilBodies                                             &bodies,
                  const Patch<dim>                                             &patch,
                  const std::function<double(const PoreFluid &, const double)> &of)
  {
    std::vector<double> result(patch.points.size());
    for (unsigned int b = 0; b < bodies.soils.size(); ++b)
      {
        const Expression    pressure(bodies.initial_pore_pressure[b],
                                  {"x", "y", "z"},
                                  bodies.constants);
        std::vector<double> at_nodes(patch.nodes.n_local());
        for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
          {
            const auto x    = patch.node_position(i);
            double     v[3] = {0, 0, 0};
            for (int d = 0; d < dim; ++d)
              v[d] = x[d];
            at_nodes[i] = of(bodies.soils[b].fluid, pressure(v));
          }
        const auto of_body = PorousForce<dim>::fluctuations(patch, at_nodes);
        for (const auto &batch : patch.points.batches)
          if (batch.body == b)
            std::copy(of_body.begin() + batch.begin,
                      of_body.begin() + batch.end,
                      result.begin() + batch.begin);
      }
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                                      \
  template void                saturate(const SoilBodies &,                         \
                                        const Patch<dim> &,                         \
                                        std::vector<GeneratedPoint<dim>> &);        \
  template void                begin_motion(const SoilBodies &, PointState<dim> &); \
  template std::vector<double> fluctuations_of(                                     \
    const SoilBodies &,                                                             \
    const Patch<dim> &,                                                             \
    const std::function<double(const PoreFluid &, const double)> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
