#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/shortened.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/thread_local_storage.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace kedge
{
  namespace
  {
    /** What a text such as "-1.5e3" says; nothing if it is not just a number. */
    std::optional<double>
    plain_number(const std::string &text)
    {
      double     number = 0;
      const auto end    = text.data() + text.size();
      const auto result = std::from_chars(text.data(), end, number);
      if (result.ec != std::errc() || result.ptr != end || !std::isfinite(number))
        return std::nullopt;
      return number;
    }

    void
    define_functions(mu::Parser &parser)
    {
      parser.DefineConst("pi", dealii::numbers::PI);
      parser.DefineFun(
        "floor",
        +[](const double a) {
          return std::floor(a);
        });
      parser.DefineFun(
        "ceil",
        +[](const double a) {
          return std::ceil(a);
        });
      parser.DefineFun(
        "erf",
        +[](const double a) {
          return std::erf(a);
        });
      parser.DefineFun(
        "erfc",
        +[](const double a) {
          return std::erfc(a);
        });
      parser.DefineFun(
        "log",
        +[](const double a) {
          return std::log(a);
        });
      parser.DefineFun(
        "pow",
        +[](const double a, const double b) {
          return std::pow(a, b);
        });
      parser.DefineFun(
        "mod",
        +[](const double a, const double b) {
          return std::fmod(a, b);
        });
      parser.DefineFun(
        "if",
        +[](const double condition, const double a, const double b) {
          return condition != 0 ? a : b;
        });
    }

    /** muParser reads a single = as an assignment; nobody means that here. */
    void
    refuse_assignment(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const bool after_comparison =
            i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!');
          if (text[i] != '=' || after_comparison)
            continue;
          if (i + 1 == text.size() || text[i + 1] != '=')
            throw UserError("The expression '" + shortened(text) +
                            "' holds a single =; write == to compare.");
          ++i;
        }
    }

    /** A parser with the memory of its variables. It must not move. */
    struct Parser
    {
      Parser(const std::string                   &text,
             const std::vector<std::string>      &variables,
             const std::map<std::string, double> &constants)
        : values(variables.size(), 0.)
      {
        define_functions(parser);
        for (const auto &[name, value] : constants)
          parser.DefineConst(name, value);
        for (std::size_t i = 0; i < variables.size(); ++i)
          parser.DefineVar(variables[i], &values[i]);
        parser.SetExpr(text);
      }

      Parser(const Parser &) = delete;
      Parser &
      operator=(const Parser &) = delete;

      mu::Parser          parser;
      std::vector<double> values;
    };
  } // namespace



  /** What is needed to make one parser per thread, and those made so far. */
  class Expression::Parsers
  {
  public:
    Parsers(const std::string                   &text,
            const std::vector<std::string>      &variables,
            const std::map<std::string, double> &constants)
      : text(text)
      , variables(variables)
      , constants(constants)
    {}

    Parser &
    of_this_thread() const
    {
      std::unique_ptr<Parser> &parser = parsers.get();
      if (!parser)
        parser = std::make_unique<Parser>(text, variables, constants);
      return *parser;
    }

  private:
    const std::string                   text;
    const std::vector<std::string>      variables;
    const std::map<std::string, double> constants;

    mutable dealii::Threads::ThreadLocalStorage<std::unique_ptr<Parser>> parsers;
  };



  Expression::Expression(const double value)
    : formula(dealii::Utilities::to_string(value))
    , constant_value(value)
  {}



  Expression::Expression(const std::string                   &text,
                         const std::vector<std::string>      &variables,
                         const std::map<std::string, double> &constants)
    : formula(dealii::Utilities::trim(text))
  {
    if (formula.empty())
      throw UserError("An expression is empty.");
    if (const std::optional<double> number = plain_number(formula))
      {
        constant_value = *number;
        return;
      }
    refuse_assignment(formula);
    try
      {
        parsers                   = std::make_shared<const Parsers>(formula, variables, constants);
        Parser    &parser         = parsers->of_this_thread();
        const bool uses_variables = !parser.parser.GetUsedVar().empty();
        constant_value            = parser.parser.Eval();
        if (parser.parser.GetNumResults() != 1)
          throw UserError("The expression '" + shortened(formula) + "' has more than one value.");
        if (uses_variables)
          return;
        parsers.reset();
      }
    catch (const mu::ParserError &error)
      {
        std::string known;
        for (const std::string &variable : variables)
          known += variable + ", ";
        for (const auto &constant : constants)
          known += constant.first + ", ";
        std::string cause = error.GetMsg();
        if (!cause.empty() && cause.back() != '.')
          cause += '.';
        throw UserError("The expression '" + shortened(formula) + "' cannot be read: " +
                        shortened(cause) + " Known names: " + shortened(known + "pi", 400) + ".");
      }
    if (!std::isfinite(constant_value))
      throw UserError("The expression '" + shortened(formula) + "' has no finite value.");
  }



  double
  Expression::operator()(const double *values) const
  {
    if (!parsers)
      return constant_value;
    Parser &parser = parsers->of_this_thread();
    std::copy(values, values + parser.values.size(), parser.values.begin());
    return parser.parser.Eval();
  }



  double
  Expression::operator()(const std::initializer_list<double> values) const
  {
    return (*this)(values.begin());
  }



  bool
  Expression::is_constant() const
  {
    return !parsers;
  }



  double
  Expression::value() const
  {
    return parsers ? std::numeric_limits<double>::signaling_NaN() : constant_value;
  }



  const std::string &
  Expression::text() const
  {
    return formula;
  }



  std::vector<std::string>
  Expression::function_names()
  {
    mu::Parser parser;
    define_functions(parser);
    std::vector<std::string> names;
    for (const auto &function : parser.GetFunDef())
      names.push_back(function.first);
    return names;
  }



  double
  evaluate_constant(const std::string &text, const std::map<std::string, double> &constants)
  {
    return Expression(text, {}, constants).value();
  }



  std::vector<std::string>
  split_list(const std::string &text)
  {
    std::vector<std::string> parts;
    if (dealii::Utilities::trim(text).empty())
      return parts;
    parts.emplace_back();
    int depth = 0;
    for (const char letter : text)
      {
        depth += (letter == '(') - (letter == ')');
        if (depth == 0 && (letter == ',' || letter == ';'))
          parts.emplace_back();
        else
          parts.back() += letter;
      }
    for (std::string &part : parts)
      part = dealii::Utilities::trim(part);
    return parts;
  }
} // namespace kedge
