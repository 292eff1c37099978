#include <kedge/base/exceptions.h>
#include <kedge/materials/initial_strain.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** How far beyond the yield surface counts as round-off of a stress on it. */
    constexpr double surface_tolerance = 1e-9;

    double
    volume_strain_at(const Hencky &law, const double pressure)
    {
      return pressure / law.bulk_modulus;
    }

    /** Of Modified Cam Clay, which bears no tension. */
    double
    volume_strain_at(const ModifiedCamClay &law, const double pressure)
    {
      if (!(pressure < 0.))
        {
          std::ostringstream message;
          message << "its mean stress of " << pressure
                  << " Pa is no compression, which modified_cam_clay cannot do without";
          throw UserError(message.str());
        }
      return -law.kappa * std::log(-pressure / law.reference_pressure);
    }

    double
    volume_strain_at(const ImprovedHencky &law, const double pressure)
    {
      const double closed = (1. - law.initial_porosity) / law.initial_porosity;
      const double square = 1. - 2. * closed * pressure / law.bulk_modulus;
      if (square < 0.)
        {
          std::ostringstream message;
          message << "its mean tension of " << pressure
                  << " Pa is beyond what the improved Hencky law can bear, "
                  << 0.5 * law.bulk_modulus / closed << " Pa";
          throw UserError(message.str());
        }
      return 2. * pressure / (law.bulk_modulus * (1. + std::sqrt(square)));
    }

    /** n_0, which Hencky's law does not ask for. */
    double
    porosity(const Hencky &)
    {
      return 1.;
    }

    double
    porosity(const ImprovedHencky &law)
    {
      return law.initial_porosity;
    }

    const Hencky &
    elasticity(const Hencky &law)
    {
      return law;
    }

    const ImprovedHencky &
    elasticity(const ImprovedHencky &law)
    {
      return law;
    }

    const Hencky &
    elasticity(const VonMises &law)
    {
      return law.elastic;
    }

    template <class Law>
    const Hencky &
    elasticity(const HenckyPlasticity<Law> &law)
    {
      return law.elastic;
    }

    const ModifiedCamClay &
    elasticity(const ModifiedCamClay &law)
    {
      return law;
    }

    template <class Elasticity>
    const Elasticity &
    elasticity(const CriticalState<Elasticity> &law)
    {
      return law.elastic;
    }

    /** The plastic part of the strain. */
    template <class Law>
    double
    returned(const Law &law, const HistoryOf<Law> &history, const double (&strain)[3])
    {
      const double nothing[3] = {0., 0., 0.};
      const auto   response   = law.respond(strain, nothing, history);
      if (!response.valid)
        return 1.;
      double size = 0., plastic = 0.;
      for (int i = 0; i < 3; ++i)
        {
          size += std::abs(strain[i]);
          plastic += std::abs(law.plastic_increment(response, i));
        }
      return plastic > 0. ? plastic / size : 0.;
    }

    /** How far beyond the yield surface, over its size [-]. */
    template <class Law>
    double
    excess(const Law            &law,
           const HistoryOf<Law> &history,
           const double (&strain)[3],
           const double,
           const double)
    {
      if constexpr (Law::yields)
        return returned(law, history, strain);
      else
        {
          (void)law;
          (void)history;
          (void)strain;
          return 0.;
        }
    }

    double
    excess(const VonMises                  &law,
           const VonMises::History<double> &history,
           const double (&)[3],
           const double,
           const double shear)
    {
      const double radius = law.radius(history);
      return 2. * law.elastic.shear_modulus * shear / radius - 1.;
    }

    template <class Elasticity>
    double
    excess(const CriticalState<Elasticity> &law,
           const HistoryOf<CriticalState<Elasticity>> &,
           const double (&)[3],
           const double volume_strain,
           const double shear)
    {
      const auto surface = law.surface(volume_strain, shear, porosity(law.elastic));
      return surface.A > 0. && surface.B > 0. ? surface.excess : 1.;
    }
  } // namespace



  namespace
  {
    /** Of soils of stiffness 1: what the moduli of the place are times those of the law. */
    template <class Law>
    double
    stiffness_of(const HistoryOf<Law> &history)
    {
      if constexpr (std::is_base_of_v<HenckyPlasticity<Law>, Law>)
        if constexpr (Law::stiffness_of_place)
          return history.stiffness;
      (void)history;
      return 1.;
    }

    /** What of the history follows from the stress at the start. */
    template <class Law>
    void
    follow_stress(const Law &, const std::array<double, 3> &, HistoryOf<Law> &)
    {}

    void
    follow_stress(const ModifiedCamClay            &law,
                  const std::array<double, 3>      &stress,
                  ModifiedCamClay::History<double> &history)
    {
      if (!law.preconsolidation_by_ratio)
        return;
      const double p      = -(stress[0] + stress[1] + stress[2]) / 3.;
      double       square = 0.;
      for (const double s : stress)
        square += 1.5 * (s + p) * (s + p);
      const double M = law.critical_state_ratio;
      history.preconsolidation_pressure *= p + square / (M * M * p);
    }

    /** The law's own return of an elastic strain, as a step without plastic past. */
    template <class Law>
    void
    return_to_surface(const Law &law,
                      const double (&strain)[3],
                      HistoryOf<Law> &history,
                      InitialState   &state)
    {
      const double nothing[3] = {0., 0., 0.};
      const auto   response   = law.respond(strain, nothing, history);
      if constexpr (Law::can_fail)
        if (!response.valid)
          throw UserError("it lies so far beyond the yield surface that there is no return to it");
      double size = 0., change = 0.;
      for (int i = 0; i < 3; ++i)
        {
          size   = std::max(size, std::abs(state.stress[i]));
          change = std::max(change, std::abs(response.kirchhoff_stress[i] - state.stress[i]));
          state.stress[i] = response.kirchhoff_stress[i];
          state.strain[i] -= law.plastic_increment(response, i);
        }
      state.returned = change / size;
      history        = law.updated(response, history);
    }

    template <class Law>
    InitialState
    state_of(const Law &law, const std::array<double, 3> &stress, HistoryOf<Law> history)
    {
      const auto  &elastic   = elasticity(law);
      const double stiffness = stiffness_of<Law>(history);
      const double pressure  = (stress[0] + stress[1] + stress[2]) / 3. / stiffness;
      const double volume    = volume_strain_at(elastic, pressure);
      follow_stress(law, stress, history);

      InitialState result;
      result.stress = stress;
      double square = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const double deviator = 0.5 * (stress[i] / stiffness - pressure) / elastic.shear_modulus;
          result.strain[i]      = deviator + volume / 3.;
          square += deviator * deviator;
        }
      const double values[3] = {result.strain[0], result.strain[1], result.strain[2]};
      if constexpr (Law::yields)
        if (excess(law, history, values, volume, std::sqrt(square)) > surface_tolerance)
          return_to_surface(law, values, history, result);
      result.history.assign(n_columns<Law>, 0.);
      write_history<Law>(history, result.history.data());
      return result;
    }
  } // namespace



  InitialState
  initial_state(const Material              &material,
                const std::array<double, 3> &stress,
                const std::vector<double>   &history)
  {
    return std::visit(
      [&](const auto &law) {
        using Law = std::decay_t<decltype(law)>;
        return state_of<Law>(law, stress, read_history<Law>(history.data()));
      },
      material);
  }



  std::array<double, 3>
  initial_elastic_strain(const Material              &material,
                         const std::array<double, 3> &stress,
                         const std::vector<double>   &history)
  {
    const InitialState state = initial_state(material, stress, history);
    if (state.returned > 0.)
      throw UserError("it lies beyond the yield surface");
    return state.strain;
  }
} // namespace kedge
