#ifndef kedge_contact_contact_term_h
#define kedge_contact_contact_term_h

#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/contact_picture.h>
#include <kedge/contact/coupling_sum.h>
#include <kedge/contact/direction_updates.h>
#include <kedge/contact/parameters.h>
#include <kedge/contact/surface_samples.h>
#include <kedge/equations/term.h>

namespace kedge
{
  /** Two bodies that may touch, and how stiff the contact between them is. */
  template <int dim>
  struct ContactBodies
  {
    const BodySurface<dim>         *first, *second;
    double                          normal_stiffness, tangent_stiffness; ///< [Pa/m]
    std::array<bool, 2>             carry_water = {{false, false}}; ///< whether they are saturated
    std::array<const Material *, 2> clay        = {{nullptr, nullptr}}; ///< where it has an s_u
  };

  /**
   * Contact between the surfaces of two groups of bodies, by samples on both of them, each half:
   *   R -= sum of A B^T (p n + t),   D = B u
   * with D the relative displacement of a sample and its partner over the step, and the law
   * contact_response(). Directions and partners are those of the balance's configuration, first
   * of a predicted one; they follow the first corrections of Newton's method and are then held
   * fixed; once the equations are solved they are taken anew until the forces change no more than
   * a little.
   *
   * Without inertia the balance is that of the step's end, and the pressures are found by Uzawa's
   * iteration, cell by cell (CellMultipliers), until gaps are small in the mean of each cell.
   */
  template <int dim>
  class ContactTerm
    : public Term<dim>
    , public ShownContact<dim>
  {
  public:
    /** In parts of a cell: how far partners are looked for, how deep surfaces may overlap. */
    static constexpr double reach = 1., largest_overlap = 0.5;

    /** Bodies at rest that do not press yet are held, in the first tangent, where gaps are smaller
     * than this part of a cell. */
    static constexpr double nearly_closed = 0.05;

    /**
     * @param bodies    each of one group with each of the other
     * @param constants of the scene's expressions
     * @param cell_size the smallest of the grid [m]
     */
    ContactTerm(const ContactParameters               &parameters,
                const std::vector<ContactBodies<dim>> &bodies,
                const std::map<std::string, double>   &constants,
                const Scheme                          &scheme,
                const double                           cell_size);

    std::string
    name() const override
    {
      return "contact '" + parameters.name + "'";
    }

    void
    declare_books(Ledger &ledger) override;

    /** @throws UserError for bodies that overlap by more than a surface can have come by contact */
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

    /** The halves of each pair of bodies: samples on the first body's surface, on the second's. */
    const std::vector<SurfaceSamples<dim>> &
    halves() const
    {
      return passes;
    }

  private:
    using Forces = std::vector<dealii::Tensor<1, dim>>;
    using Memory = ContactMemory<dim>;

    MovingSurface<dim> &
    moving(const ContactBodies<dim> &pair, const unsigned int which);
    void
    read_pore_pressures(const Trial<dim> &trial);
    void
    add_pressure_slope(const SurfaceSamples<dim>                     &half,
                       const typename SurfaceSamples<dim>::Sample    &sample,
                       const typename CouplingSum<dim>::Coefficients &forces,
                       const dealii::Tensor<1, dim>                  &by_pressure,
                       CouplingSum<dim>                              &sum) const;
    std::vector<Forces>
    sample_forces() const;
    void
    move_surfaces(const Trial<dim> &trial);
    bool
    touches() const;
    bool
    presses() const;
    std::vector<ContactPlace<dim>>
    places_of_step(const double dt) const;

    const ContactParameters                          parameters;
    const double                                     cell_size;
    const double                                     alpha; ///< part of the step of the balance
    const bool                                       at_rest;
    ShearLimit<dim>                                  shear_limit;
    std::vector<std::unique_ptr<MovingSurface<dim>>> surfaces;
    std::vector<SurfaceSamples<dim>> passes; ///< first on second, second on first ..
    std::vector<Memory>              end_of_step;
    std::vector<ContactPlace<dim>>   places, committed_places; ///< of the attempt, of the last step
    double                           released = 0.;            ///< energy lost track of [J]
    DirectionUpdates                 directions;
    UzawaIteration<dim>              uzawa;
    ContactBooks<dim>                books;
  };
} // namespace kedge

#endif
