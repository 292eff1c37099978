#include <kedge/solid/ghost_term.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    const Ledger::Entry stabilisation_energy = {"stabilisation_energy",
                                                "J",
                                                Ledger::Section::energy,
                                                Ledger::Kind::total,
                                                Ledger::Role::lost,
                                                "energy"};

    /** A matrix of zeros between the nodes of a configuration. */
    template <int dim>
    void
    start_matrix(const Patch<dim> &patch, NodeMatrix<dim> &matrix)
    {
      if (patch.new_pattern())
        matrix.reinit(patch.nodes.n_local(), 1, GhostTerm<dim>::radius);
      matrix.set_zero();
    }

    /** x . A y, this rank's share. */
    template <int dim>
    double
    product(const Patch<dim>          &patch,
            const std::vector<double> &x,
            const NodeMatrix<dim>     &matrix,
            const std::vector<double> &y)
    {
      std::vector<double> Ay(y.size());
      multiply(matrix, patch, dim, y, Ay);
      double sum = 0.;
      for (std::size_t i = 0; i < x.size(); ++i)
        sum += x[i] * Ay[i];
      return sum;
    }
  } // namespace



  template <int dim>
  GhostTerm<dim>::GhostTerm(const unsigned int             field,
                            const Patch<dim>              &patch,
                            const StabilisationParameters &parameters,
                            const std::vector<double>     &modulus_of_body,
                            const Scheme                  &scheme)
    : field(field)
    , patch(patch)
    , parameters(parameters)
    , modulus_of_body(modulus_of_body)
    , scheme(scheme)
  {}



  template <int dim>
  void
  GhostTerm<dim>::declare_books(Ledger &ledger)
  {
    energy = ledger.declare(stabilisation_energy);
  }



  template <int dim>
  void
  GhostTerm<dim>::reach(const unsigned int of_field, std::vector<unsigned char> &reached)
  {
    if (of_field == field)
      ghosts.find(patch, modulus_of_body, reached);
  }



  template <int dim>
  void
  GhostTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    start_matrix(patch, stiffness);
    ghosts.add_stiffness(patch, parameters.ghost_stiffness_factor, stiffness);
  }



  template <int dim>
  Answer
  GhostTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    add_product(patch,
                scheme.alpha_f,
                stiffness,
                trial.displacement(field),
                residual.partial(field));
    return {};
  }



  template <int dim>
  void
  GhostTerm<dim>::add_tangent(const Trial<dim> &, Tangent<dim> &tangent)
  {
    tangent.add_to_diagonal_blocks(field, scheme.alpha_f, stiffness, 0, dim);
  }



  /** u . alpha_f K_G u */
  template <int dim>
  void
  GhostTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    const std::vector<double> &u = trial.displacement(field);
    ledger.book(energy, scheme.alpha_f * product(patch, u, stiffness, u));
  }



  template <int dim>
  GhostInertiaTerm<dim>::GhostInertiaTerm(const unsigned int             field,
                                          const Patch<dim>              &patch,
                                          const GhostTerm<dim>          &ghosts,
                                          const StabilisationParameters &parameters,
                                          const Scheme                  &scheme)
    : field(field)
    , patch(patch)
    , ghosts(ghosts)
    , factor(parameters.ghost_mass_factor)
    , scheme(scheme)
  {}



  template <int dim>
  void
  GhostInertiaTerm<dim>::declare_books(Ledger &ledger)
  {
    energy = ledger.declare(stabilisation_energy);
  }



  template <int dim>
  void
  GhostInertiaTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    start_matrix(patch, mass);
    ghosts.penalty().add_mass(patch, factor, mass);
  }



  template <int dim>
  void
  GhostInertiaTerm<dim>::add_mapping_mass(const unsigned int of_field,
                                          NodeMatrix<dim>   &mapped) const
  {
    if (of_field != field)
      return;
    is_mapped = lumped_mass_ratio(patch, mapped) < badly_conditioned_mass;
    if (!is_mapped)
      return;
    for (unsigned int s = 0; s < mass.n_slots(); ++s)
      {
        const unsigned int slot = mapped.slot(mass.offset(s)); // in the matrix, which may be wider
        for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
          mapped.row(i, 0)[slot] += mass.row(i, 0)[s];
      }
  }



  template <int dim>
  Answer
  GhostInertiaTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    add_product(patch, 1., mass, trial.motion[field].acceleration, residual.partial(field));
    return {};
  }



  template <int dim>
  void
  GhostInertiaTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    tangent.add_to_diagonal_blocks(field, scheme.inertia_coefficient(trial.times.dt), mass, 0, dim);
  }



  /** u . M_G a_m - v_n . M_G dv, the last only if M_G is in the mapping. */
  template <int dim>
  void
  GhostInertiaTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    const auto &motion = trial.motion[field];
    double      work   = product(patch, trial.displacement(field), mass, motion.acceleration);
    if (is_mapped)
      {
        std::vector<double> change = trial.end_velocity(scheme, field);
        for (std::size_t i = 0; i < change.size(); ++i)
          change[i] -= motion.velocity_n[i];
        work -= product(patch, motion.velocity_n, mass, change);
      }
    ledger.book(energy, work);
  }

  template class GhostTerm<2>;
  template class GhostTerm<3>;
  template class GhostInertiaTerm<2>;
  template class GhostInertiaTerm<3>;
} // namespace kedge
