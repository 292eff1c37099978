#ifndef kedge_contact_contact_books_h
#define kedge_contact_contact_books_h

#include <kedge/contact/contact_law.h>
#include <kedge/equations/ledger.h>
#include <kedge/grid/lattice.h>
#include <kedge/surfaces/body_surface.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace kedge
{
  /** What a place of contact, the middle of a facet, has done in a step. */
  template <int dim>
  struct ContactPlace
  {
    const BodySurface<dim> *surface  = nullptr; ///< of the facet
    unsigned int            facet    = 0;
    int                     partner  = 0;    ///< body that is met, or ContactPicture's wall
    bool                    on_first = true; ///< whether the facet is one of the first bodies
    dealii::Point<dim>      at;            ///< where the force acts, in the balance's configuration
    dealii::Tensor<1, dim>  force;         ///< on the first body [N]
    double                  area     = 0.; ///< that it stands for; of the start, then of now
    double                  pressure = 0.; ///< [Pa]
    double                  gap      = 0.; ///< at the end of the step [m]
    double                  friction = 0.; ///< energy dissipated in the step [J]
    dealii::Tensor<1, dim>  slip_rate;     ///< along the surface, of the facet [m/s]
    bool                    sticks = false;

    /** Takes what the law has answered to a relative displacement of the facet in a step, per area
     * at the start of the run; goes over to the present area. */
    void
    set_response(const ContactResponse<dim>   &response,
                 const dealii::Tensor<1, dim> &normal,
                 const dealii::Tensor<1, dim> &displacement,
                 const double                  dt);
  };

  /** A column of a contact, named after what it holds and after the contact. */
  Ledger::Entry
  contact_column(const std::string &what,
                 const std::string &unit,
                 const Ledger::Kind kind,
                 const std::string &contact);

  /** The columns of what a contact does to its first bodies: force, and moment about the origin. */
  template <int dim>
  class ResultantBooks
  {
  public:
    /** A sum of forces at places. */
    struct Sum
    {
      double force[3] = {0, 0, 0}, moment[3] = {0, 0, 0};

      void
      add(const dealii::Point<dim> &at, const dealii::Tensor<1, dim> &force);
    };

    void
    declare(Ledger &ledger, const std::string &contact);

    void
    book(Ledger &ledger, const Sum &sum) const;

  private:
    Ledger::Index force[dim], moment[3];
  };

  /**
   * What a contact between surfaces says of itself in the books. All ranks know all places; one of
   * them, which keeps the books, passes them on.
   */
  template <int dim>
  class ContactBooks
  {
  public:
    /** @param communicator of all ranks that know the places */
    explicit ContactBooks(const MPI_Comm &communicator)
      : kept_here(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {}

    bool
    are_kept_here() const
    {
      return kept_here;
    }

    void
    declare(Ledger &ledger, const std::string &pair);

    /**
     * Books a step of size @p dt.
     *
     * @param released stored energy of places that were lost [J]
     * @param lattice  in whose cells pressures are means: a single place's is not resolved
     */
    void
    book(Ledger                               &ledger,
         const std::vector<ContactPlace<dim>> &places,
         const double                          released,
         const double                          dt,
         const Lattice<dim>                   &lattice) const;

    /** Books a state that stores so much energy [J]. */
    void
    book_state(Ledger &ledger, const double stored) const;

  private:
    struct Columns
    {
      Ledger::Index energy, friction, released, area, stick_area, pressure, overlap, duration;
    };

    const bool          kept_here;
    Columns             columns{};
    ResultantBooks<dim> resultant{};
  };
} // namespace kedge

#endif
