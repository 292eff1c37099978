#ifndef kedge_base_expression_h
#define kedge_base_expression_h

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * A number that the user wrote as a formula of named variables, in
   * muParser's language: + - * / ^, comparisons, && || and ?:, the functions
   * sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log10 sqrt abs
   * sign min max sum avg rint, and floor ceil mod erf erfc if(c, a, b) log
   * (= ln) pow(a, b) as in deal.II. The constant pi is defined.
   *
   * An expression without variables is worked out once, at construction, and
   * costs nothing afterwards. One object may be evaluated by several threads
   * at a time (each owns a parser). Copies are cheap and share their parsers.
   */
  class Expression
  {
  public:
    /** The constant 0. */
    Expression() = default;

    /** The constant @p value. */
    explicit Expression(double value);

    /**
     * @param text      the formula; an empty one is an error.
     * @param variables names in the order in which values are handed over,
     *                  such as {"t"} or {"x", "y", "z"}.
     * @param constants the user's named numbers.
     *
     * @throws UserError that names the expression, the cause and the position.
     */
    Expression(const std::string                   &text,
               const std::vector<std::string>      &variables,
               const std::map<std::string, double> &constants);

    /** The value at @p values, as many as there are variables. */
    double
    operator()(const double *values) const;

    /** The value at @p values, as many as there are variables. */
    double
    operator()(std::initializer_list<double> values) const;

    /** True if no variable occurs in the expression. */
    bool
    is_constant() const;

    /** The value of a constant expression. */
    double
    value() const;

    /** The formula as the user wrote it. */
    const std::string &
    text() const;

    /** The names of all functions, which no constant may take. */
    static std::vector<std::string>
    function_names();

  private:
    class Parsers;

    std::string                    formula        = "0";
    double                         constant_value = 0;
    std::shared_ptr<const Parsers> parsers; ///< empty if constant
  };

  /**
   * The value of a formula without variables, such as "2*L".
   *
   * @throws UserError that names the expression and the cause.
   */
  double
  evaluate_constant(const std::string &text, const std::map<std::string, double> &constants);

  /**
   * The parts of a list whose separators, commas or semicolons, stand outside
   * all parentheses; blanks around the parts are removed. An empty text has no
   * parts.
   */
  std::vector<std::string>
  split_list(const std::string &text);
} // namespace kedge

#endif
