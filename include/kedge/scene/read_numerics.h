#ifndef kedge_scene_read_numerics_h
#define kedge_scene_read_numerics_h

#include <kedge/points/parameters.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/solvers/parameters.h>
#include <kedge/time_integration/parameters.h>
#include <kedge/transfer/parameters.h>

#include <set>

namespace kedge
{
  // The sections that say how a scene is computed. Each throws UserError for values that
  // do not go together.

  TimeParameters
  read_time(const ParameterReader &reader);

  NewtonParameters
  read_newton(const ParameterReader &reader);

  LinearSolverParameters
  read_linear_solver(const ParameterReader &reader);

  TransferParameters
  read_mapping(const ParameterReader &reader);

  StabilisationParameters
  read_stabilisation(const ParameterReader &reader);

  /** Whether it goes with the bases of the bodies. @throws UserError if it does not */
  void
  check_stabilisation(const ParameterReader     &reader,
                      const StabilisationKind    method,
                      const std::set<BasisKind> &bases,
                      const TimeParameters      &time);
} // namespace kedge

#endif
