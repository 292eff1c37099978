#include <kedge/fields/constraints.h>

namespace kedge
{
  template <int dim>
  void
  Constraints<dim>::reinit(const ActiveNodes<dim>    &nodes,
                           const NodeConditions<dim> &conditions,
                           const NodeTies<dim>       &ties,
                           const unsigned int         n_components)
  {
    this->nodes      = &nodes;
    this->conditions = &conditions;
    this->ties       = &ties;
    n_components_    = n_components;
    status_.resize(std::size_t(nodes.n_local()) * n_components);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      for (unsigned int c = 0; c < n_components; ++c)
        {
          const bool prescribed =
            c < dim ? conditions.prescribed(i, c) : conditions.pressure_prescribed(i);
          status_[std::size_t(i) * n_components + c] = ties.is_tied(i, c) ? NodalStatus::tied
                                                       : prescribed       ? NodalStatus::prescribed
                                                                          : NodalStatus::free;
        }
  }



  template <int dim>
  std::vector<NodalStatus>
  Constraints<dim>::status_of(const unsigned int component) const
  {
    std::vector<NodalStatus> result(status_.size() / n_components_);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = status_[i * n_components_ + component];
    return result;
  }



  template <int dim>
  void
  Constraints<dim>::prescribe(const double         t_n,
                              const double         dt,
                              const double         t_pressure,
                              std::vector<double> &unknowns) const
  {
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        double *x = &unknowns[std::size_t(i) * n_components_];
        for (int d = 0; d < dim; ++d)
          if (conditions->prescribed(i, d))
            x[d] = conditions->increment(i, d, t_n, t_n + dt);
        if (n_components_ > dim && conditions->pressure_prescribed(i))
          x[dim] = conditions->pressure(i, t_pressure);
      }
    prolong(unknowns);
  }



  template <int dim>
  void
  Constraints<dim>::prescribe_velocity(const double         t,
                                       const double         dt,
                                       std::vector<double> &velocity) const
  {
    if (!conditions->any_moving())
      return;
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        if (conditions->prescribed(i, d))
          velocity[std::size_t(i) * dim + d] = conditions->velocity(i, d, t, dt);
  }

  template class Constraints<2>;
  template class Constraints<3>;
} // namespace kedge
