#include <kedge/contact/nodal_law_term.h>

#include <sstream>

namespace kedge
{
  template <int dim>
  NodalLawTerm<dim>::NodalLawTerm(const ContactParameters  &parameters,
                                  const ContactFields<dim> &fields,
                                  const NodalLaw           &law)
    : NodalContactTerm<dim>(parameters.name, fields, law.alpha, law.friction > 0.)
    , law(law)
    , function(nodal_function<dim>(parameters.method))
    , has_multipliers(parameters.method == ContactMethod::augmented_lagrangian ||
                      parameters.method == ContactMethod::lagrange_multipliers)
    , opens_by_gap(parameters.method != ContactMethod::lagrange_multipliers)
    , multipliers(fields.number, law.friction > 0. ? dim : 1)
  {}



  template <int dim>
  void
  NodalLawTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    if (has_multipliers)
      multipliers.declare(unknowns);
  }



  template <int dim>
  void
  NodalLawTerm<dim>::reach(const unsigned int field, std::vector<unsigned char> &reached)
  {
    if (has_multipliers)
      multipliers.reach(field, reached);
  }



  template <int dim>
  void
  NodalLawTerm<dim>::start(Trial<dim> &)
  {
    states.assign(this->nodes().size(), State());
  }



  template <int dim>
  NodalResponse<dim>
  NodalLawTerm<dim>::response(const std::size_t node,
                              const Trial<dim> &trial,
                              const NodalHold   hold) const
  {
    const ContactNode<dim> &here = this->nodes()[node];
    dealii::Tensor<1, dim>  multiplier;
    if (has_multipliers)
      for (unsigned int i = 0; i < here.n_directions; ++i)
        multiplier[i] = law.stiffness * trial.unknowns.others[multipliers.number(node, i)];
    return function(law,
                    here.n_directions,
                    multiplier,
                    here.components(this->relative_displacement(here, trial)),
                    hold);
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  NodalLawTerm<dim>::forces(const Trial<dim> &trial) const
  {
    std::vector<dealii::Tensor<1, dim>> result;
    for (std::size_t n = 0; n < this->nodes().size(); ++n)
      result.push_back(this->nodes()[n].vector(response(n, trial).force));
    return result;
  }



  /** Takes a node's answer; true if it has just been held. */
  template <int dim>
  bool
  NodalLawTerm<dim>::follow(const NodalResponse<dim> &response, State &state) const
  {
    const bool   opens = state.closed && !response.closed;
    const double along =
      response.force * state.force - response.force[0] * state.force[0]; // of both forces
    const bool turns = state.closed && response.closed &&
                       (state.slides != response.slides || (response.slides && along < 0.));
    state.n_openings += opens;
    state.n_changes += opens || turns;
    state.closed = response.closed;
    state.slides = response.slides;
    state.force  = response.force;
    if (state.hold != NodalHold::none || state.n_changes <= most_changes)
      return false;
    state.hold = turns ? NodalHold::sticks : NodalHold::open;
    return true;
  }



  template <int dim>
  Answer
  NodalLawTerm<dim>::parting(const std::size_t node) const
  {
    std::ostringstream cause;
    cause << this->name() << ": the bodies part at the node at ("
          << this->fields.patch[0]->node_position(this->nodes()[node].node[0])
          << "), and Lagrange multipliers alone cannot tell an open node from one that "
             "carries nothing; Method = augmented lagrangian can";
    return Answer::failure(cause.str());
  }



  template <int dim>
  Answer
  NodalLawTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    for (std::size_t n = 0; n < this->nodes().size(); ++n)
      {
        NodalResponse<dim> here = response(n, trial);
        if (follow(here, states[n]))
          here = response(n, trial);
        if (!opens_by_gap && states[n].n_openings > most_openings)
          return parting(n);
        for (unsigned int i = 0; has_multipliers && i < this->nodes()[n].n_directions; ++i)
          residual.others()[multipliers.number(n, i)] += here.constraint[i];
      }
    return NodalContactTerm<dim>::add_residual(trial, residual);
  }



  template <int dim>
  Answer
  NodalLawTerm<dim>::finish(const Trial<dim> &trial)
  {
    double      sum = 0., worst = 0.;
    std::size_t where = 0;
    for (std::size_t n = 0; n < this->nodes().size(); ++n)
      {
        const NodalResponse<dim> here = response(n, trial);
        sum += here.force.norm();
        if (states[n].hold == NodalHold::none)
          continue;
        const NodalResponse<dim> law_says = response(n, trial, NodalHold::none);
        const double             mismatch =
          has_multipliers ? law_says.constraint.norm() : (law_says.force - here.force).norm();
        if (mismatch > worst)
          {
            worst = mismatch;
            where = n;
          }
      }
    if (worst <= largest_mismatch * sum)
      return {};
    std::ostringstream cause;
    cause << this->name() << ": the node at ("
          << this->fields.patch[0]->node_position(this->nodes()[where].node[0])
          << ") goes to and fro between its states; what it would take, " << worst
          << " N, is too much of all forces to be let be";
    return Answer::failure(cause.str());
  }



  template <int dim>
  void
  NodalLawTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    std::vector<bool> is_used(multipliers.size(), false);
    for (std::size_t n = 0; n < this->nodes().size(); ++n)
      {
        const ContactNode<dim>  &node = this->nodes()[n];
        const NodalResponse<dim> here = response(n, trial);
        dealii::Tensor<2, dim>   slope;
        for (unsigned int i = 0; i < node.n_directions; ++i)
          for (unsigned int j = 0; j < node.n_directions; ++j)
            slope += here.force_by_displacement[i][j] *
                     outer_product(node.direction[i], node.direction[j]);
        this->add_slope(node, node, slope, tangent);
        for (unsigned int i = 0; has_multipliers && i < node.n_directions; ++i)
          {
            is_used[n * multipliers.per_node + i] = true;
            add_multiplier(n, i, here, tangent);
          }
      }
    multipliers.hold_unused(is_used, law.stiffness, tangent);
  }



  template <int dim>
  void
  NodalLawTerm<dim>::add_multiplier(const std::size_t         n,
                                    const unsigned int        i,
                                    const NodalResponse<dim> &response,
                                    Tangent<dim>             &tangent) const
  {
    const ContactNode<dim> &node = this->nodes()[n];
    dealii::Tensor<1, dim>  force, constraint; // by l_i; of C_i by D
    for (unsigned int j = 0; j < node.n_directions; ++j)
      {
        force += law.stiffness * response.force_by_multiplier[j][i] * node.direction[j];
        constraint += response.constraint_by_displacement[i][j] * node.direction[j];
        tangent.add(multiplier(n, i),
                    multiplier(n, j),
                    law.stiffness * response.constraint_by_multiplier[i][j]);
      }
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const UnknownIndex u{this->fields.number[k], node.node[k], d};
          tangent.add(u, multiplier(n, i), k == 0 ? -force[d] : force[d]);
          tangent.add(multiplier(n, i), u, k == 0 ? constraint[d] : -constraint[d]);
        }
  }

  template class NodalLawTerm<2>;
  template class NodalLawTerm<3>;
} // namespace kedge
