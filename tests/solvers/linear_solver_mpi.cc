// Every method of the linear solver on systems with a known solution, on one
// rank and on two.
#include <kedge/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace kedge;

namespace
{
  using Kind = LinearSolverKind;

  const std::vector<Kind> all_kinds = {Kind::automatic,
                                       Kind::banded,
                                       Kind::direct,
                                       Kind::krylov_ilu,
                                       Kind::krylov_amg};

  constexpr int width = 7, height = 9, n = width * height;

  double
  random_scale(const int i)
  {
    std::mt19937 generator(i);
    return std::pow(10., std::uniform_real_distribution<double>(-4, 4)(generator));
  }

  /** Five-point Laplacian plus convection, rows and columns scaled over eight decades. */
  double
  entry(const int i, const int j, const double convection)
  {
    const int  dx = j % width - i % width, dy = j / width - i / width;
    const bool neighbours = std::abs(dx) + std::abs(dy) == 1;
    if (i != j && !neighbours)
      return 0.;
    const double value = i == j ? 4. : -1. + convection * (dx + 0.5 * dy);
    return value * random_scale(i) * random_scale(j);
  }

  /** The first rank has a third of the rows. */
  SparseSystem
  make_system(const std::function<double(int, int)> &entry_of)
  {
    const int    rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const int    n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const int    third   = n_ranks == 1 ? n : n / 3;
    const int    begin = rank == 0 ? 0 : third, end = rank == 0 ? third : (rank == 1 ? n : third);
    SparseSystem system;
    system.communicator = MPI_COMM_WORLD;
    system.n_global     = n;
    system.first_row    = begin;
    for (int i = begin; i < end; ++i)
      {
        for (int j = 0; j < n; ++j)
          if (std::abs(entry_of(i, j)) > 0. || i == j)
            {
              system.column.push_back(j);
              system.value.push_back(entry_of(i, j));
            }
        system.row_start.push_back(system.column.size());
      }
    return system;
  }

  /** The solution; unscaled unknowns are of order 1. */
  double
  solution(const int i)
  {
    return std::sin(1. + i) / random_scale(i);
  }

  LinearSolver
  make_solver(const Kind kind, const bool positive_definite)
  {
    LinearSolverParameters parameters;
    parameters.kind      = kind;
    parameters.tolerance = 1e-12;
    MatrixTraits traits;
    traits.positive_definite = positive_definite;
    return LinearSolver(parameters, traits);
  }

  void
  check_solve(LinearSolver &solver, const SparseSystem &system)
  {
    std::vector<double> b, x;
    for (unsigned int i = 0; i < system.n_rows(); ++i)
      {
        b.push_back(0.);
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          b[i] += system.value[k] * solution(system.column[k]);
      }
    const auto status = solver.solve(b, x);
    EXPECT_TRUE(status.success) << status.cause;
    ASSERT_EQ(x.size(), b.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const int row = static_cast<int>(system.first_row) + i;
        // condition about 50, Krylov residual 1e-12
        EXPECT_NEAR(x[i] * random_scale(row), solution(row) * random_scale(row), 1e-10);
      }
  }

  std::string
  name(const Kind kind)
  {
    return "method " + std::to_string(static_cast<int>(kind));
  }
} // namespace

TEST(SolversLinearMpi, SymmetricSystemsByAllMethods)
{
  const auto system = make_system([](const int i, const int j) {
    return entry(i, j, 0.);
  });
  for (const Kind kind : all_kinds)
    for (const bool positive_definite : {true, false})
      {
        SCOPED_TRACE(name(kind) + (positive_definite ? " positive definite" : " general"));
        LinearSolver solver = make_solver(kind, positive_definite);
        const auto   status = solver.factorise(system);
        ASSERT_TRUE(status.success) << status.cause;
        check_solve(solver, system);
        check_solve(solver, system); // the factor stays
      }
}

TEST(SolversLinearMpi, UnsymmetricSystemsAndNewValues)
{
  for (const Kind kind : all_kinds)
    {
      SCOPED_TRACE(name(kind));
      LinearSolver solver = make_solver(kind, false);
      for (const double convection : {0.4, -0.3})
        {
          const auto system = make_system([&](const int i, const int j) {
            return entry(i, j, convection);
          });
          ASSERT_TRUE(solver.factorise(system).success);
          check_solve(solver, system);
        }
      // another pattern: a coupling of far nodes
      const auto other = make_system([](const int i, const int j) {
        return entry(i, j, 0.1) +
               (i == 2 && j == 40 ? 0.3 * random_scale(2) * random_scale(40) : 0.);
      });
      solver.pattern_changed();
      ASSERT_TRUE(solver.factorise(other).success);
      check_solve(solver, other);
    }
}

// Cholesky in blocks of 16, 32 and 64, the last of them smaller; a symmetric
// matrix that is not positive definite and one that is not symmetric by 1e-6
TEST(SolversLinearMpi, BandsOfAllWidths)
{
  for (const int bandwidth : {1, 20, 60, 330})
    for (const int variant : {0, 1, 2})
      {
        SCOPED_TRACE("width " + std::to_string(bandwidth) + " variant " + std::to_string(variant));
        const int    n_rows = 2 * bandwidth + 35;
        SparseSystem system;
        system.communicator = MPI_COMM_WORLD;
        system.n_global     = n_rows;
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          for (int i = 0; i < n_rows; ++i)
            {
              for (int j = std::max(0, i - bandwidth); j <= std::min(n_rows - 1, i + bandwidth);
                   ++j)
                {
                  // a dominant diagonal, of which variant 1 turns a third
                  const double sign = variant == 1 && i % 3 == 0 ? -1. : 1.;
                  double value      = i == j ? sign * (1.1 + bandwidth) : std::cos(3. * i + 3. * j);
                  if (variant == 2 && i == j + 1)
                    value += 1e-6;
                  system.column.push_back(j);
                  system.value.push_back(value);
                }
              system.row_start.push_back(system.column.size());
            }
        LinearSolver solver = make_solver(Kind::banded, false);
        const auto   status = solver.factorise(system);
        ASSERT_TRUE(status.success) << status.cause;
        EXPECT_GE(status.condition_estimate, 1.);
        std::vector<double> b, x;
        for (unsigned int i = 0; i < system.n_rows(); ++i)
          {
            b.push_back(0.);
            for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
              b[i] += system.value[k] * std::sin(1. + system.column[k]);
          }
        ASSERT_TRUE(solver.solve(b, x).success);
        for (unsigned int i = 0; i < x.size(); ++i)
          EXPECT_NEAR(x[i], std::sin(1. + i), 1e-12); // conditions below 100
      }
}

TEST(SolversLinearMpi, NamesTheMethodInUse)
{
  const auto                     system = make_system([](const int i, const int j) {
    return entry(i, j, 0.);
  });
  const std::vector<std::string> names = {"banded", "banded", "direct", "krylov-ilu", "krylov-amg"};
  for (unsigned int k = 0; k < all_kinds.size(); ++k)
    {
      LinearSolver solver = make_solver(all_kinds[k], true);
      solver.factorise(system);
      // automatic takes the band solver for a system as small as this
      EXPECT_EQ(solver.method(), names[k]);
    }
}

TEST(SolversLinearMpi, SaysWhichEquationIsSingular)
{
  constexpr int hole = 30; // of the second of two ranks
  // nothing at all in row and column 30
  const auto empty = make_system([](const int i, const int j) {
    return i == hole || j == hole ? 0. : entry(i, j, 0.1);
  });
  // rows 30 to 32 float freely: a chain with irregular springs and no support,
  // so that elimination leaves a pivot of round-off, not of zero
  const auto floating = make_system([](const int i, const int j) {
    const bool in_i = i >= hole && i < hole + 3, in_j = j >= hole && j < hole + 3;
    if (!in_i && !in_j)
      return entry(i, j, 0.1);
    if (!in_i || !in_j)
      return 0.;
    const double spring[4] = {0., 0.1, 0.7 / 3., 0.};
    const int    k         = i - hole;
    if (i == j)
      return spring[k] + spring[k + 1];
    return std::abs(i - j) == 1 ? -spring[std::max(i, j) - hole] : 0.;
  });
  for (const Kind kind : {Kind::automatic, Kind::banded, Kind::direct})
    {
      SCOPED_TRACE(name(kind));
      LinearSolver solver = make_solver(kind, false);
      const auto   status = solver.factorise(empty);
      EXPECT_FALSE(status.success);
      EXPECT_EQ(status.equation, hole);
      EXPECT_NE(status.cause.find("singular"), std::string::npos) << status.cause;

      LinearSolver other   = make_solver(kind, false);
      const auto   floated = other.factorise(floating);
      EXPECT_FALSE(floated.success);
      EXPECT_GE(floated.equation, hole);
      EXPECT_LT(floated.equation, hole + 3);
    }
  for (const bool positive_definite : {true, false})
    {
      // Cholesky must not take the square root of round-off for a pivot
      LinearSolver solver = make_solver(Kind::banded, positive_definite);
      EXPECT_FALSE(solver
                     .factorise(make_system([](const int i, const int j) {
                       const bool in_i = i < 3, in_j = j < 3;
                       if (in_i != in_j)
                         return 0.;
                       const double v[3] = {0.1, 0.3, 0.7};
                       // a rank-one block: v v^T
                       return in_i ? v[i] * v[j] : (i == j ? 1. : 0.);
                     }))
                     .success);
    }
}

// A saddle point, [A B^T; B 0], in units eight decades apart: the last three unknowns are
// multipliers. Direct methods solve it as accurately as the system without them, whatever
// the units of the multipliers; iterative ones say that they cannot.
TEST(SolversLinearMpi, MultipliersByDirectMethods)
{
  for (const double unit : {1e-9, 1., 1e9})
    {
      const auto is_multiplier = [](const int i) {
        return i >= n - 3;
      };
      const auto system = make_system([&](const int i, const int j) {
        if (is_multiplier(i) && is_multiplier(j))
          return 0.;
        if (!is_multiplier(i) && !is_multiplier(j))
          return entry(i, j, 0.);
        const int m = std::max(i, j), k = std::min(i, j); // every third unknown has a part
        return k % 3 == n - 1 - m ? unit * std::cos(1. + k) * random_scale(i) * random_scale(j)
                                  : 0.;
      });
      for (const Kind kind : {Kind::automatic, Kind::banded, Kind::direct, Kind::krylov_ilu})
        {
          SCOPED_TRACE(name(kind));
          LinearSolverParameters parameters;
          parameters.kind = kind;
          MatrixTraits traits;
          traits.multipliers = true;
          LinearSolver solver(parameters, traits);
          const auto   status = solver.factorise(system);
          EXPECT_EQ(status.success, kind != Kind::krylov_ilu);
          if (!status.success)
            {
              EXPECT_NE(status.cause.find("multipliers"), std::string::npos);
              continue;
            }
          EXPECT_LT(status.condition_estimate, 1e4); // of the scaled matrix
          std::vector<double> b, x;
          const auto          exact = [&](const int i) {
            return is_multiplier(i) ? solution(i) / unit : solution(i);
          };
          for (unsigned int i = 0; i < system.n_rows(); ++i)
            {
              b.push_back(0.);
              for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
                b[i] += system.value[k] * exact(system.column[k]);
            }
          EXPECT_TRUE(solver.solve(b, x).success);
          for (unsigned int i = 0; i < x.size(); ++i)
            {
              const int row = static_cast<int>(system.first_row) + i;
              EXPECT_NEAR(x[i] / exact(row), 1., 1e-9); // condition below 1e4, round-off
            }
        }
    }
}

// Large enough for an iterative method to be chosen, and nothing for it: the
// diagonal is a fifth of the other entries. A direct method takes over, and
// only for this matrix.
TEST(SolversLinearMpi, DirectMethodsTakeOverFromIterativeOnes)
{
  constexpr int n_rows      = 2400;
  const auto    make_matrix = [](const double coupling) {
    const int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const int half = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 ? n_rows / 2 : 0;
    SparseSystem system;
    system.communicator = MPI_COMM_WORLD;
    system.n_global     = n_rows;
    system.first_row    = rank == 0 ? 0 : half;
    const int end       = rank == 0 && half > 0 ? half : n_rows;
    for (int i = static_cast<int>(system.first_row); i < (rank < 2 ? end : 0); ++i)
      {
        for (const int distance : {-700, -40, 0, 1, 40, 700})
          if (i + distance >= 0 && i + distance < n_rows)
            {
              system.column.push_back(i + distance);
              system.value.push_back(distance == 0 ? 1. : coupling * std::sin(i * (2. + distance)));
            }
        system.row_start.push_back(system.column.size());
      }
    return system;
  };
  MatrixTraits traits;
  traits.space_dimension      = 3;
  traits.dominated_by_inertia = true;
  LinearSolver solver(LinearSolverParameters(), traits);
  for (const double coupling : {0.1, 5., 0.1})
    {
      const auto system = make_matrix(coupling);
      ASSERT_TRUE(solver.factorise(system).success);
      EXPECT_EQ(solver.method(), "krylov-ilu");
      std::vector<double> b(system.n_rows(), 0.), x;
      for (unsigned int i = 0; i < system.n_rows(); ++i)
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          b[i] += system.value[k] * std::cos(0.1 * system.column[k]);
      const auto status = solver.solve(b, x);
      ASSERT_TRUE(status.success) << status.cause;
      EXPECT_EQ(status.iterations > 0, coupling < 1.);
      for (unsigned int i = 0; i < x.size(); ++i) // residuals of 1e-10
        EXPECT_NEAR(x[i], std::cos(0.1 * (system.first_row + i)), 1e-8);
    }
}

// Iterations grow with what is asked for; multigrid is a direct solver here
TEST(SolversLinearMpi, KrylovMethodsStopWhereTold)
{
  const auto system = make_system([](const int i, const int j) {
    return entry(i, j, 0.3);
  });
  for (const Kind kind : {Kind::krylov_ilu, Kind::krylov_amg})
    {
      SCOPED_TRACE(name(kind));
      LinearSolver solver = make_solver(kind, false);
      ASSERT_TRUE(solver.factorise(system).success);
      std::vector<double> b, x;
      for (unsigned int i = 0; i < system.n_rows(); ++i)
        b.push_back(std::cos(1. * (system.first_row + i)) *
                    random_scale(static_cast<int>(system.first_row) + i));
      unsigned int before = 0;
      for (const double tolerance : {0.1, 1e-4, 0.}) // of make_solver at last, 1e-12
        {
          const auto status = solver.solve(b, x, tolerance);
          EXPECT_TRUE(status.success) << status.cause;
          EXPECT_GE(status.iterations, before + (kind == Kind::krylov_ilu ? 1 : 0));
          before = status.iterations;
        }
    }
}

TEST(SolversLinearMpi, KrylovMethodsOwnUpToFailure)
{
  const auto             system = make_system([](const int i, const int j) {
    return entry(i, j, 0.);
  });
  const unsigned int     n_rows = system.n_rows();
  LinearSolverParameters parameters;
  parameters.kind           = Kind::krylov_ilu;
  parameters.tolerance      = 1e-12;
  parameters.max_iterations = 2; // too few for 63 unknowns
  LinearSolver solver(parameters, MatrixTraits{});
  ASSERT_TRUE(solver.factorise(system).success);
  std::vector<double> x;
  const auto          status = solver.solve(std::vector<double>(n_rows, 1.), x);
  EXPECT_FALSE(status.success);
  EXPECT_FALSE(status.cause.empty());
  // a right-hand side of zero needs no iteration
  const auto zero = solver.solve(std::vector<double>(n_rows, 0.), x);
  EXPECT_TRUE(zero.success);
  for (const double value : x)
    EXPECT_EQ(value, 0.);
}

TEST(SolversLinearMpi, SystemsWithoutEquations)
{
  SparseSystem nothing;
  nothing.communicator = MPI_COMM_WORLD;
  for (const Kind kind : {Kind::automatic, Kind::banded, Kind::direct})
    {
      LinearSolver        solver = make_solver(kind, false);
      std::vector<double> x      = {1.};
      EXPECT_TRUE(solver.factorise(nothing).success);
      EXPECT_TRUE(solver.solve({}, x).success);
      EXPECT_TRUE(x.empty());
    }
}
