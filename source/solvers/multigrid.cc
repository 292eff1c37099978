#include "multigrid.h"

#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>

#include <ml_utils.h>

#include <stdexcept>

namespace kedge
{
  namespace
  {
    /** Systems of this size are solved directly. */
    constexpr int coarsest = 400;

    /** Couplings below this part of the diagonals do not make aggregates. */
    constexpr double threshold = 0.01;
  } // namespace



  void
  Multigrid::reinit(std::unique_ptr<Epetra_CrsMatrix> new_matrix,
                    const int                         n_per_node,
                    std::vector<double>               new_near_kernel,
                    const int                         n_vectors)
  {
    clear();
    matrix      = std::move(new_matrix);
    near_kernel = std::move(new_near_kernel);
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("ML print initial list", -2);
    list.set("prec type", "MGW"); // with V-cycles iterations grow with the number of levels
    list.set("PDE equations", n_per_node);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", n_vectors);
    list.set("null space: vectors", near_kernel.data());
    list.set("null space: add default vectors", false);
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: threshold", threshold);
    list.set("smoother: type", "symmetric Gauss-Seidel");
    list.set("smoother: sweeps", 1);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", coarsest);
    ML_set_random_seed(1); // of the start of its eigen-analysis, else another after a resumption
    levels = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*matrix, list, false);
    if (levels->ComputePreconditioner() != 0)
      throw std::runtime_error("multigrid could not be set up");
  }



  void
  Multigrid::multiply(const std::vector<double> &x, std::vector<double> &y) const
  {
    const Epetra_Map &map = matrix->RowMap();
    Epetra_Vector     from(View, map, const_cast<double *>(x.data()));
    y.resize(x.size());
    Epetra_Vector to(View, map, y.data());
    levels->ApplyInverse(from, to);
  }



  void
  Multigrid::clear()
  {
    levels.reset();
    matrix.reset();
  }
} // namespace kedge
