#include <kedge/materials/critical_state.h>

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace kedge
{
  namespace
  {
    /** Iterations of a return; 4 to 8 are usual. */
    constexpr unsigned int most_iterations = 15;
    /** Of the residual, strains relative to those at the centre of the surface. */
    constexpr double tolerance = 1e-14;
    /** What a return may end with when round-off lets it get no better. */
    constexpr double loose_tolerance = 1e-10;

    /** How near to the surface a second start is looked for, and how long. */
    constexpr double       near_surface    = 0.1;
    constexpr unsigned int most_bisections = 60;

    using Vector = std::array<double, 3>;

    struct Jacobian
    {
      double row[3][3];

      /** Cramer's rule. */
      Vector
      solve(const Vector &right) const
      {
        const auto cofactor = [this](const int i, const int j) {
          const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
          return row[i1][j1] * row[i2][j2] - row[i1][j2] * row[i2][j1];
        };
        const double determinant =
          row[0][0] * cofactor(0, 0) + row[0][1] * cofactor(0, 1) + row[0][2] * cofactor(0, 2);
        Vector x{};
        for (int j = 0; j < 3; ++j)
          {
            for (int i = 0; i < 3; ++i)
              x[j] += cofactor(i, j) * right[i];
            x[j] /= determinant;
          }
        return x;
      }
    };

    /** Hencky's law: phi/A falls with the volume all the way. */
    double
    largest_compression(const CriticalState<Hencky> &, const double)
    {
      return -std::numeric_limits<double>::infinity();
    }

    /**
     * Elastic volume strain at which phi/A is smallest, at the porosity n. Beyond it A,
     * which grows with the square of the strain over n, overtakes phi: at pressures of
     * hundreds of MPa the surface ends, and what lies there is no state that soil comes
     * to from within it. With s = K~/n, c = (1 - n)/n:
     *   s c eps^2/2 + shift (c eps - 1) - a_0/(1 - gamma) = 0.
     */
    double
    largest_compression(const CriticalState<ImprovedHencky> &law, const double n)
    {
      if (law.surface_gamma >= 1.)
        return -std::numeric_limits<double>::infinity();
      const double s = law.elastic.bulk_parameter / n, c = (1. - n) / n, a = law.shift;
      const double eps =
        -(a * c +
          std::sqrt(a * c * a * c + 2. * s * c * (a + law.centre / (1. - law.surface_gamma)))) /
        (s * c);
      // if the surface does not even reach it, all of the axis is elastic
      return law.surface(eps, 0., n).excess > 0. ? eps : -std::numeric_limits<double>::infinity();
    }
  } // namespace



  /** The unknowns of a return and what they give. */
  template <class Elasticity>
  struct CriticalState<Elasticity>::Return
  {
    double       volume, shear, multiplier;
    Surface      surface;
    Vector       residual;
    double       error;
    unsigned int n_iterations = 0;

    /** The residual at the unknowns; false where it has no meaning. */
    bool
    evaluate(const CriticalState &law,
             const double         trial_volume,
             const double         trial_shear,
             const double         n)
    {
      surface         = law.surface(volume, shear, n);
      const double &A = surface.A, &B = surface.B;
      if (!(A > 0.) || !(B > 0.))
        return false;
      residual                 = {{volume - trial_volume + multiplier * surface.phi / (A * A),
                                   shear - trial_shear + multiplier * surface.rho / (B * B),
                                   surface.excess}};
      const double volume_unit = law.centre / law.bulk_modulus;
      const double shear_unit  = 0.5 * law.centre / law.elastic.shear_modulus;
      error                    = std::max({std::abs(residual[0]) / volume_unit,
                                           std::abs(residual[1]) / shear_unit,
                                           std::abs(residual[2])});
      return std::isfinite(error);
    }

    /**
     * Newton's method, halving steps that leave the domain of the residual or
     * more than double it. @return whether it has converged to a return
     */
    bool
    iterate(const CriticalState &law,
            const double         trial_volume,
            const double         trial_shear,
            const double         n)
    {
      for (unsigned int i = 0; i < most_iterations && error > tolerance; ++i)
        {
          const Vector step = jacobian(law).solve(residual);
          Return       next;
          double       fraction = 1.;
          bool         ok       = false;
          for (; !ok && fraction > 1e-3; fraction *= 0.5)
            {
              next.volume     = volume - fraction * step[0];
              next.shear      = shear - fraction * step[1];
              next.multiplier = multiplier - fraction * step[2];
              ok = next.evaluate(law, trial_volume, trial_shear, n) && next.error <= 2. * error;
            }
          if (!ok || (error < loose_tolerance && next.error >= error))
            break;
          next.n_iterations = n_iterations + 1;
          *this             = next;
        }
      return error < loose_tolerance && multiplier >= 0.;
    }

    /**
     * A start near the surface for trial states far off. Where the volume is
     * given, the flow rule gives the rest, and the surface lies between the
     * trial volume and that without plastic change of volume, phi = 0.
     */
    bool
    start_near(const CriticalState &law,
               const double         trial_volume,
               const double         trial_shear,
               const double         n)
    {
      const VolumetricResponse<> at_zero = volumetric_response(law.elastic, 0., n);
      double                     inside  = -law.shift / at_zero.dissipative_slope;
      double                     outside = std::max(trial_volume, largest_compression(law, n));
      for (unsigned int i = 0; i < most_bisections; ++i)
        {
          volume                   = 0.5 * (inside + outside);
          const Surface s          = law.surface(volume, 0., n);
          bool          is_outside = !(s.A > 0. && s.B > 0.);
          if (!is_outside)
            {
              multiplier = (trial_volume - volume) * s.A * s.A / s.phi;
              shear =
                trial_shear / (1. + 2. * law.elastic.shear_modulus * multiplier / (s.B * s.B));
              if (evaluate(law, trial_volume, trial_shear, n) &&
                  std::abs(surface.excess) < near_surface)
                return true;
              is_outside = surface.excess > 0.;
            }
          (is_outside ? outside : inside) = volume;
        }
      return false;
    }

    Jacobian
    jacobian(const CriticalState &law) const
    {
      const auto &[volume_response, phi, rho, A, B, excess] = surface;
      const double phi_d                                    = volume_response.dissipative_slope;
      const double A_d = -(1. - law.surface_gamma) * volume_response.slope;
      const double B_d =
        -law.critical_state_slope * (1. - law.surface_alpha) * volume_response.slope;
      const double rho_d = 2. * law.elastic.shear_modulus;
      return {{{1. + multiplier * (phi_d - 2. * phi * A_d / A) / (A * A), 0., phi / (A * A)},
               {-2. * multiplier * rho * B_d / (B * B * B),
                1. + multiplier * rho_d / (B * B),
                rho / (B * B)},
               {((phi * phi_d - phi * phi * A_d / A) / (A * A) - rho * rho * B_d / (B * B * B)) /
                  (1. + excess),
                rho * rho_d / (B * B) / (1. + excess),
                0.}}};
    }

    /** The residual's derivative by n at fixed unknowns. */
    Vector
    porosity_slope(const CriticalState &law) const
    {
      const auto &[volume_response, phi, rho, A, B, excess] = surface;
      const double phi_n = volume_response.dissipative_porosity_slope;
      const double A_n   = -(1. - law.surface_gamma) * volume_response.porosity_slope;
      const double B_n =
        -law.critical_state_slope * (1. - law.surface_alpha) * volume_response.porosity_slope;
      return {{multiplier * (phi_n - 2. * phi * A_n / A) / (A * A),
               -2. * multiplier * rho * B_n / (B * B * B),
               ((phi * phi_n - phi * phi * A_n / A) / (A * A) - rho * rho * B_n / (B * B * B)) /
                 (1. + excess)}};
    }
  };



  template <class Elasticity>
  CriticalState<Elasticity>::CriticalState(const MaterialParameters &parameters)
    : elastic(parameters)
    , bulk_modulus(elastic.bulk_modulus)
    , centre(0.5 * parameters.surface_gamma * parameters.preconsolidation_pressure)
    , shift(parameters.frozen_energy == FrozenEnergy::centred ? centre : 0.)
    , surface_alpha(parameters.surface_alpha)
    , surface_gamma(parameters.surface_gamma)
    , critical_state_slope(parameters.critical_state_slope)
  {}



  template <class Elasticity>
  double
  CriticalState<Elasticity>::porosity_at(const double volume_strain) const
  {
    if constexpr (std::is_same_v<Elasticity, ImprovedHencky>)
      return elastic.porosity(volume_strain);
    else
      return 1.;
  }



  template <class Elasticity>
  typename CriticalState<Elasticity>::Surface
  CriticalState<Elasticity>::surface(const double volume_strain,
                                     const double shear,
                                     const double n) const
  {
    Surface s;
    s.volume       = volumetric_response(elastic, volume_strain, n);
    const double P = -s.volume.pressure;
    s.phi          = s.volume.dissipative + shift;
    s.rho          = 2. * elastic.shear_modulus * shear;
    s.A            = (1. - surface_gamma) * P + centre;
    s.B            = critical_state_slope * ((1. - surface_alpha) * P + surface_alpha * centre);
    s.excess       = std::sqrt(s.phi / s.A * s.phi / s.A + s.rho / s.B * s.rho / s.B) - 1.;
    return s;
  }



  template <class Elasticity>
  bool
  CriticalState<Elasticity>::return_to_surface(const double trial_volume,
                                               const double trial_shear,
                                               const double n,
                                               Return      &result) const
  {
    result.volume      = trial_volume;
    result.shear       = trial_shear;
    result.multiplier  = 0.;
    const double limit = largest_compression(*this, n);
    return (trial_volume >= limit && result.evaluate(*this, trial_volume, trial_shear, n) &&
            result.iterate(*this, trial_volume, trial_shear, n) && result.volume >= limit) ||
           (result.start_near(*this, trial_volume, trial_shear, n) &&
            result.iterate(*this, trial_volume, trial_shear, n) && result.volume >= limit);
  }



  template <class Elasticity>
  void
  CriticalState<Elasticity>::set_plastic(const Return &result,
                                         const double  trial_volume,
                                         const double  trial_shear,
                                         const double  n,
                                         Response     &response) const
  {
    const auto &[volume, phi, rho, A, B, excess] = result.surface;
    response.n_iterations                        = result.n_iterations;
    response.plastic_multiplier                  = result.multiplier;
    response.plastic_volume                      = result.multiplier * phi / (A * A);
    response.plastic_shear                       = result.multiplier * rho / (B * B);

    // the elastic energy from the trial strain back, the frozen energy, the dissipation
    const VolumetricResponse<> trial = volumetric_response(elastic, trial_volume, n);
    response.work_increment -=
      0.5 * (trial.dissipative + volume.dissipative) * response.plastic_volume +
      elastic.shear_modulus * (trial_shear + result.shear) * response.plastic_shear +
      shift * response.plastic_volume - result.multiplier;

    const Jacobian J    = result.jacobian(*this);
    const Vector   by_n = result.porosity_slope(*this);
    const Vector   X_v =
      J.solve({{1. - (1. - n) * by_n[0], -(1. - n) * by_n[1], -(1. - n) * by_n[2]}});
    const Vector X_s       = J.solve({{0., 1., 0.}});
    const double two_G     = 2. * elastic.shear_modulus;
    response.volume_volume = volume.slope * X_v[0] + (1. - n) * volume.porosity_slope;
    response.volume_shear  = volume.slope * X_s[0];
    response.shear_volume  = two_G * X_v[1];
    response.shear_shear   = two_G * X_s[1];
    response.secant_shear  = two_G / (1. + two_G * result.multiplier / (B * B));
    response.work_coupling =
      -result.multiplier * ((1. - surface_gamma) * phi * phi / (A * A * A) +
                            critical_state_slope * (1. - surface_alpha) * rho * rho / (B * B * B));
  }



  template <class Elasticity>
  typename CriticalState<Elasticity>::Response
  CriticalState<Elasticity>::respond(const double (&strain_n)[3],
                                     const double (&increment)[3],
                                     const History<double> &history) const
  {
    const auto trial = elastic.respond(strain_n, increment, of_elasticity(history));
    Response   response;
    response.valid = true;
    if constexpr (Elasticity::can_fail)
      response.valid = trial.valid;
    if (!response.valid)
      return response;

    const double trace_d = increment[0] + increment[1] + increment[2];
    double       strain = 0., square = 0.;
    for (int i = 0; i < 3; ++i)
      strain += strain_n[i] + increment[i];
    for (int i = 0; i < 3; ++i)
      {
        response.flow[i] = strain_n[i] + increment[i] - strain / 3.;
        square += response.flow[i] * response.flow[i];
      }
    const double shear = std::sqrt(square);
    for (double &direction : response.flow)
      direction = shear > 0. ? direction / shear : 0.;
    response.volume_strain      = history.volume_strain + trace_d;
    response.work_increment     = trial.work_increment;
    response.plastic_multiplier = 0.;
    response.plastic_volume     = 0.;
    response.plastic_shear      = 0.;
    response.n_iterations       = 0;

    const double  n        = porosity_at(response.volume_strain);
    const Surface at       = surface(strain, shear, n);
    response.volume_volume = at.volume.slope + (1. - n) * at.volume.porosity_slope;
    response.volume_shear  = 0.;
    response.shear_volume  = 0.;
    response.shear_shear   = 2. * elastic.shear_modulus;
    response.secant_shear  = 2. * elastic.shear_modulus;
    response.work_coupling = 0.;
    double     pressure    = at.volume.pressure;
    double     rho         = at.rho;
    const bool has_meaning = at.A > 0. && at.B > 0. && strain >= largest_compression(*this, n);
    if (!(has_meaning && at.excess <= tolerance))
      {
        Return result;
        if (return_to_surface(strain, shear, n, result))
          {
            set_plastic(result, strain, shear, n, response);
            pressure = result.surface.volume.pressure;
            rho      = result.surface.rho;
          }
        else // a state that was returned to the surface may lie off it by round-off
          response.valid = has_meaning && at.excess <= loose_tolerance;
      }
    for (int i = 0; i < 3; ++i)
      response.kirchhoff_stress[i] = pressure + rho * response.flow[i];
    return response;
  }

  template class CriticalState<Hencky>;
  template class CriticalState<ImprovedHencky>;
} // namespace kedge
