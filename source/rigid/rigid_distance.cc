#include <kedge/rigid/rigid_distance.h>
#include <kedge/surfaces/facet_search.h>

#include <deal.II/numerics/rtree.h>

namespace kedge
{
  namespace
  {
    /** The surfaces of all bodies, where they stand. */
    template <int dim>
    SurfaceMesh<dim>
    surfaces_in_space(const RigidBodies<dim> &bodies)
    {
      SurfaceMesh<dim> result;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          SurfaceMesh<dim> moved    = bodies.surface(b);
          const Matrix33   attitude = matrix_of(bodies[b].state.attitude);
          for (dealii::Point<dim> &vertex : moved.vertices)
            {
              Vector3 own;
              for (int d = 0; d < dim; ++d)
                own[d] = vertex[d];
              const Vector3 lever = attitude * own;
              for (int d = 0; d < dim; ++d)
                vertex[d] = bodies[b].state.centre[d] + lever[d];
            }
          result.append(moved);
        }
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  distances_to_surfaces(const RigidBodies<dim>                &bodies,
                        const std::vector<dealii::Point<dim>> &places)
  {
    using Entry                  = std::pair<dealii::BoundingBox<dim>, unsigned int>;
    const SurfaceMesh<dim> mesh  = surfaces_in_space(bodies);
    const auto             count = static_cast<unsigned int>(mesh.facets.size());
    std::vector<double>    result(places.size(), std::numeric_limits<double>::max());
    std::vector<Entry>     boxes;
    for (unsigned int f = 0; f < count; ++f)
      {
        const auto                            corners = mesh.corners(f);
        const std::vector<dealii::Point<dim>> as_list(corners.begin(), corners.end());
        boxes.emplace_back(dealii::BoundingBox<dim>(as_list), f);
      }
    const auto tree = dealii::pack_rtree(boxes);
    for (std::size_t i = 0; i < places.size(); ++i)
      // nearest boxes first: none that is farther than the nearest facet found holds a nearer one
      for (auto entry = tree.qbegin(boost::geometry::index::nearest(places[i], count));
           entry != tree.qend() && boost::geometry::distance(entry->first, places[i]) < result[i];
           ++entry)
        result[i] =
          std::min(result[i],
                   closest_on_facet<dim>(mesh.corners(entry->second), places[i]).distance);
    return result;
  }

  template std::vector<double>
  distances_to_surfaces(const RigidBodies<2> &, const std::vector<dealii::Point<2>> &);
  template std::vector<double>
  distances_to_surfaces(const RigidBodies<3> &, const std::vector<dealii::Point<3>> &);
} // namespace kedge
