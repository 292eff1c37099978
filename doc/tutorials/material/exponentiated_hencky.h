// A law of one's own: the exponentiated Hencky energy of Neff, Ghiba and Lankeit (J. Elasticity
// 121, 2015), an elastic solid that stiffens as it is strained,
//   Psi = G/k (exp(k e:e) - 1) + K/(2 l) (exp(l (tr eps)^2) - 1)   per reference volume [J/m^3],
//   tau_i = dPsi/deps_i = 2 G exp(k e:e) e_i + K exp(l (tr eps)^2) tr eps                [Pa],
// eps the logarithmic strain and e its deviator. For small strains it is Hencky's law.
#ifndef exponentiated_hencky_h
#define exponentiated_hencky_h

#include <kedge/materials/history.h>
#include <kedge/materials/parameters.h>

#include <cmath>

class ExponentiatedHencky
{
public:
  // What kedge asks a law at compile time; doc/architecture.md explains each.
  static constexpr bool yields               = false; // no plastic strains
  static constexpr bool can_fail             = false; // an answer to every strain
  static constexpr bool decoupled_volume     = false; // mean stress is not K tr eps
  static constexpr bool stress_is_work_slope = true;  // tau = d(work)/d(strain)
  static constexpr bool takes_packs          = false; // one point at a time: plain doubles

  // It answers by the elastic strain alone: no history.
  static constexpr std::array<kedge::Column, 0> columns{};
  template <typename Number>
  struct History
  {};
  static std::array<const kedge::SpatialConstant *, 0>
  constants(const kedge::MaterialParameters &)
  {
    return {};
  }

  // What it answers to a principal strain, and what the tangent needs of it.
  struct Response
  {
    double kirchhoff_stress[3]; // [Pa]
    double work_increment;      // Psi at the end less Psi at the start [J/m^3]
    double strain[3];           // at the end
  };

  ExponentiatedHencky(const double bulk_modulus,
                      const double shear_modulus,
                      const double shape_stiffening,
                      const double volume_stiffening)
    : K(bulk_modulus)
    , G(shear_modulus)
    , k(shape_stiffening)
    , l(volume_stiffening)
  {}

  // The work must be formed from the increment: the difference of two energies has no digits left
  // in small steps, and kedge's balance of energy would have none either. With x = e:e,
  //   exp(k x_1) - exp(k x_0) = exp(k x_0) expm1(k (x_1 - x_0)),  x_1 - x_0 = de:(2 e_0 + de).
  Response
  respond(const double (&strain_n)[3],
          const double (&increment)[3],
          const History<double> & = {}) const
  {
    Response     response;
    const double trace_n = strain_n[0] + strain_n[1] + strain_n[2];
    const double trace_d = increment[0] + increment[1] + increment[2];
    double       shape_n = 0., shape_d = 0.;
    for (int i = 0; i < 3; ++i)
      {
        const double e_n = strain_n[i] - trace_n / 3., de = increment[i] - trace_d / 3.;
        shape_n += e_n * e_n;
        shape_d += de * (2. * e_n + de);
        response.strain[i] = strain_n[i] + increment[i];
      }
    const double volume_n = trace_n * trace_n, volume_d = trace_d * (2. * trace_n + trace_d);
    response.work_increment = G / k * std::exp(k * shape_n) * std::expm1(k * shape_d) +
                              0.5 * K / l * std::exp(l * volume_n) * std::expm1(l * volume_d);
    const Parts part = parts(response.strain);
    for (int i = 0; i < 3; ++i)
      response.kirchhoff_stress[i] = part.shear * part.deviator[i] + part.bulk * part.trace;
    return response;
  }

  // dtau_i/deps_j = shear (delta_ij - 1/3 + 2 k e_i e_j) + bulk (1 + 2 l (tr eps)^2)
  double
  tangent(const Response &response, const int i, const int j) const
  {
    const Parts part = parts(response.strain);
    return part.shear *
             ((i == j ? 1. : 0.) - 1. / 3. + 2. * k * part.deviator[i] * part.deviator[j]) +
           part.bulk * (1. + 2. * l * part.trace * part.trace);
  }

  // (tau_i - tau_j)/(eps_i - eps_j): finite for equal strains, too
  double
  secant_shear(const Response &response, int, int) const
  {
    return parts(response.strain).shear;
  }

  double
  energy(const double (&strain)[3], const History<double> & = {}) const
  {
    const Parts part  = parts(strain);
    double      shape = 0.;
    for (const double e : part.deviator)
      shape += e * e;
    return G / k * std::expm1(k * shape) + 0.5 * K / l * std::expm1(l * part.trace * part.trace);
  }

  double
  p_wave_modulus() const
  {
    return K + 4. / 3. * G;
  }

private:
  struct Parts
  {
    double trace, deviator[3];
    double shear; // 2 G exp(k e:e)
    double bulk;  // K exp(l (tr eps)^2)
  };

  Parts
  parts(const double (&strain)[3]) const
  {
    Parts part;
    part.trace   = strain[0] + strain[1] + strain[2];
    double shape = 0.;
    for (int i = 0; i < 3; ++i)
      {
        part.deviator[i] = strain[i] - part.trace / 3.;
        shape += part.deviator[i] * part.deviator[i];
      }
    part.shear = 2. * G * std::exp(k * shape);
    part.bulk  = K * std::exp(l * part.trace * part.trace);
    return part;
  }

  double K, G, k, l;
};

#endif
