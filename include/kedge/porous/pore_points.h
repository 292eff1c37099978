#ifndef kedge_porous_pore_points_h
#define kedge_porous_pore_points_h

#include <kedge/fields/step_points.h>
#include <kedge/materials/pore_fluid.h>
#include <kedge/points/material_points.h>
#include <kedge/time_integration/pore_scheme.h>

namespace kedge
{
  /** A body of saturated soil, beside its skeleton's Material. */
  struct Soil
  {
    PoreFluid fluid;
    double    grain_density;  ///< rho_s [kg/m^3]
    double    stabilisation;  ///< tau of (4.179) [1/Pa]; 0: none
    bool      has_body_force; ///< whether the body force acts on it
    /**
     * Of a dry body, whose pores hold nothing that weighs and have no pressure [1/Pa]; 0: it is
     * saturated. A storage that is small against all others, so that the pressure is zero at nodes
     * that no saturated point reaches.
     */
    double dry_storage = 0.;
  };

  /**
   * What the points know of their pores at the start of a step, in the slots
   * of StepPoints.
   *
   * Nothing of it is mapped to the grid: a step changes what the points hold
   * by nodal fields of its own, so the balance of mass has no error of mapping.
   */
  template <int dim>
  struct PorePoints
  {
    std::vector<double> pressure;    ///< p_n [Pa]
    std::vector<double> fluctuation; ///< (N - N^0) p of (4.179) at n [Pa]
    /** The fluid content's rate and that one's rate at n, per V0; empty if not carried. */
    std::vector<double> rate, rate_change;

    /** Reads the cloud in the order of @p points. */
    void
    reinit(const MaterialPoints<dim> &cloud,
           const StepPoints<dim>     &points,
           const PoreScheme          &scheme);
  };
} // namespace kedge

#endif
