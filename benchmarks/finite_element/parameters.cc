#include "parameters.h"

#include <kedge/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <map>

namespace finite_element
{
  namespace
  {
    const std::map<std::string, kedge::SchemeKind> schemes = {
      {"quasi-static", kedge::SchemeKind::quasi_static},
      {"clc-quasi-static", kedge::SchemeKind::clc_quasi_static},
      {"clc-midpoint", kedge::SchemeKind::clc_midpoint},
      {"midpoint", kedge::SchemeKind::midpoint},
      {"trapezoidal", kedge::SchemeKind::trapezoidal},
      {"generalised-alpha", kedge::SchemeKind::generalised_alpha}};

    const std::map<std::string, int> sides = {{"left", 0}, {"right", 1}, {"bottom", 2}, {"top", 3}};

    void
    declare(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      prm.declare_entry("Origin", "0, 0", Anything(), "Corner of the body [m]");
      prm.declare_entry("Extent", "1, 1", Anything(), "Edges of the body [m]");
      prm.declare_entry("Cells", "1, 1", List(Integer(1), dim, dim), "Elements per direction");
      prm.declare_entry("Degree", "1", Integer(1, 2), "Of the elements: 1 or 2");
      prm.declare_entry("Density", "1", Double(0.), "[kg/m^3]");
      prm.declare_entry("Young's modulus", "1", Double(0.), "[Pa]");
      prm.declare_entry("Poisson's ratio", "0", Double(-1., 0.5), "[-]");
      prm.declare_entry("Yield radius rho_y", "0", Double(0.), "||s|| at yield [Pa]; 0: elastic");
      prm.declare_entry("Fixed x", "0", Anything(), "Where, an expression of x, y");
      prm.declare_entry("Fixed y", "0", Anything(), "Where, an expression of x, y");
      prm.declare_entry("Body force", "0; 0", Anything(), "Of t [m/s^2]");
      prm.declare_entry("End load",
                        "0; 0",
                        Anything(),
                        "Whole dead load, spread over the right side, of t [N/m]");
      prm.declare_entry("Initial velocity", "0; 0", Anything(), "Of x, y [m/s]");
      prm.declare_entry("Scheme", "clc-midpoint", Anything(), "As kedge's Time/Scheme");
      prm.declare_entry("End", "1", Double(0.), "[s]");
      prm.declare_entry("Step", "0", Double(0.), "[s]; 0: from Steps");
      prm.declare_entry("Steps", "0", Integer(0), "From 0 to End");
      prm.declare_entry("Probes", "", Anything(), "name: side; name: x, y; ...");
      prm.declare_entry("Exact stress", "", Anything(), "Cauchy yy at the end, of x, y [Pa]");
      prm.declare_entry("Stress scale", "1", Double(0.), "Its error is divided by it [Pa]");
    }

    std::vector<std::string>
    parts(const std::string &text, const std::size_t n)
    {
      const std::vector<std::string> list = kedge::split_list(text);
      if (list.size() != n)
        throw kedge::UserError("'" + text + "' should have " + std::to_string(n) + " parts.");
      return list;
    }

    dealii::Point<dim>
    point(const std::string &text)
    {
      dealii::Point<dim> result;
      const auto         list = parts(text, dim);
      for (int d = 0; d < dim; ++d)
        result[d] = kedge::evaluate_constant(list[d], {});
      return result;
    }

    void
    read_expressions(const std::string              &text,
                     const std::vector<std::string> &variables,
                     kedge::Expression (&expressions)[dim])
    {
      const auto list = parts(text, dim);
      for (int d = 0; d < dim; ++d)
        expressions[d] = kedge::Expression(list[d], variables, {});
    }

    std::vector<ProbeParameters>
    read_probes(const std::string &text)
    {
      std::vector<ProbeParameters> probes;
      for (const std::string &entry : dealii::Utilities::split_string_list(text, ';'))
        {
          const auto name_and_place = dealii::Utilities::split_string_list(entry, ':');
          if (name_and_place.size() != 2)
            throw kedge::UserError("Probes: '" + entry + "' is not NAME: PLACE.");
          ProbeParameters probe;
          probe.name      = name_and_place[0];
          const auto side = sides.find(name_and_place[1]);
          if (side != sides.end())
            probe.side = side->second;
          else
            probe.place = point(name_and_place[1]);
          probes.push_back(probe);
        }
      return probes;
    }

    kedge::MaterialParameters
    read_material(const dealii::ParameterHandler &prm)
    {
      kedge::MaterialParameters material;
      const double              yield_radius = prm.get_double("Yield radius rho_y");
      material.kind =
        yield_radius > 0. ? kedge::MaterialKind::von_mises : kedge::MaterialKind::hencky;
      material.density       = prm.get_double("Density");
      material.young_modulus = prm.get_double("Young's modulus");
      material.poisson_ratio = prm.get_double("Poisson's ratio");
      material.yield_stress  = std::sqrt(1.5) * yield_radius;
      return material;
    }

    kedge::TimeParameters
    read_time(const dealii::ParameterHandler &prm)
    {
      kedge::TimeParameters time;
      const auto            scheme = schemes.find(prm.get("Scheme"));
      if (scheme == schemes.end())
        throw kedge::UserError("There is no scheme '" + prm.get("Scheme") + "'.");
      time.scheme = scheme->second;
      time.end    = prm.get_double("End");
      time.step   = prm.get_double("Step");
      if (time.step == 0.)
        time.step = time.end / std::max<double>(1., prm.get_integer("Steps"));
      return time;
    }
  } // namespace



  CommandLine
  read_command_line(const int argc, const char *const *argv)
  {
    CommandLine command;
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if ((argument == "-o" || argument == "-s") && i + 1 < argc)
          {
            if (argument == "-o")
              command.output = argv[++i];
            else
              command.settings.emplace_back(argv[++i]);
          }
        else if (argument[0] != '-' && command.file.empty())
          command.file = argument;
        else
          throw kedge::UserError("What is '" + argument + "'?");
      }
    if (command.file.empty())
      throw kedge::UserError("kedge_finite_element FILE.prm [-o DIR] [-s \"Name = value\" ...]");
    return command;
  }



  Parameters
  read_parameters(const CommandLine &command)
  {
    dealii::ParameterHandler prm;
    declare(prm);
    try
      {
        prm.parse_input(command.file);
        for (const std::string &setting : command.settings)
          prm.parse_input_from_string("set " + setting);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        throw kedge::UserError(command.file + ": " + exception.what());
      }

    Parameters parameters;
    parameters.origin = point(prm.get("Origin"));
    parameters.extent = point(prm.get("Extent"));
    for (const std::string &n : parts(prm.get("Cells"), dim))
      parameters.cells.push_back(dealii::Utilities::string_to_int(n));
    parameters.degree   = prm.get_integer("Degree");
    parameters.material = read_material(prm);
    parameters.fixed[0] = kedge::Expression(prm.get("Fixed x"), {"x", "y"}, {});
    parameters.fixed[1] = kedge::Expression(prm.get("Fixed y"), {"x", "y"}, {});
    read_expressions(prm.get("Body force"), {"t"}, parameters.acceleration);
    read_expressions(prm.get("End load"), {"t"}, parameters.end_load);
    read_expressions(prm.get("Initial velocity"), {"x", "y"}, parameters.initial_velocity);
    parameters.time             = read_time(prm);
    parameters.probes           = read_probes(prm.get("Probes"));
    parameters.has_exact_stress = !prm.get("Exact stress").empty();
    if (parameters.has_exact_stress)
      parameters.exact_stress = kedge::Expression(prm.get("Exact stress"), {"x", "y"}, {});
    parameters.stress_scale = prm.get_double("Stress scale");
    return parameters;
  }
} // namespace finite_element
