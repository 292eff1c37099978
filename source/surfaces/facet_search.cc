#include <kedge/surfaces/facet_search.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Surfaces look towards each other if the cosine between their normals is below this. */
    constexpr double largest_cosine = -0.05;

    /** Nearer than this to an edge or a vertex, in sizes of the facet, the direction from there is
     * round-off. */
    constexpr double smallest_distance = 1e-6;

    template <int dim>
    dealii::BoundingBox<dim>
    box_of(const std::array<dealii::Point<dim>, dim> &corners)
    {
      dealii::Point<dim> lower = corners[0], upper = corners[0];
      for (const auto &corner : corners)
        for (int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], corner[d]);
            upper[d] = std::max(upper[d], corner[d]);
          }
      return dealii::BoundingBox<dim>({lower, upper});
    }

    using Region = FacetPoint<3>::Region;

    /** Of a triangle a, b, c: the regions of its vertices, edges and face, one after the other. */
    FacetPoint<3>
    closest_on_triangle(const std::array<dealii::Point<3>, 3> &t, const dealii::Point<3> &x)
    {
      const dealii::Tensor<1, 3> ab = t[1] - t[0], ac = t[2] - t[0];
      const dealii::Tensor<1, 3> ax = x - t[0], bx = x - t[1], cx = x - t[2];
      const double               d1 = ab * ax, d2 = ac * ax, d3 = ab * bx, d4 = ac * bx;
      const double               d5 = ab * cx, d6 = ac * cx;
      const auto                 at_vertex = [](const unsigned int i) {
        FacetPoint<3> result{Region::vertex, {{0., 0., 0.}}, 0., {{i, i}}};
        result.weights[i] = 1.;
        return result;
      };
      const auto on_edge = [](const unsigned int i, const unsigned int j, const double s) {
        FacetPoint<3> result{Region::edge, {{0., 0., 0.}}, 0., {{i, j}}};
        result.weights[i] = 1. - s;
        result.weights[j] = s;
        return result;
      };
      if (d1 <= 0. && d2 <= 0.)
        return at_vertex(0);
      if (d3 >= 0. && d4 <= d3)
        return at_vertex(1);
      const double vc = d1 * d4 - d3 * d2;
      if (vc <= 0. && d1 >= 0. && d3 <= 0.)
        return on_edge(0, 1, d1 / (d1 - d3));
      if (d6 >= 0. && d5 <= d6)
        return at_vertex(2);
      const double vb = d5 * d2 - d1 * d6;
      if (vb <= 0. && d2 >= 0. && d6 <= 0.)
        return on_edge(0, 2, d2 / (d2 - d6));
      const double va = d3 * d6 - d5 * d4;
      if (va <= 0. && d4 - d3 >= 0. && d5 - d6 >= 0.)
        return on_edge(1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
      const double sum = va + vb + vc;
      return {Region::face, {{va / sum, vb / sum, vc / sum}}, 0., {{0, 0}}};
    }

    FacetPoint<2>
    closest_on_line(const std::array<dealii::Point<2>, 2> &line, const dealii::Point<2> &x)
    {
      using Region2                    = FacetPoint<2>::Region;
      const dealii::Tensor<1, 2> along = line[1] - line[0];
      const double               s     = (x - line[0]) * along / along.norm_square();
      if (s <= 0.)
        return {Region2::vertex, {{1., 0.}}, 0., {{0, 0}}};
      if (s >= 1.)
        return {Region2::vertex, {{0., 1.}}, 0., {{1, 1}}};
      return {Region2::face, {{1. - s, s}}, 0., {{0, 0}}};
    }
  } // namespace



  template <int dim>
  FacetPoint<dim>
  closest_on_facet(const std::array<dealii::Point<dim>, dim> &corners, const dealii::Point<dim> &x)
  {
    FacetPoint<dim> result;
    if constexpr (dim == 2)
      result = closest_on_line(corners, x);
    else
      result = closest_on_triangle(corners, x);
    dealii::Tensor<1, dim> off = x;
    for (int i = 0; i < dim; ++i)
      off -= result.weights[i] * corners[i];
    result.distance = off.norm();
    return result;
  }



  template <int dim>
  class FacetSearch<dim>::Tree
  {
  public:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    explicit Tree(const std::vector<Entry> &facets)
      : tree(dealii::pack_rtree(facets))
    {}

    dealii::RTree<Entry> tree;
  };



  template <int dim>
  FacetSearch<dim>::FacetSearch(const SurfaceMesh<dim>         &mesh,
                                const dealii::BoundingBox<dim> &region)
    : mesh(mesh)
  {
    std::vector<typename Tree::Entry> found;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        const auto box = box_of<dim>(mesh.corners(f));
        if (!mesh.has_left(f) && boost::geometry::intersects(box, region))
          found.emplace_back(box, f);
      }
    n_found = static_cast<unsigned int>(found.size());
    if (empty())
      return;
    tree = std::make_unique<Tree>(found);
    std::vector<unsigned int> facets;
    for (const auto &entry : found)
      facets.push_back(entry.second);
    find_normals(facets);
  }



  /** Normals at the vertices of the facets in the region. */
  template <int dim>
  void
  FacetSearch<dim>::find_normals(const std::vector<unsigned int> &found)
  {
    normals.resize(mesh.facets.size());
    number_of_vertex.assign(mesh.vertices.size(), no_facet);
    unsigned int n_vertices = 0;
    for (const unsigned int f : found)
      for (const unsigned int v : mesh.facets[f])
        if (number_of_vertex[v] == no_facet)
          number_of_vertex[v] = n_vertices++;
    vertex_normals.resize(n_vertices);
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        const bool is_near =
          std::any_of(mesh.facets[f].begin(), mesh.facets[f].end(), [&](const unsigned int v) {
            return number_of_vertex[v] != no_facet;
          });
        if (!is_near || mesh.has_left(f))
          continue;
        const auto corners = mesh.corners(f);
        normals[f]         = area_vector<dim>(corners);
        const double area  = normals[f].norm();
        if (!(area > 0.))
          continue;
        normals[f] /= area;
        for (int i = 0; i < dim; ++i)
          {
            const unsigned int number = number_of_vertex[mesh.facets[f][i]];
            if (number == no_facet)
              continue;
            double weight = 1.; // in 2D neighbours count alike
            if constexpr (dim == 3)
              {
                const auto a = corners[(i + 1) % 3] - corners[i],
                           b = corners[(i + 2) % 3] - corners[i];
                weight       = std::atan2(cross_product_3d(a, b).norm(), a * b);
              }
            vertex_normals[number].sum += weight * normals[f];
            vertex_normals[number].facets.push_back(f);
          }
      }
    for (auto &vertex : vertex_normals)
      find_mean(vertex);
  }



  template <int dim>
  void
  FacetSearch<dim>::find_mean(MeanNormal &mean) const
  {
    const double size = mean.sum.norm();
    mean.is_sharp     = !(size > 0.);
    if (mean.is_sharp)
      return;
    mean.sum /= size;
    for (const unsigned int f : mean.facets)
      mean.is_sharp = mean.is_sharp || mean.sum * normals[f] < sharp;
  }



  template <int dim>
  FacetSearch<dim>::~FacetSearch() = default;



  /** At an edge or a vertex of a facet in the region. */
  template <int dim>
  typename FacetSearch<dim>::MeanNormal
  FacetSearch<dim>::mean_at(const unsigned int facet, const FacetPoint<dim> &place) const
  {
    const auto       &vertices = mesh.facets[facet];
    const MeanNormal &here     = vertex_normals[number_of_vertex[vertices[place.corners[0]]]];
    if (place.region == FacetPoint<dim>::Region::vertex)
      return here;
    const unsigned int other = vertices[place.corners[1]];
    MeanNormal         mean;
    for (const unsigned int f : here.facets)
      if (std::find(mesh.facets[f].begin(), mesh.facets[f].end(), other) != mesh.facets[f].end())
        {
          mean.sum += normals[f];
          mean.facets.push_back(f);
        }
    find_mean(mean);
    return mean;
  }



  /** Whether the nearest of some facets, whatever way it looks, has @p x on its outer side. */
  template <int dim>
  bool
  FacetSearch<dim>::is_outside(const dealii::Point<dim>        &x,
                               const std::vector<unsigned int> &facets,
                               const double                     reach) const
  {
    double least  = reach;
    bool   result = false;
    for (const unsigned int f : facets)
      {
        const auto            corners = mesh.corners(f);
        const FacetPoint<dim> place   = closest_on_facet<dim>(corners, x);
        if (place.distance >= least)
          continue;
        least                          = place.distance;
        const bool             on_face = place.region == FacetPoint<dim>::Region::face;
        dealii::Tensor<1, dim> off     = x;
        for (int i = 0; i < dim; ++i)
          off -= place.weights[i] * corners[i];
        result = off * (on_face ? normals[f] : mean_at(f, place).sum) > 0.;
      }
    return result;
  }



  /** The facets in the region whose boxes come as near, in their order. */
  template <int dim>
  std::vector<unsigned int>
  FacetSearch<dim>::facets_within(const dealii::Point<dim> &x, const double distance) const
  {
    dealii::Point<dim> lower = x, upper = x;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] -= distance;
        upper[d] += distance;
      }
    std::vector<unsigned int> near;
    for (const auto &entry :
         tree->tree | boost::geometry::index::adaptors::queried(boost::geometry::index::intersects(
                        dealii::BoundingBox<dim>({lower, upper}))))
      near.push_back(entry.second);
    std::sort(near.begin(), near.end()); // the answer does not depend on the tree's order
    return near;
  }



  template <int dim>
  void
  FacetSearch<dim>::take_if_nearer(const dealii::Point<dim>     &x,
                                   const dealii::Tensor<1, dim> &outward,
                                   const unsigned int            facet,
                                   const unsigned int            previous,
                                   Nearest                      &nearest) const
  {
    if (!(normals[facet] * outward < largest_cosine))
      return;
    const auto            corners  = mesh.corners(facet);
    const FacetPoint<dim> place    = closest_on_facet<dim>(corners, x);
    double                distance = place.distance;
    // inside a bend both facets have a foot of the perpendicular
    if (facet == previous && place.region == FacetPoint<dim>::Region::face)
      distance -= hysteresis * (corners[1] - corners[0]).norm();
    if (distance < nearest.distance)
      nearest = {facet, place, distance};
  }



  /**
   * Of the facets nearer than @p reach that look towards x the nearest, by searches wider and wider
   * until nothing outside of the last one can be nearer. Returns the facets of that one.
   */
  template <int dim>
  std::vector<unsigned int>
  FacetSearch<dim>::find_nearest(const dealii::Point<dim>     &x,
                                 const dealii::Tensor<1, dim> &outward,
                                 const double                  reach,
                                 const unsigned int            previous,
                                 const unsigned int            guess,
                                 Nearest                      &nearest) const
  {
    constexpr double first = 0.25, wider = 2.; // in reaches; from one search to the next
    double           kept = 0.;                // what the last partner may be farther off
    if (previous < mesh.facets.size())
      {
        const auto corners = mesh.corners(previous);
        kept               = hysteresis * (corners[1] - corners[0]).norm();
      }
    double distance = std::min(first * reach + kept, reach);
    if (guess < normals.size())
      {
        nearest.distance = reach;
        take_if_nearer(x, outward, guess, no_facet, nearest);
        if (nearest.facet != no_facet)
          distance = std::min((1. + 1e-9) * nearest.distance + kept, reach);
      }
    while (true)
      {
        nearest.facet                        = no_facet;
        nearest.distance                     = reach;
        const std::vector<unsigned int> near = facets_within(x, distance);
        for (const unsigned int f : near)
          take_if_nearer(x, outward, f, previous, nearest);
        // what is not among them is farther off than this distance
        if (distance >= reach || (nearest.facet != no_facet && nearest.distance + kept <= distance))
          return near;
        distance = std::min(wider * distance, reach);
      }
  }



  template <int dim>
  bool
  FacetSearch<dim>::find(const dealii::Point<dim>     &x,
                         const dealii::Tensor<1, dim> &outward,
                         const double                  reach,
                         const unsigned int            previous,
                         Partner                      &partner,
                         const unsigned int            guess) const
  {
    if (empty())
      return false;
    Nearest                         nearest;
    const std::vector<unsigned int> near =
      find_nearest(x, outward, reach, previous, guess, nearest);
    const unsigned int     best_facet = nearest.facet;
    const FacetPoint<dim> &best       = nearest.place;
    if (best_facet == no_facet)
      return false;
    partner.normal = normals[best_facet];
    if (best.region != FacetPoint<dim>::Region::face)
      {
        const MeanNormal mean = mean_at(best_facet, best);
        if (mean.is_sharp)
          return false;
        partner.normal = mean.sum;
      }
    const auto             corners = mesh.corners(best_facet);
    dealii::Tensor<1, dim> off     = x;
    for (int i = 0; i < dim; ++i)
      off -= best.weights[i] * corners[i];
    partner.facet   = best_facet;
    partner.weights = best.weights;
    partner.gap     = std::copysign(best.distance, off * partner.normal);
    // through the body, from outside of a nearer side that does not look this way: no overlap
    if (partner.gap < 0. && is_outside(x, near, best.distance))
      return false;
    // off an edge or a vertex along the line between both places: a force has no moment then
    if (best.region != FacetPoint<dim>::Region::face &&
        best.distance > smallest_distance * (corners[1] - corners[0]).norm())
      partner.normal = off / partner.gap;
    return true;
  }



  template <int dim>
  double
  FacetSearch<dim>::depth(const dealii::Point<dim> &x, const double first) const
  {
    for (double distance = first; !empty(); distance *= 2.)
      {
        const std::vector<unsigned int> near  = facets_within(x, distance);
        double                          least = 2. * distance;
        for (const unsigned int f : near)
          least = std::min(least, closest_on_facet<dim>(mesh.corners(f), x).distance);
        if (least <= distance) // what is not among them is farther off
          return is_outside(x, near, 2. * distance) ? 0. : least;
      }
    return 0.;
  }

  template struct FacetPoint<2>;
  template struct FacetPoint<3>;
  template FacetPoint<2>
  closest_on_facet<2>(const std::array<dealii::Point<2>, 2> &, const dealii::Point<2> &);
  template FacetPoint<3>
  closest_on_facet<3>(const std::array<dealii::Point<3>, 3> &, const dealii::Point<3> &);
  template class FacetSearch<2>;
  template class FacetSearch<3>;
} // namespace kedge
