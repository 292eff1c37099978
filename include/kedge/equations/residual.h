#ifndef kedge_equations_residual_h
#define kedge_equations_residual_h

#include <kedge/equations/tangent.h>
#include <kedge/equations/unknowns.h>
#include <kedge/fields/patch.h>

namespace kedge
{
  /**
   * The residual of all balances, summed term by term. A term adds sums over
   * the points of this rank to partial(), which are then restricted by the constraints and
   * added to the nodes' owners; or what it knows complete at the owned nodes to complete().
   * With them comes the size of what cancels in the residual, of which its
   * round-off is a fraction: the norm of the term's own sums, or what it says itself.
   */
  template <int dim>
  class Residual
  {
  public:
    Residual(const std::vector<const Patch<dim> *> &patches,
             const Unknowns<dim>                   &unknowns,
             const Tangent<dim>                    &tangent);

    /** Takes the nodes of a new configuration. */
    void
    reinit();

    /** Begins a new sum. */
    void
    set_zero();

    /** n_components sums per local node of a field, of this rank's points. */
    std::vector<double> &
    partial(const unsigned int field)
    {
      fields[field].is_partial = true;
      return fields[field].of_term;
    }

    /** The same, complete at the owned nodes. */
    std::vector<double> &
    complete(const unsigned int field)
    {
      fields[field].is_complete = true;
      return fields[field].of_term;
    }

    /** Of the unknowns that belong to no node: this rank's share. */
    std::vector<double> &
    others()
    {
      return others_;
    }

    /**
     * A share of the square of the size of a part of the present term, in
     * Newton's norm; without it the norm of the term's sums is taken. Every rank
     * must call it as often.
     */
    void
    add_square(const double square);

    /** Ends the sums of one term (collective). */
    void
    end_term();

    /**
     * Ends the residual: its norm, and the size of its terms (collective).
     *
     * @param diagonal of the last tangent, by field and equation; see Unknowns::Field
     * @param n_failed terms of this rank that have no answer
     */
    NewtonProblem::Evaluation
    end(const std::vector<std::vector<double>> &diagonal,
        const UnknownVector                    &x,
        const unsigned int                      n_failed);

    /** The residual at the owned nodes of a field, at prescribed components too. */
    const std::vector<double> &
    of_field(const unsigned int field) const
    {
      return fields[field].sum;
    }

    const UnknownVector
    all() const;

  private:
    struct Field
    {
      std::vector<double> of_term, sum;
      bool                is_partial = false, is_complete = false;
    };

    const std::vector<const Patch<dim> *> patches;
    const Unknowns<dim>                  &unknowns;
    const Tangent<dim>                   &tangent;
    std::vector<Field>                    fields;
    std::vector<double>                   others_;
    std::vector<double>                   squares; ///< shares of this rank
    bool                                  has_square = false;
  };
} // namespace kedge

#endif
