#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/scene/values.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace kedge
{
  namespace
  {
    using Constants = std::map<std::string, double>;

    /** How far, relative, a count given as an expression may be from a whole number. */
    constexpr double rounding_tolerance = 1e-9;

    std::string
    to_text(const double number)
    {
      std::ostringstream out;
      out << number;
      return out.str();
    }

    /** Removes @p ending and the blanks before it; false if the text does not end so. */
    bool
    strip_ending(std::string &text, const std::string &ending)
    {
      if (text.size() < ending.size() ||
          text.compare(text.size() - ending.size(), ending.size(), ending) != 0)
        return false;
      text = dealii::Utilities::trim(text.substr(0, text.size() - ending.size()));
      return true;
    }

    /** Splits "name(argument)"; false if the text has another form. */
    bool
    split_call(const std::string &text, std::string &name, std::string &argument)
    {
      const std::size_t open = text.find('(');
      if (open == std::string::npos || text.back() != ')')
        return false;
      name     = dealii::Utilities::trim(text.substr(0, open));
      argument = dealii::Utilities::trim(text.substr(open + 1, text.size() - open - 2));
      return true;
    }

    /** "; 4/0.3 is 13.33333333" for an expression, nothing for a number. */
    std::string
    value_of(const std::string &text, const double number)
    {
      double            plain  = 0.;
      const char *const end    = text.data() + text.size();
      const auto        result = std::from_chars(text.data(), end, plain);
      if (result.ec == std::errc() && result.ptr == end)
        return "";
      std::ostringstream out;
      out << "; " << shortened(text, 60) << " is " << std::setprecision(10) << number;
      return out.str();
    }

    void
    check_count(const std::size_t found, const unsigned int wanted, const std::string &what)
    {
      if (found != wanted)
        throw UserError("It must be " + std::to_string(wanted) + " " + what +
                        " separated by commas or semicolons, not " + std::to_string(found) + ".");
    }
  } // namespace



  NumberRange
  NumberRange::positive()
  {
    NumberRange range;
    range.lower          = 0;
    range.includes_lower = false;
    return range;
  }



  NumberRange
  NumberRange::not_negative()
  {
    NumberRange range;
    range.lower = 0;
    return range;
  }



  bool
  NumberRange::contains(const double number) const
  {
    return (includes_lower ? number >= lower : number > lower) &&
           (includes_upper ? number <= upper : number < upper);
  }



  std::string
  NumberRange::describe() const
  {
    std::string text;
    if (std::isfinite(lower))
      text += (includes_lower ? " of at least " : " greater than ") + to_text(lower);
    if (std::isfinite(upper))
      text += (text.empty() ? "" : " and") +
              std::string(includes_upper ? " of at most " : " less than ") + to_text(upper);
    return text;
  }



  double
  parse_number(const std::string &text, const Constants &constants, const NumberRange &range)
  {
    const double number = evaluate_constant(text, constants);
    if (!range.contains(number))
      throw UserError("It must be a number" + range.describe() + value_of(text, number) + ".");
    return number;
  }



  unsigned int
  parse_whole_number(const std::string &text,
                     const Constants   &constants,
                     const unsigned int minimum)
  {
    const double number = evaluate_constant(text, constants);
    const double whole  = std::round(number);
    if (std::abs(number - whole) > rounding_tolerance * std::max(1., std::abs(whole)) ||
        whole < minimum)
      throw UserError("It must be a whole number of at least " + std::to_string(minimum) +
                      value_of(text, number) + ".");
    if (whole > std::numeric_limits<unsigned int>::max())
      throw UserError("It must be a whole number of at most " +
                      std::to_string(std::numeric_limits<unsigned int>::max()) +
                      value_of(text, number) + ".");
    return static_cast<unsigned int>(whole);
  }



  std::vector<double>
  parse_numbers(const std::string &text,
                const unsigned int n_numbers,
                const Constants   &constants,
                const NumberRange &range)
  {
    const std::vector<std::string> parts = split_list(text);
    check_count(parts.size(), n_numbers, "numbers");
    std::vector<double> numbers;
    for (const std::string &part : parts)
      numbers.push_back(parse_number(part, constants, range));
    return numbers;
  }



  std::vector<std::string>
  parse_expressions(const std::string              &text,
                    const unsigned int              n_expressions,
                    const std::vector<std::string> &variables,
                    const Constants                &constants)
  {
    const std::vector<std::string> parts = split_list(text);
    check_count(parts.size(), n_expressions, "expressions");
    for (const std::string &part : parts)
      Expression(part, variables, constants);
    return parts;
  }



  void
  parse_choice(const std::string &text, const std::vector<std::string> &choices)
  {
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      throw UserError("It must be one of " + boost::algorithm::join(choices, ", ") + "." +
                      did_you_mean(text, choices));
  }



  bool
  parse_truth(const std::string &text)
  {
    parse_choice(text, {"true", "false"});
    return text == "true";
  }



  template <int dim>
  unsigned int
  parse_side(const std::string &text)
  {
    const std::vector<std::string> words = {"left", "right", "bottom", "top", "back", "front"};
    const std::vector<std::string> signs = {"-x", "+x", "-y", "+y", "-z", "+z"};
    const std::vector<std::string> ends  = {"x-", "x+", "y-", "y+", "z-", "z+"};
    std::vector<std::string>       choices;
    for (const auto &names : {words, signs, ends})
      for (unsigned int side = 0; side < 2 * dim; ++side)
        {
          if (text == names[side])
            return side;
          choices.push_back(names[side]);
        }
    throw UserError("It must be one of " + boost::algorithm::join(choices, ", ") + "." +
                    did_you_mean(text, choices));
  }



  template <int dim>
  unsigned int
  parse_side_or_all(const std::string &text)
  {
    if (text == "all")
      return 2 * dim;
    try
      {
        return parse_side<dim>(text);
      }
    catch (const UserError &error)
      {
        throw UserError(std::string(error.what()) + " Or all.");
      }
  }



  ComponentCondition
  parse_component_condition(const std::string &text, const Constants &constants)
  {
    ComponentCondition condition;
    std::string        name, argument;
    if (text == "free")
      condition.kind = ConditionKind::free;
    else if (text == "fixed")
      condition.kind = ConditionKind::fixed;
    else if (split_call(text, name, argument) && (name == "displacement" || name == "velocity"))
      {
        condition.kind =
          name == "displacement" ? ConditionKind::displacement : ConditionKind::velocity;
        condition.expression = argument;
        Expression(argument, {"t"}, constants);
      }
    else if (split_call(text, name, argument) && name == "motion")
      {
        condition.kind       = ConditionKind::motion;
        condition.expression = argument;
        if (constants.count("dt") > 0)
          throw UserError("Within motion() dt is the step; give the constant dt another name.");
        Expression(argument, motion_variables(), constants);
      }
    else
      throw UserError("It must be free, fixed, displacement(expression of t), "
                      "velocity(expression of t) or motion(expression of x, y, z, t, dt)." +
                      did_you_mean(text.substr(0, text.find('(')),
                                   {"free", "fixed", "displacement", "velocity", "motion"}));
    return condition;
  }



  ComponentCondition
  parse_body_motion(const std::string &text, const Constants &constants, std::string &force)
  {
    std::string name, argument;
    force.clear();
    const bool                     is_call = split_call(text, name, argument);
    const std::vector<std::string> kinds =
      {"free", "fixed", "displacement", "velocity", "motion", "force"};
    const std::string word = is_call ? name : text;
    if (std::find(kinds.begin(), kinds.end(), word) == kinds.end())
      throw UserError("It must be free, fixed, displacement(expression of t), velocity(expression "
                      "of t), motion(expression of x, y, z, t, dt) or force(expression of t)." +
                      did_you_mean(text.substr(0, text.find('(')), kinds));
    if (!is_call || name != "force")
      return parse_component_condition(text, constants);
    Expression(argument, {"t"}, constants);
    force = argument;
    return {};
  }



  template <int dim>
  std::pair<unsigned int, double>
  parse_section(const std::string &text, const Constants &constants)
  {
    const std::vector<std::string> parts = split_list(text);
    if (parts.size() == 2)
      for (unsigned int d = 0; d < dim; ++d)
        if (parts[0] == std::string(1, "xyz"[d]))
          return {d, parse_number(parts[1], constants)};
    throw UserError("It must be a direction and a place, such as x, 5.");
  }



  AxisControl
  parse_axis_control(const std::string &text, const Constants &constants)
  {
    std::string name, argument;
    if (!split_call(text, name, argument) || (name != "strain" && name != "stress"))
      throw UserError("It must be strain(expression of t) or stress(expression of t)." +
                      did_you_mean(text.substr(0, text.find('(')), {"strain", "stress"}));
    Expression(argument, {"t"}, constants);
    return {name == "stress", argument};
  }



  std::pair<StepSizeKind, double>
  parse_step(const std::string &text, const Constants &constants)
  {
    StepSizeKind kind   = StepSizeKind::fixed;
    std::string  number = text;
    if (strip_ending(number, "cfl"))
      kind = strip_ending(number, "initial")   ? StepSizeKind::cfl_initial
             : strip_ending(number, "density") ? StepSizeKind::cfl_density
                                               : StepSizeKind::cfl_nodal;
    if (number.empty())
      throw UserError("The factor before cfl is missing; write for example 15 cfl.");
    return {kind, parse_number(number, constants, NumberRange::positive())};
  }



  std::pair<CheckStatistic, std::string>
  parse_quantity(const std::string &text)
  {
    const std::map<std::string, CheckStatistic> statistics = {
      {"at", CheckStatistic::at},
      {"last", CheckStatistic::last},
      {"minimum", CheckStatistic::minimum},
      {"maximum", CheckStatistic::maximum},
      {"max_abs", CheckStatistic::max_abs},
      {"drift", CheckStatistic::drift},
      {"period", CheckStatistic::period},
      {"point_error", CheckStatistic::point_error},
      {"point_quantile", CheckStatistic::point_quantile}};
    std::string name, column;
    if (!split_call(text, name, column) || column.empty())
      throw UserError("It must have the form statistic(column), for example "
                      "last(history.total_energy).");
    std::vector<std::string> names;
    for (const auto &statistic : statistics)
      names.push_back(statistic.first);
    parse_choice(name, names);
    const CheckStatistic statistic = statistics.at(name);
    const bool           of_columns =
      column.rfind("history.", 0) == 0 ||
      (column.rfind("probe.", 0) == 0 && column.find('.') != column.rfind('.'));
    if (!is_of_points(statistic) && !of_columns)
      throw UserError("Within the parentheses stands history.COLUMN or probe.NAME.COLUMN.");
    if (is_of_points(statistic) && column.find('.') != std::string::npos)
      throw UserError(name + " takes the name of a field of the material points, for example "
                             "cauchy_stress_yy.");
    return {statistic, column};
  }



  std::pair<double, bool>
  parse_tolerance(const std::string &text, const Constants &constants)
  {
    std::string  number      = text;
    const bool   is_relative = strip_ending(number, "%");
    const double value       = parse_number(number, constants, NumberRange::not_negative());
    return {is_relative ? value / 100 : value, is_relative};
  }



  template unsigned int
  parse_side_or_all<2>(const std::string &);
  template unsigned int
  parse_side_or_all<3>(const std::string &);
  template unsigned int
  parse_side<2>(const std::string &);
  template unsigned int
  parse_side<3>(const std::string &);
  template std::pair<unsigned int, double>
  parse_section<2>(const std::string &, const Constants &);
  template std::pair<unsigned int, double>
  parse_section<3>(const std::string &, const Constants &);
} // namespace kedge
