#ifndef kedge_equations_tangent_h
#define kedge_equations_tangent_h

#include <kedge/equations/equation_system.h>
#include <kedge/equations/unknowns.h>
#include <kedge/fields/patch.h>
#include <kedge/solvers/newton.h>

namespace kedge
{
  /**
   * The tangent of all balances. Most of it couples neighbouring nodes of one
   * field: lattice() takes these entries without any search. All others, between fields,
   * with rigid bodies and multipliers, go through add(), which distributes them by
   * the constraints. The linear system is C^T A C of it.
   *
   * Equations are numbered rank by rank, within a rank field by field, on the first
   * rank followed by the unknowns that belong to no node. A single field without
   * entries of the second kind needs no copy: its own system is the whole.
   */
  template <int dim>
  class Tangent
  {
  public:
    Tangent(const std::vector<const Patch<dim> *> &patches, const Unknowns<dim> &unknowns);

    /**
     * Takes the fields whose nodes or ties have changed (collective).
     *
     * @param radius how far a field's points couple its nodes, by field
     */
    void
    reinit(const std::vector<int> &radius);

    void
    set_zero();

    /** Entries between nodes of a field: shares of this rank's points. */
    NodeMatrix<dim> &
    lattice(const unsigned int field)
    {
      return blocks[field].matrix;
    }

    const NodeMatrix<dim> &
    lattice(const unsigned int field) const
    {
      return blocks[field].matrix;
    }

    /** Adds coefficient times a matrix that acts alike on components @p first to before @p end. */
    void
    add_to_diagonal_blocks(const unsigned int     field,
                           const double           coefficient,
                           const NodeMatrix<dim> &matrix,
                           const int              first,
                           const int              end);

    /** Adds an entry between any two unknowns, this rank's share of it. */
    void
    add(const UnknownIndex &row, const UnknownIndex &column, const double value);

    /** Forms the linear system from the entries (collective). */
    void
    assemble();

    const SparseSystem &
    system() const
    {
      return is_single() ? blocks.front().equations.system() : joint;
    }

    /** Equations of this rank. */
    unsigned int
    n_own_equations() const;

    /** True if system() has another pattern than before the last reinit() or assemble(). */
    bool
    take_new_pattern()
    {
      const bool result = new_pattern;
      new_pattern       = false;
      return result;
    }

    /** The equations of one field by themselves. */
    const EquationSystem<dim> &
    equations(const unsigned int field) const
    {
      return blocks[field].equations;
    }

    /** Nodal component (node * n_components + component) of each of a field's equations here. */
    const std::vector<unsigned int> &
    equations_of_field(const unsigned int field) const
    {
      return blocks[field].equations.nodal_indices();
    }

    /** Diagonal of the last assembled system, of a field's equations. */
    std::vector<double>
    diagonal(const unsigned int field) const;

    /** This rank's equations of a vector. */
    std::vector<double>
    gather(const UnknownVector &x) const;

    /** Values of all unknowns from this rank's equations: 0 where there is none (collective). */
    void
    scatter(const std::vector<double> &equations, UnknownVector &x) const;

    /** Weight of each of this rank's equations in Newton's norm. */
    double
    weight_of_equation(const unsigned int equation) const;

    /** The unknown of an equation of this rank. */
    UnknownIndex
    unknown(const unsigned int equation) const;

  private:
    struct Block
    {
      NodeMatrix<dim>           matrix;
      EquationSystem<dim>       equations;
      std::vector<std::int64_t> number;    ///< joint number of each local nodal component, or -1
      unsigned int              first = 0; ///< of its equations among this rank's
    };
    struct Entry
    {
      std::int64_t row, column;
      double       value;
    };

    bool
    is_single() const
    {
      return blocks.size() == 1 && unknowns.n_others() == 0 && !has_entries;
    }
    MPI_Comm
    communicator() const
    {
      return patches.front()->nodes.communicator();
    }
    void
    number_equations();
    std::int64_t
    joint_column(const unsigned int field, const std::int64_t column) const;
    template <typename Visit>
    void
    for_equations(const UnknownIndex &unknown, const Visit &visit) const;
    void
    send_entries_to_owners();
    void
    sum_entries();
    void
    build_joint_rows();
    void
    fill_joint_rows();
    unsigned int
    n_own_others() const;

    const std::vector<const Patch<dim> *> patches;
    const Unknowns<dim>                  &unknowns;
    std::vector<Block>                    blocks;
    bool                                  new_pattern = true;

    // of several fields or further unknowns
    bool                      has_entries = false; ///< of any rank, outside the lattice
    bool                      to_build    = true;  ///< the joint pattern
    std::vector<Entry>        entries;
    std::vector<std::int64_t> rank_begin;  ///< first joint equation of each rank, and the end
    std::vector<std::int64_t> field_begin; ///< of each rank and field: first in the field
    std::int64_t              first_other = 0;
    SparseSystem              joint;
    std::vector<std::size_t>  place_of_lattice; ///< in the joint system, of each field's entries
    std::vector<std::size_t>  place_of_entry;
    std::vector<std::pair<std::int64_t, std::int64_t>> entry_pattern;
  };
} // namespace kedge

#endif
