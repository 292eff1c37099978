#ifndef kedge_contact_tool_term_h
#define kedge_contact_tool_term_h

#include <kedge/contact/contact_picture.h>
#include <kedge/contact/direction_updates.h>
#include <kedge/contact/tool_edges.h>
#include <kedge/contact/tool_penetration.h>
#include <kedge/contact/tool_samples.h>
#include <kedge/equations/term.h>

namespace kedge
{
  /**
   * Contact of bodies with a rigid body, the tool: the middles of their surfaces' facets are
   * samples, R -= sum of A B^T (p n + t),   D = B x, with D the displacement of a sample less that
   * of its partner on the tool, which is of the nodes and of the tool's unknowns; the tool bears
   * the opposite forces, and what they do is in the books to round-off (RigidBodies). Directions
   * follow the first corrections of Newton's method, are then held fixed, and taken anew once the
   * equations are solved, until the forces change no more than a little; at rest pressures are
   * found by Uzawa's iteration, both as in ContactTerm.
   */
  template <int dim>
  class ToolTerm
    : public Term<dim>
    , public ShownContact<dim>
  {
  public:
    /** As of ContactTerm: in parts of a cell. */
    static constexpr double reach = 1., largest_overlap = 0.5, nearly_closed = 0.05;

    /**
     * @param touching  bodies whose surfaces may meet the tool
     * @param rigid     must last as long as this
     * @param tool      its number among the rigid bodies
     * @param constants of the scene's expressions
     * @throws UserError for a tool without a shape
     */
    ToolTerm(const ContactParameters             &parameters,
             const std::vector<WallBody<dim>>    &touching,
             RigidBodies<dim>                    &rigid,
             const unsigned int                   tool,
             const std::map<std::string, double> &constants,
             const Scheme                        &scheme,
             const double                         cell_size);

    std::string
    name() const override
    {
      return "contact '" + parameters.name + "'";
    }

    void
    declare_books(Ledger &ledger) override;

    /** @throws UserError for bodies that the tool stands in */
    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    activate(const MaterialPoints<dim> &points) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    bool
    refresh(const Trial<dim> &trial) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

    void
    save(SavedState &state) const override;

    void
    restore(const SavedState &state) override;

    void
    show(ContactPicture<dim> &picture) const override;

  private:
    using Sample = typename ToolSide<dim>::Sample;

    void
    move(const Trial<dim> &trial);
    bool
    presses() const;
    std::vector<std::vector<dealii::Tensor<1, dim>>>
    forces() const;
    void
    add_sample(const ToolSide<dim>        &side,
               const Sample               &sample,
               const ContactResponse<dim> &response,
               const bool                  to_be_held,
               Tangent<dim>               &tangent) const;
    Answer
    too_deep(const ToolSide<dim> &side, const Sample &sample, const double overlap) const;
    Answer
    finish(ToolSide<dim> &side, const double dt);
    ContactPlace<dim>
    place_of(const ToolSide<dim> &side, const Sample &sample, const double dt) const;

    const ContactParameters                 parameters;
    RigidBodies<dim>                       &rigid;
    const unsigned int                      tool;
    const double                            cell_size;
    const bool                              at_rest;
    ShearLimit<dim>                         shear_limit;
    std::unique_ptr<const FacetSearch<dim>> search; ///< in the tool's axes
    std::vector<SharpPlace<dim>>            edges;  ///< in the tool's axes
    /** Of each body two: its surface's facets and the tool's edges. */
    std::vector<std::unique_ptr<ToolSide<dim>>> sides;
    std::vector<ContactPlace<dim>> places, committed_places; ///< of the attempt, of the last step
    double              released = 0.; ///< energy of samples that no longer look here [J]
    DirectionUpdates    directions;
    UzawaIteration<dim> uzawa;
    ContactBooks<dim>   books;
    std::unique_ptr<ToolPenetration<dim>> penetration;
  };
} // namespace kedge

#endif
