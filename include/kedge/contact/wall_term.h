#ifndef kedge_contact_wall_term_h
#define kedge_contact_wall_term_h

#include <kedge/base/expression.h>
#include <kedge/base/load_program.h>
#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/closed_contact.h>
#include <kedge/contact/contact_picture.h>
#include <kedge/contact/coupling_sum.h>
#include <kedge/contact/shear_limit.h>
#include <kedge/equations/term.h>
#include <kedge/surfaces/facet_means.h>

namespace kedge
{
  /** A plane that bodies do not pass. */
  template <int dim>
  struct WallPlane
  {
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> normal; ///< unit vector towards the bodies

    double
    gap(const dealii::Point<dim> &x) const
    {
      return normal * (x - point);
    }
  };

  /** How far a wall has moved since the start. */
  template <int dim>
  struct WallMotion
  {
    std::vector<Expression> components; ///< of t [m]; empty: it stands
    LoadProgram             program;

    bool
    moves() const
    {
      return !components.empty();
    }

    dealii::Tensor<1, dim>
    displacement(const double t) const
    {
      dealii::Tensor<1, dim> result;
      for (std::size_t d = 0; d < components.size(); ++d)
        result[d] = components[d]({program.time(t)});
      return result;
    }
  };

  /** A body that may touch a wall, and how stiff the contact is. */
  template <int dim>
  struct WallBody
  {
    const BodySurface<dim> *surface;
    double                  normal_stiffness, tangent_stiffness; ///< [Pa/m]
    bool                    carries_water = false;               ///< whether it is saturated
    const Material         *clay          = nullptr;             ///< if it has an s_u
  };

  /**
   * Contact of bodies with a rigid plane, which may move: a surface's facets that look towards it
   * are samples, and the law is contact_response() with the mean displacement of the facet less
   * that of the wall over the step, w,
   *   R -= sum of A B^T (p n + t),   D = B u - w.
   * The gap n.(x - x_wall) is linear in D, so that the carried gap of conserving steps is the
   * measured one. The wall's work is sum of A (p n + t).w. Without inertia the pressures are found
   * by Uzawa's iteration, as in ContactTerm.
   */
  template <int dim>
  class WallTerm
    : public Term<dim>
    , public ShownContact<dim>
  {
  public:
    /** In parts of a cell: how near samples matter, how deep they may come, where bodies that do
     * not press yet are held in the tangent. */
    static constexpr double reach = 1., largest_overlap = 0.5, nearly_closed = 0.05;

    /** Facets look towards the wall whose normals have at least this part against it. */
    static constexpr double towards = 0.05;

    /** Numbers that a checkpoint holds of a closed facet. */
    static constexpr std::size_t width_of_record = 3 + dim;

    WallTerm(const ContactParameters             &parameters,
             const WallPlane<dim>                &plane,
             const WallMotion<dim>               &motion,
             const std::vector<WallBody<dim>>    &bodies,
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

    /** @throws UserError for bodies that lie behind the wall */
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
    using Closed = ClosedContact<dim>;
    using Memory = std::map<unsigned int, Closed>; ///< by facet

    struct Sample
    {
      unsigned int       facet;
      dealii::Point<dim> place; ///< at the start of the step
      Closed             start;
      double             area;             ///< at the start of the run
      double             shear_limit = 0.; ///< there, per area at the start of the run [Pa]
      double             stretch     = 1.; ///< of its area since then

      dealii::Tensor<1, dim> D = {}; ///< displacement over the step, mean over the facet [m]
    };

    struct Side
    {
      const BodySurface<dim> *surface;
      ContactLaw              law;
      bool                    carries_water;
      const Material         *clay;
      std::vector<double>     strengths; ///< of the vertices, s_u; empty: none [Pa]
      std::vector<Sample>     samples;
      FacetMeans<dim>         means;
      std::vector<double>     pore_pressures; ///< of the vertices, of the balance [Pa]
      Memory                  memory, end_of_step;
    };

    void
    find(Side &side) const;
    void
    move(const Trial<dim> &trial);
    WallPlane<dim>
    plane_at(const double t) const
    {
      return {plane_at_rest.point + motion.displacement(t), plane_at_rest.normal};
    }
    typename CouplingSum<dim>::Coefficients
    pressure_functions(const Side &side, const Sample &sample) const;
    ContactResponse<dim>
    response(const Side &side, const Sample &sample) const;
    static double
    stored(const ContactLaw &law, const Closed &closed);
    static double
    stored(const Side &side, const Memory &memory);
    bool
    presses() const;
    ContactPlace<dim>
    place_of(const Side &side, const Sample &sample, const double dt) const;
    dealii::Point<dim>
    middle(const Side &side, const unsigned int facet) const;

    const ContactParameters        parameters;
    const WallPlane<dim>           plane_at_rest; ///< before it has moved
    const WallMotion<dim>          motion;
    WallPlane<dim>                 plane;    ///< at the start of the step
    dealii::Tensor<1, dim>         moves_by; ///< in the step [m]
    const double                   cell_size, alpha;
    const bool                     at_rest;
    ShearLimit<dim>                shear_limit;
    std::vector<Side>              sides;                    ///< one per body
    std::vector<ContactPlace<dim>> places, committed_places; ///< of the attempt, of the last step
    double              released = 0.; ///< energy of samples that no longer look here [J]
    UzawaIteration<dim> uzawa;
    ContactBooks<dim>   books;
    Ledger::Index       work = 0; ///< of the wall, if it moves
  };
} // namespace kedge

#endif
