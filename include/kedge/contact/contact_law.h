#ifndef kedge_contact_contact_law_h
#define kedge_contact_contact_law_h

#include <kedge/contact/parameters.h>
#include <kedge/time_integration/scheme.h>

#include <deal.II/base/tensor.h>

#include <limits>

namespace kedge
{
  /** What two surfaces that touch do to each other, per reference area. */
  struct ContactLaw
  {
    double normal_stiffness  = 0.; ///< eps [Pa/m]
    double tangent_stiffness = 0.; ///< eps_t [Pa/m]
    double friction          = 0.; ///< mu [-]
    double adhesion          = 0.; ///< a, the shear stress that is borne without pressure [Pa]
    double shear_limit = std::numeric_limits<double>::infinity(); ///< of the shear stress [Pa]

    /** Part of the step at which the balance stands. */
    double alpha = 0.5;
    /** Whether the pressure is the discrete gradient of the energy; if not, that at alpha. */
    bool conserving = true;
    /** States of rest: multipliers hold the gaps, and what sticks, and store nothing. */
    bool at_rest = false;
  };

  /**
   * eps_t over eps for a Poisson's ratio: Mindlin's of half-spaces, (1 - nu)/(1 - nu/2), but along
   * the surface no stiffer than three times a sheared cell, 3 G/M. Soil that hardly changes its
   * volume has a large M; with Mindlin's ratio alone it would slip after a part of its strain so
   * small that Newton's method goes to and fro between sticking and slipping.
   */
  double
  tangent_ratio(const double poisson);

  /** The law of a section of Contact, with the stiffnesses of a pair of surfaces [Pa/m]; its shear
   * limit is of the place (ShearLimit). */
  ContactLaw
  contact_law_of(const ContactParameters &parameters,
                 const double             normal_stiffness,
                 const double             tangent_stiffness,
                 const Scheme            &scheme);

  /** The pressure between two surfaces in a step, and what it depends on. */
  struct ContactPressure
  {
    double value = 0.; ///< p of the balance, never negative [Pa]
    double slope = 0.; ///< dp / d(g_1 - g_0) [Pa/m]
  };

  /**
   * The pressure as the gap goes from @p gap_n to @p gap_n + @p change [m], with the stored energy
   *   W(g) = <lambda - eps g>^2 / (2 eps):
   * conserving, p = -[W(g_1) - W(g_0)] / (g_1 - g_0), whose work is what W loses; else
   * p = <lambda - eps g_alpha>.
   */
  ContactPressure
  contact_pressure(const ContactLaw &law,
                   const double      gap_n,
                   const double      change,
                   const double      multiplier);

  /**
   * Energy of a closed gap and of the elastic slip e beside it, W(g) + eps_t |e|^2 / 2 [J/m^2]. At
   * rest the multiplier and the slip stand for forces of constraint, which do no work: what is
   * stored is that of a gap that is not closed yet, eps <-g>^2 / 2.
   */
  template <int dim>
  double
  stored_in_contact(const ContactLaw             &law,
                    const double                  gap,
                    const double                  multiplier,
                    const dealii::Tensor<1, dim> &slip);

  /** The answer of a pair of surfaces to a relative displacement over the step. */
  template <int dim>
  struct ContactResponse
  {
    double                 pressure = 0.;       ///< p [Pa]
    dealii::Tensor<1, dim> traction;            ///< p s + t, on the sampled surface [Pa]
    dealii::Tensor<2, dim> slope;               ///< d traction / dD [Pa/m]
    double                 gap_end = 0.;        ///< g_1 [m]
    dealii::Tensor<1, dim> slip_end;            ///< e_1, the elastic part of the slip [m]
    double                 dissipation = 0.;    ///< by friction in the step [J/m^2]
    bool                   sticks      = false; ///< held by friction; else it slides, or is open
    dealii::Tensor<1, dim> traction_by_pore_pressure; ///< d traction / d p_w [-]
  };

  /**
   * The law at the normal n from the other surface to the sampled one. D is the displacement
   * of the sampled point less that of its partner over the step. The gap changes by the slope s of
   * the gap over the step, nearly n: g_1 = g_0 + s.D, and p acts along s. With
   * D_t = D - n (n.D) and e the elastic slip, in the plane across n,
   *   t = -eps_t e_alpha,  e_alpha = e_0 + alpha D_t,
   * scaled back to |t| <= tau = min(mu <p - p_w> + a, tau_max), p_w the pressure of the pore water
   * there: the surfaces carry p, and friction acts on what the grains carry of it; sliding, e_alpha
   * = -t / eps_t and e_1 = e_0 + (e_alpha - e_0) / alpha. With alpha = 1/2, t.D_t = -eps_t (|e_1|^2
   * - |e_0|^2) / 2 - (what friction dissipates). An open contact (p = 0) forgets its elastic slip,
   * whose energy is dissipated.
   */
  template <int dim>
  ContactResponse<dim>
  contact_response(const ContactLaw             &law,
                   const dealii::Tensor<1, dim> &normal,
                   const dealii::Tensor<1, dim> &gap_slope,
                   const double                  gap_n,
                   const dealii::Tensor<1, dim> &slip_n,
                   const double                  multiplier,
                   const dealii::Tensor<1, dim> &D,
                   const double                  pore_pressure = 0.);

  /** d traction / dD of a place that is closed and sticks. */
  template <int dim>
  dealii::Tensor<2, dim>
  stiffness_when_closed(const ContactLaw &law, const dealii::Tensor<1, dim> &normal);

  /** A vector across @p from turned with it to be across @p to; both unit vectors. */
  template <int dim>
  dealii::Tensor<1, dim>
  turned(const dealii::Tensor<1, dim> &vector,
         const dealii::Tensor<1, dim> &from,
         const dealii::Tensor<1, dim> &to);
} // namespace kedge

#endif
