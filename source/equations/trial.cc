#include <kedge/equations/trial.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  Trial<dim>::begin(const StepTimes                 &times,
                    const Unknowns<dim>             &layout,
                    const std::vector<unsigned int> &n_local_nodes)
  {
    const std::size_t n_fields = layout.fields.size();
    this->times                = times;
    n_components.resize(n_fields);
    unknowns.fields.resize(n_fields);
    displacements.resize(n_fields);
    motion.assign(n_fields, {});
    for (std::size_t f = 0; f < n_fields; ++f)
      {
        n_components[f] = layout.fields[f].n_components;
        unknowns.fields[f].assign(std::size_t(n_local_nodes[f]) * n_components[f], 0.);
        displacements[f].assign(n_components[f] == dim ? 0 : std::size_t(n_local_nodes[f]) * dim,
                                0.);
      }
    unknowns.others.assign(layout.n_others(), 0.);
  }



  template <int dim>
  void
  Trial<dim>::follow(const Scheme &scheme)
  {
    for (unsigned int f = 0; f < motion.size(); ++f)
      {
        for (std::size_t i = 0; i < displacements[f].size() / dim; ++i)
          std::copy_n(&unknowns.fields[f][i * n_components[f]], dim, &displacements[f][i * dim]);
        Motion                    &of_field = motion[f];
        const std::vector<double> &u        = displacement(f);
        of_field.acceleration.resize(of_field.velocity_n.size());
        for (std::size_t k = 0; k < of_field.acceleration.size(); ++k)
          of_field.acceleration[k] = scheme.equilibrium_acceleration(u[k],
                                                                     of_field.velocity_n[k],
                                                                     of_field.acceleration_n[k],
                                                                     times.dt);
      }
  }



  template <int dim>
  std::vector<double>
  Trial<dim>::end_velocity(const Scheme &scheme, const unsigned int field) const
  {
    const Motion              &of_field = motion[field];
    const std::vector<double> &u        = displacement(field);
    std::vector<double>        result(u.size());
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] =
        scheme.end_velocity(u[k], of_field.velocity_n[k], of_field.acceleration_n[k], times.dt);
    return result;
  }



  template <int dim>
  std::vector<double>
  Trial<dim>::end_acceleration(const Scheme &scheme, const unsigned int field) const
  {
    const Motion              &of_field = motion[field];
    const std::vector<double> &u        = displacement(field);
    std::vector<double>        result(u.size());
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] =
        scheme.end_acceleration(u[k], of_field.velocity_n[k], of_field.acceleration_n[k], times.dt);
    return result;
  }

  template struct Trial<2>;
  template struct Trial<3>;
} // namespace kedge
