#ifndef kedge_equations_trial_h
#define kedge_equations_trial_h

#include <kedge/equations/unknowns.h>
#include <kedge/time_integration/scheme.h>

namespace kedge
{
  struct StepTimes
  {
    double t_n = 0.; ///< [s]
    double dt  = 0.; ///< [s]
  };

  /**
   * The state of the grid that a step tries. Nothing of it is committed; a
   * rejected step forgets it.
   */
  template <int dim>
  struct Trial
  {
    /** Of a field, dim values per local node, ghosts up to date; empty without inertia. */
    struct Motion
    {
      std::vector<double> velocity_n;     ///< v_n [m/s]
      std::vector<double> acceleration_n; ///< a_n [m/s^2]; zero where the scheme carries none
      std::vector<double> acceleration;   ///< a_m of the balance [m/s^2]
    };

    StepTimes           times;
    UnknownVector       unknowns; ///< displacements over the step [m], pressures at balance [Pa]
    std::vector<Motion> motion;   ///< one per field

    /** Displacement over the step of a field, dim values per local node [m]. */
    const std::vector<double> &
    displacement(const unsigned int field) const
    {
      return displacements[field].empty() ? unknowns.fields[field] : displacements[field];
    }

    /** Begins a step: all unknowns are 0, no field has motions yet. */
    void
    begin(const StepTimes                 &times,
          const Unknowns<dim>             &layout,
          const std::vector<unsigned int> &n_local_nodes);

    /** After a change of the unknowns: displacements and accelerations follow. */
    void
    follow(const Scheme &scheme);

    /** v_{n+1} of a field with motions [m/s]. */
    std::vector<double>
    end_velocity(const Scheme &scheme, const unsigned int field) const;

    /** a_{n+1} of a field with motions [m/s^2]. */
    std::vector<double>
    end_acceleration(const Scheme &scheme, const unsigned int field) const;

  private:
    std::vector<unsigned int>        n_components;
    std::vector<std::vector<double>> displacements; ///< empty where the unknowns are just that
  };
} // namespace kedge

#endif
