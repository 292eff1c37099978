#ifndef kedge_transfer_motion_term_h
#define kedge_transfer_motion_term_h

#include <kedge/equations/term.h>
#include <kedge/grid/open_sides.h>
#include <kedge/transfer/motion_transfer.h>

namespace kedge
{
  /**
   * The motion of a field's points: where a step takes them and how fast they are then.
   * It has no residual. A step that takes a point out of the background grid is
   * refused, but for open sides of the grid. Books kinetic energy, momenta, mass and counts; if the
   * scene has several fields, energy and momenta of each field too.
   */
  template <int dim>
  class MotionTerm : public Term<dim>
  {
  public:
    /** @param transfer of the field's velocities; nullptr in quasi-static runs */
    MotionTerm(const unsigned int    field,
               const Patch<dim>     &patch,
               MotionTransfer<dim>  *transfer,
               const OpenSides<dim> &open_sides = OpenSides<dim>());

    std::string
    name() const override
    {
      return "motion";
    }

    void
    declare_books(Ledger &ledger) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

    /** Displacements of the points in the step that finish() has seen, by slot [m]. */
    const std::vector<dealii::Tensor<1, dim>> &
    displacements() const
    {
      return point_displacements;
    }

    /** How many of this rank's points stay in the grid in the step that finish() has seen; found
     * if it has open sides. */
    unsigned int
    n_staying() const
    {
      return n_staying_;
    }

  private:
    /** How many points stay in the grid. */
    unsigned int
    count_staying() const;
    /** Why a point cannot move as far as the equations say. */
    std::string
    describe_jump(const unsigned int slot) const;

    /** Momenta have their components in x, y, z; in 2D the angular one z alone. */
    struct Columns
    {
      Ledger::Index kinetic_energy, mapping_dissipation, linear_momentum[3], angular_momentum[3];
      Ledger::Index mass, n_points, n_active_cells, min_det_F;
    };

    const unsigned int                  field;
    const Patch<dim>                   &patch;
    MotionTransfer<dim>                *transfer;
    const OpenSides<dim>                open_sides;
    std::vector<dealii::Tensor<1, dim>> point_displacements;
    unsigned int                        n_staying_ = 0;
    Columns                             columns{};
  };
} // namespace kedge

#endif
