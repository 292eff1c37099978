#ifndef kedge_materials_pore_fluid_h
#define kedge_materials_pore_fluid_h

#include <cmath>

namespace kedge
{
  /** What is done when a skeleton loses its pores, n <= 0, which no real one can. */
  enum class PorosityWatch
  {
    warn,
    stop
  };

  /** The fluid in the pores of a saturated body and how it gets through them. */
  struct PoreFluidParameters
  {
    double        initial_porosity       = 0;     ///< n_0 = pores/volume at J = 1, in (0, 1) [-]
    double        fluid_density          = 0;     ///< rho_0 at pressure 0 [kg/m^3]
    double        fluid_bulk_modulus     = 0;     ///< K_f [Pa]
    double        hydraulic_conductivity = 0;     ///< kappa_0 at n_0 [m/s]
    bool          kozeny_carman          = false; ///< kappa follows the porosity, else constant
    double        reference_gravity      = 0;     ///< g that kappa is measured with [m/s^2]
    PorosityWatch porosity_watch         = PorosityWatch::warn;
  };

  /** Porosity n = 1 - (1 - n_0)/J of a skeleton of incompressible grains (4.89). */
  inline double
  porosity(const double initial_porosity, const double J)
  {
    return 1. - (1. - initial_porosity) / J;
  }

  /** dn/dJ = (1 - n)/J; by the volume strain ln J it is 1 - n (C.3). */
  inline double
  porosity_slope(const double initial_porosity, const double J)
  {
    return (1. - initial_porosity) / (J * J);
  }

  /**
   * A barotropic fluid in the pores and Darcy's flow of it. Pore pressure p
   * is positive in compression.
   */
  class PoreFluid
  {
  public:
    explicit PoreFluid(const PoreFluidParameters &parameters)
      : initial_porosity(parameters.initial_porosity)
      , reference_density(parameters.fluid_density)
      , bulk_modulus(parameters.fluid_bulk_modulus)
      , reference_conductivity(parameters.hydraulic_conductivity)
      , kozeny_carman(parameters.kozeny_carman)
      , reference_gravity(parameters.reference_gravity)
      , porosity_watch(parameters.porosity_watch)
    {}

    /** rho_f = rho_0 exp(p/K_f) [kg/m^3], (4.115). */
    double
    density(const double pressure) const
    {
      return reference_density * std::exp(pressure / bulk_modulus);
    }

    /** d rho_f/dp = rho_f/K_f [kg/m^3/Pa], (4.114). */
    double
    density_slope(const double pressure) const
    {
      return density(pressure) / bulk_modulus;
    }

    /**
     * Energy stored per mass of fluid, the integral of p/rho_f^2 over rho_f:
     * K_f/rho_0 (1 - (1 + x) exp(-x)), x = p/K_f [J/kg].
     */
    double
    energy(const double pressure) const
    {
      const double x = pressure / bulk_modulus;
      // where the closed form cancels, its series, cut at x^5/30
      const double value = std::abs(x) < 1e-3 ? x * x * (0.5 - x * (1. / 3. - 0.125 * x))
                                              : -std::expm1(-x) - x * std::exp(-x);
      return bulk_modulus / reference_density * value;
    }

    /**
     * rho_0 mu of the free enthalpy per mass mu (4.112), which a pressure at rest has:
     * K_f (1 - exp(-p/K_f)) [Pa].
     */
    double
    potential(const double pressure) const
    {
      return -bulk_modulus * std::expm1(-pressure / bulk_modulus);
    }

    /** Its slope by the pressure, rho_0/rho_f [-]. */
    double
    potential_slope(const double pressure) const
    {
      return std::exp(-pressure / bulk_modulus);
    }

    /** n(J), (4.89). */
    double
    porosity(const double J) const
    {
      return kedge::porosity(initial_porosity, J);
    }

    /** dn/dJ. */
    double
    porosity_slope(const double J) const
    {
      return kedge::porosity_slope(initial_porosity, J);
    }

    /**
     * Hydraulic conductivity kappa [m/s]: kappa_0, or after Kozeny and Carman
     * kappa = c_1 n^3/(1 - n)^2 (4.118) with kappa(n_0) = kappa_0; nothing
     * flows where there are no pores, n <= 0.
     */
    double
    conductivity(const double n) const
    {
      if (!kozeny_carman)
        return reference_conductivity;
      return n > 0. ? kozeny_carman_factor() * n * n * n / ((1. - n) * (1. - n)) : 0.;
    }

    /** d kappa/dn = c_1 n^2 (3 - n)/(1 - n)^3, (B.40) [m/s]. */
    double
    conductivity_slope(const double n) const
    {
      if (!kozeny_carman || !(n > 0.))
        return 0.;
      return kozeny_carman_factor() * n * n * (3. - n) / ((1. - n) * (1. - n) * (1. - n));
    }

    /**
     * kappa/g = rho_f k [s], which Darcy's law (4.117) multiplies by
     * -(grad p - rho_f (f - a)) to give the flux of mass [kg/m^2/s]. g is the
     * constant reference gravity, not the body force applied.
     */
    double
    mass_mobility(const double n) const
    {
      return conductivity(n) / reference_gravity;
    }

    /** d(kappa/g)/dn [s]. */
    double
    mass_mobility_slope(const double n) const
    {
      return conductivity_slope(n) / reference_gravity;
    }

    const double        initial_porosity;       ///< n_0 [-]
    const double        reference_density;      ///< rho_0 [kg/m^3]
    const double        bulk_modulus;           ///< K_f [Pa]
    const double        reference_conductivity; ///< kappa_0 [m/s]
    const bool          kozeny_carman;
    const double        reference_gravity; ///< g [m/s^2]
    const PorosityWatch porosity_watch;

  private:
    /** c_1 [m/s] */
    double
    kozeny_carman_factor() const
    {
      const double grains = 1. - initial_porosity;
      return reference_conductivity * grains * grains /
             (initial_porosity * initial_porosity * initial_porosity);
    }
  };
} // namespace kedge

#endif
