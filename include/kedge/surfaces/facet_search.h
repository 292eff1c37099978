#ifndef kedge_surfaces_facet_search_h
#define kedge_surfaces_facet_search_h

#include <kedge/geometry/surface_mesh.h>

#include <deal.II/base/bounding_box.h>

#include <memory>

namespace kedge
{
  /** The point of a facet that is closest to a given one. */
  template <int dim>
  struct FacetPoint
  {
    /** In what part of the facet's surroundings the given point lies. */
    enum class Region
    {
      face,
      edge, ///< of a triangle
      vertex
    };

    Region                  region;
    std::array<double, dim> weights;  ///< of the facet's corners; their sum is one
    double                  distance; ///< not negative [m]
    /** Of an edge the two corners that it joins, of a vertex twice it: counted in the facet. */
    std::array<unsigned int, 2> corners;
  };

  /** The closest point by regions (Ericson, Real-Time Collision Detection, 5.1). */
  template <int dim>
  FacetPoint<dim>
  closest_on_facet(const std::array<dealii::Point<dim>, dim> &corners, const dealii::Point<dim> &x);

  /**
   * Finds where a surface comes closest to points, in a given configuration. Facets stand in an
   * R-tree (Boost.Geometry), so that a question costs about the logarithm of their number.
   */
  template <int dim>
  class FacetSearch
  {
  public:
    /** The partner of a point. */
    struct Partner
    {
      unsigned int            facet;
      std::array<double, dim> weights; ///< of the facet's corners
      /** From the surface outward; off edges and vertices along the line from there, very close to
       * them the mean weighted by angles. */
      dealii::Tensor<1, dim> normal;
      double                 gap; ///< signed distance, negative inside the body [m]
    };

    static constexpr unsigned int no_facet = static_cast<unsigned int>(-1);

    /** An edge or a corner is sharp if a facet's normal forms an angle with the mean one whose
     * cosine is below this (25 degrees). */
    static constexpr double sharp = 0.9;

    /** So much closer, in sizes of the facet, another facet must be to take a partner's place. */
    static constexpr double hysteresis = 0.02;

    /**
     * @param mesh   its vertices as the search is to see them
     * @param region only facets that come into it are looked at
     */
    FacetSearch(const SurfaceMesh<dim> &mesh, const dealii::BoundingBox<dim> &region);
    ~FacetSearch();

    bool
    empty() const
    {
      return n_found == 0;
    }

    /**
     * The closest place on the facets that look towards @p x: those whose normals form an obtuse
     * angle with @p outward, the normal of the surface on which x lies. Beyond a sharp edge or
     * corner there is none: what slides past a corner is not pushed by it.
     *
     * @param reach    facets farther off do not count [m]
     * @param previous the last partner, which is kept if no other is clearly closer
     * @param guess    a facet that is perhaps near, from which the search begins: the answer does
     *                 not depend on it
     * @return false if there is none
     */
    bool
    find(const dealii::Point<dim>     &x,
         const dealii::Tensor<1, dim> &outward,
         const double                  reach,
         const unsigned int            previous,
         Partner                      &partner,
         const unsigned int            guess = no_facet) const;

    /**
     * How deep @p x lies in the body: its distance from the surface, 0 outside [m]. All facets of
     * the closed surface must be in the region.
     *
     * @param first where the search begins, which widens until it meets a facet [m]
     */
    double
    depth(const dealii::Point<dim> &x, const double first) const;

  private:
    class Tree;

    /** The facet found so far. */
    struct Nearest
    {
      unsigned int    facet = no_facet;
      FacetPoint<dim> place{};
      double          distance; ///< by which facets are compared, with hysteresis [m]
    };

    /** A sum of the normals around an edge or a vertex, and the facets that have added to it. */
    struct MeanNormal
    {
      dealii::Tensor<1, dim>    sum; ///< later a unit vector
      std::vector<unsigned int> facets;
      bool                      is_sharp = false;
    };

    void
    find_normals(const std::vector<unsigned int> &found);
    void
    find_mean(MeanNormal &mean) const;
    MeanNormal
    mean_at(const unsigned int facet, const FacetPoint<dim> &place) const;
    std::vector<unsigned int>
    facets_within(const dealii::Point<dim> &x, const double distance) const;
    void
    take_if_nearer(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &outward,
                   const unsigned int            facet,
                   const unsigned int            previous,
                   Nearest                      &nearest) const;
    std::vector<unsigned int>
    find_nearest(const dealii::Point<dim>     &x,
                 const dealii::Tensor<1, dim> &outward,
                 const double                  reach,
                 const unsigned int            previous,
                 const unsigned int            guess,
                 Nearest                      &nearest) const;
    bool
    is_outside(const dealii::Point<dim>        &x,
               const std::vector<unsigned int> &facets,
               const double                     reach) const;

    const SurfaceMesh<dim>             &mesh;
    std::vector<dealii::Tensor<1, dim>> normals; ///< unit vectors of the facets in the region and
                                                 ///< of those that share a vertex with one
    std::vector<unsigned int> number_of_vertex;  ///< of these facets, in vertex_normals
    std::vector<MeanNormal>   vertex_normals;    ///< weighted by angles
    std::unique_ptr<Tree>     tree;
    unsigned int              n_found = 0;
  };
} // namespace kedge

#endif
