#ifndef kedge_geometry_triangle_surface_h
#define kedge_geometry_triangle_surface_h

#include <kedge/geometry/moments.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace kedge
{
  /** A triangle with its corners in space, counter-clockwise seen from outside. */
  using Triangle = std::array<dealii::Point<3>, 3>;

  /** The point of a surface that is closest to a given one. */
  struct ClosestPoint
  {
    dealii::Point<3>     location;
    dealii::Tensor<1, 3> normal;   ///< outward unit vector; on edges and corners weighted by angles
    double               distance; ///< signed, negative inside [m]
    unsigned int         facet;
  };

  /**
   * A closed surface of triangles whose normals point out of the body. Facets stand in
   * an R-tree (Boost.Geometry), so that a question costs about the logarithm of their
   * number.
   */
  class TriangleSurface
  {
  public:
    /**
     * Joins corners that agree in all digits to vertices, and checks that the surface
     * bounds a body: there are facets, none of them without an area; each edge belongs to
     * two facets, which run through it in opposite directions; no facets cross or overlap;
     * the volume is positive.
     *
     * @throws UserError that names the facets, counted from 1 as in a file, and a corner.
     */
    explicit TriangleSurface(const std::vector<Triangle> &triangles);
    ~TriangleSurface();

    unsigned int
    n_facets() const
    {
      return static_cast<unsigned int>(corners.size());
    }

    /** The three vertices of a facet. */
    const std::array<unsigned int, 3> &
    facet(const unsigned int number) const
    {
      return corners[number];
    }

    const std::vector<dealii::Point<3>> &
    vertices() const
    {
      return places;
    }

    Triangle
    triangle(const unsigned int number) const;

    /** Outward unit normal of a facet. */
    const dealii::Tensor<1, 3> &
    normal(const unsigned int facet) const
    {
      return normals[facet];
    }

    const dealii::BoundingBox<3> &
    bounding_box() const
    {
      return box;
    }

    /**
     * The closest point of the surface. The sign of the distance follows from the normal
     * there, which is weighted by the facets' angles on edges and corners (Baerentzen and
     * Aanaes 2005), where no single facet could tell.
     */
    ClosestPoint
    closest_point(const dealii::Point<3> &x) const;

    /** The facets whose own boxes touch @p region, ascending. */
    std::vector<unsigned int>
    facets_near(const dealii::BoundingBox<3> &region) const;

    /**
     * Volume, first and second moments about the centre of @p region of what the surface
     * encloses within it, in closed form (exact to round-off). The enclosed body is a sum
     * over facets of what lies behind them along x, counted with the sign of -n_x:
     * int_C f dV = - sum_facets int n_x dA int_{max(x, x_0)}^{x_1} f dx'.
     */
    VolumeMoments<3>
    moments_within(const dealii::BoundingBox<3> &region) const;

    /** Volume, first and second moments of the body about the centre of its bounding_box(). */
    VolumeMoments<3>
    moments() const
    {
      return moments_within(box);
    }

  private:
    class Tree;

    dealii::Tensor<1, 3>
    normal_at(const unsigned int facet, const std::array<double, 3> &weights) const;

    std::vector<dealii::Point<3>>            places;
    std::vector<std::array<unsigned int, 3>> corners;
    std::vector<dealii::Tensor<1, 3>>        normals;        ///< of the facets
    std::vector<dealii::Tensor<1, 3>>        vertex_normals; ///< weighted by angles
    std::vector<std::array<unsigned int, 3>> neighbours;     ///< beyond the edge after a corner
    dealii::BoundingBox<3>                   box;
    std::unique_ptr<Tree>                    tree;
  };

  /** Where a surface stands: scaled, turned about x, then y, then z, then moved. */
  struct Placement
  {
    double               scale = 1;
    dealii::Tensor<1, 3> angles; ///< about the fixed axes x, y, z [degrees]
    dealii::Tensor<1, 3> shift;  ///< [m]
  };

  /** The triangles where @p placement puts them. */
  std::vector<Triangle>
  placed(std::vector<Triangle> triangles, const Placement &placement);
} // namespace kedge

#endif
