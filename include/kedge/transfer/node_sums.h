#ifndef kedge_transfer_node_sums_h
#define kedge_transfer_node_sums_h

#include <kedge/equations/node_matrix.h>

namespace kedge
{
  /**
   * Sums over material points to the nodes and back. Results at ghost nodes
   * are partial until ActiveNodes::add_to_owners().
   */

  /** Consistent mass (3.118): M_AB = sum_p m N_A N_B, a NodeMatrix with one component [kg]. */
  template <int dim>
  void
  assemble_mass(const Patch<dim> &patch, NodeMatrix<dim> &mass);

  /** The same sum with other weights than masses, one per slot. */
  template <int dim>
  void
  assemble_mass(const Patch<dim> &patch, const std::vector<double> &weights, NodeMatrix<dim> &mass);

  /** sum_p w grad N_A . grad N_B, weights one per slot; a NodeMatrix with one component. */
  template <int dim>
  void
  assemble_laplacian(const Patch<dim>          &patch,
                     const std::vector<double> &weights,
                     NodeMatrix<dim>           &laplacian);

  /**
   * (3.161): M~ = (1 - epsilon) M + epsilon diag(lumped), in place. The
   * lumped mass (3.162) is the row sum of M.
   */
  template <int dim>
  void
  blend_mass(const double epsilon, NodeMatrix<dim> &mass, const unsigned int n_rows);

  /**
   * sum_p w_p N_A q_p for a vector per point: `dim` values per local node,
   * added to @p sums. @p weights has one entry per slot (mass for momentum).
   */
  template <int dim>
  void
  add_to_nodes(const Patch<dim>                          &patch,
               const std::vector<double>                 &weights,
               const std::vector<dealii::Tensor<1, dim>> &values,
               std::vector<double>                       &sums);

  /** sum_p N_A s_p for n_values scalars per point, slot-major; added to @p sums. */
  template <int dim>
  void
  add_scalars_to_nodes(const Patch<dim>          &patch,
                       const std::vector<double> &values,
                       const unsigned int         n_values,
                       std::vector<double>       &sums);

  /** v_p = sum_A N_A v_A for all slots. Ghost values must be up to date. */
  template <int dim>
  void
  interpolate_to_points(const Patch<dim>                    &patch,
                        const std::vector<double>           &nodal,
                        std::vector<dealii::Tensor<1, dim>> &at_points);

  /** d v_i / dx_j, [i][j], for all slots. Ghost values must be up to date. */
  template <int dim>
  void
  gradients_at_points(const Patch<dim>                    &patch,
                      const std::vector<double>           &nodal,
                      std::vector<dealii::Tensor<2, dim>> &gradients);

  /**
   * The local node at each slot of each row of a NodeMatrix, to multiply with
   * it many times. Slots without an active node, where the matrix is zero, have
   * the row's own node.
   */
  template <int dim>
  std::vector<unsigned int>
  node_neighbours(const NodeMatrix<dim> &matrix, const Patch<dim> &patch);

  /**
   * y = A x, dim values per local node, for a matrix with one component; see the
   * multiply() below.
   */
  template <int dim>
  void
  multiply_velocities(const NodeMatrix<dim>           &matrix,
                      const std::vector<unsigned int> &neighbours,
                      const std::vector<double>       &x,
                      std::vector<double>             &y);

  /** The same for the last of dim + 1 values per local node; others are left alone. */
  template <int dim>
  void
  multiply_pressures(const NodeMatrix<dim>           &matrix,
                     const std::vector<unsigned int> &neighbours,
                     const std::vector<double>       &x,
                     std::vector<double>             &y);

  /** sums += factor A x, dim values of x per local node, n_components() of the sums. */
  template <int dim>
  void
  add_product(const Patch<dim>          &patch,
              const double               factor,
              const NodeMatrix<dim>     &matrix,
              const std::vector<double> &x,
              std::vector<double>       &sums);

  /**
   * y = A x with this rank's share of the matrix: partial sums at all local
   * nodes. Ghost values of x must be up to date.
   */
  template <int dim>
  void
  multiply(const NodeMatrix<dim>     &matrix,
           const Patch<dim>          &patch,
           const unsigned int         n_components,
           const std::vector<double> &x,
           std::vector<double>       &y);
} // namespace kedge

#endif
