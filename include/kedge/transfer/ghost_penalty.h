#ifndef kedge_transfer_ghost_penalty_h
#define kedge_transfer_ghost_penalty_h

#include <kedge/equations/node_matrix.h>
#include <kedge/fields/patch.h>

namespace kedge
{
  /**
   * Volume of material, in cells, from which a cell counts as full. A little
   * over one half: a cell that is filled so far holds its nodes as well as any
   * (the mass of the farthest falls by a factor of 8 per direction at most),
   * and round-off does not decide about cells of which a regular lattice of
   * points fills exactly one half.
   */
  constexpr double full_cell = 0.55;

  /**
   * Smallest over largest nodal mass (row sums) below which the mass counts as
   * badly conditioned, so that the mapping of velocities takes the ghost mass
   * too. The diagonal goes with the square of the row sum: above this ratio a
   * ghost mass of 1e-6 changes it by about one hundredth at most.
   */
  constexpr double badly_conditioned_mass = 1e-2;

  /** A face of the grid with a penalty. */
  struct GhostFace
  {
    unsigned int lower_cell; ///< number in the window of the cell on its lower side
    unsigned int direction;  ///< of its normal
    double       density;    ///< rho, mean of the material in both cells [kg/m^3]
    double       modulus;    ///< Young's modulus E, likewise [Pa]
  };

  /**
   * J_G of (3.151) for one face and one component,
   *   h^3/3 int [dN_A/dn] [dN_B/dn] da,   [.] the jump across the face,
   * exactly integrated; h is the cell size along the normal. Q1 functions make
   * it h/3 (1, -2, 1) (1, -2, 1)^T along the normal times the mass matrices of
   * linear elements in the other directions.
   *
   * @param h cell size per direction [m]
   * @return row by row, 3 nodes along the normal by 2 in the other directions,
   *         x fastest [m^dim]
   */
  template <int dim>
  std::vector<double>
  ghost_face_matrix(const dealii::Tensor<1, dim> &h, const unsigned int direction);

  /**
   * Face penalty of the jumps of normal gradients (ghost stabilisation, Burman
   * 2010; (3.151)-(3.153)), on all faces between a partly filled cell and a
   * neighbour with material: it makes badly filled nodes continue the linear
   * field of the cells next to them. J_G is symmetric, positive semi-definite
   * and zero for linear fields, so rigid motions cost nothing and
   * sum_A (J_G u)_A = 0.
   */
  template <int dim>
  class GhostPenalty
  {
  public:
    /**
     * Finds the faces around this rank's cells and flags their nodes in @p
     * reached, which all have material of some rank (collective).
     *
     * @param modulus_of_body Young's moduli [Pa]
     */
    void
    find(const Patch<dim>           &patch,
         const std::vector<double>  &modulus_of_body,
         std::vector<unsigned char> &reached);

    /** Adds this rank's share of M_G = factor rho J_G [kg]; the matrix must have radius 2. */
    void
    add_mass(const Patch<dim> &patch, const double factor, NodeMatrix<dim> &mass) const;

    /**
     * Adds this rank's share of K_G = factor E / h^2 J_G [N/m]. Different from
     * (3.152), which lacks the 1/h^2 that makes it a stiffness.
     */
    void
    add_stiffness(const Patch<dim> &patch, const double factor, NodeMatrix<dim> &stiffness) const;

    /**
     * Adds this rank's share of factor/h^2 J_G: for a factor c kappa_0/(rho_0 g) the volume of
     * fluid that flows for a pressure, K_G^(f) of (4.177) over rho_0 [m^3/(Pa s)]. Different
     * from the print, which lacks the 1/(g h^2) as (3.152) lacks the 1/h^2.
     */
    void
    add_gradient_penalty(const Patch<dim> &patch,
                         const double      factor,
                         NodeMatrix<dim>  &matrix) const;

    /**
     * Adds this rank's share of factor J_G: for a factor c/K_f the volume of fluid that is
     * stored for a pressure, M_G^(f) of (4.176) over rho_0 [m^3/Pa].
     */
    void
    add_value_penalty(const Patch<dim> &patch, const double factor, NodeMatrix<dim> &matrix) const;

    /** The faces of this rank; each belongs to one rank. */
    const std::vector<GhostFace> &
    faces() const
    {
      return faces_;
    }

  private:
    void
    add(const Patch<dim>                               &patch,
        const std::function<double(const GhostFace &)> &coefficient,
        NodeMatrix<dim>                                &matrix) const;

    std::vector<GhostFace> faces_;
  };

  /** Smallest over largest row sum of a mass matrix [-] (collective). */
  template <int dim>
  double
  lumped_mass_ratio(const Patch<dim> &patch, const NodeMatrix<dim> &mass);
} // namespace kedge

#endif
