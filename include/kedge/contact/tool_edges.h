#ifndef kedge_contact_tool_edges_h
#define kedge_contact_tool_edges_h

#include <kedge/contact/tool_side.h>

namespace kedge
{
  /** A place on a sharp edge or at a sharp corner of a surface, in the axes of its body. */
  template <int dim>
  struct SharpPlace
  {
    dealii::Point<dim>     at;
    dealii::Tensor<1, dim> outward; ///< mean of the normals around it, a unit vector
    double                 length;  ///< of the edges that it stands for; in 2D 1 [m; -]
  };

  /** Those of a closed surface, at most @p spacing apart along edges: where facets bend outward by
   * more than twice the angle of FacetSearch::sharp. */
  template <int dim>
  std::vector<SharpPlace<dim>>
  sharp_places(const SurfaceMesh<dim> &mesh, const double spacing);

  /**
   * Sharp edges and corners of a rigid body as places of contact with a body's surface: what
   * would pass between the middles of its facets. Keys are the places, partners facets of the
   * surface, which moves there as its vertices do; the normal is opposite to that of the surface.
   * A place stands for half of the spacing to either side of the edge.
   */
  template <int dim>
  class ToolEdges : public ToolSide<dim>
  {
  public:
    using Sample = typename ToolSide<dim>::Sample;
    using Memory = typename ToolSide<dim>::Memory;

    /** @param places must last as long as this  @param spacing of the surface's points [m] */
    ToolEdges(const WallBody<dim>                &body,
              const ContactLaw                   &law,
              const RigidBodies<dim>             &bodies,
              const unsigned int                  tool,
              const std::vector<SharpPlace<dim>> &places,
              const double                        spacing,
              const ShearLimit<dim>              &limit,
              const double                        reach,
              const double                        depth)
      : ToolSide<dim>(body, law, bodies, tool, limit, reach, depth)
      , places(places)
      , spacing(spacing)
    {}

    std::size_t
    n_places() const override
    {
      return places.size();
    }

    const MeanFunctions &
    functions(const Sample &sample) const override
    {
      return sample.on_surface;
    }

    /** The facets' middles say it. */
    std::pair<double, dealii::Point<dim>>
    deepest() const override
    {
      return {0., {}};
    }

    Memory
    handed_on(Memory &&of_step) const override
    {
      return kedge::handed_on<dim>(std::move(of_step),
                                   FacetHeritage(),
                                   this->body.surface->heritage());
    }

    double
    stored_after_step(const Memory &handed_on) const override
    {
      return this->stored(handed_on);
    }

  private:
    /** The part of the surface that a search looks at. */
    struct Near
    {
      SurfaceMesh<dim>                        mesh;
      std::unique_ptr<const FacetSearch<dim>> search;
    };

    void
    find_places() override;
    MeanFunctions
    functions_at(const Sample &sample) const;
    double
    area_of(const unsigned int key) const override
    {
      return places[key].length * (dim == 2 ? spacing : 0.5 * spacing);
    }
    bool
    measure_at_end(const Sample &sample, double &gap) const override;
    void
    look_at(const double part, Near &near) const;
    bool
    find_partner(const Near                         &near,
                 const unsigned int                  key,
                 const double                        part,
                 const unsigned int                  previous,
                 typename FacetSearch<dim>::Partner &partner) const;

    const std::vector<SharpPlace<dim>> &places;
    const double                        spacing;
    Near                                end; ///< of the step, as moved last
  };
} // namespace kedge

#endif
