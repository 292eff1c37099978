#ifndef kedge_contact_contact_books_h
#define kedge_contact_contact_books_h

#include <kedge/equations/ledger.h>
#include <kedge/grid/lattice.h>

#include <string>
#include <vector>

namespace kedge
{
  /** What a place of contact has done in a step. */
  template <int dim>
  struct ContactPlace
  {
    dealii::Point<dim>     at;            ///< where the force acts, in the balance's configuration
    dealii::Tensor<1, dim> force;         ///< on the first body [N]
    double                 area     = 0.; ///< that it stands for
    double                 pressure = 0.; ///< [Pa]
    double                 overlap  = 0.; ///< [m]
    double                 friction = 0.; ///< energy dissipated in the step [J]
  };

  /** What a contact between surfaces says of itself in the books. */
  template <int dim>
  class ContactBooks
  {
  public:
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
      Ledger::Index energy, friction, released;
      Ledger::Index force[dim], moment[3], area, pressure, overlap, duration;
    };

    Columns columns{};
  };
} // namespace kedge

#endif
