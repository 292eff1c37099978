#ifndef kedge_scene_values_h
#define kedge_scene_values_h

#include <kedge/grid/parameters.h>
#include <kedge/io/parameters.h>
#include <kedge/stress/parameters.h>
#include <kedge/time_integration/parameters.h>

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kedge
{
  /** Which numbers an entry allows. */
  struct NumberRange
  {
    double lower          = -std::numeric_limits<double>::infinity();
    double upper          = std::numeric_limits<double>::infinity();
    bool   includes_lower = true;
    bool   includes_upper = true;

    static NumberRange
    positive();

    static NumberRange
    not_negative();

    bool
    contains(double number) const;

    /** " greater than 0", " between -1 and 0.5, both excluded", or nothing. */
    std::string
    describe() const;
  };

  // What follows reads the text of one entry. All numbers may be expressions
  // of the user's constants. Each throws a UserError that says what is wrong
  // with the text and what is allowed; the caller adds which entry it is.

  double
  parse_number(const std::string                   &text,
               const std::map<std::string, double> &constants,
               const NumberRange                   &range = NumberRange());

  /** A count of at least @p minimum; an expression may miss it by rounding. */
  unsigned int
  parse_whole_number(const std::string                   &text,
                     const std::map<std::string, double> &constants,
                     unsigned int                         minimum = 0);

  /** @p n_numbers numbers separated by commas or semicolons. */
  std::vector<double>
  parse_numbers(const std::string                   &text,
                unsigned int                         n_numbers,
                const std::map<std::string, double> &constants,
                const NumberRange                   &range = NumberRange());

  /** @p n_expressions expressions of @p variables; returns their texts. */
  std::vector<std::string>
  parse_expressions(const std::string                   &text,
                    unsigned int                         n_expressions,
                    const std::vector<std::string>      &variables,
                    const std::map<std::string, double> &constants);

  /** Checks that @p text is one of @p choices; names the nearest if it is not. */
  void
  parse_choice(const std::string &text, const std::vector<std::string> &choices);

  bool
  parse_truth(const std::string &text);

  /** A side of a box: left, right, bottom, top, back, front; -x, +x, .. +z; or x-, x+, .. z+. */
  template <int dim>
  unsigned int
  parse_side(const std::string &text);

  /** A side, or all of them: 2*dim. */
  template <int dim>
  unsigned int
  parse_side_or_all(const std::string &text);

  /** free, fixed, displacement(of t), velocity(of t) or motion(of x, y, z, t, dt). */
  ComponentCondition
  parse_component_condition(const std::string                   &text,
                            const std::map<std::string, double> &constants);

  /** The same, or force(of t): its expression is put into @p force. */
  ComponentCondition
  parse_body_motion(const std::string                   &text,
                    const std::map<std::string, double> &constants,
                    std::string                         &force);

  /** "x, 5": a direction, by number, and a place along it. */
  template <int dim>
  std::pair<unsigned int, double>
  parse_section(const std::string &text, const std::map<std::string, double> &constants);

  /** strain(of t) or stress(of t). */
  AxisControl
  parse_axis_control(const std::string &text, const std::map<std::string, double> &constants);

  /** "0.1" (seconds), "15 cfl" or "15 initial cfl"; the value is step or factor. */
  std::pair<StepSizeKind, double>
  parse_step(const std::string &text, const std::map<std::string, double> &constants);

  /** "last(history.total_energy)" and the like: the statistic and its column. */
  std::pair<CheckStatistic, std::string>
  parse_quantity(const std::string &text);

  /** "0.5 %" is (0.005, relative), "1e-3" is (0.001, absolute). */
  std::pair<double, bool>
  parse_tolerance(const std::string &text, const std::map<std::string, double> &constants);
} // namespace kedge

#endif
