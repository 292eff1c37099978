#ifndef kedge_equations_unknowns_h
#define kedge_equations_unknowns_h

#include <kedge/solvers/linear_solver.h>

#include <array>
#include <functional>
#include <vector>

namespace kedge
{
  /** The values of all unknowns, or a change of them. */
  struct UnknownVector
  {
    /** Of each field: its components at the local nodes, node by node, ghosts up to date. */
    std::vector<std::vector<double>> fields;
    /** Those that belong to no node: of rigid bodies, multipliers; alike on all ranks. */
    std::vector<double> others;
  };

  /** An unknown: a component at a local node of a field, or one that belongs to no node. */
  struct UnknownIndex
  {
    static constexpr unsigned int no_field = static_cast<unsigned int>(-1);

    unsigned int field;
    unsigned int node; ///< local; the number of the unknown if field is no_field
    unsigned int component = 0;

    static UnknownIndex
    other(const unsigned int number)
    {
      return {no_field, number, 0};
    }
  };

  /**
   * What a step solves for, in blocks: the displacements (and pore pressures) of
   * each field, and unknowns of terms that belong to no node. Terms declare here what
   * they add, once; the equations follow.
   */
  template <int dim>
  class Unknowns
  {
  public:
    /** Takes a base and a change to new values of a range of the others. */
    using Retraction =
      std::function<void(const double *base, const double *change, double *result)>;

    /** Values per node of a field, and how Newton's method measures them. */
    struct Field
    {
      unsigned int n_components = dim;
      /** Of an equation of each component in Newton's norm; unknowns count by the inverse. */
      std::array<double, dim + 1> weight;
      /** Whether diagonal times unknown counts among the terms that cancel in a residual. */
      bool measure_diagonal = false;

      Field()
      {
        weight.fill(1.);
      }
    };

    std::vector<Field> fields;
    MatrixTraits       traits;
    /** A tangent worse than this may be why Newton's method fails. */
    double suspicious_condition = 1e9;

    /**
     * Adds @p n unknowns that belong to no node and says the number of the first.
     *
     * @param retraction how a correction changes them; empty: it is added
     */
    unsigned int
    add_others(const unsigned int n, const Retraction &retraction = {});

    unsigned int
    n_others() const
    {
      return n_others_;
    }

    /**
     * x = base (+) s dx: sums at the nodes, and for the others what their term
     * declared (rotations turn on, multipliers are projected).
     */
    void
    retract(const UnknownVector &base,
            const double         s,
            const UnknownVector &dx,
            UnknownVector       &x) const;

  private:
    struct Range
    {
      unsigned int first, n;
      Retraction   retraction;
    };

    unsigned int       n_others_ = 0;
    std::vector<Range> ranges;
  };
} // namespace kedge

#endif
