#include <kedge/base/user_errors.h>
#include <kedge/surfaces/body_surface.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace kedge
{
  template <int dim>
  void
  BodySurface<dim>::seed(const SurfaceMesh<dim> &seeded, const EdgeLengths &edges)
  {
    this->edges = edges;
    committed   = {seeded, seeded.vertices, {}};
    for (unsigned int f = 0; f < n_facets(); ++f)
      committed.reference_areas.push_back(area_vector<dim>(seeded.corners(f)).norm());
  }



  namespace
  {
    /** Calls visit(cell) for the cells of a level around @p x that have numbers. */
    template <int dim, typename Visit>
    void
    for_cells_around(const GridLevels<dim>    &levels,
                     const unsigned int        level,
                     const dealii::Point<dim> &x,
                     const int                 radius,
                     const Visit              &visit)
    {
      const LatticeIndex<dim> here  = levels.lattice(level).cell_of(x);
      const int               width = 2 * radius + 1;
      unsigned int            n     = 1;
      for (int d = 0; d < dim; ++d)
        n *= width;
      for (unsigned int k = 0; k < n; ++k)
        {
          LatticeIndex<dim> cell;
          unsigned int      rest = k;
          for (int d = 0; d < dim; ++d, rest /= width)
            cell[d] = here[d] + static_cast<int>(rest % width) - radius;
          if (levels.cells(level).contains_cell(cell))
            visit(cell);
        }
    }

    /** How far a place is from a cell, in cells: of those that touch in it the one whose centre is
     * nearest is nearer. */
    template <int dim>
    double
    distance_to(const Lattice<dim>       &lattice,
                const LatticeIndex<dim>  &cell,
                const dealii::Point<dim> &x)
    {
      double outside = 0., from_centre = 0.; // squares
      for (int d = 0; d < dim; ++d)
        {
          const double s = lattice.scaled(x[d], d) - cell[d];
          outside += std::pow(std::max({-s, 0., s - 1.}), 2);
          from_centre += (s - 0.5) * (s - 0.5);
        }
      return std::sqrt(outside) + 1e-3 * std::sqrt(from_centre);
    }
  } // namespace



  /** How much of each cell of the window the body's points fill, in cells. */
  template <int dim>
  std::vector<double>
  BodySurface<dim>::fillings() const
  {
    const GridLevels<dim> &levels = patch.grid().levels();
    std::vector<double>    result(patch.window().n_cells_total(), 0.);
    const auto            &points = patch.points;
    for (const auto &batch : points.batches)
      if (batch.body == body)
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const LatticeIndex<dim> cell = levels.cell_at(points.location[slot]);
            result[patch.window().cell_number(cell)] +=
              points.volume[slot] * points.determinant[slot] /
              levels.lattice(levels.on_level(cell).level).cell_volume();
          }
    if (dealii::Utilities::MPI::n_mpi_processes(patch.grid().communicator()) > 1)
      MPI_Allreduce(MPI_IN_PLACE, // points of a cell are all on one rank: the sums are exact
                    result.data(),
                    static_cast<int>(result.size()),
                    MPI_DOUBLE,
                    MPI_SUM,
                    patch.grid().communicator());
    return result;
  }



  namespace
  {
    /** The well-filled cell nearest to a place, and the fullest one around. */
    template <int dim>
    struct Surroundings
    {
      LatticeIndex<dim> nearest, fullest;
      double            least = std::numeric_limits<double>::max(); ///< distance of the nearest
      double            most  = 0.;                                 ///< filling of the fullest
    };

    /** Looks at the cells of all levels around @p x, up to @p radius of them away. */
    template <int dim>
    Surroundings<dim>
    look_around(const Patch<dim>          &patch,
                const dealii::Point<dim>  &x,
                const std::vector<double> &filling,
                const int                  radius)
    {
      const GridLevels<dim> &levels = patch.grid().levels();
      Surroundings<dim>      result;
      result.nearest = result.fullest = levels.cell_at(x);
      for (unsigned int level = 0; level < levels.size(); ++level)
        for_cells_around<dim>(levels, level, x, radius, [&](const LatticeIndex<dim> &cell) {
          const LatticeIndex<dim> in_window = levels.in_window({level, cell});
          const double            full      = filling[patch.window().cell_number(in_window)];
          if (full > result.most)
            {
              result.most    = full;
              result.fullest = in_window;
            }
          if (full < BodySurface<dim>::well_filled * (1. - 1e-9))
            return;
          const double distance = distance_to<dim>(levels.lattice(level), cell, x) / (1 << level);
          if (distance < result.least)
            {
              result.least   = distance;
              result.nearest = in_window;
            }
        });
      return result;
    }

    /** How near, in the scene's cells, one can be that look_around() with this radius leaves out.
     */
    template <int dim>
    double
    left_out_beyond(const GridLevels<dim> &levels, const dealii::Point<dim> &x, const int radius)
    {
      double result = std::numeric_limits<double>::max();
      for (unsigned int level = 0; level < levels.size(); ++level)
        {
          const Lattice<dim>     &lattice = levels.lattice(level);
          const LatticeIndex<dim> here    = lattice.cell_of(x);
          double                  to_next = 0.5; // cell beside this one, in cells
          for (int d = 0; d < dim; ++d)
            {
              const double s = lattice.scaled(x[d], d) - here[d];
              to_next        = std::min({to_next, s, 1. - s});
            }
          result = std::min(result, (to_next + radius) / (1 << level));
        }
      return result;
    }
  } // namespace



  template <int dim>
  LatticeIndex<dim>
  BodySurface<dim>::root_cell(const dealii::Point<dim>  &x,
                              const std::vector<double> &filling,
                              const int                  radius) const
  {
    for (int near = 0; near < radius; ++near)
      if (const auto around = look_around(patch, x, filling, near);
          around.least < left_out_beyond(patch.grid().levels(), x, near))
        return around.nearest;
    const auto around = look_around(patch, x, filling, radius);
    if (around.most ==
        0.) // far from all material: what is torn off follows the nearest cell there is
      {
        const auto &n      = patch.window().n_cells;
        const int   widest = *std::max_element(n.begin(), n.end());
        if (radius > 2 * widest)
          {
            std::ostringstream message;
            message << "Surface of body '" << body_name << "': its vertex at (" << x
                    << ") is farther from all its material points than the grid in use is wide. A "
                       "body that is too thin for its cells cannot carry its surface; take smaller "
                       "cells or more of them over its thickness.";
            throw UserError(message.str());
          }
        return root_cell(x, filling, 2 * radius);
      }
    return around.least < std::numeric_limits<double>::max() ? around.nearest : around.fullest;
  }



  /** Marks the facets that have left through open sides. */
  template <int dim>
  void
  BodySurface<dim>::let_out(const std::vector<double> &filling)
  {
    const bool no_points = std::all_of(filling.begin(), filling.end(), [](const double full) {
      return full == 0.;
    });
    for (unsigned int f = 0; f < n_facets(); ++f)
      {
        dealii::Point<dim> middle;
        for (const unsigned int v : mesh().facets[f])
          middle += mesh().vertices[v] / dim;
        if (!no_points && !open_sides.let_out(patch.grid().lattice(), middle))
          continue;
        committed.mesh.left.resize(n_facets());
        committed.mesh.left[f] = true;
      }
  }



  /** Those of facets that have not left. */
  template <int dim>
  std::vector<bool>
  BodySurface<dim>::vertices_that_stay() const
  {
    std::vector<bool> result(n_vertices(), committed.mesh.left.empty());
    for (unsigned int f = 0; f < n_facets(); ++f)
      if (!mesh().has_left(f))
        for (const unsigned int v : mesh().facets[f])
          result[v] = true;
    return result;
  }



  template <int dim>
  void
  BodySurface<dim>::claim_nodes(std::vector<unsigned char> &reached)
  {
    const auto               &window  = patch.window();
    const std::vector<double> filling = fillings();
    is_known                          = true;
    if (open_sides.any())
      let_out(filling);
    const std::vector<bool>     stays = vertices_that_stay();
    std::set<LatticeIndex<dim>> around;
    const auto                  claim = [&](const LatticeIndex<dim> &cell) {
      for (unsigned int c = 0; c < n_corners; ++c)
        {
          LatticeIndex<dim> node = cell;
          for (int d = 0; d < dim; ++d)
            node[d] += static_cast<int>((c >> d) & 1u);
          reached[window.node_number(node)] = 1;
        }
    };
    for (unsigned int v = 0; v < n_vertices(); ++v)
      {
        if (!stays[v])
          continue;
        claim(root_cell(mesh().vertices[v], filling, search_radius));
        // what lies on a facet between vertices
        const LatticeIndex<dim> here = patch.grid().levels().cell_at(mesh().vertices[v]);
        if (around.insert(here).second)
          for (unsigned int k = 0; k < (dim == 2 ? 9u : 27u); ++k)
            {
              LatticeIndex<dim> cell = here;
              unsigned int      rest = k;
              for (int d = 0; d < dim; ++d, rest /= 3)
                cell[d] += static_cast<int>(rest % 3) - 1;
              if (window.contains_cell(cell) && filling[window.cell_number(cell)] > 0.)
                claim(cell);
            }
      }
  }



  template <int dim>
  void
  BodySurface<dim>::find_roots()
  {
    const auto               &window  = patch.window();
    const std::vector<double> filling = fillings();
    if (open_sides.any())
      let_out(filling);
    const std::vector<bool> stays = vertices_that_stay();
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(patch.grid().communicator());
    std::map<unsigned int, unsigned int> number_of_cell;
    roots.clear();
    root_of_vertex.assign(n_vertices(), elsewhere);
    is_own.assign(n_vertices(), false);
    weights.clear();
    first_weight.assign(1, 0);
    for (unsigned int v = 0; v < n_vertices(); ++v)
      {
        first_weight.push_back(static_cast<unsigned int>(weights.size()));
        if (!stays[v])
          continue;
        const dealii::Point<dim> &x    = mesh().vertices[v];
        const LatticeIndex<dim>   cell = root_cell(x, filling, search_radius);
        is_own[v]                      = patch.grid().cell_owner(cell) == rank;
        if (!is_own[v] && !is_known)
          continue;
        const auto [entry, is_new] =
          number_of_cell.emplace(window.cell_number(cell), static_cast<unsigned int>(roots.size()));
        if (is_new)
          {
            roots.push_back(root_of(cell));
            AssertThrow(roots.back().is_known, dealii::ExcInternalError());
          }
        root_of_vertex[v] = entry->second;
        for_functions(roots[entry->second], x, [&](const unsigned int node, const double N) {
          weights.push_back({node, N});
        });
        first_weight.back() = static_cast<unsigned int>(weights.size());
      }
    has_points.resize(filling.size());
    for (std::size_t cell = 0; cell < filling.size(); ++cell)
      has_points[cell] = filling[cell] > 0.;
  }



  template <int dim>
  typename BodySurface<dim>::Root
  BodySurface<dim>::root_of(const LatticeIndex<dim> &cell) const
  {
    const auto &grid   = patch.grid();
    Root        result = {cell, false, true};
    result.is_own =
      grid.cell_owner(cell) == dealii::Utilities::MPI::this_mpi_process(grid.communicator());
    for (unsigned int c = 0; c < n_corners; ++c)
      {
        LatticeIndex<dim> node = cell;
        for (int d = 0; d < dim; ++d)
          node[d] += static_cast<int>((c >> d) & 1u);
        const int local = patch.nodes.local(grid.window().node_number(node));
        result.is_known = result.is_known && local >= 0;
      }
    return result;
  }



  template <int dim>
  typename BodySurface<dim>::Root
  BodySurface<dim>::root_at(const LatticeIndex<dim> &cell, const unsigned int nearest_vertex) const
  {
    const auto &window = patch.window();
    if (window.contains_cell(cell) && has_points[window.cell_number(cell)])
      return root_of(cell);
    const unsigned int known = root_of_vertex[nearest_vertex];
    return known == elsewhere ? Root{} : roots[known];
  }



  template <int dim>
  void
  BodySurface<dim>::interpolate(const std::vector<double>           &nodal,
                                std::vector<dealii::Tensor<1, dim>> &at_vertices) const
  {
    at_vertices.assign(n_vertices(), dealii::Tensor<1, dim>());
    for (unsigned int v = 0; v < n_vertices(); ++v)
      for_nodes(v, [&](const unsigned int node, const double N) {
        for (int d = 0; d < dim; ++d)
          at_vertices[v][d] += N * nodal[std::size_t(node) * dim + d];
      });
    if (dealii::Utilities::MPI::n_mpi_processes(patch.grid().communicator()) == 1)
      return;
    std::vector<double> sums;
    for (const auto &value : at_vertices)
      sums.insert(sums.end(), value.begin_raw(), value.end_raw());
    MPI_Allreduce(MPI_IN_PLACE,
                  sums.data(),
                  static_cast<int>(sums.size()),
                  MPI_DOUBLE,
                  MPI_SUM,
                  patch.grid().communicator());
    for (unsigned int v = 0; v < n_vertices(); ++v)
      std::copy_n(sums.begin() + v * dim, dim, at_vertices[v].begin_raw());
  }



  template <int dim>
  void
  BodySurface<dim>::interpolate_pressure(const std::vector<double> &unknowns,
                                         std::vector<double>       &at_vertices) const
  {
    const std::size_t n_components = patch.n_components();
    at_vertices.assign(n_vertices(), 0.);
    for (unsigned int v = 0; v < n_vertices(); ++v)
      for_nodes(v, [&](const unsigned int node, const double N) {
        at_vertices[v] += N * unknowns[(node + 1) * n_components - 1];
      });
    if (dealii::Utilities::MPI::n_mpi_processes(patch.grid().communicator()) > 1)
      MPI_Allreduce(MPI_IN_PLACE,
                    at_vertices.data(),
                    static_cast<int>(at_vertices.size()),
                    MPI_DOUBLE,
                    MPI_SUM,
                    patch.grid().communicator());
  }



  template <int dim>
  void
  BodySurface<dim>::move(const std::vector<dealii::Tensor<1, dim>> &displacements)
  {
    moved = committed;
    for (unsigned int v = 0; v < n_vertices(); ++v)
      moved.mesh.vertices[v] += displacements[v];
    heritage_ = adapt<dim>(moved, edges);
  }



  template <int dim>
  void
  BodySurface<dim>::commit()
  {
    committed = std::move(moved);
    if (!heritage_.empty())
      ++generation_;
  }



  template <int dim>
  std::vector<double>
  BodySurface<dim>::save() const
  {
    std::vector<double> result = {double(n_vertices()), double(n_facets())};
    for (const auto *places : {&mesh().vertices, &committed.start})
      for (const auto &x : *places)
        result.insert(result.end(), x.begin_raw(), x.end_raw());
    for (const auto &facet : mesh().facets)
      result.insert(result.end(), facet.begin(), facet.end());
    result.insert(result.end(), committed.reference_areas.begin(), committed.reference_areas.end());
    for (unsigned int f = 0; f < n_facets(); ++f)
      if (mesh().has_left(f))
        result.push_back(f);
    return result;
  }



  template <int dim>
  void
  BodySurface<dim>::restore(const std::vector<double> &saved)
  {
    AssertThrow(saved.size() >= 2, dealii::ExcInternalError());
    SurfaceMesh<dim> &mesh = committed.mesh;
    mesh.vertices.resize(static_cast<std::size_t>(saved[0]));
    committed.start.resize(mesh.vertices.size());
    mesh.facets.resize(static_cast<std::size_t>(saved[1]));
    committed.reference_areas.resize(mesh.facets.size());
    Assert(saved.size() >= 2 + 2 * dim * n_vertices() + (dim + 1) * n_facets(),
           dealii::ExcInternalError());
    auto next = saved.begin() + 2;
    for (auto *places : {&mesh.vertices, &committed.start})
      for (auto &x : *places)
        for (int d = 0; d < dim; ++d)
          x[d] = *next++;
    for (auto &facet : mesh.facets)
      for (unsigned int &vertex : facet)
        vertex = static_cast<unsigned int>(*next++);
    for (double &area : committed.reference_areas)
      area = *next++;
    mesh.left.assign(next == saved.end() ? 0 : n_facets(), false);
    for (; next != saved.end(); ++next)
      mesh.left[static_cast<std::size_t>(*next)] = true;
    ++generation_; // those who know the facets by number read them anew
  }

  template class BodySurface<2>;
  template class BodySurface<3>;
} // namespace kedge
