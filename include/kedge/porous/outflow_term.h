#ifndef kedge_porous_outflow_term_h
#define kedge_porous_outflow_term_h

#include <kedge/equations/term.h>
#include <kedge/porous/pore_points.h>
#include <kedge/transfer/motion_term.h>

namespace kedge
{
  /**
   * What material takes with it that leaves the grid through its open sides: mass, momentum and
   * energy of the points that have gone, as they were at the end of the step that brought them
   * out. It has no residual; there is one only in scenes with open sides.
   *
   * With the energy goes what the points had dissipated by yielding, which `plastic_dissipation`,
   * a sum over the points that are there, does not hold any more. The energy of the run is then
   *   total energy + dissipated + gone = energy at the start + external work.
   */
  template <int dim>
  class OutflowTerm : public Term<dim>
  {
  public:
    /**
     * @param soils   one per body of saturated scenes; else empty
     * @param motions of all fields, which stand before this term
     * @param fluid_moves whether the fluid has a velocity of its own
     */
    OutflowTerm(const std::vector<Soil>                    &soils,
                const std::vector<const MotionTerm<dim> *> &motions,
                const bool                                  fluid_moves,
                const MPI_Comm                              communicator);

    std::string
    name() const override
    {
      return "outflow";
    }

    void
    declare_books(Ledger &ledger) override;

    /** Refuses a step after which no field has a point left (collective). */
    Answer
    finish(const Trial<dim> &trial) override;

    void
    book_outflow(const std::vector<PointRecord<dim>> &gone, Ledger &ledger) const override;

  private:
    const std::vector<Soil>                    soils;
    const std::vector<const MotionTerm<dim> *> motions;
    const bool                                 fluid_moves;
    const MPI_Comm                             communicator;
    Ledger::Index energy = 0, momentum[dim] = {}, mass = 0, n_points = 0, fluid_mass = 0;
  };
} // namespace kedge

#endif
