#ifndef kedge_surfaces_surface_term_h
#define kedge_surfaces_surface_term_h

#include <kedge/equations/term.h>
#include <kedge/surfaces/body_surface.h>

namespace kedge
{
  /**
   * Lets a surface follow its body: seeds it, finds its root cells in each configuration, moves
   * it with each accepted step, keeps it in checkpoints. It has no residual; the terms that
   * act on the surface stand behind it. A surface that only loads ask for is left out where they
   * act on sides along the axes alone: there the points' own faces serve.
   */
  template <int dim>
  class SurfaceTerm : public Term<dim>
  {
  public:
    /**
     * @param body     whose surface it is
     * @param spacing  of the vertices [m]
     * @param contact  whether it is needed whatever its sides are like
     * @param sides    those on which loads act, see SurfaceParameters
     * @param open_sides of the grid
     */
    SurfaceTerm(const BodyParameters<dim>       &body,
                const unsigned int               body_index,
                const unsigned int               field,
                const Patch<dim>                &patch,
                const double                     spacing,
                const bool                       contact,
                const std::vector<unsigned int> &sides,
                const OpenSides<dim>            &open_sides = OpenSides<dim>())
      : surface_(body.name, body_index, field, patch, open_sides)
      , geometry(body.geometry)
      , is_clipped(body.clip)
      , spacing(spacing)
      , contact(contact)
      , sides(sides)
    {}

    std::string
    name() const override
    {
      return "surface of body '" + surface_.body_name + "'";
    }

    /** Contact couples any two places of the surface: each rank must know the nodes of all. */
    void
    claim(const unsigned int field, std::vector<unsigned char> &reached) override;

    /** @throws UserError if the body has no surface within the grid */
    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    save(SavedState &state) const override;

    void
    restore(const SavedState &state) override;

    const BodySurface<dim> &
    surface() const
    {
      return surface_;
    }

    /** Whether loads on a side act on facets and not on the faces of points: if it has parts that
     * are not along the axes, and if it is the whole surface. */
    bool
    has_facets(const unsigned int side) const
    {
      return on_facets[side];
    }

  private:
    void
    find_sides(const std::vector<GeneratedPoint<dim>> &points);

    BodySurface<dim>                     surface_;
    const std::shared_ptr<Geometry<dim>> geometry;
    const bool                           is_clipped; ///< or made of whole sub-cells
    const double                         spacing;
    const bool                           contact;
    const std::vector<unsigned int>      sides;
    std::array<bool, 2 * dim + 1>        on_facets{};
  };
} // namespace kedge

#endif
