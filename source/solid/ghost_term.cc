#include <kedge/solid/ghost_term.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
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
    energy = ledger.declare({"stabilisation_energy",
                             "J",
                             Ledger::Section::energy,
                             Ledger::Kind::total,
                             Ledger::Role::lost,
                             "energy"});
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
    const auto start = [&](NodeMatrix<dim> &matrix) -> NodeMatrix<dim> & {
      if (patch.new_pattern())
        matrix.reinit(patch.nodes.n_local(), 1, radius);
      matrix.set_zero();
      return matrix;
    };
    ghosts.add_stiffness(patch, parameters.ghost_stiffness_factor, start(stiffness));
    if (scheme.dynamic)
      ghosts.add_mass(patch, parameters.ghost_mass_factor, start(mass));
  }



  template <int dim>
  void
  GhostTerm<dim>::add_mapping_mass(const unsigned int of_field, NodeMatrix<dim> &mapped) const
  {
    if (of_field != field)
      return;
    is_mapped = lumped_mass_ratio(patch, mapped) < badly_conditioned_mass;
    if (is_mapped)
      for (std::size_t k = 0; k < mapped.values().size(); ++k)
        mapped.values()[k] += mass.values()[k];
  }



  template <int dim>
  Answer
  GhostTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    const std::vector<double> &u = trial.displacement(field);
    std::vector<double>        force(u.size()), inertia(u.size(), 0.);
    multiply(stiffness, patch, dim, u, force);
    if (scheme.dynamic)
      multiply(mass, patch, dim, trial.motion[field].acceleration, inertia);
    std::vector<double> &sums         = residual.partial(field);
    const std::size_t    n_components = patch.n_components();
    for (std::size_t i = 0; i < u.size() / dim; ++i)
      for (int d = 0; d < dim; ++d)
        sums[i * n_components + d] += scheme.alpha_f * force[i * dim + d] + inertia[i * dim + d];
    return {};
  }



  template <int dim>
  void
  GhostTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    tangent.add_to_diagonal_blocks(field, scheme.alpha_f, stiffness, 0, dim);
    if (scheme.dynamic)
      tangent.add_to_diagonal_blocks(field,
                                     scheme.inertia_coefficient(trial.times.dt),
                                     mass,
                                     0,
                                     dim);
  }



  /** u . (M_G a_m + alpha_f K_G u) - v_n . M_G dv, the last only if M_G is in the mapping. */
  template <int dim>
  double
  GhostTerm<dim>::work(const Trial<dim> &trial) const
  {
    const std::vector<double> &u = trial.displacement(field);
    std::vector<double>        product(u.size());
    double                     sum = 0.;
    multiply(stiffness, patch, dim, u, product);
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += scheme.alpha_f * u[i] * product[i];
    if (!scheme.dynamic)
      return sum;
    const auto &motion = trial.motion[field];
    multiply(mass, patch, dim, motion.acceleration, product);
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += u[i] * product[i];
    if (!is_mapped)
      return sum;
    std::vector<double> change = trial.end_velocity(scheme, field);
    for (std::size_t i = 0; i < u.size(); ++i)
      change[i] -= motion.velocity_n[i];
    multiply(mass, patch, dim, change, product);
    for (std::size_t i = 0; i < u.size(); ++i)
      sum -= motion.velocity_n[i] * product[i];
    return sum;
  }



  template <int dim>
  void
  GhostTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    ledger.book(energy, work(trial));
  }

  template class GhostTerm<2>;
  template class GhostTerm<3>;
} // namespace kedge
