// The block preconditioner on a small saturated strip, finite differences, on
// one rank and on two.
#include <kedge/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  constexpr int dim = 2;

  struct Strip
  {
    int width = 12, height = 10;
  };

  /** Entry of node a, component c, and node b, component d; pressure is component 2. */
  double
  entry(const int    width,
        const int    a,
        const int    c,
        const int    b,
        const int    d,
        const double conductivity)
  {
    const int dx = b % width - a % width, dy = b / width - a / width;
    if (std::abs(dx) > 1 || std::abs(dy) > 1)
      return 0.;
    // 9-point Laplacian and mass of bilinear elements on unit cells
    const double laplacian = dx == 0 && dy == 0 ? 8. / 3. : -1. / 3.;
    const double mass      = (dx == 0 ? 4. : 1.) * (dy == 0 ? 4. : 1.) / 36.;
    if (c < dim && d < dim)
      return c == d ? laplacian : 0.;
    if (c == dim && d == dim)
      return conductivity * laplacian + 0.3 * ((dx == 0 && dy == 0 ? 1. : 0.) - mass) + 1e-3 * mass;
    const int    direction = c < dim ? c : d;
    const int    step = direction == 0 ? dx : dy, across = direction == 0 ? dy : dx;
    const double slope = 0.5 * step * (across == 0 ? 4. : 1.) / 6.;
    return slope; // G = -D^T: the slope turns its sign with the step
  }

  /** All equations, nodes in order; the first rank has a third of the nodes. */
  SparseSystem
  make_system(const double conductivity, MixedBlocks &blocks, const Strip &strip = Strip())
  {
    const int    width = strip.width, height = strip.height;
    const int    rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const int    n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const int    n_nodes = width * height, third = n_ranks == 1 ? n_nodes : n_nodes / 3;
    const int    begin = rank == 0 ? 0 : third, end = rank == 0 ? third : n_nodes;
    SparseSystem system;
    system.communicator              = MPI_COMM_WORLD;
    system.n_global                  = 3 * n_nodes;
    system.first_row                 = 3 * begin;
    blocks                           = MixedBlocks();
    blocks.by_stiffness.communicator = MPI_COMM_WORLD;
    blocks.by_stiffness.n_global     = n_nodes;
    blocks.by_stiffness.first_row    = begin;
    for (int a = begin; a < end; ++a)
      for (int c = 0; c <= dim; ++c)
        {
          for (int b = 0; b < n_nodes; ++b)
            {
              const int dx = std::abs(b % width - a % width), dy = std::abs(b / width - a / width);
              if (dx > 1 || dy > 1)
                continue;
              for (int d = 0; d <= dim; ++d)
                {
                  system.column.push_back(3 * b + d);
                  // springs hold the lowest row of nodes
                  const double spring = a == b && c == d && c < dim && a < width ? 1. : 0.;
                  system.value.push_back(entry(width, a, c, b, d, conductivity) + spring);
                }
              if (c < dim)
                continue;
              blocks.by_stiffness.column.push_back(b);
              blocks.by_stiffness.value.push_back((dx == 0 ? 4. : 1.) * (dy == 0 ? 4. : 1.) / 36.);
            }
          system.row_start.push_back(system.column.size());
          if (c == dim)
            blocks.by_stiffness.row_start.push_back(blocks.by_stiffness.column.size());
          blocks.component.push_back(static_cast<unsigned char>(c));
          blocks.position.push_back(a % width);
          blocks.position.push_back(a / width);
        }
    return system;
  }

  LinearSolver
  make_solver(const LinearSolverKind kind)
  {
    LinearSolverParameters parameters;
    parameters.kind      = kind;
    parameters.tolerance = 1e-11;
    return LinearSolver(parameters, {dim, false, false, true});
  }
} // namespace

// Direct solution of the same system; conditions are below 1e4, residuals 1e-11.
// Iterations: a bound of 40 for 360 unknowns, a ninth of what GMRES needs at worst.
TEST(SolversMixedBlocksMpi, SolutionIsTheDirectOneFromDrainedToUndrained)
{
  for (const double conductivity : {1e4, 1., 1e-4, 0.})
    {
      SCOPED_TRACE("conductivity " + std::to_string(conductivity));
      MixedBlocks         blocks;
      const auto          system = make_system(conductivity, blocks);
      std::vector<double> b, x, exact;
      for (unsigned int i = 0; i < system.n_rows(); ++i)
        b.push_back(std::sin(1. + system.first_row + i));
      LinearSolver solver = make_solver(LinearSolverKind::krylov_blocks);
      solver.set_blocks(blocks);
      ASSERT_TRUE(solver.factorise(system).success);
      EXPECT_EQ(solver.method(), "krylov-blocks");
      const auto status = solver.solve(b, x);
      ASSERT_TRUE(status.success) << status.cause;
      EXPECT_LE(status.iterations, 40u);
      LinearSolver direct = make_solver(LinearSolverKind::direct);
      ASSERT_TRUE(direct.factorise(system).success);
      ASSERT_TRUE(direct.solve(b, exact).success);
      for (unsigned int i = 0; i < x.size(); ++i)
        EXPECT_NEAR(x[i], exact[i], 1e-6 * (1. + std::abs(exact[i])));
    }
}

TEST(SolversMixedBlocksMpi, OwnsUpToFailure)
{
  MixedBlocks            blocks;
  const auto             system = make_system(1e-4, blocks);
  LinearSolverParameters parameters;
  parameters.kind           = LinearSolverKind::krylov_blocks;
  parameters.max_iterations = 2;
  LinearSolver solver(parameters, {dim, false, false, true});
  solver.set_blocks(blocks);
  ASSERT_TRUE(solver.factorise(system).success);
  std::vector<double> x;
  const auto          status = solver.solve(std::vector<double>(system.n_rows(), 1.), x);
  EXPECT_FALSE(status.success);
  EXPECT_NE(status.cause.find("tolerance"), std::string::npos);
}

// A strip so wide and long that `automatic` takes the blocks. With a wrong sign in place of
// the skeleton's part of the Schur complement, large, GMRES does not come to the tolerance
// within the time of a direct solution, which takes over for that matrix alone.
TEST(SolversMixedBlocksMpi, DirectMethodTakesOver)
{
  const Strip         strip{75, 40};
  MixedBlocks         blocks;
  const auto          system = make_system(1e-4, blocks, strip);
  const MixedBlocks   good   = blocks;
  std::vector<double> b(system.n_rows(), 0.), x;
  for (unsigned int i = 0; i < system.n_rows(); ++i)
    for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
      b[i] += system.value[k] * std::cos(0.1 * system.column[k]);
  LinearSolver solver(LinearSolverParameters(), {dim, false, false, true});
  for (const bool spoilt : {false, true, false})
    {
      SCOPED_TRACE(spoilt ? "spoilt" : "good");
      blocks.by_stiffness.value = good.by_stiffness.value;
      if (spoilt)
        for (unsigned int k = 0; k < blocks.by_stiffness.value.size(); ++k)
          blocks.by_stiffness.value[k] *= -1e3 * std::cos(1. * k);
      solver.set_blocks(blocks);
      ASSERT_TRUE(solver.factorise(system).success);
      EXPECT_EQ(solver.method(), "krylov-blocks");
      const auto status = solver.solve(b, x);
      ASSERT_TRUE(status.success) << status.cause;
      EXPECT_EQ(status.iterations > 0, !spoilt);
      for (unsigned int i = 0; i < x.size(); ++i) // conditions below 1e4, residuals of 1e-10
        EXPECT_NEAR(x[i], std::cos(0.1 * (system.first_row + i)), 1e-5);
    }
}
