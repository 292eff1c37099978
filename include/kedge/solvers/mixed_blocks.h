#ifndef kedge_solvers_mixed_blocks_h
#define kedge_solvers_mixed_blocks_h

#include <kedge/solvers/sparse_system.h>

namespace kedge
{
  /**
   * What a block preconditioner needs to know of a system in displacements u
   * and pressures p,
   *   [A  G] [u]
   *   [D  C] [p],
   * whose Schur complement C - D A^-1 G it replaces with C and the given
   * matrices. Rows are those of this rank, the components of a node together.
   */
  struct MixedBlocks
  {
    int                        dim = 2;
    std::vector<unsigned char> component; ///< of each row of a node: dim is the pressure
    std::vector<double>        position;  ///< of each row's node, dim coordinates [m]

    /** Rows of unknowns that belong to no node, behind all others; on one rank only. */
    unsigned int n_others = 0;

    /**
     * What stands for -D A^-1 G where stiffness determines A, a matrix of the
     * pressures in their order [m^3/Pa].
     */
    SparseSystem by_stiffness;

    /** The same where inertia does; without rows in quasi-static systems. */
    SparseSystem by_inertia;
  };
} // namespace kedge

#endif
