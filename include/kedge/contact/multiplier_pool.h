#ifndef kedge_contact_multiplier_pool_h
#define kedge_contact_multiplier_pool_h

#include <kedge/contact/nodal_contact_term.h>

namespace kedge
{
  /**
   * Multipliers at the nodes that two fields have in common, as unknowns of the step that belong to
   * no node. There are as many as some step has needed; those that a step does not use get an
   * equation that leaves them 0.
   */
  template <int dim>
  class MultiplierPool
  {
  public:
    MultiplierPool(const std::array<unsigned int, 2> &fields, const unsigned int per_node)
      : fields(fields)
      , per_node(per_node)
    {}

    void
    declare(Unknowns<dim> &unknowns)
    {
      this->unknowns              = &unknowns;
      unknowns.traits.multipliers = true;
    }

    /** As Term::reach: once both fields are known there are enough. */
    void
    reach(const unsigned int field, const std::vector<unsigned char> &reached)
    {
      for (unsigned int k = 0; k < 2; ++k)
        if (field == fields[k])
          reached_nodes[k] = reached;
      if (field != std::max(fields[0], fields[1]))
        return;
      std::size_t n_common = 0;
      for (std::size_t i = 0; i < reached.size(); ++i)
        n_common += reached_nodes[0][i] != 0 && reached_nodes[1][i] != 0;
      while (numbers.size() < n_common * per_node)
        numbers.push_back(unknowns->add_others(1));
    }

    /** Number among the unknowns of a multiplier of the n-th common node. */
    unsigned int
    number(const std::size_t node, const unsigned int which) const
    {
      return numbers[node * per_node + which];
    }

    std::size_t
    size() const
    {
      return numbers.size();
    }

    /** Gives all that are not used an equation of their own. */
    void
    hold_unused(const std::vector<bool> &is_used,
                const double             stiffness,
                Tangent<dim>            &tangent) const
    {
      for (std::size_t k = 0; k < numbers.size(); ++k)
        if (k >= is_used.size() || !is_used[k])
          tangent.add(UnknownIndex::other(numbers[k]), UnknownIndex::other(numbers[k]), stiffness);
    }

    const std::array<unsigned int, 2> fields;
    const unsigned int                per_node;

  private:
    Unknowns<dim>                            *unknowns = nullptr;
    std::array<std::vector<unsigned char>, 2> reached_nodes;
    std::vector<unsigned int>                 numbers;
  };
} // namespace kedge

#endif
