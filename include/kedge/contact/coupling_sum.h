#ifndef kedge_contact_coupling_sum_h
#define kedge_contact_coupling_sum_h

#include <kedge/equations/tangent.h>

namespace kedge
{
  /**
   * Sums matrices that couple the displacements of a few nodes, of one or several fields:
   * B^T A B with B = [c_1 I, c_2 I ..]. Contributions to the same nodes are added up before
   * they go to the tangent, for which each entry costs a search.
   */
  template <int dim>
  class CouplingSum
  {
  public:
    /** Coefficients of nodes: ((field, local node), c), each node once, ascending. */
    using Coefficients = std::map<std::pair<unsigned int, unsigned int>, double>;

    void
    add(const Coefficients &coefficients, const dealii::Tensor<2, dim> &matrix);

    /**
     * Adds B^T a E, E = [e_1, e_2 ..] the coefficients of pore pressures: how forces at some nodes
     * depend on the pressures at others.
     */
    void
    add_by_pressure(const Coefficients           &forces,
                    const Coefficients           &pressures,
                    const dealii::Tensor<1, dim> &vector);

    /** Adds the sums to a tangent. */
    void
    add_to(Tangent<dim> &tangent) const;

  private:
    using Nodes = std::vector<std::pair<unsigned int, unsigned int>>;

    static Nodes
    nodes_of(const Coefficients &coefficients);

    std::map<Nodes, std::vector<dealii::Tensor<2, dim>>>                   blocks; ///< row by row
    std::map<std::pair<Nodes, Nodes>, std::vector<dealii::Tensor<1, dim>>> by_pressure;
  };
} // namespace kedge

#endif
