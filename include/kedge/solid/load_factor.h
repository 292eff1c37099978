#ifndef kedge_solid_load_factor_h
#define kedge_solid_load_factor_h

#include <kedge/equations/tangent.h>
#include <kedge/equations/trial.h>
#include <kedge/equations/unknowns.h>
#include <kedge/time_integration/scheme.h>

namespace kedge
{
  /** The load factor l that loads follow where it is found and not given by the time. */
  template <int dim>
  class LoadFactor
  {
  public:
    virtual ~LoadFactor() = default;
    /** l of the last step, or at the start. */
    virtual double
    at_start() const = 0;
    /** l of a trial, at the time of the balance. */
    virtual double
    at_balance(const Trial<dim> &trial) const = 0;
  };

  /** Loads that are taken at the time t, or at a load factor l in its place. */
  template <int dim>
  class ControlledLoads
  {
  public:
    explicit ControlledLoads(const Scheme &scheme)
      : load_scheme(scheme)
    {}

    virtual ~ControlledLoads() = default;

    /** From now on the forces follow a load factor, which must last as long as this. */
    void
    follow(const LoadFactor<dim> &factor)
    {
      load_factor = &factor;
    }

    /** |df_ext/dl|^2 of a trial at the owned nodes [N^2; N^2/m^2 in 2D] (collective). */
    virtual double
    square_of_slope(const Trial<dim> &trial) const = 0;

    /** Adds the column -s df_ext/dl of an unknown with l = l_n + s x (collective). */
    virtual void
    add_slope(const Trial<dim>   &trial,
              const double        s,
              const UnknownIndex &x,
              Tangent<dim>       &tangent) const = 0;

  protected:
    /** t or l at which the balance has its loads. */
    double
    balance_time(const Trial<dim> &trial) const
    {
      return load_factor != nullptr ? load_factor->at_balance(trial)
                                    : load_scheme.load_time(trial.times.t_n, trial.times.dt);
    }

    /** t or l at which they are as they work: in the middle of the step. */
    double
    middle_time(const Trial<dim> &trial) const
    {
      if (load_factor == nullptr)
        return trial.times.t_n + 0.5 * trial.times.dt;
      const double start = load_factor->at_start();
      return start + 0.5 / load_scheme.load_time(0., 1.) * (load_factor->at_balance(trial) - start);
    }

    bool
    is_controlled() const
    {
      return load_factor != nullptr;
    }

    /** Difference of load factors for the loads' derivative: linear loads have it to round-off,
     * others to 1e-8. */
    static double
    small_difference(const double l)
    {
      constexpr double small = 1e-4;
      return small * std::max(1., std::abs(l));
    }

  private:
    const Scheme           load_scheme;
    const LoadFactor<dim> *load_factor = nullptr;
  };
} // namespace kedge

#endif
