#include "lattice_multigrid.h"

#include "backend.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace kedge
{
  namespace
  {
    /** Systems of this size are solved directly. */
    constexpr unsigned int smallest_size = 600;

    /** A level that is not smaller than this part of the finer one ends the coarsening. */
    constexpr double too_large = 0.7;

    /** Raises the diagonal of 1 of the smallest level, for what nothing determines there. */
    constexpr double smallest_shift = 1e-10;

    /**
     * What raises the diagonal of 1 before it is factorised incompletely: the first of these
     * with which a sweep does not overshoot. Sweeps of bodies with little change of volume do so
     * from Poisson's ratios of 0.45 on, and diverge later; bodies of very different stiffness lose
     * iterations by it.
     */
    constexpr double dampings[] = {0., 0.05, 0.2, 0.5};

    /** A sweep overshoots if the largest eigenvalue of M^-1 A is above this; 2 and it diverges. */
    constexpr double       overshoot        = 1.4;
    constexpr unsigned int power_iterations = 5;
  } // namespace



  LatticeMultigrid::LatticeMultigrid(LatticeLevel finest)
    : levels(1)
    , smallest(make_banded_backend())
  {
    levels.front().nodes = std::move(finest);
  }

  LatticeMultigrid::~LatticeMultigrid() = default;



  void
  LatticeMultigrid::analyse(const SparseSystem &)
  {
    levels.resize(1);
    while (levels.back().nodes.n_rows() > smallest_size)
      {
        Level           coarse;
        LatticeTransfer transfer(levels.back().nodes, coarse.nodes);
        if (coarse.nodes.n_rows() > too_large * levels.back().nodes.n_rows())
          break;
        levels.back().to_coarser = std::move(transfer);
        levels.push_back(std::move(coarse));
      }
  }



  void
  LatticeMultigrid::factorise(const DistributedMatrix &matrix)
  {
    for (std::size_t l = 0; l < levels.size(); ++l)
      {
        Level &level = levels[l];
        if (l > 0)
          {
            const Level &finer = levels[l - 1];
            level.system       = finer.to_coarser->coarse_matrix(finer.nodes,
                                                           l == 1 ? matrix.values() : finer.system,
                                                           level.nodes);
            level.matrix.reinit(level.system);
            level.matrix.set_values(level.system);
            level.scaling = level.matrix.scaling();
          }
        if (!level.to_coarser)
          break;
        const DistributedMatrix &here = l == 0 ? matrix : level.matrix;
        set_up_smoother(level, here);
      }
    const LinearStatus status =
      smallest->factorise(levels.size() == 1 ? matrix.values() : levels.back().system,
                          true,
                          smallest_shift);
    if (!status.success)
      throw std::runtime_error("the smallest level of multigrid: " + status.cause);
  }



  void
  LatticeMultigrid::set_up_smoother(Level &level, const DistributedMatrix &matrix)
  {
    for (const double damping : dampings)
      {
        level.smoother = make_incomplete_lu(level.nodes.dim, damping);
        level.smoother->reinit(matrix);
        level.smoother->factorise(matrix);
        if (largest_eigenvalue(level, matrix) < overshoot)
          return;
      }
  }



  /** Of M^-1 A, by few power iterations: an outlier shows soon. */
  double
  LatticeMultigrid::largest_eigenvalue(Level &level, const DistributedMatrix &matrix)
  {
    const std::size_t n = matrix.n_rows();
    level.x.resize(n);
    level.residual.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      level.x[i] = std::sin(1.7 * static_cast<double>(i + 1) * static_cast<double>(i % 7 + 1));
    double before = 0., after = 0.;
    for (unsigned int k = 0; k < power_iterations; ++k)
      {
        before = std::sqrt(std::inner_product(level.x.begin(), level.x.end(), level.x.begin(), 0.));
        matrix.multiply(level.x.data(), level.residual.data());
        level.smoother->multiply(matrix, level.residual.data(), level.x.data());
        after = std::sqrt(std::inner_product(level.x.begin(), level.x.end(), level.x.begin(), 0.));
      }
    return before > 0. ? after / before : 0.;
  }



  /** r = b - A x. */
  void
  LatticeMultigrid::find_residual(Level &level, const DistributedMatrix &matrix)
  {
    matrix.multiply(level.x.data(), level.residual.data());
    for (std::size_t i = 0; i < level.b.size(); ++i)
      level.residual[i] = level.b[i] - level.residual[i];
  }



  /** x += M^-1 (b - A x). */
  void
  LatticeMultigrid::smooth(Level &level, const DistributedMatrix &matrix)
  {
    find_residual(level, matrix);
    level.smoother->multiply(matrix, level.residual.data(), level.change.data());
    for (std::size_t i = 0; i < level.b.size(); ++i)
      level.x[i] += level.change[i];
  }



  /** The direct method takes and gives what is not scaled. */
  void
  LatticeMultigrid::solve_smallest(Level &level)
  {
    for (std::size_t i = 0; i < level.b.size(); ++i)
      level.residual[i] = level.b[i] / level.scaling[i];
    smallest->solve(level.residual, level.x, 0., 0);
    for (std::size_t i = 0; i < level.b.size(); ++i)
      level.x[i] /= level.scaling[i];
  }



  /** x from b of level l. */
  void
  LatticeMultigrid::cycle(const std::size_t l, const DistributedMatrix &matrix)
  {
    Level            &level = levels[l];
    const std::size_t n     = level.b.size();
    for (auto *vector : {&level.x, &level.residual, &level.change})
      vector->resize(n);
    if (!level.to_coarser)
      {
        solve_smallest(level);
        return;
      }
    level.smoother->multiply(matrix, level.b.data(), level.x.data());
    find_residual(level, matrix);
    for (std::size_t i = 0; i < n; ++i)
      level.residual[i] /= level.scaling[i];
    Level &coarser = levels[l + 1];
    level.to_coarser->restrict_sums(level.nodes, level.residual, coarser.nodes, coarser.b);
    for (std::size_t i = 0; i < coarser.b.size(); ++i)
      coarser.b[i] *= coarser.scaling[i];
    cycle(l + 1, coarser.matrix);
    for (std::size_t i = 0; i < coarser.b.size(); ++i)
      coarser.x[i] *= coarser.scaling[i];
    level.to_coarser->prolong(level.nodes, coarser.nodes, coarser.x, level.change);
    for (std::size_t i = 0; i < n; ++i)
      level.x[i] += level.change[i] / level.scaling[i];
    smooth(level, matrix);
  }



  void
  LatticeMultigrid::multiply(const DistributedMatrix &matrix, const double *x, double *y)
  {
    Level &finest  = levels.front();
    finest.scaling = matrix.scaling();
    finest.b.assign(x, x + matrix.n_rows());
    cycle(0, matrix);
    std::copy(finest.x.begin(), finest.x.end(), y);
  }
} // namespace kedge
