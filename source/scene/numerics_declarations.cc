#include <kedge/scene/numerics_declarations.h>

namespace kedge
{
  namespace
  {
    template <int dim>
    SectionDeclaration
    newton(const ValuePatterns<dim> &allow)
    {
      return {"Newton",
              "When a step counts as solved.",
              SectionKind::plain,
              {{"Tolerance",
                "1e-11",
                allow.number(NumberRange::positive()),
                "Of |r_k| |du_k| / (|r_0| |du_1|), residual times correction [-]."},
               {"Iterations",
                "20",
                allow.whole_number(1),
                "Then the step is cut, unless the residual still falls: up to three times as "
                "many [-]."},
               {"Log",
                "false",
                allow.truth(),
                "Write newton.csv: every residual and correction, and the order."}}};
    }

    template <int dim>
    SectionDeclaration
    linear_solver(const ValuePatterns<dim> &allow)
    {
      return {
        "Linear solver",
        "How the linear systems are solved.",
        SectionKind::plain,
        {{"Method",
          "auto",
          allow.one_of({"auto", "banded", "direct", "krylov-ilu", "krylov-amg", "krylov-blocks"}),
          "auto chooses by size and bandwidth. krylov-amg: multigrid, on the grid's lattice in a "
          "single process. krylov-blocks: algebraic multigrid, of displacements and of pore "
          "pressures."},
         {"Tolerance",
          "1e-10",
          allow.number(NumberRange::positive()),
          "Relative residual of the Krylov methods [-]."},
         {"Iterations", "1000", allow.whole_number(1), "At most, of the Krylov methods [-]."}}};
    }

    template <int dim>
    SectionDeclaration
    mapping(const ValuePatterns<dim> &allow)
    {
      NumberRange fraction = NumberRange::not_negative();
      fraction.upper       = 1;
      return {
        "Mapping",
        "Between material points and grid.",
        SectionKind::plain,
        {{"Velocity",
          "flip",
          allow.one_of({"flip", "pic"}),
          "flip: points take the change of the grid's velocity. pic: the velocity itself, "
          "which damps."},
         {"Filter time",
          "",
          allow.number(NumberRange::positive()).or_empty(),
          "flip: in which velocities that only the points have, and not the grid, fall to 1/e [s]; "
          "their energy is booked as mapping_dissipation; empty: they stay."},
         {"Lumping",
          "0",
          allow.number(fraction),
          "Mass matrix from 0, consistent, to 1, lumped [-]."},
         {"Pressure",
          "consistent",
          allow.one_of({"consistent", "lumped"}),
          "Of saturated bodies: the volume matrix that takes pore pressures from points to nodes, "
          "from where Newton's method starts; consistent is exact for linear pressures."},
         {"Audit",
          "false",
          allow.truth(),
          "Write transfer_audit.csv: what each mapping loses of momenta and kinetic energy."}}};
    }

    template <int dim>
    SectionDeclaration
    stabilisation(const ValuePatterns<dim> &allow)
    {
      NumberRange filling = NumberRange::positive();
      filling.upper       = 1;
      return {"Stabilisation",
              "What is done about cells that the body fills badly.",
              SectionKind::plain,
              {{"Method",
                "aggregation",
                allow.one_of({"aggregation", "ghost", "none"}),
                "aggregation: badly filled nodes follow well-filled cells. ghost: jumps of "
                "gradients at partly filled cells are penalised, which dissipates."},
               {"Smallest filling",
                "0.05",
                allow.number(filling),
                "aggregation: nodes with less material than this are tied [cells]."},
               {"Ghost mass factor",
                "1e-6",
                allow.number(NumberRange::not_negative()),
                "ghost: of the mass penalty, over the density [-]."},
               {"Ghost stiffness factor",
                "1e-6",
                allow.number(NumberRange::not_negative()),
                "ghost: of the stiffness penalty, over Young's modulus [-]."},
               {"Ghost conductivity factor",
                "",
                allow.number(NumberRange::not_negative()).or_empty(),
                "ghost, in saturated bodies: of the penalty of pressures, over the (least) "
                "conductivity [-]; empty: 1e-3."},
               {"Ghost storage factor",
                "",
                allow.number(NumberRange::not_negative()).or_empty(),
                "ghost, in saturated bodies: of the penalty of changes of pressure, over the "
                "fluid's compressibility 1/K_f [-]; empty: 0."}}};
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_pore_fluid(const ValuePatterns<dim> &allow)
  {
    NumberRange theta;
    theta.lower         = 0.5;
    theta.upper         = 1;
    NumberRange part    = NumberRange::not_negative();
    part.upper          = 1;
    const auto positive = allow.number(NumberRange::positive());
    return {
      "Pore fluid",
      "With a Density all bodies are saturated with it; what a material says is then of the "
      "skeleton: its Density is that of the grains, its stress the effective one. Pore "
      "pressure is positive in compression.",
      SectionKind::plain,
      {{"Density",
        "",
        positive.or_empty(),
        "Of the fluid at pressure 0 [kg/m^3]; empty: the bodies are dry."},
       {"Bulk modulus", "2.2e9", positive, "Of the fluid [Pa]; the default is water's."},
       {"Hydraulic conductivity",
        "",
        positive.or_empty(),
        "At the initial porosity, kappa_0, of all materials that have none of their own [m/s]."},
       {"Conductivity law",
        "constant",
        allow.one_of({"constant", "kozeny-carman"}),
        "kozeny-carman: follows the porosity n as n^3/(1 - n)^2."},
       {"Reference gravity", "9.81", positive, "With which the conductivity was measured [m/s^2]."},
       {"Pressure space",
        "equal",
        allow.one_of({"equal", "coarse"}),
        "equal: that of the displacement, with Stabilisation. coarse: bilinear over the grid's "
        "cells, the displacement's nodes standing half as far apart (linear, gimp, spline: also in the "
        "middles of their edges) or on quadratic elements; stable by itself."},
       {"Stabilisation",
        "",
        allow.number(NumberRange::not_negative()).or_empty(),
        "Factor of the polynomial pressure projection, times 1/(2 G), less in short steps with "
        "inertia [-]; 0: none; empty: 1 for Pressure space = equal, none for coarse."},
       {"Stabilisation theta",
        "",
        allow.number(theta).or_empty(),
        "Of the projection in the scheme clc-midpoint: 1/2 loses no energy, 1 damps pressures "
        "that alternate [-]; empty: 0.5 if all bodies are gimp, else 0.55."},
       {"Velocity filter",
        "0",
        allow.number(part),
        "In the scheme clc-midpoint: part of what the fluid's velocity against the skeleton has "
        "beside that of the balance, and which alternates where friction is stiff, that each step "
        "takes away; momenta stay, the energy lost is booked [-]."},
       {"Surface penalty",
        "10",
        allow.number(NumberRange::positive()),
        "Of Surface pressures, times the conductivity over the size of a cell [-]."},
       {"Theta",
        "0.5",
        allow.number(theta),
        "Of the fluid's balance in the scheme midpoint: 1/2 is of second order, 1 damps [-]."},
       {"Lost porosity",
        "warn",
        allow.one_of({"warn", "stop"}),
        "What is done when a point's porosity falls to zero."}}};
  }



  template <int dim>
  SectionDeclaration
  declare_time(const ValuePatterns<dim> &allow)
  {
    NumberRange factor   = NumberRange::positive();
    factor.upper         = 1;
    NumberRange fraction = NumberRange::not_negative();
    fraction.upper       = 1;
    NumberRange beta     = NumberRange::positive();
    beta.upper           = 0.5;
    NumberRange growth;
    growth.lower = 1;
    return {
      "Time",
      "From when to when, in which steps, by which scheme.",
      SectionKind::plain,
      {{"Scheme",
        "clc-midpoint",
        allow.one_of({"quasi-static",
                      "clc-quasi-static",
                      "clc-midpoint",
                      "midpoint",
                      "trapezoidal",
                      "newmark",
                      "generalised-alpha"}),
        "clc-midpoint conserves energy and momenta, of saturated bodies too. quasi-static leaves inertia out; time then "
        "only counts the load. clc-quasi-static balances the middle of the step instead of "
        "its end, so that the energy books close."},
       {"Start", "0", allow.number(), "When the run starts [s]."},
       {"End", std::nullopt, allow.number(), "When it ends [s]."},
       {"Step",
        std::nullopt,
        allow.step(),
        "Fixed step, or a factor times the step that the waves allow an explicit method: of "
        "the undeformed materials (initial cfl), or of the nodes at every step, from sums of "
        "mass and volume (cfl) or of density (density cfl)."},
       {"Smallest step factor",
        "1/1024",
        allow.number(factor),
        "A step that does not converge is cut; below this fraction of Step the run stops [-]."},
       {"Largest step factor",
        "",
        allow.number(growth).or_empty(),
        "If given, steps adapt to Newton's method: 10 iterations or more halve the next step, "
        "three steps in a row with at most 5 double it, up to this times Step [-]."},
       {"Break times", "", allow.numbers().or_empty(), "Times at which a step must end [s]."},
       {"Failure displacement",
        "",
        allow.number(NumberRange::positive()).or_empty(),
        "Of quasi-static runs: once a material point has moved so far, or once there is no "
        "equilibrium any more, the run is finished, at its limit load, and its Checks are made "
        "[m]. Nothing: it goes on, and without equilibrium it stops with exit code 2."},
       {"Newmark beta", "0.25", allow.number(beta), "Of the scheme newmark [-]."},
       {"Newmark gamma", "0.5", allow.number(fraction), "Of the scheme newmark [-]."},
       {"Spectral radius",
        "0.818",
        allow.number(fraction),
        "Of generalised-alpha at infinite frequency; 1 damps nothing [-]."},
       {"Carry acceleration",
        "true",
        allow.truth(),
        "Whether material points keep their acceleration from step to step; false restarts "
        "newmark, trapezoidal and generalised-alpha with zero at each step."}}};
  }



  template <int dim>
  std::vector<SectionDeclaration>
  declare_numerics(const ValuePatterns<dim> &allow)
  {
    return {newton(allow), linear_solver(allow), mapping(allow), stabilisation(allow)};
  }



  template SectionDeclaration
  declare_pore_fluid<2>(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_pore_fluid<3>(const ValuePatterns<3> &);
  template SectionDeclaration
  declare_time<2>(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_time<3>(const ValuePatterns<3> &);
  template std::vector<SectionDeclaration>
  declare_numerics<2>(const ValuePatterns<2> &);
  template std::vector<SectionDeclaration>
  declare_numerics<3>(const ValuePatterns<3> &);
} // namespace kedge
