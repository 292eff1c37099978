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
  std::vector<dealii::Tensor<1, dim>>
  ContactVelocityTerm<dim>::forces(const Trial<dim> &trial) const
  {
    std::vector<dealii::Tensor<1, dim>> result(this->nodes().size());
    const double                        dt = trial.times.dt;
    for (const Coupling &coupling : couplings)
      {
        const ContactNode<dim> &from = this->nodes()[coupling.from];
        const double approach = from.direction[0] * this->relative_displacement(from, trial) / dt;
        if (approach > 0.)
          result[coupling.at] -= coupling.mass / dt * approach * from.direction[0];
      }
    return result;
  }



  template <int dim>
  void
  ContactVelocityTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    const double dt = trial.times.dt;
    for (const Coupling &coupling : couplings)
      {
        const ContactNode<dim>      &from       = this->nodes()[coupling.from];
        const dealii::Tensor<1, dim> n          = from.direction[0];
        const bool                   approaches = n * this->relative_displacement(from, trial) > 0.;
        this->add_slope(this->nodes()[coupling.at],
                        from,
                        (approaches ? -coupling.mass / (dt * dt) : 0.) * outer_product(n, n),
                        tangent);
      }
  }

  template class ContactVelocityTerm<2>;
  template class ContactVelocityTerm<3>;
} // namespace kedge
