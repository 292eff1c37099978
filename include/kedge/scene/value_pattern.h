#ifndef kedge_scene_value_pattern_h
#define kedge_scene_value_pattern_h

#include <kedge/scene/values.h>

#include <deal.II/base/patterns.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kedge
{
  /** A deal.II pattern that can say what is wrong with a value. */
  class ValuePattern : public dealii::Patterns::PatternBase
  {
  public:
    /**
     * @param allowed      what is allowed, in words.
     * @param parse        reads a value and throws UserError if it cannot.
     * @param may_be_empty whether no value is a value.
     */
    ValuePattern(const std::string                              &allowed,
                 const std::function<void(const std::string &)> &parse,
                 bool                                            may_be_empty = false);

    /** The same, but no value is a value too. */
    ValuePattern
    or_empty() const;

    /** What is wrong with @p value and what is allowed; an empty text if nothing is wrong. */
    std::string
    problem(const std::string &value) const;

    bool
    match(const std::string &value) const override;

    std::string
    description(OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    std::string                              allowed;
    std::function<void(const std::string &)> parse;
    bool                                     may_be_empty;
  };

  /** Makes the patterns of a scene's entries; they know the user's constants. */
  template <int dim>
  class ValuePatterns
  {
  public:
    explicit ValuePatterns(const std::map<std::string, double> &constants);

    ValuePattern
    text(const std::string &allowed) const;

    ValuePattern
    number(const NumberRange &range = NumberRange()) const;

    ValuePattern
    whole_number(const unsigned int minimum) const;

    ValuePattern
    vector(const NumberRange &range = NumberRange()) const;

    ValuePattern
    counts(const bool one_for_all) const;

    ValuePattern
    expression(const std::vector<std::string> &variables, const std::string &words) const;

    ValuePattern
    expressions(const std::vector<std::string> &variables, const std::string &words) const;

    /** One expression for each of the @p components. */
    ValuePattern
    expressions(const std::vector<std::string> &variables,
                const std::string              &words,
                const std::vector<std::string> &components) const;

    ValuePattern
    one_of(const std::vector<std::string> &choices) const;

    ValuePattern
    list_of(const std::vector<std::string> &choices) const;

    ValuePattern
    truth() const;

    ValuePattern
    side() const;
    ValuePattern
    side_or_all() const;

    ValuePattern
    sides() const;

    ValuePattern
    numbers() const;

    ValuePattern
    geometry() const;

    ValuePattern
    component_condition() const;

    /** The same, or a force. */
    ValuePattern
    body_motion() const;

    /** A direction and a place along it. */
    ValuePattern
    section() const;

    ValuePattern
    step() const;

    ValuePattern
    quantity() const;

    ValuePattern
    tolerance() const;

  private:
    std::shared_ptr<const std::map<std::string, double>> constants;
  };
} // namespace kedge

#endif
