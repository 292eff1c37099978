#include <kedge/surfaces/adapted_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

namespace kedge
{
  template <int dim>
  std::array<dealii::Point<dim>, dim>
  CarriedSurface<dim>::corners_at_start(const unsigned int facet) const
  {
    std::array<dealii::Point<dim>, dim> result;
    for (int i = 0; i < dim; ++i)
      result[i] = start[mesh.facets[facet][i]];
    return result;
  }



  namespace
  {
    /** By vanishing edges no facet may turn by more than 20 degrees. */
    constexpr double smallest_cosine = 0.94;

    /** An edge may vanish that has shrunk to less than this part of what it was at the start. */
    constexpr double clearly_shrunk = 0.5;

    /** What a vanishing edge makes longer must stay this far from being divided again. */
    constexpr double clearly_short = 0.9;

    /** An edge is divided no further than to this part of the longest one at the start: a surface
     * that is torn does not grow facets without end. */
    constexpr double finest = 1. / 128.;

    constexpr unsigned int most_rounds = 20;

    /** Divides edges of a surface and lets them vanish, one after the other. */
    template <int dim>
    class SurfaceEditor
    {
    public:
      SurfaceEditor(CarriedSurface<dim> &surface, const EdgeLengths &lengths)
        : surface(surface)
        , mesh(surface.mesh)
        , lengths(lengths)
        , n_before(mesh.facets.size())
      {}

      /** One round of divisions: each facet at most once. */
      bool
      divide();

      /** One round of vanishing edges: around each vertex at most one. */
      bool
      unite();

      FacetHeritage
      close();

    private:
      using Facet = std::array<unsigned int, dim>;
      struct Edge
      {
        double       length;
        unsigned int a, b; ///< vertices, a < b
        bool
        operator<(const Edge &other) const
        {
          return std::tie(length, a, b) < std::tie(other.length, other.a, other.b);
        }
      };

      template <typename Fits>
      std::vector<Edge>
      edges_where(const Fits &fits) const;
      void
      begin_round();
      std::vector<unsigned int>
      facets_with(const unsigned int a, const unsigned int b) const;
      bool
      is_untouched(const std::vector<unsigned int> &facets, const std::vector<bool> &touched) const
      {
        return std::none_of(facets.begin(), facets.end(), [&](const unsigned int f) {
          return touched[f] || mesh.has_left(f);
        });
      }
      void
      divide(const Edge &edge, const std::vector<unsigned int> &facets);
      std::optional<double>
      least_cosine(const unsigned int kept, const unsigned int gone) const;
      double
      cosine_of_turn(const unsigned int facet,
                     const unsigned int kept,
                     const unsigned int gone,
                     const unsigned int compared) const;
      bool
      is_manifold(const unsigned int kept, const unsigned int gone) const;
      void
      draw(const unsigned int gone, const unsigned int kept);
      void
      hand_over(const std::vector<unsigned int> &lost, const std::vector<unsigned int> &taking);
      void
      number_anew();

      CarriedSurface<dim>                          &surface;
      SurfaceMesh<dim>                             &mesh;
      const EdgeLengths                             lengths;
      const std::size_t                             n_before; ///< facets
      std::vector<bool>                             removed;
      std::vector<Facet>                            facets_at_start_of_round;
      std::vector<std::vector<FacetHeritage::Part>> parts;
      std::vector<std::vector<unsigned int>>        facets_of; ///< of each vertex
    };



    /** In the order of their lengths. */
    template <int dim>
    template <typename Fits>
    std::vector<typename SurfaceEditor<dim>::Edge>
    SurfaceEditor<dim>::edges_where(const Fits &fits) const
    {
      std::vector<Edge> result;
      for (unsigned int f = 0; f < mesh.facets.size(); ++f)
        if ((removed.empty() || !removed[f]) && !mesh.has_left(f))
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < i; ++j)
              {
                const auto [a, b] = std::minmax(mesh.facets[f][i], mesh.facets[f][j]);
                const Edge edge{mesh.vertices[a].distance(mesh.vertices[b]), a, b};
                if (fits(edge))
                  result.push_back(edge);
              }
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(),
                               result.end(),
                               [](const Edge &one, const Edge &other) {
                                 return one.a == other.a && one.b == other.b;
                               }),
                   result.end());
      return result;
    }



    template <int dim>
    void
    SurfaceEditor<dim>::begin_round()
    {
      if (parts.empty()) // the first one
        {
          removed.assign(n_before, false);
          for (unsigned int f = 0; f < n_before; ++f)
            parts.push_back({{f, surface.reference_areas[f]}});
        }
      facets_at_start_of_round = mesh.facets;
      facets_of.assign(mesh.vertices.size(), {});
      for (unsigned int f = 0; f < mesh.facets.size(); ++f)
        if (!removed[f])
          for (const unsigned int v : mesh.facets[f])
            facets_of[v].push_back(f);
    }



    /** As they were at the start of the round. */
    template <int dim>
    std::vector<unsigned int>
    SurfaceEditor<dim>::facets_with(const unsigned int a, const unsigned int b) const
    {
      std::vector<unsigned int> result;
      for (const unsigned int f : facets_of[a])
        if (const Facet &facet = facets_at_start_of_round[f];
            std::find(facet.begin(), facet.end(), b) != facet.end())
          result.push_back(f);
      return result;
    }



    template <int dim>
    bool
    SurfaceEditor<dim>::divide()
    {
      auto edges = edges_where([&](const Edge &edge) {
        return edge.length > lengths.longest &&
               surface.start[edge.a].distance(surface.start[edge.b]) > finest * lengths.longest;
      });
      if (edges.empty())
        return false;
      begin_round();
      std::vector<bool> touched(mesh.facets.size(), false);
      bool              any = false;
      for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge)
        {
          const std::vector<unsigned int> facets = facets_with(edge->a, edge->b);
          if (!is_untouched(facets, touched))
            continue;
          for (const unsigned int f : facets)
            touched[f] = true;
          divide(*edge, facets);
          any = true;
        }
      return any;
    }



    template <int dim>
    void
    SurfaceEditor<dim>::divide(const Edge &edge, const std::vector<unsigned int> &facets)
    {
      const unsigned int middle = static_cast<unsigned int>(mesh.vertices.size());
      mesh.vertices.push_back(mesh.vertices[edge.a] +
                              0.5 * (mesh.vertices[edge.b] - mesh.vertices[edge.a]));
      surface.start.push_back(surface.start[edge.a] +
                              0.5 * (surface.start[edge.b] - surface.start[edge.a]));
      for (const unsigned int f : facets)
        {
          Facet other = mesh.facets[f];
          std::replace(mesh.facets[f].begin(), mesh.facets[f].end(), edge.b, middle);
          std::replace(other.begin(), other.end(), edge.a, middle);
          mesh.facets.push_back(other);
          surface.reference_areas[f] *= 0.5;
          surface.reference_areas.push_back(surface.reference_areas[f]);
          for (auto &part : parts[f])
            part.area *= 0.5;
          parts.push_back(std::vector<FacetHeritage::Part>(parts[f]));
          removed.push_back(false);
          if (!mesh.left.empty())
            mesh.left.push_back(false);
        }
    }



    template <int dim>
    bool
    SurfaceEditor<dim>::unite()
    {
      const auto edges = edges_where([&](const Edge &edge) {
        return edge.length < lengths.shortest &&
               edge.length < clearly_shrunk * surface.start[edge.a].distance(surface.start[edge.b]);
      });
      if (edges.empty())
        return false;
      begin_round();
      std::vector<bool> touched(mesh.facets.size(), false);
      bool              any = false;
      for (const Edge &edge : edges)
        {
          std::vector<unsigned int> around = facets_of[edge.a];
          around.insert(around.end(), facets_of[edge.b].begin(), facets_of[edge.b].end());
          if (!is_untouched(around, touched))
            continue;
          const auto keep_a = least_cosine(edge.a, edge.b), keep_b = least_cosine(edge.b, edge.a);
          if (!keep_a && !keep_b)
            continue;
          for (const unsigned int f : around)
            touched[f] = true;
          if (keep_a && (!keep_b || *keep_a >= *keep_b))
            draw(edge.b, edge.a);
          else
            draw(edge.a, edge.b);
          any = true;
        }
      return any;
    }



    /** Of the angle between a facet once vertex @p gone is drawn to @p kept and one that was
     * before; the smaller one of now and of the start. */
    template <int dim>
    double
    SurfaceEditor<dim>::cosine_of_turn(const unsigned int facet,
                                       const unsigned int kept,
                                       const unsigned int gone,
                                       const unsigned int compared) const
    {
      double result = 1.;
      for (const auto *places : {&mesh.vertices, &surface.start})
        {
          std::array<dealii::Point<dim>, dim> before, after;
          for (int i = 0; i < dim; ++i)
            {
              const unsigned int v = mesh.facets[facet][i];
              before[i]            = (*places)[mesh.facets[compared][i]];
              after[i]             = (*places)[v == gone ? kept : v];
            }
          const auto   old_area = area_vector<dim>(before), new_area = area_vector<dim>(after);
          const double size = old_area.norm() * new_area.norm();
          result            = std::min(result, size > 0. ? old_area * new_area / size : -1.);
        }
      return result;
    }



    /** Whether the surface stays one if two neighbouring vertices become one: they must have no
     * other neighbours in common than those of the facets between them. */
    template <int dim>
    bool
    SurfaceEditor<dim>::is_manifold(const unsigned int kept, const unsigned int gone) const
    {
      std::array<std::vector<unsigned int>, 2> neighbours;
      for (const unsigned int side : {0u, 1u})
        {
          for (const unsigned int f : facets_of[side == 0 ? kept : gone])
            neighbours[side].insert(neighbours[side].end(),
                                    mesh.facets[f].begin(),
                                    mesh.facets[f].end());
          std::sort(neighbours[side].begin(), neighbours[side].end());
          neighbours[side].erase(std::unique(neighbours[side].begin(), neighbours[side].end()),
                                 neighbours[side].end());
        }
      std::vector<unsigned int> common;
      std::set_intersection(neighbours[0].begin(),
                            neighbours[0].end(),
                            neighbours[1].begin(),
                            neighbours[1].end(),
                            std::back_inserter(common));
      const std::size_t n_between = facets_with(kept, gone).size();
      return dim == 2 ? n_between == 1 && common.size() == 2 : common.size() == n_between + 2;
    }



    /** If @p gone can be drawn to @p kept: of the turns of all facets, the cosine of the largest.
     */
    template <int dim>
    std::optional<double>
    SurfaceEditor<dim>::least_cosine(const unsigned int kept, const unsigned int gone) const
    {
      // the end of an open surface, and what is wound about an edge, stay
      if (facets_of[gone].size() < (dim == 2 ? 2 : 3) ||
          facets_with(kept, gone).size() != (dim == 2 ? 1 : 2) || !is_manifold(kept, gone))
        return {};
      double result = 1.;
      for (const unsigned int f : facets_of[gone])
        {
          const Facet &facet = mesh.facets[f];
          if (std::find(facet.begin(), facet.end(), kept) != facet.end())
            continue;
          result = std::min(result, cosine_of_turn(f, kept, gone, f));
          if (dim == 2) // the other facet at the vertex turns into this one
            result = std::min(result, cosine_of_turn(f, kept, gone, facets_with(kept, gone)[0]));
          for (const unsigned int v : facet)
            if (v != gone &&
                mesh.vertices[v].distance(mesh.vertices[kept]) > clearly_short * lengths.longest)
              return {};
        }
      return result >= smallest_cosine ? std::optional<double>(result) : std::nullopt;
    }



    template <int dim>
    void
    SurfaceEditor<dim>::draw(const unsigned int gone, const unsigned int kept)
    {
      const std::vector<unsigned int> lost = facets_with(kept, gone);
      std::vector<unsigned int>       taking;
      for (const unsigned int f : facets_of[gone])
        if (std::find(lost.begin(), lost.end(), f) == lost.end())
          {
            std::replace(mesh.facets[f].begin(), mesh.facets[f].end(), gone, kept);
            taking.push_back(f);
          }
      for (const unsigned int f : lost)
        removed[f] = true;
      hand_over(lost, taking);
    }



    /** Gives the areas of lost facets to those that have grown into their place. */
    template <int dim>
    void
    SurfaceEditor<dim>::hand_over(const std::vector<unsigned int> &lost,
                                  const std::vector<unsigned int> &taking)
    {
      std::vector<double> growth;
      double              sum = 0.;
      for (const unsigned int f : taking)
        {
          growth.push_back(std::max(area_vector<dim>(surface.corners_at_start(f)).norm() -
                                      surface.reference_areas[f],
                                    0.));
          sum += growth.back();
        }
      for (std::size_t k = 0; k < taking.size(); ++k)
        {
          const double share = sum > 0. ? growth[k] / sum : 1. / static_cast<double>(taking.size());
          if (share == 0.)
            continue;
          for (const unsigned int f : lost)
            for (const auto &part : parts[f])
              {
                parts[taking[k]].push_back({part.facet, share * part.area});
                surface.reference_areas[taking[k]] += share * part.area;
              }
        }
    }



    /** Leaves out vertices and facets that are gone. */
    template <int dim>
    void
    SurfaceEditor<dim>::number_anew()
    {
      constexpr unsigned int    none = std::numeric_limits<unsigned int>::max();
      std::vector<unsigned int> number(mesh.vertices.size(), none);
      std::size_t               n_facets = 0;
      for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        if (!removed[f])
          {
            for (const unsigned int v : mesh.facets[f])
              number[v] = 0;
            mesh.facets[n_facets]             = mesh.facets[f];
            surface.reference_areas[n_facets] = surface.reference_areas[f];
            parts[n_facets]                   = parts[f];
            if (!mesh.left.empty())
              mesh.left[n_facets] = mesh.left[f];
            ++n_facets;
          }
      mesh.facets.resize(n_facets);
      surface.reference_areas.resize(n_facets);
      parts.resize(n_facets);
      if (!mesh.left.empty())
        mesh.left.resize(n_facets);
      unsigned int n_vertices = 0;
      for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] != none)
          {
            mesh.vertices[n_vertices] = mesh.vertices[v];
            surface.start[n_vertices] = surface.start[v];
            number[v]                 = n_vertices++;
          }
      mesh.vertices.resize(n_vertices);
      surface.start.resize(n_vertices);
      for (auto &facet : mesh.facets)
        for (unsigned int &v : facet)
          v = number[v];
    }



    template <int dim>
    FacetHeritage
    SurfaceEditor<dim>::close()
    {
      number_anew();
      FacetHeritage       result{std::move(parts), std::vector<unsigned int>(n_before, 0)};
      std::vector<double> most(n_before, 0.);
      for (unsigned int f = 0; f < result.parts.size(); ++f)
        for (const auto &part : result.parts[f])
          if (part.area > most[part.facet])
            {
              most[part.facet]         = part.area;
              result.heirs[part.facet] = f;
            }
      return result;
    }
  } // namespace



  template <int dim>
  FacetHeritage
  adapt(CarriedSurface<dim> &surface, const EdgeLengths &lengths)
  {
    SurfaceEditor<dim> editor(surface, lengths);
    bool               any = false;
    for (unsigned int round = 0; round < most_rounds && editor.divide(); ++round)
      any = true;
    for (unsigned int round = 0; round < most_rounds && editor.unite(); ++round)
      any = true;
    return any ? editor.close() : FacetHeritage();
  }

  template struct CarriedSurface<2>;
  template struct CarriedSurface<3>;
  template FacetHeritage
  adapt(CarriedSurface<2> &, const EdgeLengths &);
  template FacetHeritage
  adapt(CarriedSurface<3> &, const EdgeLengths &);
} // namespace kedge
