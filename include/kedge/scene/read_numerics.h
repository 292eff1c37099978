#ifndef kedge_scene_read_numerics_h
#define kedge_scene_read_numerics_h

#include <kedge/scene/parameter_reader.h>
#include <kedge/solvers/parameters.h>
#include <kedge/time_integration/parameters.h>
#include <kedge/transfer/parameters.h>

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
} // namespace kedge

#endif
