#ifndef kedge_fields_constraints_h
#define kedge_fields_constraints_h

#include <kedge/fields/node_conditions.h>
#include <kedge/fields/node_ties.h>

namespace kedge
{
  /** Where the value of a nodal component comes from. */
  enum class NodalStatus : unsigned char
  {
    prescribed, ///< by a node condition: no equation
    free,       ///< an equation of its own
    tied        ///< an affine sum of others (NodeTies): no equation
  };

  /**
   * How the values at the nodes of a field follow from those that have
   * equations: each component of each node is free, prescribed, or a weighted
   * sum of others, u = C u^. The components are the dim displacements and, of a
   * saturated field, the pore pressure. Node conditions, ties of badly filled nodes and the
   * coarse space of pressures are all of this kind; whoever needs C, the
   * prescribed values or the status of a component asks here.
   *
   * A displacement that is prescribed wins over its tie; a pressure between the
   * corners of whole cells is their mean whatever is prescribed there.
   */
  template <int dim>
  class Constraints
  {
  public:
    /** Takes a configuration; the conditions and ties must last as long as this. */
    void
    reinit(const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const unsigned int         n_components);

    /** Displacements, and the pore pressure if the field is saturated. */
    unsigned int
    n_components() const
    {
      return n_components_;
    }

    /** n_components() values per local node. */
    const std::vector<NodalStatus> &
    status() const
    {
      return status_;
    }

    /** The status of one component, one value per local node. */
    std::vector<NodalStatus>
    status_of(const unsigned int component) const;

    /**
     * Writes the prescribed values of a step among @p unknowns, n_components() per local
     * node: displacements over the step from @p t_n to @p t_n + @p dt [m], pressures at
     * @p t_pressure [Pa]; then gives tied components the value of their roots.
     */
    void
    prescribe(const double         t_n,
              const double         dt,
              const double         t_pressure,
              std::vector<double> &unknowns) const;

    /**
     * Writes the velocities of the supports at time @p t among dim values per local
     * node [m/s]; see NodeConditions::velocity().
     */
    void
    prescribe_velocity(const double t, const double dt, std::vector<double> &velocity) const;

    /** v <- C v: gives tied components the value of their roots, which must be up to date. */
    void
    prolong(std::vector<double> &values) const
    {
      ties->prolong(values, n_components_);
    }

    /** r <- C^T r for partial sums, before they are added to the owners. */
    void
    restrict_sums(std::vector<double> &sums) const
    {
      ties->restrict_sums(sums, n_components_);
    }

    /**
     * Calls visit(local node, weight) for the free values of which a component is the
     * sum: itself, its roots, or none if it is prescribed.
     */
    template <typename Visit>
    void
    for_free(const unsigned int node, const unsigned int component, const Visit &visit) const
    {
      const auto here = status_[std::size_t(node) * n_components_ + component];
      if (here == NodalStatus::free)
        visit(node, 1.);
      else if (here == NodalStatus::tied)
        {
          const auto &tie = ties->ties()[ties->tie_of(node, static_cast<int>(component))];
          for (unsigned int k = 0; k < tie.roots.size(); ++k)
            if (status_[std::size_t(tie.roots[k]) * n_components_ + component] == NodalStatus::free)
              visit(tie.roots[k], tie.weights[k]);
        }
    }

  private:
    const ActiveNodes<dim>    *nodes         = nullptr;
    const NodeConditions<dim> *conditions    = nullptr;
    const NodeTies<dim>       *ties          = nullptr;
    unsigned int               n_components_ = dim;
    std::vector<NodalStatus>   status_;
  };
} // namespace kedge

#endif
