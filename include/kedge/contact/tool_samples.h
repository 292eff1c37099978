#ifndef kedge_contact_tool_samples_h
#define kedge_contact_tool_samples_h

#include <kedge/contact/tool_side.h>

namespace kedge
{
  /**
   * The facets of a body's surface as places of contact with a rigid body, which move as the mean
   * over the facet. The rigid body's facets stand in an R-tree in its own axes, made once. Keys
   * are facets of the surface, partners those of the tool.
   */
  template <int dim>
  class ToolSamples : public ToolSide<dim>
  {
  public:
    using Sample = typename ToolSide<dim>::Sample;
    using Memory = typename ToolSide<dim>::Memory;

    /** @param search in the tool's axes; it and the others must last as long as this */
    ToolSamples(const WallBody<dim>    &body,
                const ContactLaw       &law,
                const RigidBodies<dim> &bodies,
                const unsigned int      tool,
                const FacetSearch<dim> &search,
                const ShearLimit<dim>  &limit,
                const double            reach,
                const double            depth);

    void
    begin_step() override
    {
      ToolSide<dim>::begin_step();
      means.reset(*this->body.surface);
    }

    std::size_t
    n_places() const override
    {
      return this->body.surface->n_facets();
    }

    const MeanFunctions &
    functions(const Sample &sample) const override
    {
      return means.of(sample.facet);
    }

    std::pair<double, dealii::Point<dim>>
    deepest() const override;

    Memory
    handed_on(Memory &&of_step) const override
    {
      return kedge::handed_on<dim>(std::move(of_step), this->body.surface->heritage());
    }

    double
    stored_after_step(const Memory &handed_on) const override
    {
      return kedge::stored_after_step<dim>(this->law, *this->body.surface, handed_on);
    }

  private:
    void
    find_places() override;
    double
    area_of(const unsigned int key) const override
    {
      return this->body.surface->reference_area(key);
    }
    bool
    measure_at_end(const Sample &sample, double &gap) const override;
    bool
    find_partner(const unsigned int                  facet,
                 const double                        part,
                 const unsigned int                  previous,
                 typename FacetSearch<dim>::Partner &partner) const;

    const FacetSearch<dim> &search;
    double                  radius = 0.; ///< of a ball around the tool's centre [m]
    FacetMeans<dim>         means;
  };
} // namespace kedge

#endif
