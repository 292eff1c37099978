#ifndef kedge_surfaces_facet_means_h
#define kedge_surfaces_facet_means_h

#include <kedge/surfaces/body_surface.h>

namespace kedge
{
  /** A node's part in the mean over a facet. */
  struct MeanFunction
  {
    unsigned int node; ///< local number
    double       all;  ///< mean of the node's function, (1/A) int N da
    double       own;  ///< what this rank's cells have of it
  };

  /** Of all nodes that have one, each once, ascending; sum of all = 1, sum of all x_I = middle. */
  using MeanFunctions = std::vector<MeanFunction>;

  /**
   * The mean functions of a plane facet with the given corners on or near the surface of a body. It
   * is cut along the lines of the grid, and on each piece the functions are those of the cell in
   * which the body lies below it (BodySurface::root_at()). So what a uniform pressure on the facet
   * gives the nodes is int N_I p da, as its share of the stresses in the body asks.
   *
   * @param inward into the body
   * @param facet  of the surface: what lies in a cell without points of the body follows its
   * nearest vertex
   */
  template <int dim>
  MeanFunctions
  mean_functions(const BodySurface<dim>                    &surface,
                 const std::array<dealii::Point<dim>, dim> &corners,
                 const dealii::Tensor<1, dim>              &inward,
                 const unsigned int                         facet);

  /** This rank's part of the mean of a nodal vector with dim components per local node. */
  template <int dim>
  dealii::Tensor<1, dim>
  own_part_of_mean(const MeanFunctions &functions, const std::vector<double> &nodal)
  {
    dealii::Tensor<1, dim> sum;
    for (const MeanFunction &of : functions)
      for (int d = 0; d < dim; ++d)
        sum[d] += of.own * nodal[std::size_t(of.node) * dim + d];
    return sum;
  }

  /** Adds a force, spread evenly over the facet, to nodal sums of the patch's components. */
  template <int dim>
  void
  add_spread_force(const BodySurface<dim>       &surface,
                   const MeanFunctions          &functions,
                   const dealii::Tensor<1, dim> &force,
                   std::vector<double>          &sums)
  {
    const std::size_t n_components = surface.patch.n_components();
    for (const MeanFunction &of : functions)
      for (int d = 0; d < dim; ++d)
        sums[of.node * n_components + d] += of.own * force[d];
  }

  /** Adds up parts of vectors over the ranks of a patch (collective). */
  template <int dim>
  void
  sum_over_ranks(const Patch<dim> &patch, std::vector<dealii::Tensor<1, dim>> &parts);

  /** The mean functions of a surface's own facets in a step, found when they are first asked for.
   */
  template <int dim>
  class FacetMeans
  {
  public:
    /** Begins a step of a surface, which must last as long as this is used. */
    void
    reset(const BodySurface<dim> &of)
    {
      surface = &of;
      known.assign(of.n_facets(), {});
    }

    const MeanFunctions &
    of(const unsigned int facet) const;

  private:
    const BodySurface<dim>            *surface = nullptr;
    mutable std::vector<MeanFunctions> known; ///< by facet
  };
} // namespace kedge

#endif
