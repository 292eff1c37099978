#include <kedge/contact/contact_law.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  double
  tangent_ratio(const double poisson)
  {
    return std::min((1. - poisson) / (1. - 0.5 * poisson),
                    1.5 * (1. - 2. * poisson) / (1. - poisson));
  }



  ContactLaw
  contact_law_of(const ContactParameters &parameters,
                 const double             normal_stiffness,
                 const double             tangent_stiffness,
                 const Scheme            &scheme)
  {
    ContactLaw law;
    law.normal_stiffness  = normal_stiffness;
    law.tangent_stiffness = tangent_stiffness;
    law.friction          = parameters.friction;
    law.adhesion          = parameters.adhesion;
    law.alpha             = scheme.contact_alpha();
    law.conserving        = scheme.conserves_contact();
    law.at_rest           = !scheme.dynamic;
    return law;
  }



  ContactPressure
  contact_pressure(const ContactLaw &law,
                   const double      gap_n,
                   const double      change,
                   const double      multiplier)
  {
    const double eps = law.normal_stiffness;
    if (!law.conserving)
      {
        const double p = multiplier - eps * (gap_n + law.alpha * change);
        return p > 0. ? ContactPressure{p, -eps * law.alpha} : ContactPressure();
      }
    // W = a^2 / (2 eps) with a = <lambda - eps g>, so that p = (a_0^2 - a_1^2) / (2 eps dg)
    const double a_0 = std::max(multiplier - eps * gap_n, 0.);
    const double a_1 = std::max(multiplier - eps * (gap_n + change), 0.);
    if (a_0 > 0. && a_1 > 0.)
      return {0.5 * (a_0 + a_1), -0.5 * eps};
    if (a_1 > 0.) // it closes; the gap gets smaller by more than a_1 / eps
      {
        const double p = -a_1 * a_1 / (2. * eps * change);
        return {p, (a_1 - p) / change};
      }
    if (a_0 > 0.) // it opens
      {
        const double p = a_0 * a_0 / (2. * eps * change);
        return {p, -p / change};
      }
    return {};
  }



  template <int dim>
  double
  stored_in_contact(const ContactLaw             &law,
                    const double                  gap,
                    const double                  multiplier,
                    const dealii::Tensor<1, dim> &slip)
  {
    const double pressure =
      std::max((law.at_rest ? 0. : multiplier) - law.normal_stiffness * gap, 0.);
    const double in_gap = 0.5 * pressure * pressure / law.normal_stiffness;
    return law.at_rest ? in_gap : in_gap + 0.5 * law.tangent_stiffness * slip.norm_square();
  }



  namespace
  {
    /** tau, and its slope with p; that with the pore pressure is the opposite. */
    struct FrictionLimit
    {
      double value = 0., by_pressure = 0.;
    };

    FrictionLimit
    friction_limit(const ContactLaw &law, const double pressure, const double pore_pressure)
    {
      const double effective = pressure - pore_pressure;
      const double value     = law.friction * std::max(effective, 0.) + law.adhesion;
      if (value > law.shear_limit)
        return {law.shear_limit, 0.};
      return {value, effective > 0. ? law.friction : 0.};
    }
  } // namespace



  template <int dim>
  ContactResponse<dim>
  contact_response(const ContactLaw             &law,
                   const dealii::Tensor<1, dim> &normal,
                   const dealii::Tensor<1, dim> &gap_slope,
                   const double                  gap_n,
                   const dealii::Tensor<1, dim> &slip_n,
                   const double                  multiplier,
                   const dealii::Tensor<1, dim> &D,
                   const double                  pore_pressure)
  {
    const double          change   = gap_slope * D;
    const ContactPressure pressure = contact_pressure(law, gap_n, change, multiplier);
    const double          eps_t    = law.tangent_stiffness;

    ContactResponse<dim> result;
    result.pressure               = pressure.value;
    result.gap_end                = gap_n + change;
    result.traction               = pressure.value * gap_slope;
    result.slope                  = pressure.slope * outer_product(gap_slope, gap_slope);
    dealii::Tensor<2, dim> across = -1. * outer_product(normal, normal); // I - n n
    for (int d = 0; d < dim; ++d)
      across[d][d] += 1.;
    if (!(pressure.value > 0.))
      {
        result.dissipation = 0.5 * eps_t * slip_n.norm_square();
        return result;
      }
    const FrictionLimit bound = friction_limit(law, pressure.value, pore_pressure);
    const double        limit = bound.value;
    if (!(limit > 0.))
      {
        result.dissipation = 0.5 * eps_t * slip_n.norm_square();
        return result;
      }

    const dealii::Tensor<1, dim> D_t   = D - (D * normal) * normal;
    const dealii::Tensor<1, dim> trial = -eps_t * (slip_n + law.alpha * D_t);
    const double                 size  = trial.norm();
    if (size <= limit)
      {
        result.traction += trial;
        result.slope -= law.alpha * eps_t * across;
        result.slip_end = slip_n + D_t;
        result.sticks   = true;
        return result;
      }
    const dealii::Tensor<1, dim> direction = trial / size, t = limit * direction;
    result.traction += t;
    result.slope +=
      bound.by_pressure * pressure.slope * outer_product(direction, gap_slope) -
      limit * eps_t * law.alpha / size * (across - outer_product(direction, direction));
    result.slip_end                  = slip_n - (t / eps_t + slip_n) / law.alpha;
    result.dissipation               = -t * (D_t - result.slip_end + slip_n);
    result.traction_by_pore_pressure = -bound.by_pressure * direction;
    return result;
  }



  template <int dim>
  dealii::Tensor<2, dim>
  stiffness_when_closed(const ContactLaw &law, const dealii::Tensor<1, dim> &normal)
  {
    dealii::Tensor<2, dim> result =
      -law.alpha * law.normal_stiffness * outer_product(normal, normal);
    if (law.friction > 0. || law.adhesion > 0.)
      {
        const double eps_t = law.alpha * law.tangent_stiffness;
        result += eps_t * outer_product(normal, normal);
        for (int d = 0; d < dim; ++d)
          result[d][d] -= eps_t;
      }
    return result;
  }



  template <int dim>
  dealii::Tensor<1, dim>
  turned(const dealii::Tensor<1, dim> &vector,
         const dealii::Tensor<1, dim> &from,
         const dealii::Tensor<1, dim> &to)
  {
    const double cosine = from * to;
    if (!(cosine > -0.9)) // not a turn of a contact
      return {};
    // the least rotation that takes one direction to the other
    const dealii::Tensor<1, dim> both   = from + to;
    dealii::Tensor<1, dim>       result = vector - (vector * both) / (1. + cosine) * both;
    result -= (result * to) * to;
    const double size = result.norm();
    return size > 0. ? vector.norm() / size * result : result;
  }

  template ContactResponse<2>
  contact_response(const ContactLaw &,
                   const dealii::Tensor<1, 2> &,
                   const dealii::Tensor<1, 2> &,
                   const double,
                   const dealii::Tensor<1, 2> &,
                   const double,
                   const dealii::Tensor<1, 2> &,
                   const double);
  template ContactResponse<3>
  contact_response(const ContactLaw &,
                   const dealii::Tensor<1, 3> &,
                   const dealii::Tensor<1, 3> &,
                   const double,
                   const dealii::Tensor<1, 3> &,
                   const double,
                   const dealii::Tensor<1, 3> &,
                   const double);
  template double
  stored_in_contact(const ContactLaw &, const double, const double, const dealii::Tensor<1, 2> &);
  template double
  stored_in_contact(const ContactLaw &, const double, const double, const dealii::Tensor<1, 3> &);
  template dealii::Tensor<2, 2>
  stiffness_when_closed(const ContactLaw &, const dealii::Tensor<1, 2> &);
  template dealii::Tensor<2, 3>
  stiffness_when_closed(const ContactLaw &, const dealii::Tensor<1, 3> &);
  template dealii::Tensor<1, 2>
  turned(const dealii::Tensor<1, 2> &, const dealii::Tensor<1, 2> &, const dealii::Tensor<1, 2> &);
  template dealii::Tensor<1, 3>
  turned(const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &);
} // namespace kedge
