#ifndef kedge_contact_nodal_contact_term_h
#define kedge_contact_nodal_contact_term_h

#include <kedge/contact/contact_books.h>
#include <kedge/contact/parameters.h>
#include <kedge/equations/term.h>

#include <array>

namespace kedge
{
  /** Two fields and which of their bodies may touch. */
  template <int dim>
  struct ContactFields
  {
    std::array<unsigned int, 2>       number;
    std::array<const Patch<dim> *, 2> patch;
    std::array<std::vector<bool>, 2>  takes_part; ///< one per body of the scene
  };

  /** A node that both fields have in this step. */
  template <int dim>
  struct ContactNode
  {
    std::array<unsigned int, 2> node; ///< local number in each field

    /**
     * The normal away from the first body, then the directions along the surface; all of them
     * across what holds both bodies.
     */
    std::array<dealii::Tensor<1, dim>, dim> direction;
    unsigned int                            n_directions = 0;

    /** Components of a vector in these directions. */
    dealii::Tensor<1, dim>
    components(const dealii::Tensor<1, dim> &vector) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int i = 0; i < n_directions; ++i)
        result[i] = direction[i] * vector;
      return result;
    }

    dealii::Tensor<1, dim>
    vector(const dealii::Tensor<1, dim> &components) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int i = 0; i < n_directions; ++i)
        result += components[i] * direction[i];
      return result;
    }
  };

  /**
   * The nodes that two fields share, with unbiased normals (5.75)-(5.77): n along n^x - n^y, n^x
   * the direction of sum m grad N over the points of the first field, n^y over those of the second.
   * They are those of the start of the step. Nodes where neither field has a direction, or where
   * both are held along the normal, are left out.
   *
   * @param along_surface whether the directions along the surface are wanted too
   */
  template <int dim>
  std::vector<ContactNode<dim>>
  find_contact_nodes(const ContactFields<dim> &fields, const bool along_surface);

  /** Whether a component of either field at a common node depends on unknowns. */
  template <int dim>
  bool
  is_free(const ContactFields<dim>          &fields,
          const std::array<unsigned int, 2> &node,
          const unsigned int                 component);

  /**
   * Contact at common nodes of the grid, as in Pretti (2024), section 5.3.1.1: the nodes that both
   * fields have at the start of a step are pairs, and a law gives the force F on the first
   * body's,
   *   R_A -= F,   R_B += F.
   * What derives from this says what the forces are and how they depend on the unknowns.
   *
   * Books: the work -F.D that the contact takes is `friction_dissipation` along the surface, else
   * `contact_dissipation`, which is 0 for exact methods.
   */
  template <int dim>
  class NodalContactTerm : public Term<dim>
  {
  public:
    NodalContactTerm(const std::string        &pair,
                     const ContactFields<dim> &fields,
                     const double              alpha,
                     const bool                has_friction)
      : pair(pair)
      , fields(fields)
      , alpha(alpha)
      , has_friction(has_friction)
    {}

    std::string
    name() const override
    {
      return "contact '" + pair + "'";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    const std::vector<ContactNode<dim>> &
    nodes() const
    {
      return nodes_;
    }

    /** On the first body at each of the nodes [N]. */
    virtual std::vector<dealii::Tensor<1, dim>>
    forces(const Trial<dim> &trial) const = 0;

  protected:
    /** Displacement of the first body less that of the second over the step [m]. */
    dealii::Tensor<1, dim>
    relative_displacement(const ContactNode<dim> &node, const Trial<dim> &trial) const;

    /** Adds the slopes of a force on the first body at @p at with D at @p from. */
    void
    add_slope(const ContactNode<dim>       &at,
              const ContactNode<dim>       &from,
              const dealii::Tensor<2, dim> &slope,
              Tangent<dim>                 &tangent) const;

    const std::string        pair;
    const ContactFields<dim> fields;
    const double             alpha; ///< part of the step of the balance
    const bool               has_friction;

  private:
    struct Columns
    {
      Ledger::Index lost, friction, n_nodes, duration;
    };

    std::vector<ContactNode<dim>> nodes_;
    Columns                       columns{};
    ResultantBooks<dim>           resultant{};
  };
} // namespace kedge

#endif
