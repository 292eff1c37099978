#include <kedge/materials/critical_state.h>

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

    template <typename Number>
    using Vector = std::array<Number, 3>;

    template <typename Number>
    Number
    larger(const Number &a, const Number &b)
    {
      return select(a < b, b, a);
    }

    template <typename Number>
    struct Jacobian
    {
      Number row[3][3];

      /** Cramer's rule. */
      Vector<Number>
      solve(const Vector<Number> &right) const
      {
        const auto cofactor = [this](const int i, const int j) {
          const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
          return row[i1][j1] * row[i2][j2] - row[i1][j2] * row[i2][j1];
        };
        const Number determinant =
          row[0][0] * cofactor(0, 0) + row[0][1] * cofactor(0, 1) + row[0][2] * cofactor(0, 2);
        Vector<Number> x;
        for (int j = 0; j < 3; ++j)
          {
            x[j] = 0.;
            for (int i = 0; i < 3; ++i)
              x[j] += cofactor(i, j) * right[i];
            x[j] /= determinant;
          }
        return x;
      }
    };

    /** Hencky's law: phi/A falls with the volume all the way. */
    template <typename Number>
    Number
    largest_compression(const CriticalState<Hencky> &, const Number &)
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
    template <typename Number>
    Number
    largest_compression(const CriticalState<ImprovedHencky> &law, const Number &n)
    {
      using std::sqrt;
      if (law.surface_gamma >= 1.)
        return -std::numeric_limits<double>::infinity();
      const Number s = law.elastic.bulk_parameter / n, c = (1. - n) / n;
      const double a = law.shift;
      const Number eps =
        -(a * c + sqrt(a * c * a * c + 2. * s * c * (a + law.centre / (1. - law.surface_gamma)))) /
        (s * c);
      // if the surface does not even reach it, all of the axis is elastic
      return select(law.surface(eps, Number(0.), n).excess > 0.,
                    eps,
                    Number(-std::numeric_limits<double>::infinity()));
    }
  } // namespace



  /** The unknowns of a return and what they give. Lanes do not influence each other. */
  template <class Elasticity>
  template <typename Number>
  struct CriticalState<Elasticity>::Return
  {
    Number          volume, shear, multiplier;
    Surface<Number> surface;
    Vector<Number>  residual;
    Number          error;
    Number          n_iterations = 0.;

    /** Takes over @p other in some lanes. */
    void
    take(const Condition<Number> &where, const Return &other)
    {
      constexpr std::size_t n_numbers = sizeof(Return) / sizeof(Number);
      static_assert(sizeof(Return) == n_numbers * sizeof(Number), "nothing but Numbers");
      auto       *here  = reinterpret_cast<Number *>(this);
      const auto *there = reinterpret_cast<const Number *>(&other);
      for (std::size_t i = 0; i < n_numbers; ++i)
        here[i] = select(where, there[i], here[i]);
    }

    /** The residual at the unknowns; where it has a meaning. */
    Condition<Number>
    evaluate(const CriticalState &law,
             const Number        &trial_volume,
             const Number        &trial_shear,
             const Number        &n)
    {
      using std::abs;
      surface         = law.surface(volume, shear, n);
      const Number &A = surface.A, &B = surface.B;
      residual              = {{volume - trial_volume + multiplier * surface.phi / (A * A),
                                shear - trial_shear + multiplier * surface.rho / (B * B),
                                surface.excess}};
      const double units[3] = {law.centre / law.bulk_modulus,
                               0.5 * law.centre / law.elastic.shear_modulus,
                               1.};
      const Number zero     = 0.;
      auto         meaning  = A > zero && B > zero;
      error                 = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const Number size = abs(residual[i]) / units[i];
          meaning           = meaning && size < std::numeric_limits<double>::infinity();
          error             = larger(error, size);
        }
      return meaning;
    }

    /**
     * A step of Newton's method, halved while it leaves the domain of the residual or more than
     * doubles it; where one was found.
     */
    Condition<Number>
    find_next(const Condition<Number> &open,
              const CriticalState     &law,
              const Number            &trial_volume,
              const Number            &trial_shear,
              const Number            &n,
              Return                  &next) const
    {
      constexpr double     smallest_fraction = 1e-3;
      const Vector<Number> step              = jacobian(law).solve(residual);
      Condition<Number>    seeks             = open;
      for (double fraction = 1.; any(seeks) && fraction > smallest_fraction; fraction *= 0.5)
        {
          Return at;
          at.volume     = volume - fraction * step[0];
          at.shear      = shear - fraction * step[1];
          at.multiplier = multiplier - fraction * step[2];
          const auto ok =
            at.evaluate(law, trial_volume, trial_shear, n) && seeks && at.error <= 2. * error;
          at.n_iterations = n_iterations + 1.;
          next.take(ok, at);
          seeks = seeks && !ok;
        }
      return open && !seeks;
    }

    /** Newton's method; where it has converged to a return. */
    Condition<Number>
    iterate(const Condition<Number> &asked,
            const CriticalState     &law,
            const Number            &trial_volume,
            const Number            &trial_shear,
            const Number            &n)
    {
      Condition<Number> open = asked && error > tolerance;
      for (unsigned int i = 0; i < most_iterations && any(open); ++i)
        {
          Return     next    = *this;
          const auto found   = find_next(open, law, trial_volume, trial_shear, n, next);
          const auto stalled = error < loose_tolerance && next.error >= error;
          const auto moves   = found && !stalled;
          take(moves, next);
          open = moves && error > tolerance;
        }
      return asked && error < loose_tolerance && multiplier >= 0.;
    }

    /**
     * A start near the surface for trial states far off, where there is one. Where the volume is
     * given, the flow rule gives the rest, and the surface lies between the
     * trial volume and that without plastic change of volume, phi = 0.
     */
    Condition<Number>
    start_near(const Condition<Number> &asked,
               const CriticalState     &law,
               const Number            &trial_volume,
               const Number            &trial_shear,
               const Number            &n)
    {
      using std::abs;
      const double                     G       = law.elastic.shear_modulus;
      const VolumetricResponse<Number> at_zero = volumetric_response(law.elastic, Number(0.), n);
      Number                           inside  = -law.shift / at_zero.dissipative_slope;
      Number                           outside = larger(trial_volume, largest_compression(law, n));
      Condition<Number>                open    = asked;
      for (unsigned int i = 0; i < most_bisections && any(open); ++i)
        {
          Return at;
          at.volume               = 0.5 * (inside + outside);
          const Surface<Number> s = law.surface(at.volume, Number(0.), n);
          at.multiplier           = (trial_volume - at.volume) * s.A * s.A / s.phi;
          at.shear                = trial_shear / (1. + 2. * G * at.multiplier / (s.B * s.B));
          const auto meaning      = s.A > 0. && s.B > 0.;
          const auto near = at.evaluate(law, trial_volume, trial_shear, n) && meaning && open &&
                            abs(at.surface.excess) < near_surface;
          const auto is_outside = !meaning || at.surface.excess > 0.;
          take(near, at);
          open    = open && !near;
          outside = select(is_outside, at.volume, outside);
          inside  = select(is_outside, inside, at.volume);
        }
      return asked && !open;
    }

    Jacobian<Number>
    jacobian(const CriticalState &law) const
    {
      const auto &[volume_response, phi, rho, A, B, excess] = surface;
      const Number phi_d                                    = volume_response.dissipative_slope;
      const Number A_d = -(1. - law.surface_gamma) * volume_response.slope;
      const Number B_d =
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
    Vector<Number>
    porosity_slope(const CriticalState &law) const
    {
      const auto &[volume_response, phi, rho, A, B, excess] = surface;
      const Number phi_n = volume_response.dissipative_porosity_slope;
      const Number A_n   = -(1. - law.surface_gamma) * volume_response.porosity_slope;
      const Number B_n =
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
  template <typename Number>
  Number
  CriticalState<Elasticity>::porosity_at(const Number &volume_strain) const
  {
    if constexpr (std::is_same_v<Elasticity, ImprovedHencky>)
      return elastic.porosity(volume_strain);
    else
      return 1.;
  }



  template <class Elasticity>
  template <typename Number>
  typename CriticalState<Elasticity>::template Surface<Number>
  CriticalState<Elasticity>::surface(const Number &volume_strain,
                                     const Number &shear,
                                     const Number &n) const
  {
    using std::sqrt;
    Surface<Number> s;
    s.volume       = volumetric_response(elastic, volume_strain, n);
    const Number P = -s.volume.pressure;
    s.phi          = s.volume.dissipative + shift;
    s.rho          = 2. * elastic.shear_modulus * shear;
    s.A            = (1. - surface_gamma) * P + centre;
    s.B            = critical_state_slope * ((1. - surface_alpha) * P + surface_alpha * centre);
    s.excess       = sqrt(s.phi / s.A * s.phi / s.A + s.rho / s.B * s.rho / s.B) - 1.;
    return s;
  }



  template <class Elasticity>
  template <typename Number>
  Condition<Number>
  CriticalState<Elasticity>::return_to_surface(const Condition<Number> &asked,
                                               const Number            &trial_volume,
                                               const Number            &trial_shear,
                                               const Number            &n,
                                               Return<Number>          &result) const
  {
    result.volume      = trial_volume;
    result.shear       = trial_shear;
    result.multiplier  = 0.;
    const Number limit = largest_compression(*this, n);
    const auto   near =
      result.evaluate(*this, trial_volume, trial_shear, n) && asked && trial_volume >= limit;
    const auto from_trial =
      result.iterate(near, *this, trial_volume, trial_shear, n) && result.volume >= limit;
    const auto left = asked && !from_trial;
    if (!any(left))
      return from_trial;
    Return<Number> other = result;
    const auto     start = other.start_near(left, *this, trial_volume, trial_shear, n);
    const auto     found =
      other.iterate(start, *this, trial_volume, trial_shear, n) && other.volume >= limit;
    result.take(found, other);
    return from_trial || found;
  }



  template <class Elasticity>
  template <typename Number>
  void
  CriticalState<Elasticity>::set_plastic(const Condition<Number> &where,
                                         const Return<Number>    &result,
                                         const Number            &trial_volume,
                                         const Number            &trial_shear,
                                         const Number            &n,
                                         Response<Number>        &response) const
  {
    const auto &[volume, phi, rho, A, B, excess] = result.surface;
    const auto set                               = [&where](Number &value, const Number &plastic) {
      value = select(where, plastic, value);
    };
    set(response.n_iterations, result.n_iterations);
    set(response.plastic_multiplier, result.multiplier);
    set(response.plastic_volume, result.multiplier * phi / (A * A));
    set(response.plastic_shear, result.multiplier * rho / (B * B));

    // the elastic energy from the trial strain back, the frozen energy, the dissipation
    const VolumetricResponse<Number> trial = volumetric_response(elastic, trial_volume, n);
    set(response.work_increment,
        response.work_increment -
          (0.5 * (trial.dissipative + volume.dissipative) * response.plastic_volume +
           elastic.shear_modulus * (trial_shear + result.shear) * response.plastic_shear +
           shift * response.plastic_volume - result.multiplier));

    const Jacobian<Number> J    = result.jacobian(*this);
    const Vector<Number>   by_n = result.porosity_slope(*this);
    const Vector<Number>   X_v =
      J.solve({{1. - (1. - n) * by_n[0], -(1. - n) * by_n[1], -(1. - n) * by_n[2]}});
    const Vector<Number> X_s   = J.solve({{0., 1., 0.}});
    const double         two_G = 2. * elastic.shear_modulus;
    set(response.volume_volume, volume.slope * X_v[0] + (1. - n) * volume.porosity_slope);
    set(response.volume_shear, volume.slope * X_s[0]);
    set(response.shear_volume, two_G * X_v[1]);
    set(response.shear_shear, two_G * X_s[1]);
    set(response.secant_shear, two_G / (1. + two_G * result.multiplier / (B * B)));
    set(response.work_coupling,
        -result.multiplier *
          ((1. - surface_gamma) * phi * phi / (A * A * A) +
           critical_state_slope * (1. - surface_alpha) * rho * rho / (B * B * B)));
  }



  template <class Elasticity>
  template <typename Number>
  typename CriticalState<Elasticity>::template Response<Number>
  CriticalState<Elasticity>::respond(const Number (&strain_n)[3],
                                     const Number (&increment)[3],
                                     const HistoryOf<CriticalState, Number> &history) const
  {
    using std::sqrt;
    const auto       trial = elastic.respond(strain_n, increment, of_elasticity<Number>(history));
    Response<Number> response;
    const Number     trace_d = increment[0] + increment[1] + increment[2];
    Number           strain = 0., square = 0.;
    for (int i = 0; i < 3; ++i)
      strain += strain_n[i] + increment[i];
    response.valid = square <= 0.;
    if constexpr (Elasticity::can_fail)
      response.valid = trial.valid;
    if (!any(response.valid))
      return response;
    for (int i = 0; i < 3; ++i)
      {
        response.flow[i] = strain_n[i] + increment[i] - strain / 3.;
        square += response.flow[i] * response.flow[i];
      }
    const Number shear = sqrt(square);
    for (Number &direction : response.flow)
      direction = select(shear > 0., direction / select(shear > 0., shear, Number(1.)), Number(0.));
    response.volume_strain      = history.volume_strain + trace_d;
    response.work_increment     = trial.work_increment;
    response.plastic_multiplier = 0.;
    response.plastic_volume     = 0.;
    response.plastic_shear      = 0.;
    response.n_iterations       = 0.;

    const Number          n  = porosity_at(response.volume_strain);
    const Surface<Number> at = surface(strain, shear, n);
    response.volume_volume   = at.volume.slope + (1. - n) * at.volume.porosity_slope;
    response.volume_shear    = 0.;
    response.shear_volume    = 0.;
    response.shear_shear     = 2. * elastic.shear_modulus;
    response.secant_shear    = 2. * elastic.shear_modulus;
    response.work_coupling   = 0.;
    Number     pressure      = at.volume.pressure;
    Number     rho           = at.rho;
    const auto has_meaning   = at.A > 0. && at.B > 0. && strain >= largest_compression(*this, n);
    const auto yields        = response.valid && !(has_meaning && at.excess <= tolerance);
    if (any(yields))
      {
        Return<Number> result;
        const auto     found = return_to_surface(yields, strain, shear, n, result);
        set_plastic(found, result, strain, shear, n, response);
        pressure = select(found, result.surface.volume.pressure, pressure);
        rho      = select(found, result.surface.rho, rho);
        // a state that was returned to the surface may lie off it by round-off
        response.valid =
          response.valid && (!yields || found || (has_meaning && at.excess <= loose_tolerance));
      }
    for (int i = 0; i < 3; ++i)
      response.kirchhoff_stress[i] = pressure + rho * response.flow[i];
    return response;
  }

#define KEDGE_INSTANTIATE(Elasticity, Number)                                                      \
  template CriticalState<Elasticity>::Response<Number> CriticalState<Elasticity>::respond<Number>( \
    const Number(&)[3],                                                                            \
    const Number(&)[3],                                                                            \
    const HistoryOf<CriticalState<Elasticity>, Number> &) const;
  KEDGE_INSTANTIATE(Hencky, double)
  KEDGE_INSTANTIATE(Hencky, Pack)
  KEDGE_INSTANTIATE(ImprovedHencky, double)
  KEDGE_INSTANTIATE(ImprovedHencky, Pack)
#undef KEDGE_INSTANTIATE
  template CriticalState<Hencky>::Surface<double>
  CriticalState<Hencky>::surface(const double &, const double &, const double &) const;
  template CriticalState<ImprovedHencky>::Surface<double>
  CriticalState<ImprovedHencky>::surface(const double &, const double &, const double &) const;
  template class CriticalState<Hencky>;
  template class CriticalState<ImprovedHencky>;
} // namespace kedge
