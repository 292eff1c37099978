#ifndef kedge_surfaces_face_multipliers_h
#define kedge_surfaces_face_multipliers_h

#include <kedge/surfaces/surface_faces.h>

namespace kedge
{
  /**
   * The functions by which a condition on a plane surface is imposed in the mean: multilinear
   * between nodes in the plane as it was at the start, with about two cells from one to the next,
   * of which there are at least two in each direction in which the surface has more than one
   * face. They add up to one and hold all linear functions, so that forces, moments and rigid
   * motions are exact. Twice as wide as cells they are few enough for any place of the
   * surface among the nodes of the grid (inf-sup).
   *
   * On oblique and curved surfaces they are those of a lattice in space, seen on the surface. Nodes
   * whose functions say nearly the same there, as those on both sides of the surface do, and those
   * that it hardly touches, share one function, the sum of theirs: these add up to one too, and
   * what they impose of a motion is true for every rigid one, for it is the difference between
   * the motion and the displacement that has no mean.
   */
  template <int dim>
  class FaceMultipliers
  {
  public:
    /** Cells between nodes. */
    static constexpr double spacing = 2.;

    /**
     * @param extent    of the faces at the start
     * @param direction to which they are normal
     * @param cell_size by direction [m]
     */
    FaceMultipliers(const SurfaceExtent<dim>     &extent,
                    const unsigned int            direction,
                    const dealii::Tensor<1, dim> &cell_size);

    /**
     * On any surface.
     *
     * @param places    on it at the start, with the areas that they stand for
     * @param cell_size by direction [m]
     */
    FaceMultipliers(const std::vector<PlaceOfSurface<dim>> &places,
                    const dealii::Tensor<1, dim>           &cell_size);

    /** How many functions there are. */
    unsigned int
    size() const
    {
      return n_functions;
    }

    /** Calls visit(number, value) for the functions at a place of the start. */
    template <typename Visit>
    void
    for_functions(const dealii::Point<dim> &place, const Visit &visit) const
    {
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          unsigned int number = 0, stride = 1;
          double       value = 1.;
          for (int d = 0; d < dim; ++d)
            {
              const auto [cell, s]  = interval(place, d);
              const unsigned int up = (corner >> d) & 1u;
              value *= up ? s : 1. - s;
              number += stride * (cell + up);
              stride *= n_intervals[d] + 1;
            }
          if (value != 0.)
            visit(function_of_node.empty() ? number : function_of_node[number], value);
        }
    }

  private:
    unsigned int
    n_nodes() const;
    void
    unite_nodes(const std::vector<PlaceOfSurface<dim>> &places);

    /** The interval in which a place lies, and where in it; (0, 0) in a direction without any. */
    std::pair<unsigned int, double>
    interval(const dealii::Point<dim> &place, const int d) const
    {
      if (n_intervals[d] == 0)
        return {0, 0.};
      const double       s    = (place[d] - low[d]) / width[d];
      const unsigned int cell = static_cast<unsigned int>(
        std::min(std::max(s, 0.), static_cast<double>(n_intervals[d] - 1)));
      return {cell, s - cell};
    }

    std::array<unsigned int, std::size_t(dim)> n_intervals;
    dealii::Point<dim>                         low;
    dealii::Tensor<1, dim>                     width;            ///< of an interval [m]
    std::vector<unsigned int>                  function_of_node; ///< empty: each has its own
    unsigned int                               n_functions = 0;
  };
} // namespace kedge

#endif
