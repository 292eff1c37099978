#ifndef kedge_surfaces_surface_term_h
#define kedge_surfaces_surface_term_h

#include <kedge/equations/term.h>
#include <kedge/surfaces/body_surface.h>

namespace kedge
{
  /**
   * Lets a surface follow its body: seeds it, finds its root cells in each configuration, moves
   * it with each accepted step, keeps it in checkpoints. It has no residual; the terms that
   * act on the surface stand behind it.
   */
  template <int dim>
  class SurfaceTerm : public Term<dim>
  {
  public:
    /**
     * @param geometry of the body
     * @param spacing  of the vertices [m]
     */
    SurfaceTerm(const std::string                    &body_name,
                const unsigned int                    body,
                const unsigned int                    field,
                const Patch<dim>                     &patch,
                const std::shared_ptr<Geometry<dim>> &geometry,
                const double                          spacing)
      : surface_(body_name, body, field, patch)
      , geometry(geometry)
      , spacing(spacing)
    {}

    std::string
    name() const override
    {
      return "surface of body '" + surface_.body_name + "'";
    }

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

  private:
    BodySurface<dim>                     surface_;
    const std::shared_ptr<Geometry<dim>> geometry;
    const double                         spacing;
    std::vector<dealii::Tensor<1, dim>>  displacements; ///< of the step that finish() has seen
  };
} // namespace kedge

#endif
