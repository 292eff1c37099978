#ifndef kedge_contact_surface_samples_h
#define kedge_contact_surface_samples_h

#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/closed_contact.h>
#include <kedge/contact/shear_limit.h>
#include <kedge/surfaces/body_surface.h>
#include <kedge/surfaces/facet_means.h>
#include <kedge/surfaces/facet_search.h>

namespace kedge
{
  /** A surface as a step sees it. */
  template <int dim>
  struct MovingSurface
  {
    /**
     * @param carries_water whether the body is saturated
     * @param clay          its material if that has an undrained strength, else a null pointer
     */
    MovingSurface(const BodySurface<dim> &surface, const bool carries_water, const Material *clay)
      : surface(surface)
      , carries_water(carries_water)
      , clay(clay)
    {}

    /**
     * Takes the displacements over the step, @p factor times those of a nodal vector; the mesh is
     * then where @p part of them leads to (collective).
     */
    void
    move(const std::vector<double> &nodal, const double factor, const double part);

    const BodySurface<dim>             &surface;
    const bool                          carries_water;
    const Material                     *clay;
    unsigned int                        generation = 0; ///< of the surface's facets
    std::vector<double>                 pore_pressures; ///< at the vertices, of the balance [Pa]
    std::vector<double>                 strengths;      ///< at the vertices, s_u; empty: none [Pa]
    SurfaceMesh<dim>                    mesh;           ///< in the configuration of the balance
    SurfaceMesh<dim>                    end;            ///< at the end of the step
    std::vector<dealii::Tensor<1, dim>> displacements;  ///< of the vertices over the step [m]
    std::vector<double>                 nodal;          ///< of the local nodes, the same [m]
    FacetMeans<dim>                     means;          ///< over the facets at the step's start
  };

  /**
   * A surface's facets as places of contact with another surface: one of the two halves of a
   * contact, of which each bears half of the load. Where the middle of a facet meets the other
   * surface, in which direction, and how large the gap was at the start of the step, is found
   * once and then held fixed, so that the law depends on the relative displacement alone: the mean
   * over the facet of what both bodies do there, the other one on the facet laid on its surface,
   *   D = (1/A) int (sum_I N_I u_I - sum_J N_J u_J) da.
   * So the load of a facet comes to the nodes as int N da has it, wherever the grid's lines are.
   *
   * In conserving steps the gap of a closed sample is not measured anew but carried on, g_1 = g_0 +
   * s.D: the energy stored in it then changes by what the pressure has done and by nothing else.
   * s is the normal, tilted in the direction of sliding so that g_1 is what will be
   * measured at the end of the step; otherwise errors would add up as samples slide over facets.
   */
  template <int dim>
  class SurfaceSamples
  {
  public:
    /** Of a sample, in a step. */
    struct Sample
    {
      unsigned int                       facet; ///< of the sampled surface
      typename FacetSearch<dim>::Partner partner;
      dealii::Tensor<1, dim>             gap_slope;   ///< s
      double                             gap_n;       ///< g_0 [m]
      double                             lead_n = 0.; ///< g_0 less that of the middle's ways [m]
      /** e_0; at rest the slip that holds it as if it stretched a spring of the law's stiffness,
       * as Uzawa's iteration finds it, and what presses it [m], [Pa]. */
      dealii::Tensor<1, dim> slip_n;
      double                 multiplier;
      double                 area;        ///< that it stands for [m^2; m in 2D]
      double                 shear_limit; ///< there, per area at the start [Pa]
      double                 stretch;     ///< of its area since the start
      MeanFunctions          on_partner;  ///< of the other body's nodes
      dealii::Tensor<1, dim> D;           ///< relative displacement over the step [m]
    };

    /** What is committed of a sample that is closed, or that cannot yet be measured as open. */
    using Memory = PartneredContact<dim>;

    /** What became of a sample. */
    struct Outcome
    {
      ContactResponse<dim> response;
      double               true_gap; ///< at the end of the step, as measured [m]
    };

    /**
     * @param limit of the shear stress; must last as long as this
     * @param share of the load that these samples bear
     * @param reach how far off partners are looked for [m]
     * @param depth a surface deeper in the other than this has not come there by contact [m]
     */
    SurfaceSamples(const MovingSurface<dim> &sampled,
                   const MovingSurface<dim> &other,
                   const ContactLaw         &law,
                   const ShearLimit<dim>    &limit,
                   const double              share,
                   const double              reach,
                   const double              depth)
      : sampled(sampled)
      , other(other)
      , law(law)
      , limit(limit)
      , share(share)
      , reach(reach)
      , depth(depth)
    {}

    /** Finds the samples in the configuration of the moved meshes. */
    void
    find();

    /** The same in the course of a step: they keep the multipliers that they have.
     * @return the samples before */
    std::vector<Sample>
    find_anew();

    /** The box around the sampled surface in the configuration of the moved meshes. */
    dealii::BoundingBox<dim>
    box_of_samples() const;

    /** Puts the samples found before, and their multipliers, in the place of the present ones. */
    void
    exchange(std::vector<Sample> &others)
    {
      samples_.swap(others);
    }

    /** Adds the samples to an update of their multipliers. */
    void
    for_multipliers(CellMultipliers<dim> &cells);

    const std::vector<Sample> &
    samples() const
    {
      return samples_;
    }

    /** Takes the samples' relative displacements from the moved surfaces (collective). */
    void
    read_displacements();

    /** Mean functions of the sampled body's nodes over a sample's facet. */
    const MeanFunctions &
    on_sampled(const Sample &sample) const
    {
      return sampled.means.of(sample.facet);
    }

    /** Whether what a sample adds to the tangent is this rank's to add; all know all samples. */
    bool
    is_added_here(const Sample &sample) const
    {
      return sampled.surface.owns(sampled.mesh.facets[sample.facet][0]);
    }

    /** Whether there is pore water at the samples, on this side or on the other. */
    bool
    has_water() const
    {
      return sampled.carries_water || other.carries_water;
    }

    /** Calls visit(surface, vertex, e): the pore pressure at a sample is the sum of e p. */
    template <typename Visit>
    void
    for_pore_pressures(const Sample &sample, const Visit &visit) const
    {
      if (sampled.carries_water)
        for (const unsigned int v : sampled.mesh.facets[sample.facet])
          visit(sampled, v, 1. / dim);
      else if (other.carries_water)
        for (int i = 0; i < dim; ++i)
          visit(other, other.mesh.facets[sample.partner.facet][i], sample.partner.weights[i]);
    }

    /** Pressure of the pore water at a sample; 0 if neither side has any [Pa]. */
    double
    pore_pressure(const Sample &sample) const
    {
      double p = 0.;
      for_pore_pressures(sample,
                         [&](const MovingSurface<dim> &side, const unsigned int v, const double e) {
                           p += side.pore_pressures.empty() ? 0. : e * side.pore_pressures[v];
                         });
      return p;
    }

    ContactResponse<dim>
    response(const Sample &sample) const
    {
      ContactLaw here  = law;
      here.shear_limit = sample.shear_limit;
      here.adhesion *= sample.stretch; // the law is per area at the start
      return contact_response(here,
                              sample.partner.normal,
                              sample.gap_slope,
                              sample.gap_n,
                              sample.slip_n,
                              sample.multiplier,
                              sample.D,
                              pore_pressure(sample));
    }

    Outcome
    outcome(const Sample &sample) const;

    /** Middle of a sampled facet, at the start of the step [m]. */
    dealii::Point<dim>
    place(const Sample &sample) const
    {
      return place_in(sampled.surface.mesh(), sample);
    }

    /** Its partner's place, at the start of the step [m]. */
    dealii::Point<dim>
    partner_place(const Sample &sample) const
    {
      return partner_in(other.surface.mesh(), sample);
    }

    /** The same two in the configuration of the moved meshes. */
    dealii::Point<dim>
    place_at_balance(const Sample &sample) const
    {
      return place_in(sampled.mesh, sample);
    }

    dealii::Point<dim>
    partner_at_balance(const Sample &sample) const
    {
      return partner_in(other.mesh, sample);
    }

    /** Energy that the committed samples store [J]. */
    double
    stored() const
    {
      return share * stored_by_facets(law, memory, [&](const unsigned int facet) {
               return sampled.surface.reference_area(facet);
             });
    }

    /** The same of the present samples at the start of the step [J]. */
    double
    stored_at_start() const;

    /** What is to be remembered of the step, and its stored energy [J]. */
    std::map<unsigned int, Memory>
    memory_of_step(double &stored) const;

    /** Hands it on to the facets that the step leads to. */
    std::map<unsigned int, Memory>
    handed_on(std::map<unsigned int, Memory> &&of_step) const
    {
      return kedge::handed_on<dim>(std::move(of_step),
                                   sampled.surface.heritage(),
                                   other.surface.heritage());
    }

    /** Energy that samples store after the step, by what those facets remember [J]. */
    double
    stored_after_step(const std::map<unsigned int, Memory> &handed_on) const
    {
      return share * kedge::stored_after_step<dim>(law, sampled.surface, handed_on);
    }

    void
    commit(std::map<unsigned int, Memory> &&of_step)
    {
      memory = std::move(of_step);
    }

    std::vector<double>
    save() const
    {
      return saved<dim>(memory);
    }

    /** @param to_gaps turns multipliers into gaps that press as hard */
    void
    restore(const std::vector<double> &saved, const bool to_gaps)
    {
      memory = restored<dim>(saved, law, to_gaps);
    }

    const MovingSurface<dim> &sampled, &other;
    const ContactLaw          law;

  private:
    /** Largest tilt of the gap's slope: the part of the pressure that acts along the surface. */
    static constexpr double largest_tilt = 0.01;

    bool
    find_sample(const unsigned int facet, const FacetSearch<dim> &search, Sample &sample);
    MeanFunctions
    functions_on_partner(const Sample &sample) const;
    bool
    set_start(Sample &sample) const;
    dealii::Tensor<1, dim>
    displacement_of_middle(const Sample &sample) const;
    double
    shear_limit_at(const Sample &sample) const;
    void
    tilt_to_end(const FacetSearch<dim> &search, Sample &sample) const;
    dealii::Point<dim>
    place_in(const SurfaceMesh<dim> &mesh, const Sample &sample) const;
    dealii::Point<dim>
    partner_in(const SurfaceMesh<dim> &mesh, const Sample &sample) const;
    double
    energy(const double gap, const double multiplier, const dealii::Tensor<1, dim> &slip) const
    {
      return stored_in_contact(law, gap, multiplier, slip);
    }

    const ShearLimit<dim>         &limit;
    const double                   share, reach, depth;
    std::vector<Sample>            samples_;
    std::vector<unsigned int>      guesses; ///< by facet, where the last search has ended
    std::map<unsigned int, Memory> memory;  ///< committed, by facet
  };
} // namespace kedge

#endif
