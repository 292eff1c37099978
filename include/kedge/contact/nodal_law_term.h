#ifndef kedge_contact_nodal_law_term_h
#define kedge_contact_nodal_law_term_h

#include <kedge/contact/multiplier_pool.h>
#include <kedge/contact/nodal_law.h>

namespace kedge
{
  /**
   * Contact at common nodes by a law of each node's own displacement and multipliers: penalties,
   * multipliers, the augmented Lagrangian (5.78), (5.99), (5.104). Multipliers are unknowns of the
   * step, lambda = r l, so that l [m] and the constraint C [N] measure as displacements and forces
   * do.
   */
  template <int dim>
  class NodalLawTerm : public NodalContactTerm<dim>
  {
  public:
    /** How often a node may open in a step: with multipliers alone nothing keeps it open. */
    static constexpr unsigned int most_openings = 4;

    /**
     * A node that has changed its state more often in a step is held: sticking if it went to and
     * fro between that and sliding, else open. What the law then still asks for, as a part of all
     * forces, must be less than this, or the step is not accepted.
     */
    static constexpr unsigned int most_changes     = 4;
    static constexpr double       largest_mismatch = 1e-3;

    NodalLawTerm(const ContactParameters  &parameters,
                 const ContactFields<dim> &fields,
                 const NodalLaw           &law);

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    void
    reach(const unsigned int field, std::vector<unsigned char> &reached) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    Answer
    finish(const Trial<dim> &trial) override;

    std::vector<dealii::Tensor<1, dim>>
    forces(const Trial<dim> &trial) const override;

    /** What the law answers at a node, by its number among nodes(). */
    NodalResponse<dim>
    response(const std::size_t node, const Trial<dim> &trial) const
    {
      return response(node, trial, states[node].hold);
    }

  private:
    /** What became of a node in this step. */
    struct State
    {
      bool                   closed = false, slides = false; ///< in the last residual
      dealii::Tensor<1, dim> force;                          ///< likewise
      unsigned int           n_openings = 0, n_changes = 0;
      NodalHold              hold = NodalHold::none;
    };

    NodalResponse<dim>
    response(const std::size_t node, const Trial<dim> &trial, const NodalHold hold) const;
    bool
    follow(const NodalResponse<dim> &response, State &state) const;
    Answer
    parting(const std::size_t node) const;
    void
    add_multiplier(const std::size_t         node,
                   const unsigned int        direction,
                   const NodalResponse<dim> &response,
                   Tangent<dim>             &tangent) const;

    const NodalLaw           law;
    const NodalFunction<dim> function;
    const bool               has_multipliers, opens_by_gap;

    /** Number of a node's multiplier, by node and direction. */
    UnknownIndex
    multiplier(const std::size_t node, const unsigned int direction) const
    {
      return UnknownIndex::other(multipliers.number(node, direction));
    }

    MultiplierPool<dim> multipliers;
    std::vector<State>  states; ///< of the nodes
  };
} // namespace kedge

#endif
