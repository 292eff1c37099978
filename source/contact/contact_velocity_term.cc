#include <kedge/contact/contact_velocity_term.h>

namespace kedge
{
  template <int dim>
  void
  ContactVelocityTerm<dim>::start(Trial<dim> &)
  {
    couplings.clear();
    const auto                        &nodes = this->nodes();
    std::vector<int>                   number(this->fields.patch[0]->nodes.n_local(), -1);
    std::vector<std::array<double, 2>> lumped(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        number[nodes[n].node[0]] = static_cast<int>(n);
        for (unsigned int k = 0; k < 2; ++k)
          {
            const double *row = mass[k]->row(nodes[n].node[k], 0);
            for (unsigned int s = 0; s < mass[k]->n_slots(); ++s)
              lumped[n][k] += row[s];
          }
      }
    for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        const double *row   = mass[0]->row(nodes[n].node[0], 0);
        const double  share = lumped[n][1] / (lumped[n][0] + lumped[n][1]);
        for_neighbours(*this->fields.patch[0],
                       nodes[n].node[0],
                       *mass[0],
                       [&](const unsigned int slot, const unsigned int neighbour) {
                         if (number[neighbour] >= 0 && row[slot] != 0.)
                           couplings.push_back(
                             {static_cast<std::size_t>(number[neighbour]), n, row[slot] * share});
                       });
      }
  }



  template <int dim>
  std::vector<typename ContactVelocityTerm<dim>::TrialForce>
  ContactVelocityTerm<dim>::trial_forces(const Trial<dim> &trial) const
  {
    std::vector<TrialForce> result(this->nodes().size());
    const double            dt = trial.times.dt;
    for (const Coupling &coupling : couplings)
      {
        const ContactNode<dim> &from = this->nodes()[coupling.from];
        if (!approaches(from, trial))
          continue;
        const dealii::Tensor<1, dim> n        = from.direction[0];
        const dealii::Tensor<1, dim> velocity = this->relative_displacement(from, trial) / dt;
        result[coupling.at].normal -= coupling.mass / dt * (n * velocity) * n;
        result[coupling.at].whole -= coupling.mass / dt * velocity;
      }
    return result;
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ContactVelocityTerm<dim>::forces(const Trial<dim> &trial) const
  {
    std::vector<dealii::Tensor<1, dim>> result;
    const std::vector<TrialForce>       trial_forces = this->trial_forces(trial);
    for (std::size_t n = 0; n < trial_forces.size(); ++n)
      {
        result.push_back(trial_forces[n].normal);
        if (friction == 0.)
          continue;
        const dealii::Tensor<1, dim> along = along_surface(n, trial_forces[n].whole);
        const double                 bound = friction * trial_forces[n].normal.norm();
        result.back() += along.norm() <= bound ? along : bound / along.norm() * along;
      }
    return result;
  }



  /** d(friction at a node)/d(approach of another, whose normal is given), but for its mass. */
  template <int dim>
  dealii::Tensor<2, dim>
  ContactVelocityTerm<dim>::slope_of_friction(const std::size_t             node,
                                              const TrialForce             &force,
                                              const dealii::Tensor<1, dim> &normal_from) const
  {
    dealii::Tensor<2, dim> result; // T: all velocities make the trial force
    for (int d = 0; d < dim; ++d)
      {
        dealii::Tensor<1, dim> e;
        e[d]          = 1.;
        const auto Te = along_surface(node, e);
        for (int i = 0; i < dim; ++i)
          result[i][d] = Te[i];
      }
    const dealii::Tensor<1, dim> along = along_surface(node, force.whole);
    const double                 size = along.norm(), pressure = force.normal.norm();
    if (size <= friction * pressure)
      return result;
    const dealii::Tensor<1, dim> m = along / size;
    result -= outer_product(m, m * result);
    result *= friction * pressure / size;
    if (pressure > 0.)
      result += friction * (force.normal / pressure * normal_from) * outer_product(m, normal_from);
    return result;
  }



  template <int dim>
  void
  ContactVelocityTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    const double                  dt           = trial.times.dt;
    const std::vector<TrialForce> trial_forces = this->trial_forces(trial);
    for (const Coupling &coupling : couplings)
      {
        const ContactNode<dim>      &from = this->nodes()[coupling.from];
        const dealii::Tensor<1, dim> n    = from.direction[0];
        dealii::Tensor<2, dim>       slope; // 0 keeps the entry
        if (approaches(from, trial))
          {
            slope = outer_product(n, n);
            if (friction > 0.)
              slope += slope_of_friction(coupling.at, trial_forces[coupling.at], n);
          }
        this->add_slope(this->nodes()[coupling.at],
                        from,
                        -coupling.mass / (dt * dt) * slope,
                        tangent);
      }
  }

  template class ContactVelocityTerm<2>;
  template class ContactVelocityTerm<3>;
} // namespace kedge
