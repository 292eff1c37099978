#ifndef kedge_source_solvers_bordered_preconditioner_h
#define kedge_source_solvers_bordered_preconditioner_h

#include "preconditioner.h"

#include <memory>

namespace kedge
{
  /**
   * A preconditioner of a system on one rank whose last equations are a border: few unknowns that
   * couple with many others, as the motion of rigid bodies and the multipliers of joints do,
   *   [A  B] [x]   [b]
   *   [C  D] [z] = [c].
   * With P for A, another preconditioner, its inverse is taken block by block:
   *   y = P^-1 b,   z = S^-1 (c - C y),   x = y - P^-1 B z,   S = D - C P^-1 B.
   * S is small and dense. It and the border are of the present matrix, even if P is of an
   * earlier one: contacts that open or close change them most.
   */
  class BorderedPreconditioner : public Preconditioner
  {
  public:
    /** @param inner of A  @param n_border number of the last equations */
    BorderedPreconditioner(std::unique_ptr<Preconditioner> inner, const unsigned int n_border);

    void
    analyse(const SparseSystem &system) override;

    void
    factorise(const DistributedMatrix &matrix) override;

    void
    follow(const DistributedMatrix &matrix) override;

    void
    multiply(const DistributedMatrix &matrix, const double *x, double *y) override;

  private:
    void
    take_values(const DistributedMatrix &matrix);
    void
    find_schur_complement(const DistributedMatrix &matrix);
    void
    factorise_schur_complement();
    void
    solve_schur_complement(std::vector<double> &z) const;
    double
    product_with_row(const DistributedMatrix &matrix,
                     const unsigned int       row,
                     const double            *x) const;

    const std::unique_ptr<Preconditioner> inner;
    const unsigned int                    n_border;
    unsigned int                          n_inside = 0;
    SparseSystem                          inside;        ///< A
    DistributedMatrix                     inside_matrix; ///< the same, scaled
    std::vector<std::vector<double>>      columns;       ///< P^-1 B, scaled
    std::vector<double>                   schur;         ///< S by rows, then its LU factors
    std::vector<unsigned int>             pivots;        ///< the row taken in each step
  };
} // namespace kedge

#endif
