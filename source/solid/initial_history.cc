#include <kedge/base/exceptions.h>
#include <kedge/solid/initial_history.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kedge
{
  namespace
  {
    /** A constant of a body's law, ready to be evaluated. */
    struct PlaceColumn
    {
      unsigned int           memory; ///< where it stands in PointState::memory
      const SpatialConstant *constant;
      Expression             expression;

      PlaceColumn(const unsigned int                   memory,
                  const SpatialConstant               *constant,
                  const std::map<std::string, double> &constants)
        : memory(memory)
        , constant(constant)
        , expression(constant->expression.empty()
                       ? Expression(constant->value)
                       : Expression(constant->expression, spatial_variables(), constants))
      {}

      double
      value(const double (&x)[4]) const
      {
        return constant->expression.empty() ? constant->value : constant->factor * expression(x);
      }
    };

    std::vector<PlaceColumn>
    place_columns(const MaterialParameters            &parameters,
                  const std::map<std::string, double> &constants)
    {
      const Material           material = make_material(parameters);
      const auto               of_place = constants_of_place(material, parameters);
      const auto               indices  = memory_indices(material);
      std::vector<PlaceColumn> result;
      for (unsigned int c = 0; c < indices.size(); ++c)
        if (of_place[c] != nullptr)
          result.emplace_back(indices[c], of_place[c], constants);
      return result;
    }

    /** How high each body reaches. */
    template <int dim>
    std::vector<double>
    highest_points(const std::size_t n_bodies, const std::vector<GeneratedPoint<dim>> &points)
    {
      std::vector<double> result(n_bodies, std::numeric_limits<double>::lowest());
      for (const auto &point : points)
        {
          const PointState<dim> &state = point.record.state;
          double                &top   = result[static_cast<unsigned int>(state.body)];
          top = std::max(top, state.reference_position[1] + state.reference_half_lengths[1]);
        }
      return result;
    }

    /** Throws UserError if a value is not what the constant may be. */
    template <int dim>
    void
    check_value(const MaterialParameters &material,
                const SpatialConstant    &constant,
                const dealii::Point<dim> &place,
                const double              value)
    {
      if (std::isfinite(value) && (value > 0. || (constant.may_be_zero && value == 0.)))
        return;
      std::ostringstream message;
      message << "Materials/" << material.name << '/' << constant.entry << " is " << value
              << " at the material point X = (" << place << "); it must be "
              << (constant.may_be_zero ? ">= 0" : "> 0")
              << " wherever there is material. Change the expression, for instance with max(..).";
      throw UserError(message.str());
    }
  } // namespace



  template <int dim>
  void
  set_initial_history(const std::vector<MaterialParameters> &parameters,
                      const std::map<std::string, double>   &constants,
                      std::vector<GeneratedPoint<dim>>      &points)
  {
    std::vector<std::vector<PlaceColumn>> columns;
    for (const MaterialParameters &material : parameters)
      columns.push_back(place_columns(material, constants));
    const std::vector<double> tops = highest_points(parameters.size(), points);
    for (auto &point : points)
      {
        PointState<dim> &state = point.record.state;
        const auto       body  = static_cast<unsigned int>(state.body);
        double           x[4]  = {0, 0, 0, tops[body] - state.reference_position[1]};
        for (int d = 0; d < dim; ++d)
          x[d] = state.reference_position[d];
        for (const PlaceColumn &column : columns[body])
          {
            const double value = column.value(x);
            check_value(parameters[body], *column.constant, point.record.location, value);
            state.memory[column.memory] = value;
          }
      }
  }

  template void
  set_initial_history(const std::vector<MaterialParameters> &,
                      const std::map<std::string, double> &,
                      std::vector<GeneratedPoint<2>> &);
  template void
  set_initial_history(const std::vector<MaterialParameters> &,
                      const std::map<std::string, double> &,
                      std::vector<GeneratedPoint<3>> &);
} // namespace kedge
