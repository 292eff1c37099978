#ifndef kedge_surfaces_adapted_surface_h
#define kedge_surfaces_adapted_surface_h

#include <kedge/geometry/surface_mesh.h>

#include <map>

namespace kedge
{
  /** The surface of a body that carries it, with what its parts were at the start of the run. */
  template <int dim>
  struct CarriedSurface
  {
    SurfaceMesh<dim>                mesh;
    std::vector<dealii::Point<dim>> start;           ///< of the vertices, at the start of the run
    std::vector<double>             reference_areas; ///< of the facets, at the start [m^2; m in 2D]

    /** Corners of a facet at the start of the run. */
    std::array<dealii::Point<dim>, dim>
    corners_at_start(const unsigned int facet) const;
  };

  /**
   * Which facets of a surface before it was adapted each of its facets stands for. Empty if the
   * surface was as it should be.
   */
  struct FacetHeritage
  {
    /** A part of a facet before. */
    struct Part
    {
      unsigned int facet; ///< as it was counted before
      double       area;  ///< at the start of the run [m^2; m in 2D]
    };

    bool
    empty() const
    {
      return parts.empty();
    }

    /** Area of a facet at the start of the run [m^2; m in 2D]. */
    double
    area(const unsigned int facet) const
    {
      double sum = 0.;
      for (const Part &part : parts[facet])
        sum += part.area;
      return sum;
    }

    /**
     * What facets remember, of those before handed on to those of now.
     *
     * @param mean of what parts remember, as pairs of a memory and of the part of the new facet's
     *             area that it holds for; the rest remembers nothing
     */
    template <class Memory, typename Mean>
    std::map<unsigned int, Memory>
    hand_on(const std::map<unsigned int, Memory> &before, const Mean &mean) const;

    std::vector<std::vector<Part>> parts; ///< of each facet
    std::vector<unsigned int>      heirs; ///< of each facet before: that which has most of it
  };

  /** How long the edges of facets may be [m]. */
  struct EdgeLengths
  {
    /** Of those that have grown beyond twice the spacing and of those that have shrunk to a third
     * of it. */
    static EdgeLengths
    around(const double spacing)
    {
      return {2. * spacing, spacing / 3.};
    }

    double longest, shortest;
  };

  /**
   * Divides facets at edges that have become too long, the longest ones first, and lets edges
   * vanish that have become too short and have shrunk to less than half. The surface stays
   * conforming, and closed where it was. A division changes no place. An edge vanishes by one of
   * its ends being drawn to the other, and only if no facet turns by more than 20 degrees by it, as
   * it is now and as it was at the start: corners and edges of the body stay. The area at the start
   * goes over to the neighbours, so that its sum is kept to round-off.
   */
  template <int dim>
  FacetHeritage
  adapt(CarriedSurface<dim> &surface, const EdgeLengths &lengths);



  template <class Memory, typename Mean>
  std::map<unsigned int, Memory>
  FacetHeritage::hand_on(const std::map<unsigned int, Memory> &before, const Mean &mean) const
  {
    std::map<unsigned int, Memory> result;
    for (unsigned int f = 0; f < parts.size(); ++f)
      {
        std::vector<std::pair<const Memory *, double>> known;
        for (const Part &part : parts[f])
          if (const auto found = before.find(part.facet); found != before.end())
            known.emplace_back(&found->second, part.area / area(f));
        if (!known.empty())
          result.emplace(f, mean(known));
      }
    return result;
  }
} // namespace kedge

#endif
