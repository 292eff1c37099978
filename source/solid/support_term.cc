#include <kedge/solid/load_columns.h>
#include <kedge/solid/support_term.h>

namespace kedge
{
  template <int dim>
  SupportTerm<dim>::SupportTerm(const unsigned int                               field,
                                const Patch<dim>                                &patch,
                                const std::vector<NodeConditionParameters<dim>> &conditions,
                                const Scheme                                    &scheme)
    : field(field)
    , patch(patch)
    , conditions(conditions)
    , can_lose(scheme.dynamic)
  {}



  template <int dim>
  void
  SupportTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (can_lose || conditions.empty())
      return;
    std::vector<double> n_now(conditions.size(), 0.);
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (patch.conditions.prescribed(i, d))
          n_now[patch.conditions.condition(i, d)] += 1.;
    dealii::Utilities::MPI::sum(n_now, patch.nodes.communicator(), n_now);
    lost.clear();
    for (std::size_t c = 0; c < n_now.size(); ++c)
      if (!n_held.empty() && n_held[c] > 0. && n_now[c] == 0.)
        lost += (lost.empty() ? "" : ", ") + conditions[c].name;
    if (lost.empty())
      n_held = std::move(n_now);
  }



  template <int dim>
  Answer
  SupportTerm<dim>::add_residual(const Trial<dim> &, Residual<dim> &)
  {
    if (lost.empty())
      return {};
    return Answer::failure("no node of Node conditions/" + lost +
                           " is a body's any more: it has moved away from them, and what holds "
                           "the body itself is a section of Body conditions");
  }



  template <int dim>
  void
  SupportTerm<dim>::declare_books(Ledger &ledger)
  {
    work      = ledger.declare(external_work);
    reactions = declare_reactions<dim>(ledger, conditions);
  }



  template <int dim>
  void
  SupportTerm<dim>::book(const Trial<dim>    &trial,
                         const Residual<dim> &residual,
                         Ledger              &ledger) const
  {
    const auto         &force        = residual.of_field(field);
    const auto         &displacement = trial.displacement(field);
    const unsigned int  n_components = patch.n_components();
    std::vector<double> forces(conditions.size() * dim, 0.);
    double              sum = 0.;
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (patch.conditions.prescribed(i, d))
          {
            const double f = force[std::size_t(i) * n_components + d];
            forces[patch.conditions.condition(i, d) * dim + d] += f;
            sum += f * displacement[std::size_t(i) * dim + d];
          }
    if (patch.conditions.any_moving())
      ledger.book(work, sum);
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (int d = 0; d < dim && conditions[c].reaction; ++d)
        ledger.book(reactions[c * dim + d], forces[c * dim + d]);
  }

  template class SupportTerm<2>;
  template class SupportTerm<3>;
} // namespace kedge
