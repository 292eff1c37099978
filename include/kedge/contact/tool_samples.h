#ifndef kedge_contact_tool_samples_h
#define kedge_contact_tool_samples_h

#include <kedge/contact/closed_contact.h>
#include <kedge/contact/contact_law.h>
#include <kedge/contact/shear_limit.h>
#include <kedge/contact/wall_term.h>
#include <kedge/rigid/rigid_bodies.h>
#include <kedge/surfaces/facet_means.h>
#include <kedge/surfaces/facet_search.h>

#include <limits>

namespace kedge
{
  /** Vectors of the scene's space and of three dimensions. */
  template <int dim>
  Vector3
  in_space(const dealii::Tensor<1, dim> &vector)
  {
    Vector3 result;
    for (int d = 0; d < dim; ++d)
      result[d] = vector[d];
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  in_scene(const Vector3 &vector)
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = vector[d];
    return result;
  }

  /**
   * The facets of a body's surface as places of contact with a rigid body, which move as the mean
   * over the facet. The rigid body's facets stand in an R-tree in its own axes, made once. Where a
   * sample meets them, in which direction and from which gap on is found in the configuration of
   * the balance and then held fixed; gaps of closed samples are carried on, along a slope tilted to
   * what will be measured, as SurfaceSamples does.
   */
  template <int dim>
  class ToolSamples
  {
  public:
    struct Sample
    {
      unsigned int           facet, partner;  ///< of the surface, of the tool
      dealii::Point<dim>     place;           ///< at the start of the step
      Vector3                on_tool;         ///< its partner in the tool's axes, from its centre
      dealii::Tensor<1, dim> normal;          ///< of the tool, outward
      dealii::Tensor<1, dim> gap_slope;       ///< s
      double                 gap        = 0.; ///< g_0 [m]
      double                 lead       = 0.; ///< g_0 less that of the middle's ways [m]
      double                 multiplier = 0.; ///< [Pa]
      dealii::Tensor<1, dim> slip;            ///< e_0 [m]
      double                 area;
      double                 shear_limit; ///< there, per area at the start of the run [Pa]
      double                 stretch;     ///< of its area since then
      dealii::Tensor<1, dim> moves_by;    ///< in the step, the mean over the facet [m]
    };

    /** What a sample carries from step to step while it is closed. */
    using Closed = PartneredContact<dim>; // the partner is a facet of the tool
    using Memory = ContactMemory<dim>;

    /**
     * @param search in the tool's axes; it and the others must last as long as this
     * @param reach  how far off the tool is looked for [m]
     * @param depth  what is deeper in it than this has not come there by contact [m]
     */
    ToolSamples(const WallBody<dim>    &body,
                const ContactLaw       &law,
                const RigidBodies<dim> &bodies,
                const unsigned int      tool,
                const FacetSearch<dim> &search,
                const ShearLimit<dim>  &limit,
                const double            reach,
                const double            depth);

    /** Takes the strengths of the soil, of a configuration (collective). */
    void
    read_strengths();

    /** Takes displacements of the surface over the step: those of @p nodal, none if it is empty
     * (collective). */
    void
    move(const std::vector<double> &nodal);

    /** Begins a step: the surface has moved. */
    void
    begin_step()
    {
      means.reset(*body.surface);
      samples.clear();
    }

    /** Mean functions of the body's nodes over a sample's facet. */
    const MeanFunctions &
    functions(const Sample &sample) const
    {
      return means.of(sample.facet);
    }

    /** Takes the pore pressures of the balance (collective). */
    void
    read_pore_pressures(const std::vector<double> &unknowns);

    /** Finds the samples where the surface and the tool have moved to. */
    void
    find();

    /** The same in the course of a step: they keep the multipliers that they have. */
    void
    find_anew();

    /** The deepest place of the surface in the tool as it is [m], and where. */
    std::pair<double, dealii::Point<dim>>
    deepest() const;

    /** Relative displacement of a sample over the step. */
    dealii::Tensor<1, dim>
    displacement(const Sample &sample) const;

    /** Carried gap at the end of the step less that of the middle's ways [m]. */
    double
    lead_at_end(const Sample &sample) const
    {
      return sample.lead +
             sample.gap_slope * (sample.moves_by - displacement_of_middle(sample.facet));
    }

    ContactResponse<dim>
    response(const Sample &sample) const;

    /** The gap at the end of the step, as measured along the normal [m]. */
    double
    true_gap(const Sample &sample) const;

    RigidPoint
    point(const Sample &sample) const
    {
      return bodies.point(tool, sample.on_tool);
    }

    /** The place of the sample on the surface in the balance. */
    dealii::Point<dim>
    place_at_balance(const Sample &sample) const
    {
      return sample.place + bodies.alpha * sample.moves_by;
    }

    double
    stored(const Closed &closed) const
    {
      return stored_in_contact(law, closed.gap, closed.multiplier, closed.slip);
    }

    /** Energy that remembered samples store [J]. */
    double
    stored(const Memory &remembered) const
    {
      return stored_by_facets(law, remembered, [&](const unsigned int facet) {
        return body.surface->reference_area(facet);
      });
    }

    /** What is remembered of a step, on the facets that it leads to. */
    Memory
    handed_on(Memory &&of_step) const
    {
      return kedge::handed_on<dim>(std::move(of_step), body.surface->heritage());
    }

    /** Multipliers that stand for states of rest become gaps that press as hard. */
    void
    restore(const std::vector<double> &saved, const bool to_gaps)
    {
      memory = restored<dim>(saved, law, to_gaps);
    }

    std::vector<double>
    save() const
    {
      return saved<dim>(memory);
    }

    const WallBody<dim> body;
    const ContactLaw    law;
    std::vector<Sample> samples;
    Memory              memory, end_of_step;

  private:
    /** Largest tilt of the gap's slope, as of SurfaceSamples. */
    static constexpr double largest_tilt = 0.01;

    /** Where the tool is: what stands at y in space is at A^T (y - centre) in its axes. */
    struct Pose
    {
      Vector3  centre;
      Matrix33 attitude;

      dealii::Point<dim>
      in_axes(const dealii::Point<dim> &x) const
      {
        return dealii::Point<dim>(in_scene<dim>(transpose(attitude) * (in_space<dim>(x) - centre)));
      }
    };

    Pose
    pose(const double part) const;
    void
    read_displacements();
    dealii::Tensor<1, dim>
    displacement_of_middle(const unsigned int facet) const;
    bool
    find_partner(const unsigned int                  facet,
                 const double                        part,
                 const unsigned int                  previous,
                 typename FacetSearch<dim>::Partner &partner) const;
    bool
    set_start(Sample &sample) const;
    void
    tilt_to_end(Sample &sample) const;
    double
    strength_at(const unsigned int facet) const;

    const RigidBodies<dim>             &bodies;
    const unsigned int                  tool;
    const FacetSearch<dim>             &search;
    const ShearLimit<dim>              &limit;
    const double                        reach, depth;
    double                              radius;        ///< of a ball around the tool's centre [m]
    std::vector<double>                 strengths;     ///< at the vertices; empty: none [Pa]
    std::vector<dealii::Tensor<1, dim>> displacements; ///< of the vertices
    std::vector<double>                 nodal;         ///< displacements [m]
    FacetMeans<dim>                     means;
    std::vector<double>                 pore_pressures; ///< of the vertices [Pa]
  };
} // namespace kedge

#endif
