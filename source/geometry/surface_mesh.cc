#include <kedge/geometry/surface_mesh.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace kedge
{
  namespace
  {
    unsigned int
    parts_of(const double length, const double spacing)
    {
      // a length that is a multiple of the spacing but for round-off is divided as one
      return std::max(1u, static_cast<unsigned int>(std::ceil(length / spacing * (1. - 1e-9))));
    }

    /** Numbers vertices by a key, each one once. */
    template <int dim, typename Key>
    class NumberedVertices
    {
    public:
      explicit NumberedVertices(SurfaceMesh<dim> &mesh)
        : mesh(mesh)
      {}

      template <typename Place>
      unsigned int
      number(const Key &key, const Place &place)
      {
        const auto [entry, is_new] =
          numbers.emplace(key, static_cast<unsigned int>(mesh.vertices.size()));
        if (is_new)
          mesh.vertices.push_back(place());
        return entry->second;
      }

    private:
      SurfaceMesh<dim>           &mesh;
      std::map<Key, unsigned int> numbers;
    };

    SurfaceMesh<3>
    mesh_of_block(const dealii::Point<3> &lower,
                  const dealii::Point<3> &upper,
                  const double            spacing)
    {
      using Key = std::array<unsigned int, 3>;
      SurfaceMesh<3>           mesh;
      NumberedVertices<3, Key> vertices(mesh);
      Key                      n;
      for (unsigned int d = 0; d < 3; ++d)
        n[d] = parts_of(upper[d] - lower[d], spacing);
      const auto vertex = [&](const Key &key) {
        return vertices.number(key, [&] {
          dealii::Point<3> x;
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = key[d] == n[d] ? upper[d] : lower[d] + key[d] * (upper[d] - lower[d]) / n[d];
          return x;
        });
      };
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool high : {false, true})
          {
            // seen from outside of the high side, e_a and e_b turn counter-clockwise
            const unsigned int a = (d + 1) % 3, b = (d + 2) % 3;
            for (unsigned int i = 0; i < n[a]; ++i)
              for (unsigned int j = 0; j < n[b]; ++j)
                {
                  std::array<unsigned int, 4> quad;
                  for (unsigned int c = 0; c < 4; ++c)
                    {
                      Key key;
                      key[d]  = high ? n[d] : 0;
                      key[a]  = i + (c == 1 || c == 2);
                      key[b]  = j + (c >= 2);
                      quad[c] = vertex(key);
                    }
                  if (!high)
                    std::swap(quad[1], quad[3]);
                  mesh.facets.push_back({{quad[0], quad[1], quad[2]}});
                  mesh.facets.push_back({{quad[0], quad[2], quad[3]}});
                }
          }
      return mesh;
    }



    SurfaceMesh<2>
    mesh_of_disc(const dealii::Point<2> &centre, const double radius, const double spacing)
    {
      const unsigned int n = std::max(6u, parts_of(2. * dealii::numbers::PI * radius, spacing));
      SurfaceMesh<2>     mesh;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = 2. * dealii::numbers::PI * i / n;
          mesh.vertices.push_back(centre +
                                  radius * dealii::Point<2>(std::cos(angle), std::sin(angle)));
          mesh.facets.push_back({{i, (i + 1) % n}});
        }
      return mesh;
    }



    /** Each triangle of an icosahedron in n^2 parts, moved outward onto the sphere. */
    SurfaceMesh<3>
    mesh_of_sphere(const dealii::Point<3> &centre, const double radius, const double spacing)
    {
      const double                  golden = 0.5 * (1. + std::sqrt(5.));
      std::vector<dealii::Point<3>> corners;
      for (unsigned int d = 0; d < 3; ++d)
        for (const double one : {-1., 1.})
          for (const double other : {-golden, golden})
            {
              dealii::Point<3> x;
              x[d]           = one;
              x[(d + 1) % 3] = other;
              corners.push_back(x);
            }
      const double       edge = 2. / std::sqrt(1. + golden * golden) * radius;
      const unsigned int n    = parts_of(edge, spacing);
      using Weights           = std::map<unsigned int, unsigned int>;
      SurfaceMesh<3>               mesh;
      NumberedVertices<3, Weights> vertices(mesh);
      const auto                   divide = [&](const std::array<unsigned int, 3> &t) {
        const auto vertex = [&](const unsigned int i, const unsigned int j) {
          Weights            key;
          const unsigned int weights[3] = {n - i - j, i, j};
          for (unsigned int k = 0; k < 3; ++k)
            if (weights[k] > 0)
              key[t[k]] = weights[k];
          return vertices.number(key, [&] {
            dealii::Tensor<1, 3> direction;
            for (const auto &[corner, weight] : key)
              direction += weight * corners[corner];
            return centre + radius / direction.norm() * direction;
          });
        };
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; i + j < n; ++j)
            {
              mesh.facets.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)}});
              if (i + j + 1 < n)
                mesh.facets.push_back({{vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
            }
      };
      // its faces are the triples of corners at the distance of an edge, which is 2 here
      const auto near = [&](const unsigned int a, const unsigned int b) {
        return corners[a].distance(corners[b]) < 2.1;
      };
      for (unsigned int a = 0; a < 12; ++a)
        for (unsigned int b = a + 1; b < 12; ++b)
          for (unsigned int c = b + 1; c < 12; ++c)
            if (near(a, b) && near(b, c) && near(c, a))
              {
                const auto normal =
                  cross_product_3d(corners[b] - corners[a], corners[c] - corners[a]);
                const dealii::Tensor<1, 3> outward = corners[a];
                if (normal * outward > 0.)
                  divide({{a, b, c}});
                else
                  divide({{a, c, b}});
              }
      return mesh;
    }



    /** Triangles between two rings of vertices, counter-clockwise with the outer one outside. */
    void
    join_rings(const std::vector<unsigned int> &outer,
               const std::vector<unsigned int> &inner,
               const bool                       reversed,
               SurfaceMesh<3>                  &mesh)
    {
      const std::size_t n = outer.size(), m = inner.size();
      const auto add = [&](const unsigned int a, const unsigned int b, const unsigned int c) {
        if (reversed)
          mesh.facets.push_back({{a, c, b}});
        else
          mesh.facets.push_back({{a, b, c}});
      };
      for (std::size_t i = 0, j = 0; i < n || j < m;)
        if (j == m || (i < n && (i + 1) * m <= (j + 1) * n))
          {
            add(outer[i], outer[(i + 1) % n], inner[j % m]);
            ++i;
          }
        else
          {
            if (m > 1)
              add(outer[i % n], inner[(j + 1) % m], inner[j]);
            ++j;
          }
    }



    /** Cuts triangles at the middles of the edges that are longer than a length; false: there is
     * none. */
    bool
    halve_long_edges(const double length, SurfaceMesh<3> &mesh)
    {
      using Edge = std::pair<unsigned int, unsigned int>;
      std::map<Edge, unsigned int> middles;
      const auto                   middle = [&](const unsigned int a, const unsigned int b) {
        if (mesh.vertices[a].distance(mesh.vertices[b]) <= length)
          return -1;
        const Edge edge(std::min(a, b), std::max(a, b));
        const auto [entry, is_new] =
          middles.emplace(edge, static_cast<unsigned int>(mesh.vertices.size()));
        if (is_new)
          mesh.vertices.push_back(mesh.vertices[edge.first] +
                                  0.5 * (mesh.vertices[edge.second] - mesh.vertices[edge.first]));
        return static_cast<int>(entry->second);
      };
      std::vector<std::array<unsigned int, 3>> facets;
      for (auto t : mesh.facets)
        {
          int          m[3]; // of the edge after each corner
          unsigned int n_cut = 0;
          for (unsigned int i = 0; i < 3; ++i)
            {
              m[i] = middle(t[i], t[(i + 1) % 3]);
              n_cut += m[i] >= 0;
            }
          if (n_cut == 0)
            {
              facets.push_back(t);
              continue;
            }
          // turned so that the first edge is cut, and with two cuts the last is not
          while (m[0] < 0 || (n_cut == 2 && m[2] >= 0))
            {
              std::rotate(t.begin(), t.begin() + 1, t.end());
              std::rotate(m, m + 1, m + 3);
            }
          const unsigned int a = m[0];
          if (n_cut == 1)
            facets.insert(facets.end(), {{{t[0], a, t[2]}}, {{a, t[1], t[2]}}});
          else
            {
              const unsigned int b = m[1];
              facets.push_back({{a, t[1], b}});
              if (n_cut == 2)
                facets.insert(facets.end(), {{{t[0], a, b}}, {{t[0], b, t[2]}}});
              else
                {
                  const unsigned int c = m[2];
                  facets.insert(facets.end(), {{{t[0], a, c}}, {{c, b, t[2]}}, {{a, b, c}}});
                }
            }
        }
      mesh.facets.swap(facets);
      return !middles.empty();
    }
  } // namespace



  template <int dim>
  std::array<dealii::Point<dim>, dim>
  SurfaceMesh<dim>::corners(const unsigned int facet) const
  {
    std::array<dealii::Point<dim>, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      result[i] = vertices[facets[facet][i]];
    return result;
  }



  template <int dim>
  void
  SurfaceMesh<dim>::append(const SurfaceMesh &other)
  {
    const auto first = static_cast<unsigned int>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (auto facet : other.facets)
      {
        for (unsigned int &vertex : facet)
          vertex += first;
        facets.push_back(facet);
      }
  }



  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const std::array<dealii::Point<dim>, dim> &corners)
  {
    if constexpr (dim == 2)
      {
        const dealii::Tensor<1, 2> along = corners[1] - corners[0];
        return dealii::Point<2>(along[1], -along[0]);
      }
    else
      return 0.5 * cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
  }



  SurfaceMesh<2>
  mesh_of_polygon(const std::vector<dealii::Point<2>> &corners, const double spacing)
  {
    SurfaceMesh<2> mesh;
    for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const auto        &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const unsigned int n = parts_of(a.distance(b), spacing);
        for (unsigned int k = 0; k < n; ++k)
          mesh.vertices.push_back(a + double(k) / n * (b - a));
      }
    const auto n = static_cast<unsigned int>(mesh.vertices.size());
    for (unsigned int k = 0; k < n; ++k)
      mesh.facets.push_back({{k, (k + 1) % n}});
    return mesh;
  }



  template <int dim>
  SurfaceMesh<dim>
  mesh_of_box(const dealii::Point<dim> &lower,
              const dealii::Point<dim> &upper,
              const double              spacing)
  {
    if constexpr (dim == 2)
      return mesh_of_polygon(
        {lower, dealii::Point<2>(upper[0], lower[1]), upper, dealii::Point<2>(lower[0], upper[1])},
        spacing);
    else
      return mesh_of_block(lower, upper, spacing);
  }



  template <int dim>
  SurfaceMesh<dim>
  mesh_of_ball(const dealii::Point<dim> &centre, const double radius, const double spacing)
  {
    if constexpr (dim == 2)
      return mesh_of_disc(centre, radius, spacing);
    else
      return mesh_of_sphere(centre, radius, spacing);
  }



  SurfaceMesh<3>
  mesh_of_cylinder(const dealii::Point<3> &begin,
                   const dealii::Point<3> &end,
                   const double            radius,
                   const double            spacing)
  {
    const dealii::Tensor<1, 3> axis = (end - begin) / begin.distance(end);
    dealii::Tensor<1, 3>       across;
    unsigned int               least = 0; // direction that the axis has least of
    for (unsigned int d = 1; d < 3; ++d)
      if (std::abs(axis[d]) < std::abs(axis[least]))
        least = d;
    across[least]                = 1.;
    const dealii::Tensor<1, 3> u = cross_product_3d(across, axis) /
                                   cross_product_3d(across, axis).norm(),
                               v = cross_product_3d(axis, u);

    SurfaceMesh<3> mesh;
    const auto ring = [&](const dealii::Point<3> &centre, const double r, const unsigned int n) {
      std::vector<unsigned int> numbers;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = 2. * dealii::numbers::PI * i / n;
          numbers.push_back(static_cast<unsigned int>(mesh.vertices.size()));
          mesh.vertices.push_back(centre + r * std::cos(angle) * u + r * std::sin(angle) * v);
        }
      return numbers;
    };
    const unsigned int n_around =
      std::max(6u, parts_of(2. * dealii::numbers::PI * radius, spacing));
    const unsigned int n_along = parts_of(begin.distance(end), spacing);
    const unsigned int n_rings = parts_of(radius, spacing);

    std::vector<unsigned int> first = ring(begin, radius, n_around), last = first;
    for (unsigned int k = 1; k <= n_along; ++k)
      {
        const auto next =
          ring(k == n_along ? end : begin + double(k) / n_along * (end - begin), radius, n_around);
        for (unsigned int i = 0; i < n_around; ++i)
          {
            const unsigned int j = (i + 1) % n_around;
            mesh.facets.push_back({{last[i], last[j], next[j]}});
            mesh.facets.push_back({{last[i], next[j], next[i]}});
          }
        last = next;
      }
    for (const bool at_end : {false, true})
      {
        const dealii::Point<3>   &centre = at_end ? end : begin;
        std::vector<unsigned int> outer  = at_end ? last : first;
        for (unsigned int k = n_rings - 1; k >= 1; --k)
          {
            const auto inner =
              ring(centre, radius * k / n_rings, std::max(3u, n_around * k / n_rings));
            join_rings(outer, inner, !at_end, mesh);
            outer = inner;
          }
        const std::vector<unsigned int> middle = {static_cast<unsigned int>(mesh.vertices.size())};
        mesh.vertices.push_back(centre);
        join_rings(outer, middle, !at_end, mesh);
      }
    return mesh;
  }



  SurfaceMesh<3>
  mesh_of_triangles(const TriangleSurface &surface, const double spacing)
  {
    SurfaceMesh<3> mesh;
    mesh.vertices = surface.vertices();
    for (unsigned int f = 0; f < surface.n_facets(); ++f)
      mesh.facets.push_back(surface.facet(f));
    while (halve_long_edges(spacing, mesh))
      {}
    return mesh;
  }

  template struct SurfaceMesh<2>;
  template struct SurfaceMesh<3>;
  template dealii::Tensor<1, 2>
  area_vector<2>(const std::array<dealii::Point<2>, 2> &);
  template dealii::Tensor<1, 3>
  area_vector<3>(const std::array<dealii::Point<3>, 3> &);
  template SurfaceMesh<2>
  mesh_of_box(const dealii::Point<2> &, const dealii::Point<2> &, const double);
  template SurfaceMesh<3>
  mesh_of_box(const dealii::Point<3> &, const dealii::Point<3> &, const double);
  template SurfaceMesh<2>
  mesh_of_ball(const dealii::Point<2> &, const double, const double);
  template SurfaceMesh<3>
  mesh_of_ball(const dealii::Point<3> &, const double, const double);
} // namespace kedge
