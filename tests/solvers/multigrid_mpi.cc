// Multigrid for displacements, on one rank and on two.
#include "elastic_block.h"

#include <kedge/solvers/linear_solver.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  using Kind = LinearSolverKind;

  LinearSolver
  make_solver(const Kind kind, const ElasticBlock &block, const bool knows_nodes = true)
  {
    LinearSolverParameters parameters;
    parameters.kind      = kind;
    parameters.tolerance = 1e-10;
    MatrixTraits traits;
    traits.space_dimension   = 3;
    traits.positive_definite = block.twist == 0.;
    LinearSolver solver(parameters, traits);
    if (knows_nodes)
      solver.set_blocks(block.nodes);
    return solver;
  }
} // namespace

// A column that multigrid of unknowns which know no nodes does not see turn; large enough for
// several levels of both. Measured: 15 iterations and 83.
TEST(SolversMultigridMpi, RigidMotionsSaveIterations)
{
  ElasticBlock block;
  block.n_cells = {{8, 8, 24}};
  block.assemble();
  unsigned int counts[2];
  for (const bool knows_nodes : {true, false})
    {
      LinearSolver solver = make_solver(Kind::krylov_amg, block, knows_nodes);
      ASSERT_TRUE(solver.factorise(block.system).success);
      std::vector<double> x;
      const auto          status = solver.solve(block.load(), x);
      EXPECT_TRUE(status.success) << status.cause;
      counts[knows_nodes] = status.iterations;
    }
  EXPECT_LT(2 * counts[1], counts[0]);
}
