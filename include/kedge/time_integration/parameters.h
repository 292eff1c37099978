#ifndef kedge_time_integration_parameters_h
#define kedge_time_integration_parameters_h

#include <optional>
#include <vector>

namespace kedge
{
  enum class SchemeKind
  {
    quasi_static,
    clc_quasi_static,
    clc_midpoint,
    midpoint,
    trapezoidal,
    newmark,
    generalised_alpha
  };

  enum class StepSizeKind
  {
    fixed,
    cfl_initial, ///< factor times the materials' CFL step (3.126) at the start
    cfl_nodal,   ///< factor times the nodal CFL step (3.127), renewed every step
    cfl_density  ///< factor times the nodal CFL step (3.195), renewed every step
  };

  /** The quasi-static stage before a run's time starts. */
  struct EquilibriumParameters
  {
    unsigned int steps    = 0; ///< 0: there is none
    double       duration = 1; ///< what the pores take it for [s]
  };

  struct TimeParameters
  {
    SchemeKind          scheme              = SchemeKind::clc_midpoint;
    double              start               = 0;
    double              end                 = 1;
    StepSizeKind        step_kind           = StepSizeKind::fixed;
    double              step                = 0.1;       ///< [s], step_kind fixed
    double              cfl_factor          = 15;        ///< [-], step_kind cfl_*
    double              minimum_step_factor = 1. / 1024; ///< floor, times the nominal step
    bool                adapt_step          = false;     ///< to the work of Newton's method
    double              maximum_step_factor = 1;         ///< if adapt_step: times the nominal step
    std::vector<double> break_times;                     ///< times that a step must end at [s]
    double failure_displacement = 0; ///< at which a load has been too large [m]; 0: none
    double newmark_beta         = 0.25;
    double newmark_gamma        = 0.5;
    double spectral_radius      = 0.818; ///< rho_infinity of generalised-alpha
    bool   carry_acceleration   = true;  ///< false: the thesis's printed a_n = 0
    double pore_theta           = 0.5;   ///< PoreScheme::theta of the mid-point scheme
  };
} // namespace kedge

#endif
