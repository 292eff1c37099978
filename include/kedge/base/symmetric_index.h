#ifndef kedge_base_symmetric_index_h
#define kedge_base_symmetric_index_h

namespace kedge
{
  /** Number of independent components of a symmetric second-order tensor. */
  template <int dim>
  constexpr int n_symmetric = dim *(dim + 1) / 2;

  /**
   * Position of component (i, j) of a symmetric tensor in a plain array, in
   * deal.II's order: 00, 11, 01 in 2D; 00, 11, 22, 01, 02, 12 in 3D.
   */
  template <int dim>
  constexpr int
  symmetric_index(const int i, const int j)
  {
    static_assert(dim == 2 || dim == 3);
    if (i == j)
      return i;
    return dim == 2 ? 2 : i + j + 2;
  }

  /** The pair (i, j), i <= j, that stands at a position of symmetric_index(). */
  template <int dim>
  constexpr int symmetric_row[n_symmetric<dim>] = {};
  template <>
  inline constexpr int symmetric_row<2>[3] = {0, 1, 0};
  template <>
  inline constexpr int symmetric_row<3>[6] = {0, 1, 2, 0, 0, 1};

  template <int dim>
  constexpr int symmetric_column[n_symmetric<dim>] = {};
  template <>
  inline constexpr int symmetric_column<2>[3] = {0, 1, 1};
  template <>
  inline constexpr int symmetric_column<3>[6] = {0, 1, 2, 1, 2, 2};
} // namespace kedge

#endif
