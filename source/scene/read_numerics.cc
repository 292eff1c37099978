#include <kedge/scene/read_numerics.h>
#include <kedge/scene/values.h>

#include <algorithm>
#include <map>

namespace kedge
{
  TimeParameters
  read_time(const ParameterReader &reader)
  {
    static const std::map<std::string, SchemeKind> schemes = {
      {"quasi-static", SchemeKind::quasi_static},
      {"clc-quasi-static", SchemeKind::clc_quasi_static},
      {"clc-midpoint", SchemeKind::clc_midpoint},
      {"midpoint", SchemeKind::midpoint},
      {"trapezoidal", SchemeKind::trapezoidal},
      {"newmark", SchemeKind::newmark},
      {"generalised-alpha", SchemeKind::generalised_alpha}};

    const SectionReader section(reader, {"Time"});
    TimeParameters      time;
    time.scheme = schemes.at(section.text("Scheme"));
    time.start  = section.number("Start");
    time.end    = section.number("End");
    if (!(time.end > time.start))
      throw section.error("End", "It must be later than Start = " + section.text("Start") + ".");

    const auto [kind, value] = parse_step(section.text("Step"), section.constants());
    time.step_kind           = kind;
    (kind == StepSizeKind::fixed ? time.step : time.cfl_factor) = value;
    time.minimum_step_factor = section.number("Smallest step factor");

    time.adapt_step = !section.is_empty("Largest step factor");
    if (time.adapt_step)
      time.maximum_step_factor = section.number("Largest step factor");

    if (!section.is_empty("Failure displacement"))
      time.failure_displacement = section.number("Failure displacement");
    if (time.failure_displacement > 0. && time.scheme != SchemeKind::quasi_static &&
        time.scheme != SchemeKind::clc_quasi_static)
      throw section.error("Failure displacement",
                          "A load has a limit without inertia only: Scheme = quasi-static or "
                          "clc-quasi-static.");

    time.break_times = section.numbers("Break times");
    for (const double break_time : time.break_times)
      if (!(break_time > time.start && break_time <= time.end))
        throw section.error("Break times", "Each must be later than Start and not after End.");
    std::sort(time.break_times.begin(), time.break_times.end());
    time.break_times.erase(std::unique(time.break_times.begin(), time.break_times.end()),
                           time.break_times.end());

    time.newmark_beta       = section.number("Newmark beta");
    time.newmark_gamma      = section.number("Newmark gamma");
    time.spectral_radius    = section.number("Spectral radius");
    time.carry_acceleration = section.truth("Carry acceleration");
    return time;
  }



  NewtonParameters
  read_newton(const ParameterReader &reader)
  {
    const SectionReader section(reader, {"Newton"});
    NewtonParameters    newton;
    newton.tolerance      = section.number("Tolerance");
    newton.max_iterations = section.whole_number("Iterations");
    newton.log            = section.truth("Log");
    return newton;
  }



  LinearSolverParameters
  read_linear_solver(const ParameterReader &reader)
  {
    static const std::map<std::string, LinearSolverKind> methods = {
      {"auto", LinearSolverKind::automatic},
      {"banded", LinearSolverKind::banded},
      {"direct", LinearSolverKind::direct},
      {"krylov-ilu", LinearSolverKind::krylov_ilu},
      {"krylov-amg", LinearSolverKind::krylov_amg},
      {"krylov-blocks", LinearSolverKind::krylov_blocks}};

    const SectionReader    section(reader, {"Linear solver"});
    LinearSolverParameters solver;
    solver.kind           = methods.at(section.text("Method"));
    solver.tolerance      = section.number("Tolerance");
    solver.max_iterations = section.whole_number("Iterations");
    return solver;
  }



  TransferParameters
  read_mapping(const ParameterReader &reader)
  {
    const SectionReader section(reader, {"Mapping"});
    TransferParameters  transfer;
    transfer.velocity_mapping =
      section.text("Velocity") == "pic" ? VelocityUpdate::pic : VelocityUpdate::flip;
    if (!section.is_empty("Filter time"))
      transfer.filter_time = section.number("Filter time");
    transfer.lumping = section.number("Lumping");
    transfer.audit   = section.truth("Audit");
    return transfer;
  }



  StabilisationParameters
  read_stabilisation(const ParameterReader &reader)
  {
    static const std::map<std::string, StabilisationKind> methods = {
      {"aggregation", StabilisationKind::aggregation},
      {"ghost", StabilisationKind::ghost},
      {"none", StabilisationKind::none}};

    const SectionReader     section(reader, {"Stabilisation"});
    StabilisationParameters stabilisation;
    stabilisation.method                 = methods.at(section.text("Method"));
    stabilisation.smallest_filling       = section.number("Smallest filling");
    stabilisation.ghost_mass_factor      = section.number("Ghost mass factor");
    stabilisation.ghost_stiffness_factor = section.number("Ghost stiffness factor");
    if (!section.is_empty("Ghost conductivity factor"))
      stabilisation.ghost_conductivity_factor = section.number("Ghost conductivity factor");
    if (!section.is_empty("Ghost storage factor"))
      stabilisation.ghost_storage_factor = section.number("Ghost storage factor");
    return stabilisation;
  }



  void
  check_stabilisation(const ParameterReader     &reader,
                      const StabilisationKind    method,
                      const std::set<BasisKind> &bases,
                      const TimeParameters      &time)
  {
    const SectionReader section(reader, {"Stabilisation"});
    const bool          has_splines = bases.count(BasisKind::spline) > 0;
    const bool          at_rest =
      time.scheme == SchemeKind::quasi_static || time.scheme == SchemeKind::clc_quasi_static;
    if ((bases.count(BasisKind::quadratic) > 0 || has_splines) &&
        method == StabilisationKind::ghost)
      throw section.error(
        "Method",
        "The ghost penalty is made for linear elements and reaches no node beyond "
        "them; with the quadratic basis and with splines choose aggregation or "
        "none.");
    if (has_splines && !at_rest && method == StabilisationKind::none)
      throw section.error(
        "Method",
        "With splines and inertia it must be aggregation: the outermost nodes weigh "
        "too little for a mass matrix that can be solved.");
  }
} // namespace kedge
