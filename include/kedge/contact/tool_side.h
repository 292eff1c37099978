#ifndef kedge_contact_tool_side_h
#define kedge_contact_tool_side_h

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
   * Places of contact between a body's surface and a rigid body. Where a sample meets its
   * partner, in which direction and from which gap on is found in the configuration of
   * the balance and then held fixed; gaps of closed samples are carried on, along a slope tilted to
   * what will be measured, as SurfaceSamples does. Which places are samples, and how the
   * surface moves there, derived classes say.
   */
  template <int dim>
  class ToolSide
  {
  public:
    struct Sample
    {
      unsigned int            key;       ///< of the place, by which it is remembered
      unsigned int            facet;     ///< of the surface
      std::array<double, dim> weights;   ///< of its corners, where the sample is
      unsigned int            partner;   ///< what may be kept as long as no other is clearly closer
      dealii::Point<dim>      place;     ///< on the surface, at the start of the step
      Vector3                 on_tool;   ///< its partner in the tool's axes, from its centre
      dealii::Tensor<1, dim>  normal;    ///< of the tool, outward
      dealii::Tensor<1, dim>  gap_slope; ///< s
      double                  gap        = 0.; ///< g_0 [m]
      double                  lead       = 0.; ///< g_0 less that of the middle's ways [m]
      double                  multiplier = 0.; ///< [Pa]
      dealii::Tensor<1, dim>  slip;            ///< e_0 [m]
      double                  area        = 0.;
      double                  shear_limit = 0.; ///< there, per area at the start of the run [Pa]
      double                  stretch     = 1.; ///< of its area since then
      dealii::Tensor<1, dim>  moves_by;         ///< in the step, where forces act [m]
      MeanFunctions           on_surface;       ///< of a place that is no whole facet
    };

    /** What a sample carries from step to step while it is closed. */
    using Closed = PartneredContact<dim>;
    using Memory = ContactMemory<dim>;

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

      dealii::Point<dim>
      in_scene_at(const Vector3 &on_tool) const
      {
        return dealii::Point<dim>(in_scene<dim>(centre + attitude * on_tool));
      }
    };

    /**
     * @param reach how far off partners are looked for [m]
     * @param depth what is deeper than this has not come there by contact [m]
     */
    ToolSide(const WallBody<dim>    &body,
             const ContactLaw       &law,
             const RigidBodies<dim> &bodies,
             const unsigned int      tool,
             const ShearLimit<dim>  &limit,
             const double            reach,
             const double            depth);

    virtual ~ToolSide() = default;

    /** Takes the strengths of the soil, of a configuration (collective). */
    void
    read_strengths();

    /** Takes displacements of the surface over the step: those of @p nodal, none if it is empty
     * (collective). */
    void
    move(const std::vector<double> &nodal);

    /** Begins a step: the surface has moved. */
    virtual void
    begin_step()
    {
      samples.clear();
    }

    /** Keys are below this. */
    virtual std::size_t
    n_places() const = 0;

    /** Functions of the body's nodes by which the surface moves where a sample's force acts. */
    virtual const MeanFunctions &
    functions(const Sample &sample) const = 0;

    /** Takes the pore pressures of the balance (collective). */
    void
    read_pore_pressures(const std::vector<double> &unknowns);

    /** Calls visit(vertex, weight): what the vertices have, a sample has the sum of. */
    template <typename Visit>
    void
    for_vertices(const Sample &sample, const Visit &visit) const
    {
      for (int i = 0; i < dim; ++i)
        visit(body.surface->mesh().facets[sample.facet][i], sample.weights[i]);
    }

    /** Finds the samples where the surface and the tool have moved to. */
    void
    find();

    /** The same in the course of a step: they keep the multipliers that they have. */
    void
    find_anew();

    /** The deepest place of the surface in the tool as it is [m], and where. */
    virtual std::pair<double, dealii::Point<dim>>
    deepest() const = 0;

    /** Relative displacement of a sample over the step. */
    dealii::Tensor<1, dim>
    displacement(const Sample &sample) const;

    /** Carried gap at the end of the step less that of the sample's own ways [m]. */
    double
    lead_at_end(const Sample &sample) const
    {
      return sample.lead + sample.gap_slope * (sample.moves_by - displacement_of_place(sample));
    }

    ContactResponse<dim>
    response(const Sample &sample) const;

    /** The gap at the start of the step, as measured along the normal [m]. */
    double
    gap_at_start(const Sample &sample) const;

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
      return stored_by_facets(law, remembered, [&](const unsigned int key) {
        return area_of(key);
      });
    }

    /** What is remembered of a step, on the facets that it leads to. */
    virtual Memory
    handed_on(Memory &&of_step) const = 0;

    /** Energy that they then store [J]. */
    virtual double
    stored_after_step(const Memory &handed_on) const = 0;

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

  protected:
    /** Largest tilt of the gap's slope, as of SurfaceSamples. */
    static constexpr double largest_tilt = 0.01;

    /** Adds the samples: keys, places on both sides, normals, areas, stretches. */
    virtual void
    find_places() = 0;

    /** Of the place with this key at the start of the run [m^2; m in 2D]. */
    virtual double
    area_of(const unsigned int key) const = 0;

    /** The gap as measured at the end of the step; false if there is no partner then. */
    virtual bool
    measure_at_end(const Sample &sample, double &gap) const = 0;

    Pose
    pose(const double part) const;

    /** How far the sample's place on its facet moves in the step, by the facet's vertices. */
    dealii::Tensor<1, dim>
    displacement_of_place(const Sample &sample) const;

    unsigned int
    partner_before(const unsigned int key) const
    {
      const auto known = memory.find(key);
      return known == memory.end() ? FacetSearch<dim>::no_facet : known->second.partner;
    }

    const RigidBodies<dim>             &bodies;
    const unsigned int                  tool;
    const ShearLimit<dim>              &limit;
    const double                        reach, depth;
    std::vector<dealii::Tensor<1, dim>> displacements; ///< of the vertices

  private:
    void
    read_displacements();
    bool
    set_start(Sample &sample) const;
    void
    tilt_to_end(Sample &sample) const;
    double
    strength_at(const Sample &sample) const;

    std::vector<double> strengths;      ///< at the vertices; empty: none [Pa]
    std::vector<double> nodal;          ///< displacements [m]
    std::vector<double> pore_pressures; ///< of the vertices [Pa]
  };
} // namespace kedge

#endif
