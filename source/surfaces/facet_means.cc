#include <kedge/surfaces/facet_means.h>
#include <kedge/surfaces/facet_part.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Of a facet's vertices the one that is nearest to @p x. */
    template <int dim>
    unsigned int
    nearest_vertex(const SurfaceMesh<dim>   &mesh,
                   const unsigned int        facet,
                   const dealii::Point<dim> &x)
    {
      unsigned int nearest = mesh.facets[facet][0];
      for (const unsigned int v : mesh.facets[facet])
        if (mesh.vertices[v].distance_square(x) < mesh.vertices[nearest].distance_square(x))
          nearest = v;
      return nearest;
    }

    void
    add(const unsigned int node, const double part, const bool is_own, MeanFunctions &sums)
    {
      auto known = std::lower_bound(sums.begin(),
                                    sums.end(),
                                    node,
                                    [](const MeanFunction &one, const unsigned int other) {
                                      return one.node < other;
                                    });
      if (known == sums.end() || known->node != node)
        known = sums.insert(known, {node, 0., 0.});
      known->all += part;
      known->own += is_own ? part : 0.;
    }
  } // namespace



  namespace
  {
    /** Adds those over a piece in one cell: it has this part of the facet's area. */
    template <int dim>
    void
    add_piece(const BodySurface<dim>                    &surface,
              const std::array<dealii::Point<dim>, dim> &corners,
              const dealii::Point<dim>                  &inside,
              const unsigned int                         facet,
              const double                               part,
              MeanFunctions                             &sums)
    {
      const auto root = surface.root_at(surface.patch.grid().levels().cell_at(inside),
                                        nearest_vertex<dim>(surface.mesh(), facet, inside));
      if (!root.is_known)
        return;
      for (const auto &gauss : facet_quadrature<dim>())
        surface.for_functions(root,
                              place_on_facet<dim>(corners, gauss.place),
                              [&](const unsigned int node, const double N) {
                                add(node, part * gauss.weight * N, root.is_own, sums);
                              });
    }

    /** Whether no line of a lattice cuts a facet. */
    template <int dim>
    bool
    lies_in_one_cell(const Lattice<dim>                        &lattice,
                     const std::array<dealii::Point<dim>, dim> &corners)
    {
      const LatticeIndex<dim> cell = lattice.cell_of(corners[0]);
      for (int i = 1; i < dim; ++i)
        if (lattice.cell_of(corners[i]) != cell)
          return false;
      return true;
    }
  } // namespace



  template <int dim>
  MeanFunctions
  mean_functions(const BodySurface<dim>                    &surface,
                 const std::array<dealii::Point<dim>, dim> &corners,
                 const dealii::Tensor<1, dim>              &inward,
                 const unsigned int                         facet)
  {
    const Lattice<dim> lattice = lattice_of_polynomials(surface.patch.grid().levels().finest(),
                                                        surface.patch.basis_of(surface.body));
    constexpr double   depth   = 1e-6;          // of a cell: which one the body lies in
    const double       length  = inward.norm(); // 0 of a facet without area
    const auto         to_inside =
      (length > 0. ? depth * lattice.smallest_cell_size() / length : 0.) * inward;
    const auto add_to = [&](const std::array<dealii::Point<dim>, dim> &of_piece,
                            const double                               part,
                            MeanFunctions                             &sums) {
      dealii::Point<dim> inside = dealii::Point<dim>() + to_inside;
      for (const auto &corner : of_piece)
        inside += corner / dim;
      add_piece<dim>(surface, of_piece, inside, facet, part, sums);
    };
    MeanFunctions result;
    result.reserve(2 * BodySurface<dim>::n_corners);
    if (lies_in_one_cell<dim>(lattice, corners))
      {
        add_to(corners, 1., result);
        return result;
      }
    const auto pieces  = cut_to_cells<dim>(lattice, corners, FacetPart<dim>::whole());
    double     covered = 0.; // all but round-off of the area
    for (const auto &piece : pieces)
      covered += piece.fraction();
    for (const auto &piece : pieces)
      {
        std::array<dealii::Point<dim>, dim> of_piece;
        for (int i = 0; i < dim; ++i)
          of_piece[i] = place_on_facet<dim>(corners, piece.corners[i]);
        add_to(of_piece, piece.fraction() / covered, result);
      }
    return result;
  }



  template <int dim>
  void
  sum_over_ranks(const Patch<dim> &patch, std::vector<dealii::Tensor<1, dim>> &parts)
  {
    const MPI_Comm ranks = patch.grid().communicator();
    if (dealii::Utilities::MPI::n_mpi_processes(ranks) == 1)
      return;
    std::vector<double> sums;
    for (const auto &part : parts)
      sums.insert(sums.end(), part.begin_raw(), part.end_raw());
    MPI_Allreduce(MPI_IN_PLACE,
                  sums.data(),
                  static_cast<int>(sums.size()),
                  MPI_DOUBLE,
                  MPI_SUM,
                  ranks);
    for (std::size_t k = 0; k < parts.size(); ++k)
      std::copy_n(sums.begin() + k * dim, dim, parts[k].begin_raw());
  }



  template <int dim>
  const MeanFunctions &
  FacetMeans<dim>::of(const unsigned int facet) const
  {
    MeanFunctions &functions = known[facet];
    if (functions.empty())
      {
        const auto corners = surface->mesh().corners(facet);
        functions = mean_functions<dim>(*surface, corners, -area_vector<dim>(corners), facet);
      }
    return functions;
  }

#define KEDGE_INSTANTIATE(dim)                                                                  \
  template MeanFunctions mean_functions<dim>(                                                   \
    const BodySurface<dim> &,                                                                   \
    const std::array<dealii::Point<dim>, std::size_t(dim)> &,                                   \
    const dealii::Tensor<1, dim> &,                                                             \
    const unsigned int);                                                                        \
  template void sum_over_ranks<dim>(const Patch<dim> &, std::vector<dealii::Tensor<1, dim>> &); \
  template class FacetMeans<dim>;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
