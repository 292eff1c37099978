#include <kedge/points/outline.h>
#include <kedge/surfaces/seed_surface.h>

#include <algorithm>
#include <map>

namespace kedge
{
  namespace
  {
    /** A lattice of points around a region, with the sign of each. */
    template <int dim>
    class SampledRegion
    {
    public:
      using Index = std::array<unsigned int, dim>;

      SampledRegion(const Geometry<dim>            &geometry,
                    const double                    spacing,
                    const dealii::BoundingBox<dim> &domain)
        : geometry(geometry)
      {
        bounds                  = geometry.bounding_box(domain);
        const auto &[low, high] = bounds.get_boundary_points();
        std::size_t total       = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // off the region's bounds, where its faces would lie on the lattice
            n[d]      = static_cast<unsigned int>(std::ceil((high[d] - low[d]) / spacing)) + 3;
            origin[d] = low[d] - 0.5 * (n[d] - 1 - (high[d] - low[d]) / spacing) * spacing;
            total *= n[d];
          }
        width = spacing;
        inside.resize(total);
        for (std::size_t k = 0; k < total; ++k)
          {
            const dealii::Point<dim> x = place(k);
            inside[k]                  = geometry.contains(x);
            for (unsigned int d = 0; d < dim; ++d) // what leaves the domain ends there
              inside[k] = inside[k] && x[d] >= low[d] && x[d] <= high[d];
          }
      }

      std::size_t
      number(const Index &index) const
      {
        std::size_t result = 0;
        for (int d = dim - 1; d >= 0; --d)
          result = result * n[d] + index[d];
        return result;
      }

      dealii::Point<dim>
      place(std::size_t number) const
      {
        dealii::Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          {
            x[d] = origin[d] + static_cast<double>(number % n[d]) * width;
            number /= n[d];
          }
        return x;
      }

      /** Where the line from a point inside to one outside leaves the region. */
      dealii::Point<dim>
      crossing(const std::size_t from, const std::size_t to) const
      {
        const dealii::Point<dim> a = place(from), b = place(to);
        double                   low = 0., high = 1.;
        for (unsigned int k = 0; k < 50; ++k)
          {
            const double             s                                        = 0.5 * (low + high);
            const dealii::Point<dim> x                                        = a + s * (b - a);
            (geometry.contains(x) && bounds.point_inside(x, 0.) ? low : high) = s;
          }
        return a + low * (b - a);
      }

      const Geometry<dim>     &geometry;
      dealii::Point<dim>       origin;
      double                   width;
      Index                    n;
      std::vector<bool>        inside;
      dealii::BoundingBox<dim> bounds;
    };

    /** The simplices that the corners of a cube form along each order of the axes (Kuhn). */
    template <int dim>
    std::vector<std::array<std::array<unsigned int, dim>, dim + 1>>
    simplices_of_cube()
    {
      std::vector<std::array<std::array<unsigned int, dim>, dim + 1>> result;
      std::array<unsigned int, dim>                                   order;
      for (unsigned int d = 0; d < dim; ++d)
        order[d] = d;
      do
        {
          result.emplace_back();
          std::array<unsigned int, dim> corner{};
          result.back()[0] = corner;
          for (unsigned int k = 0; k < dim; ++k)
            {
              corner[order[k]]     = 1;
              result.back()[k + 1] = corner;
            }
      } while (std::next_permutation(order.begin(), order.end()));
      return result;
    }
  } // namespace



  namespace
  {
    /** The cuts of a surface through the simplices of a lattice. */
    template <int dim>
    class Cuts
    {
    public:
      using Index = typename SampledRegion<dim>::Index;

      Cuts(const SampledRegion<dim> &region, const double spacing)
        : region(region)
        , smallest(1e-9 * std::pow(spacing, dim - 1))
        , simplices(simplices_of_cube<dim>())
      {}

      /** Adds the facets in a cell. */
      void
      add_cell(const Index &cell)
      {
        for (const auto &simplex : simplices)
          {
            std::vector<std::size_t> in, out;
            for (const auto &corner : simplex)
              {
                auto index = cell;
                for (unsigned int d = 0; d < dim; ++d)
                  index[d] += corner[d];
                const std::size_t k = region.number(index);
                (region.inside[k] ? in : out).push_back(k);
              }
            if (!in.empty() && !out.empty())
              add_simplex(in, out);
          }
      }

      SurfaceMesh<dim> mesh;

    private:
      /** Adds the cut that parts the corners within from those without. */
      void
      add_simplex(const std::vector<std::size_t> &in, const std::vector<std::size_t> &out)
      {
        dealii::Tensor<1, dim> outward;
        for (const std::size_t k : out)
          outward += region.place(k) / static_cast<double>(out.size());
        for (const std::size_t k : in)
          outward -= region.place(k) / static_cast<double>(in.size());
        std::vector<unsigned int> cut; // in turn around the cut
        for (std::size_t i = 0; i < in.size(); ++i)
          for (std::size_t k = 0; k < out.size(); ++k)
            cut.push_back(vertex(in[i], out[i % 2 == 0 ? k : out.size() - 1 - k]));
        std::array<unsigned int, dim> facet;
        std::copy_n(cut.begin(), dim, facet.begin());
        add_facet(facet, outward);
        if (cut.size() > dim) // a quadrilateral
          {
            facet[0]       = cut[0];
            facet[1]       = cut[2];
            facet[2 % dim] = cut[3 % cut.size()];
            add_facet(facet, outward);
          }
      }

      unsigned int
      vertex(const std::size_t in, const std::size_t out)
      {
        const auto [entry, is_new] =
          numbers.emplace(std::pair(in, out), static_cast<unsigned int>(mesh.vertices.size()));
        if (is_new)
          mesh.vertices.push_back(region.crossing(in, out));
        return entry->second;
      }

      void
      add_facet(const std::array<unsigned int, dim> &facet, const dealii::Tensor<1, dim> &outward)
      {
        mesh.facets.push_back(facet);
        const auto corners = mesh.corners(static_cast<unsigned int>(mesh.facets.size() - 1));
        const auto area    = area_vector<dim>(corners);
        if (area.norm() < smallest) // the surface touches a point of the lattice
          mesh.facets.pop_back();
        else if (area * outward < 0.)
          std::swap(mesh.facets.back()[0], mesh.facets.back()[1]);
      }

      const SampledRegion<dim>                                   &region;
      const double                                                smallest; ///< facet that is kept
      const decltype(simplices_of_cube<dim>())                    simplices;
      std::map<std::pair<std::size_t, std::size_t>, unsigned int> numbers; ///< of vertices
    };
  } // namespace



  template <int dim>
  SurfaceMesh<dim>
  march_surface(const Geometry<dim>            &geometry,
                const double                    spacing,
                const dealii::BoundingBox<dim> &domain)
  {
    const SampledRegion<dim>  region(geometry, spacing, domain);
    Cuts<dim>                 cuts(region, spacing);
    typename Cuts<dim>::Index cell{};
    for (bool more = true; more;)
      {
        cuts.add_cell(cell);
        more = false;
        for (unsigned int d = 0; d < dim && !more; ++d)
          if (++cell[d] + 1 < region.n[d])
            more = true;
          else
            cell[d] = 0;
      }
    return cuts.mesh;
  }



  template <int dim>
  SurfaceMesh<dim>
  seed_surface(const Geometry<dim>            &geometry,
               const double                    spacing,
               const dealii::BoundingBox<dim> &domain)
  {
    const auto known = outline(geometry, spacing);
    return known ? *known : march_surface(geometry, spacing, domain);
  }

  template SurfaceMesh<2>
  march_surface(const Geometry<2> &, const double, const dealii::BoundingBox<2> &);
  template SurfaceMesh<3>
  march_surface(const Geometry<3> &, const double, const dealii::BoundingBox<3> &);
  template SurfaceMesh<2>
  seed_surface(const Geometry<2> &, const double, const dealii::BoundingBox<2> &);
  template SurfaceMesh<3>
  seed_surface(const Geometry<3> &, const double, const dealii::BoundingBox<3> &);
} // namespace kedge
