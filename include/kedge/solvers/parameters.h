#ifndef kedge_solvers_parameters_h
#define kedge_solvers_parameters_h

namespace kedge
{
  struct NewtonParameters
  {
    double       tolerance      = 1e-11; ///< of criterion (3.185) [-]
    unsigned int max_iterations = 20;
    bool         log            = false; ///< write newton.csv: every residual and correction
    bool to_round_off = false; ///< corrections with the last tangent go on as long as they help
  };

  enum class LinearSolverKind
  {
    automatic,
    banded, ///< LAPACK's band LU
    direct, ///< UMFPACK
    krylov_ilu,
    krylov_amg,
    krylov_blocks ///< for displacements and pressures
  };

  struct LinearSolverParameters
  {
    LinearSolverKind kind           = LinearSolverKind::automatic;
    double           tolerance      = 1e-10; ///< relative residual of Krylov methods [-]
    unsigned int     max_iterations = 1000;
  };
} // namespace kedge

#endif
