#ifndef kedge_solvers_mixed_preconditioner_h
#define kedge_solvers_mixed_preconditioner_h

#include "multigrid.h"
#include "preconditioner.h"

#include <kedge/solvers/mixed_blocks.h>

namespace kedge
{
  /**
   * The block triangular preconditioner of a scaled system in displacements
   * and pressures,
   *   p = S^-1 r_p,  u = A^-1 (r_u - G p),
   * by one W-cycle of multigrid for each inverse. A's coarse levels keep the
   * rigid motions. S^-1 = (C + X_s)^-1 + (C + X_i)^-1 with X_s, X_i in place of
   * the Schur complement of stiffness and of inertia: of the two the smaller
   * counts (Cahouet and Chabert 1988). It is never off by more than a factor
   * of two for what C, with permeability, compressibility and stabilisation,
   * decides. Without pressures it is A's cycle alone.
   */
  class MixedPreconditioner : public Preconditioner
  {
  public:
    /** @p blocks must last as long as this; their matrices may change with each system. */
    explicit MixedPreconditioner(const MixedBlocks &blocks)
      : blocks(blocks)
    {}

    /** Finds out which equations are which (collective). */
    void
    analyse(const SparseSystem &system) override;

    /** Sets up the multigrids of new values (collective); may throw. */
    void
    factorise(const DistributedMatrix &matrix) override;

    /** y = P^-1 x; @p matrix gives G (collective). */
    void
    multiply(const DistributedMatrix &matrix, const double *x, double *y) override;

  private:
    std::unique_ptr<Epetra_CrsMatrix>
    displacement_matrix(const DistributedMatrix &matrix) const;
    std::unique_ptr<Epetra_CrsMatrix>
    pressure_matrix(const DistributedMatrix &matrix, const SparseSystem &added) const;
    std::vector<double>
    rigid_motions(const DistributedMatrix &matrix) const;
    void
    multiply_pressures(const DistributedMatrix &matrix, const double *x);

    const MixedBlocks &blocks;
    int                dim = 2;

    /**
     * Place of each global equation among the pressures, or -1 - its place
     * among the displacements, of which each node has dim, unknown or not.
     */
    std::vector<int> place;
    int              n_pressures = 0, first_pressure = 0, n_global_pressures = 0;
    int              n_displacements = 0, first_displacement = 0, n_global_displacements = 0;

    Multigrid           displacements, pressures, inertial_pressures;
    bool                with_inertia = false;
    std::vector<double> u, p, more, residual_u, residual_p, padded, product;
  };
} // namespace kedge

#endif
