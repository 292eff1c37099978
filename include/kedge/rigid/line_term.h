#ifndef kedge_rigid_line_term_h
#define kedge_rigid_line_term_h

#include <kedge/rigid/line_law.h>
#include <kedge/rigid/rigid_term.h>

namespace kedge
{
  /**
   * Lines that pull at rigid bodies: from a body to another, or to a place in space that may move,
   * with a length that may be wound in or out. Elastic ones follow line_tension(); others keep
   * their length, l_1 <= L(t_{n+1}) and T >= 0, one of them an equation (of rods always the first),
   * with the tension as unknown. A line without stretch that becomes taut in a step stops its
   * ends dead: what that costs of energy is dissipated.
   */
  template <int dim>
  class LineTerm : public Term<dim>
  {
  public:
    /** @throws UserError for what the scene does not allow */
    LineTerm(const std::vector<LineParameters>   &parameters,
             RigidBodies<dim>                    &bodies,
             const std::map<std::string, double> &constants,
             const LoadProgram                   &program,
             const Scheme                        &scheme,
             const double                         start_time);

    std::string
    name() const override
    {
      return "lines";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    void
    declare_books(Ledger &ledger) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

    void
    save(SavedState &state) const override;

    void
    restore(const SavedState &state) override;

  private:
    struct Line
    {
      std::string               name;
      unsigned int              body;
      std::optional<unsigned>   other;
      Vector3                   place, other_place; ///< at the bodies, in their own axes
      std::array<Expression, 3> anchor;
      Expression                length;
      bool                      stretches, pushes;
      double       stiffness;   ///< [N/m]; that scales the equation, if it does not stretch
      unsigned int unknown = 0; ///< tension over stiffness [m], if it does not stretch
    };

    struct Columns
    {
      Ledger::Index tension, length, stretch;
    };

    /** What a line does in the step that is tried. */
    struct Pull
    {
      RigidPoint  at, at_other;
      LineInStep  line;
      double      length_start, length_end; ///< without load
      LineTension tension;
      bool        taut; ///< of one that does not stretch: whether its length is an equation
    };

    Line
    make_line(const LineParameters                &given,
              const std::map<std::string, double> &constants,
              const double                         start_time) const;
    Vector3
    anchor(const Line &line, const double t) const;
    Pull
    pull(const Line &line, const Trial<dim> &trial) const;
    double
    stop_ends(const Pull &pull, const bool has_other);
    void
    add_to_tangent(const Line &line, const Pull &pull, Tangent<dim> &tangent) const;

    RigidBodies<dim>    &bodies;
    const LoadProgram    program;
    const Scheme         scheme;
    std::vector<Line>    lines;
    StepTimes            times;        ///< of the attempt
    double               stopped = 0.; ///< energy lost in it by lines that became taut [J]
    std::vector<Columns> columns;
    Ledger::Index        work = 0, energy = 0, dissipation = 0;
  };
} // namespace kedge

#endif
