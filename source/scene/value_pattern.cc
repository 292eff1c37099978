#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/points/geometry.h>
#include <kedge/scene/value_pattern.h>

namespace kedge
{
  ValuePattern::ValuePattern(const std::string                              &allowed,
                             const std::function<void(const std::string &)> &parse,
                             const bool                                      may_be_empty)
    : allowed(allowed)
    , parse(parse)
    , may_be_empty(may_be_empty)
  {}



  ValuePattern
  ValuePattern::or_empty() const
  {
    return ValuePattern(allowed + ", or nothing", parse, true);
  }



  std::string
  ValuePattern::problem(const std::string &value) const
  {
    if (value.empty())
      return may_be_empty ? "" : "It must be given: " + allowed + ".";
    try
      {
        parse(value);
      }
    catch (const UserError &error)
      {
        const std::string problem = error.what();
        return problem.rfind("It must", 0) == 0 ? problem : problem + " Allowed: " + allowed + ".";
      }
    return "";
  }



  bool
  ValuePattern::match(const std::string &value) const
  {
    return problem(value).empty();
  }



  std::string
  ValuePattern::description(const OutputStyle) const
  {
    return allowed;
  }



  std::unique_ptr<dealii::Patterns::PatternBase>
  ValuePattern::clone() const
  {
    return std::make_unique<ValuePattern>(*this);
  }



  template <int dim>
  ValuePatterns<dim>::ValuePatterns(const std::map<std::string, double> &constants)
    : constants(std::make_shared<const std::map<std::string, double>>(constants))
  {}



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::text(const std::string &allowed) const
  {
    return ValuePattern(allowed, [](const std::string &) {});
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::number(const NumberRange &range) const
  {
    return ValuePattern("a number" + range.describe(), [=, c = constants](const auto &text) {
      parse_number(text, *c, range);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::whole_number(const unsigned int minimum) const
  {
    return ValuePattern("a whole number of at least " + std::to_string(minimum),
                        [=, c = constants](const auto &text) {
                          parse_whole_number(text, *c, minimum);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::vector(const NumberRange &range) const
  {
    return ValuePattern("one number" + range.describe() + " per direction, separated by commas",
                        [=, c = constants](const auto &text) {
                          parse_numbers(text, dim, *c, range);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::counts(const bool one_for_all) const
  {
    return ValuePattern(std::string(one_for_all ? "one whole number for all directions or " : "") +
                          "one whole number of at least 1 per direction, separated by commas",
                        [=, c = constants](const auto &text) {
                          const auto parts = split_list(text);
                          if (!one_for_all || parts.size() != 1)
                            parse_numbers(text, dim, *c);
                          for (const std::string &part : parts)
                            parse_whole_number(part, *c, 1);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::expression(const std::vector<std::string> &variables,
                                 const std::string              &words) const
  {
    return ValuePattern("an expression of " + words, [=, c = constants](const auto &text) {
      Expression(text, variables, *c);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::expressions(const std::vector<std::string> &variables,
                                  const std::string              &words) const
  {
    return ValuePattern("one expression of " + words + " per direction, separated by ;",
                        [=, c = constants](const auto &text) {
                          parse_expressions(text, dim, variables, *c);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::expressions(const std::vector<std::string> &variables,
                                  const std::string              &words,
                                  const std::vector<std::string> &components) const
  {
    std::string names;
    for (const std::string &name : components)
      names += (names.empty() ? "" : "; ") + name;
    return ValuePattern("expressions of " + words + " for " + names,
                        [=, c = constants](const auto &text) {
                          parse_expressions(text, components.size(), variables, *c);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::one_of(const std::vector<std::string> &choices) const
  {
    std::string allowed;
    for (const std::string &choice : choices)
      allowed += (allowed.empty() ? "" : " | ") + choice;
    return ValuePattern(allowed, [=](const auto &text) {
      parse_choice(text, choices);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::list_of(const std::vector<std::string> &choices) const
  {
    return ValuePattern("a list, separated by commas, of " + one_of(choices).description(),
                        [=](const auto &text) {
                          for (const std::string &part : split_list(text))
                            parse_choice(part, choices);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::truth() const
  {
    return ValuePattern("true | false", [](const auto &text) {
      parse_truth(text);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::side() const
  {
    return ValuePattern(dim == 2 ? "left | right | bottom | top, or -x | +x | -y | +y"
                                 : "left | right | bottom | top | back | front, "
                                   "or -x | +x | -y | +y | -z | +z",
                        [](const auto &text) {
                          parse_side<dim>(text);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::side_or_all() const
  {
    return ValuePattern(side().description() + ", or all", [](const auto &text) {
      parse_side_or_all<dim>(text);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::sides() const
  {
    return ValuePattern("a list, separated by commas, of " + side().description(),
                        [](const auto &text) {
                          for (const std::string &part : split_list(text))
                            parse_side<dim>(part);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::numbers() const
  {
    return ValuePattern("numbers separated by commas", [c = constants](const auto &text) {
      for (const std::string &part : split_list(text))
        parse_number(part, *c);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::geometry() const
  {
    const std::string shapes =
      dim == 2 ? "box(x0, y0; x1, y1), ball(x, y; radius), polygon(x0, y0; x1, y1; x2, y2; ...), "
                 "implicit(phi(x, y), negative inside), below(f(x)), above(f(x))"
               : "box(x0, y0, z0; x1, y1, z1), ball(x, y, z; radius), cylinder(x, y, z; x, y, z; "
                 "radius), stl(file; scale; x, y, z of its origin; degrees about x, y, z), "
                 "implicit(phi(x, y, z), negative inside), below(f(x, z)), above(f(x, z))";
    return ValuePattern(shapes + ", joined by + (union) and - (difference)",
                        [c = constants](const auto &text) {
                          parse_geometry<dim>(text, *c);
                        });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::component_condition() const
  {
    return ValuePattern(
      "free | fixed | displacement(expression of t) [m, since the start] | "
      "velocity(expression of t) [m/s] | motion(expression of x, y, z, t, dt) [m, "
      "from t to t + dt, of a node at x, y, z]",
      [c = constants](const auto &text) {
        parse_component_condition(text, *c);
      });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::body_motion() const
  {
    return ValuePattern(
      "free | fixed | displacement(expression of t) [m, since the start] | "
      "velocity(expression of t) [m/s] | motion(expression of x, y, z, t, dt) [m, "
      "from t to t + dt, of what is at x, y, z] | force(expression of t) [N; N/m in 2D, in all]",
      [c = constants](const auto &text) {
        std::string force;
        parse_body_motion(text, *c, force);
      });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::section() const
  {
    return ValuePattern("a direction and a place, such as x, 5", [c = constants](const auto &text) {
      parse_section<dim>(text, *c);
    });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::step() const
  {
    return ValuePattern(
      "a number greater than 0 [s] | FACTOR cfl | FACTOR density cfl | FACTOR initial cfl",
      [c = constants](const auto &text) {
        parse_step(text, *c);
      });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::quantity() const
  {
    return ValuePattern(
      "STATISTIC(COLUMN) with at, last, minimum, maximum, max_abs, drift or period of "
      "history.COLUMN or probe.NAME.COLUMN, or point_error or "
      "point_quantile of a field of the points",
      [](const auto &text) {
        parse_quantity(text);
      });
  }



  template <int dim>
  ValuePattern
  ValuePatterns<dim>::tolerance() const
  {
    return ValuePattern("PERCENT % of Reference, or a number of its unit",
                        [c = constants](const auto &text) {
                          parse_tolerance(text, *c);
                        });
  }



  template class ValuePatterns<2>;
  template class ValuePatterns<3>;
} // namespace kedge
