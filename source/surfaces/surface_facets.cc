#include <kedge/surfaces/face_functions.h>
#include <kedge/surfaces/surface_facets.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <map>

namespace kedge
{
  namespace
  {
    /** The material points of a body, by cells. */
    template <int dim>
    class PointsOfBody
    {
    public:
      PointsOfBody(const Patch<dim> &patch, const unsigned int body)
        : patch(patch)
      {
        const auto &points = patch.points;
        for (const auto &batch : points.batches)
          if (batch.body == body)
            for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
              slots[patch.window().cell_number(
                      patch.grid().lattice().cell_of(points.location[slot]))]
                .push_back(slot);
      }

      /** A point, and the square of its distance [m^2]. */
      struct Nearest
      {
        unsigned int slot     = 0;
        double       distance = std::numeric_limits<double>::max();
      };

      /** Whether a cell of the window holds points of this rank. */
      bool
      has_points_in(const LatticeIndex<dim> &cell) const
      {
        return patch.window().contains_cell(cell) &&
               slots.count(patch.window().cell_number(cell)) > 0;
      }

      /** The point nearest to @p x in the cells around it, or, if @p anywhere, in all cells. */
      Nearest
      nearest(const dealii::Point<dim> &x, const bool anywhere) const
      {
        Nearest    best;
        const auto look = [&](const std::vector<unsigned int> &of_cell) {
          for (const unsigned int slot : of_cell)
            if (const double to_x = patch.points.location[slot].distance_square(x);
                to_x < best.distance)
              best = {slot, to_x};
        };
        if (anywhere)
          for (const auto &[cell, of_cell] : slots)
            look(of_cell);
        const LatticeIndex<dim> here = patch.grid().lattice().cell_of(x);
        for (int k = 0; k < (dim == 2 ? 9 : 27) && !anywhere; ++k)
          {
            LatticeIndex<dim> cell = here;
            for (int d = 0, rest = k; d < dim; ++d, rest /= 3)
              cell[d] += rest % 3 - 1;
            if (!patch.window().contains_cell(cell))
              continue;
            const auto found = slots.find(patch.window().cell_number(cell));
            if (found != slots.end())
              look(found->second);
          }
        return best;
      }

    private:
      const Patch<dim>                                 &patch;
      std::map<unsigned int, std::vector<unsigned int>> slots; ///< by cell of the window
    };

    /** A place just inside the body below the middle of a part of a facet with these corners. */
    template <int dim>
    dealii::Point<dim>
    place_below(const Lattice<dim>                        &lattice,
                const std::array<dealii::Point<dim>, dim> &corners,
                const FacetPart<dim>                      &part)
    {
      constexpr double                 depth  = 1e-6; // of a cell
      const dealii::Tensor<1, dim>     normal = area_vector<dim>(corners);
      typename FacetPart<dim>::Weights middle;
      middle.fill(1. / dim);
      return place_on_facet<dim>(corners, part.place(middle)) -
             depth * lattice.smallest_cell_size() / normal.norm() * normal;
    }

    /** Whether a facet looks rather to this side than to others; to all of 2 dim. */
    template <int dim>
    bool
    looks_to(const unsigned int side, const dealii::Tensor<1, dim> &normal)
    {
      if (side == 2 * dim)
        return true;
      unsigned int largest = 0; // of two that are as large the first
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) > (1. + 1e-9) * std::abs(normal[largest]))
          largest = d;
      return side == 2 * largest + (normal[largest] > 0.);
    }
  } // namespace



  template <int dim>
  std::vector<PlaceOfSurface<dim>>
  SurfaceFacets<dim>::choose(const unsigned int       number,
                             const SurfaceParameters &parameters,
                             const Expression        &where,
                             const BodySurface<dim>  &surface)
  {
    Chosen result{number, parameters.side, where, &surface, 0, {}};
    choose_parts(result);
    std::vector<PlaceOfSurface<dim>> places;
    for (const Part &part : result.parts)
      for (const auto &gauss : facet_quadrature<dim>())
        places.push_back({place_on_facet<dim>(surface.corners_at_start(part.facet),
                                              part.covered.place(gauss.place)),
                          gauss.weight * part.covered.fraction() * part.area});
    chosen.push_back(std::move(result));
    return places;
  }



  /** The facets, or the parts of them, that were to be chosen at the start of the run. */
  template <int dim>
  void
  SurfaceFacets<dim>::choose_parts(Chosen &chosen)
  {
    const BodySurface<dim> &surface = *chosen.surface;
    chosen.generation               = surface.generation();
    chosen.parts.clear();
    for (unsigned int f = 0; f < surface.n_facets(); ++f)
      {
        const auto corners = surface.corners_at_start(f);
        if (!looks_to<dim>(chosen.side, area_vector<dim>(corners)))
          continue;
        for (const auto &part : parts_where<dim>(chosen.where, corners))
          chosen.parts.push_back({f, surface.reference_area(f), part});
      }
  }



  namespace
  {
    /**
     * Finds the nearest material points and leaves out the candidates that belong to another rank:
     * to the one whose points lie in the candidate's cell, else to that of the nearest point
     * (collective).
     */
    template <int dim, class Candidate>
    void
    find_points(const PointsOfBody<dim> &body,
                const MPI_Comm           ranks,
                std::vector<Candidate>  &candidates)
    {
      struct Found // as MPI_DOUBLE_INT has it
      {
        double distance;
        int    rank;
      };
      const int          rank = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(ranks));
      std::vector<Found> found(candidates.size(), {std::numeric_limits<double>::max(), rank});
      for (const bool anywhere : {false, true}) // the second for what is far from all material
        {
          bool any = false;
          for (std::size_t k = 0; k < candidates.size(); ++k)
            if (found[k].distance == std::numeric_limits<double>::max())
              {
                const auto best          = body.nearest(candidates[k].point.place, anywhere);
                candidates[k].point.slot = best.slot;
                found[k] = {body.has_points_in(candidates[k].cell) ? -1. : best.distance, rank};
                any      = true;
              }
          if (any && dealii::Utilities::MPI::n_mpi_processes(ranks) > 1)
            MPI_Allreduce(MPI_IN_PLACE,
                          found.data(),
                          static_cast<int>(found.size()),
                          MPI_DOUBLE_INT,
                          MPI_MINLOC,
                          ranks);
        }
      std::size_t n = 0;
      for (std::size_t k = 0; k < candidates.size(); ++k)
        if (found[k].rank == rank && found[k].distance < std::numeric_limits<double>::max())
          candidates[n++] = candidates[k];
      candidates.resize(n);
    }
  } // namespace



  /** The quadrature points on the chosen parts of a surface, on all ranks alike. */
  template <int dim>
  std::vector<typename SurfaceFacets<dim>::Candidate>
  SurfaceFacets<dim>::candidates_on(const Chosen &here, const GridLevels<dim> &levels)
  {
    std::vector<Candidate> result;
    const Lattice<dim>     polynomials =
      lattice_of_polynomials(levels.finest(), here.surface->patch.basis_of(here.surface->body));
    for (const Part &part : here.parts)
      {
        if (here.surface->mesh().has_left(part.facet))
          continue;
        const auto corners = here.surface->mesh().corners(part.facet);
        const auto start   = here.surface->corners_at_start(part.facet);
        const auto area = area_vector<dim>(corners), area_at_start = area_vector<dim>(start);
        for (const auto &piece : cut_to_cells<dim>(polynomials, corners, part.covered))
          {
            const auto   cell = levels.cell_at(place_below<dim>(levels.finest(), corners, piece));
            const double fraction = piece.fraction();
            for (const auto &gauss : facet_quadrature<dim>())
              {
                const auto        weights = piece.place(gauss.place);
                SurfacePoint<dim> point{};
                point.place            = place_on_facet<dim>(corners, weights);
                point.surface          = here.number;
                point.reference_area   = gauss.weight * fraction * part.area;
                point.reference_place  = place_on_facet<dim>(start, weights);
                point.reference_normal = area_at_start / area_at_start.norm();
                for (int d = 0; d < dim; ++d)
                  point.area[d] = gauss.weight * fraction * area[d];
                result.push_back({point, cell});
              }
          }
      }
    return result;
  }



  template <int dim>
  void
  SurfaceFacets<dim>::add_points(const Patch<dim> &patch, std::vector<SurfacePoint<dim>> &points)
  {
    const GridLevels<dim> &levels = patch.grid().levels();
    for (Chosen &here : chosen)
      {
        if (&here.surface->patch != &patch)
          continue;
        if (here.generation != here.surface->generation())
          choose_parts(here);
        const BasisKind basis      = patch.basis_of(here.surface->body);
        auto            candidates = candidates_on(here, levels);
        find_points<dim>(PointsOfBody<dim>(patch, here.surface->body),
                         patch.grid().communicator(),
                         candidates);
        for (const auto &candidate : candidates)
          {
            SurfacePoint<dim>         point = candidate.point;
            const dealii::Point<dim> &at    = patch.points.location[point.slot];
            for (int d = 0; d < dim; ++d)
              point.offset[d] = point.place[d] - at[d];
            auto functions = functions_of_cell<dim>(patch, basis, candidate.cell, point.place);
            if (!functions)
              functions = functions_of_cell<dim>(patch, basis, levels.cell_at(at), point.place);
            AssertThrow(functions, dealii::ExcInternalError());
            point.functions = point.gradients = *functions;
            points.push_back(point);
          }
      }
  }

  template class SurfaceFacets<2>;
  template class SurfaceFacets<3>;
} // namespace kedge
