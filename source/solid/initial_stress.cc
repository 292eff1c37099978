#include <kedge/base/exceptions.h>
#include <kedge/materials/initial_strain.h>
#include <kedge/solid/initial_stress.h>

namespace kedge
{
  namespace
  {
    /** Components in the order in which a scene gives them: xx, yy, zz, xy, xz, yz. */
    constexpr int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};

    dealii::SymmetricTensor<2, 3>
    evaluate(const std::vector<Expression> &stress, const double (&x)[3])
    {
      dealii::SymmetricTensor<2, 3> result;
      for (unsigned int k = 0; k < stress.size(); ++k)
        result[rows[k]][columns[k]] = stress[k](x);
      return result;
    }

    /** The numbers in the columns of a law. */
    template <int dim>
    std::vector<double>
    history_of(const PointState<dim> &state, const std::vector<unsigned int> &columns)
    {
      std::vector<double> result;
      for (const unsigned int column : columns)
        result.push_back(column < most_memory_columns ? state.memory[column] : 0.);
      return result;
    }

    /** Points of a body whose stress was returned. */
    struct Returned
    {
      std::size_t n_points = 0, n_returned = 0;
      double      largest = 0.; ///< change of a principal stress, over the largest one [-]

      std::string
      describe(const std::string &body, const std::string &place) const
      {
        std::ostringstream text;
        text.precision(3);
        text << "Bodies/" << body << "/Initial stress: " << n_returned << " of " << n_points
             << " material points ("
             << 100. * static_cast<double>(n_returned) / static_cast<double>(n_points)
             << " %) began beyond the yield surface and were returned to it, which changed their "
                "stress by up to "
             << 100. * largest << " % (at " << place << "): what is left may not be in balance.";
        return text.str();
      }
    };

    /**
     * Stress, elastic frame, history and energy of a point in the reference configuration; by how
     * much the stress was returned.
     */
    template <int dim>
    double
    set_state(const Material                      &material,
              const std::vector<unsigned int>     &columns,
              const dealii::SymmetricTensor<2, 3> &stress,
              PointState<dim>                     &state)
    {
      // in plane strain the third axis is one of them
      dealii::SymmetricTensor<2, dim> in_plane;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          in_plane[i][j] = stress[i][j];
      const auto axes =
        dealii::eigenvectors(in_plane, dealii::SymmetricTensorEigenvectorMethod::jacobi);
      std::array<double, 3> principal;
      principal[2] = stress[2][2];
      for (int k = 0; k < dim; ++k)
        principal[k] = axes[k].first;

      const InitialState start = initial_state(material, principal, history_of(state, columns));
      const std::vector<double>   &history = start.history;
      const std::array<double, 3> &strain  = start.strain;
      for (unsigned int c = 0; c < columns.size(); ++c)
        if (columns[c] < most_memory_columns)
          state.memory[columns[c]] = history[c];
      for (int k = 0; k < dim; ++k)
        for (int i = 0; i < dim; ++i)
          state.elastic_frame[i][k] = std::exp(strain[k]) * axes[k].second[i];
      state.kirchhoff_stress = in_plane;
      if (start.returned > 0.)
        {
          state.kirchhoff_stress = dealii::SymmetricTensor<2, dim>();
          for (int k = 0; k < dim; ++k)
            state.kirchhoff_stress +=
              start.stress[k] * symmetrize(outer_product(axes[k].second, axes[k].second));
        }
      if (dim == 2)
        {
          state.out_of_plane_elastic_stretch  = std::exp(strain[2]);
          state.out_of_plane_kirchhoff_stress = start.stress[2];
        }
      const double values[3] = {strain[0], strain[1], strain[2]};
      std::visit(
        [&](const auto &law) {
          using Law           = std::decay_t<decltype(law)>;
          const auto begin    = read_history<Law>(history.data());
          state.strain_energy = law.energy(values, begin);
          if constexpr (Law::yields)
            state.hardening_energy = law.hardening_energy(begin);
        },
        material);
      return start.returned;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  set_initial_stress(const std::vector<BodyParameters<dim>> &bodies,
                     const std::vector<Material>            &material_of_body,
                     const std::map<std::string, double>    &constants,
                     std::vector<GeneratedPoint<dim>>       &points)
  {
    std::vector<std::vector<Expression>> stresses(bodies.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (const std::string &text : bodies[b].initial_stress)
        stresses[b].emplace_back(text, std::vector<std::string>{"x", "y", "z"}, constants);
    std::vector<std::vector<unsigned int>> columns;
    for (const Material &material : material_of_body)
      columns.push_back(memory_indices(material));
    std::vector<Returned>    returned(bodies.size());
    std::vector<std::string> worst(bodies.size()), result;
    for (auto &point : points)
      {
        PointState<dim> &state = point.record.state;
        const auto       body  = static_cast<unsigned int>(state.body);
        if (stresses[body].empty())
          continue;
        double x[3] = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          x[d] = point.record.location[d];
        try
          {
            const double change =
              set_state(material_of_body[body], columns[body], evaluate(stresses[body], x), state);
            Returned &of_body = returned[body];
            ++of_body.n_points;
            of_body.n_returned += change > 0.;
            if (change > of_body.largest)
              {
                std::ostringstream place;
                place << '(' << point.record.location << ')';
                worst[body]     = place.str();
                of_body.largest = change;
              }
          }
        catch (const UserError &error)
          {
            std::ostringstream message;
            message << "Bodies/" << bodies[body].name << "/Initial stress at ("
                    << point.record.location << "): " << error.what() << '.';
            throw UserError(message.str());
          }
      }
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (returned[b].n_returned > 0)
        result.push_back(returned[b].describe(bodies[b].name, worst[b]));
    return result;
  }

  template std::vector<std::string>
  set_initial_stress(const std::vector<BodyParameters<2>> &,
                     const std::vector<Material> &,
                     const std::map<std::string, double> &,
                     std::vector<GeneratedPoint<2>> &);
  template std::vector<std::string>
  set_initial_stress(const std::vector<BodyParameters<3>> &,
                     const std::vector<Material> &,
                     const std::map<std::string, double> &,
                     std::vector<GeneratedPoint<3>> &);
} // namespace kedge
