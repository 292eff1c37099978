#include <kedge/contact/tool_edges.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Of the angle between the normals of two facets at a sharp edge: each is farther from their
     * mean than FacetSearch::sharp says. */
    template <int dim>
    constexpr double
    sharp_cosine()
    {
      return 2. * FacetSearch<dim>::sharp * FacetSearch<dim>::sharp - 1.;
    }

    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    normals_of(const SurfaceMesh<dim> &mesh)
    {
      std::vector<dealii::Tensor<1, dim>> normals;
      for (unsigned int f = 0; f < mesh.facets.size(); ++f)
        {
          const auto area = area_vector<dim>(mesh.corners(f));
          normals.push_back(area.norm() > 0. ? area / area.norm() : area);
        }
      return normals;
    }

    /** Whether two facets with an edge in common bend outward there, and sharply. */
    template <int dim>
    bool
    is_sharp(const SurfaceMesh<dim>                    &mesh,
             const std::vector<dealii::Tensor<1, dim>> &normals,
             const unsigned int                         one,
             const unsigned int                         other)
    {
      if (normals[one] * normals[other] > sharp_cosine<dim>())
        return false;
      dealii::Tensor<1, dim> across; // from the middle of the one to that of the other
      for (int i = 0; i < dim; ++i)
        across += (mesh.vertices[mesh.facets[other][i]] - mesh.vertices[mesh.facets[one][i]]) / dim;
      return normals[one] * across < 0.;
    }
  } // namespace



  template <>
  std::vector<SharpPlace<2>>
  sharp_places<2>(const SurfaceMesh<2> &mesh, const double)
  {
    const auto                           normals = normals_of(mesh);
    std::map<unsigned int, unsigned int> begins; // facets by their first vertex
    std::vector<SharpPlace<2>>           result;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      begins[mesh.facets[f][0]] = f;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      if (const auto next = begins.find(mesh.facets[f][1]);
          next != begins.end() && is_sharp<2>(mesh, normals, f, next->second))
        {
          const dealii::Tensor<1, 2> sum = normals[f] + normals[next->second];
          if (sum.norm() > 0.)
            result.push_back({mesh.vertices[next->first], sum / sum.norm(), 1.});
        }
    return result;
  }



  /** Places at the ends of equal parts of sharp edges; at a corner one for all edges. */
  template <>
  std::vector<SharpPlace<3>>
  sharp_places<3>(const SurfaceMesh<3> &mesh, const double spacing)
  {
    using Edge         = std::pair<unsigned int, unsigned int>;
    const auto normals = normals_of(mesh);

    std::map<Edge, std::vector<unsigned int>> facets_of;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      for (unsigned int i = 0; i < 3; ++i)
        facets_of[std::minmax(mesh.facets[f][i], mesh.facets[f][(i + 1) % 3])].push_back(f);

    std::map<unsigned int, SharpPlace<3>> corners; // by vertex; sums of normals
    std::vector<SharpPlace<3>>            result;
    for (const auto &[edge, facets] : facets_of)
      {
        if (facets.size() != 2 || !is_sharp<3>(mesh, normals, facets[0], facets[1]))
          continue;
        const dealii::Tensor<1, 3> sum = normals[facets[0]] + normals[facets[1]];
        const auto                &a = mesh.vertices[edge.first], &b = mesh.vertices[edge.second];
        const double               length = a.distance(b);
        const int                  n = std::max(1, static_cast<int>(std::ceil(length / spacing)));
        for (int k = 1; k < n && sum.norm() > 0.; ++k)
          result.push_back({a + double(k) / n * (b - a), sum / sum.norm(), length / n});
        for (const unsigned int v : {edge.first, edge.second})
          {
            auto &corner =
              corners.emplace(v, SharpPlace<3>{mesh.vertices[v], {}, 0.}).first->second;
            corner.outward += sum;
            corner.length += 0.5 * length / n;
          }
      }
    for (auto &[v, corner] : corners)
      if (const double size = corner.outward.norm(); size > 0.)
        {
          corner.outward /= size;
          result.push_back(corner);
        }
    return result;
  }



  /** By the facet's vertices. */
  template <int dim>
  MeanFunctions
  ToolEdges<dim>::functions_at(const Sample &sample) const
  {
    const BodySurface<dim>              &surface = *this->body.surface;
    std::map<unsigned int, MeanFunction> sums;
    this->for_vertices(sample, [&](const unsigned int v, const double weight) {
      surface.for_nodes_anywhere(v, [&](const unsigned int node, const double N) {
        MeanFunction &of = sums.emplace(node, MeanFunction{node, 0., 0.}).first->second;
        of.all += weight * N;
        of.own += surface.owns(v) ? weight * N : 0.;
      });
    });
    MeanFunctions functions;
    for (const auto &[node, of] : sums)
      functions.push_back(of);
    return functions;
  }



  /** The facets that come near the tool where @p part of the step has led. */
  template <int dim>
  void
  ToolEdges<dim>::look_at(const double part, Near &near) const
  {
    near.mesh = this->body.surface->mesh();
    for (std::size_t v = 0; v < near.mesh.vertices.size(); ++v)
      near.mesh.vertices[v] += part * this->displacements[v];
    const auto               pose = this->pose(part);
    dealii::BoundingBox<dim> box;
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const auto                     x = pose.in_scene_at(in_space<dim>(places[k].at));
        const dealii::BoundingBox<dim> here({x, x});
        if (k == 0)
          box = here;
        else
          box.merge_with(here);
      }
    box.extend(this->reach);
    near.search = std::make_unique<FacetSearch<dim>>(near.mesh, box);
  }



  template <int dim>
  bool
  ToolEdges<dim>::find_partner(const Near                         &near,
                               const unsigned int                  key,
                               const double                        part,
                               const unsigned int                  previous,
                               typename FacetSearch<dim>::Partner &partner) const
  {
    const auto pose = this->pose(part);
    return near.search->find(pose.in_scene_at(in_space<dim>(places[key].at)),
                             in_scene<dim>(pose.attitude * in_space<dim>(places[key].outward)),
                             this->reach,
                             previous,
                             partner);
  }



  template <int dim>
  void
  ToolEdges<dim>::find_places()
  {
    if (places.empty())
      return;
    Near now;
    look_at(this->bodies.alpha, now);
    if (this->law.conserving)
      look_at(1., end);
    const auto &mesh = this->body.surface->mesh();
    for (unsigned int k = 0; k < places.size(); ++k)
      {
        typename FacetSearch<dim>::Partner partner;
        if (!find_partner(now, k, this->bodies.alpha, this->partner_before(k), partner))
          continue;
        Sample sample;
        sample.key     = k;
        sample.facet   = partner.facet;
        sample.partner = partner.facet;
        sample.weights = partner.weights;
        for (int i = 0; i < dim; ++i)
          sample.place += partner.weights[i] * mesh.vertices[mesh.facets[partner.facet][i]];
        sample.on_tool    = in_space<dim>(places[k].at);
        sample.normal     = -partner.normal;
        sample.area       = area_of(k);
        sample.stretch    = 1.;
        sample.on_surface = functions_at(sample);
        this->samples.push_back(sample);
      }
  }



  template <int dim>
  bool
  ToolEdges<dim>::measure_at_end(const Sample &sample, double &gap) const
  {
    typename FacetSearch<dim>::Partner partner;
    if (!find_partner(end, sample.key, 1., sample.partner, partner))
      return false;
    gap = partner.gap;
    return true;
  }

  template class ToolEdges<2>;
  template class ToolEdges<3>;
} // namespace kedge
