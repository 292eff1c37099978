#ifndef kedge_stress_soil_test_h
#define kedge_stress_soil_test_h

#include <kedge/stress/single_point.h>

namespace kedge
{
  /**
   * An element test of a soil: of each of the axes x, y, z either the strain
   * or the stress is prescribed in time; there is no shear between them. The
   * specimen may be consolidated first, drained and isotropic, to an effective
   * pressure; strains are prescribed from there.
   *
   * Drained, the pore pressure p stays 0. Undrained, the grains being
   * incompressible, the fluid in the pores keeps its mass,
   *   p = K_f ln((J_0 - 1 + n_0)/(J - 1 + n_0)),
   * J_0 the volume at the start of the test; without K_f the fluid is
   * incompressible too, J = J_0, and p is what the prescribed stresses need.
   * Prescribed stresses are total Cauchy stresses sigma = sigma' - p.
   */
  class SoilTest
  {
  public:
    /** @throws UserError for expressions that cannot be read. */
    SoilTest(const PathParameters                &parameters,
             const MaterialParameters            &material,
             const std::map<std::string, double> &constants);

    /** Consolidates the specimen. @return false if it cannot be. */
    bool
    consolidate();

    /** One step to the time @p t. @return false if there is no solution; the state is kept then. */
    bool
    advance_to(const double t);

    const SinglePoint::State &
    state() const
    {
      return point.state();
    }

    const SinglePoint &
    material_point() const
    {
      return point;
    }

    /** p, positive in compression [Pa] */
    double
    pore_pressure() const
    {
      return pore_pressure_n;
    }

  private:
    /** What is prescribed of an axis: strain ln(stretch) or total Cauchy stress [Pa]. */
    struct Target
    {
      bool   is_stress;
      double value;
    };

    /** Unknowns of a step: the strains of the axes and the pore pressure. */
    struct Trial
    {
      std::array<double, 3> strain;
      double                pore_pressure;
      PointUpdate<3>        update;
    };

    /** What the trial misses the targets by, over the stiffness; false if it has no stress. */
    bool
    evaluate(const std::array<Target, 3> &targets,
             Trial                       &trial,
             std::vector<double>         &residual) const;

    bool
    solve(const std::array<Target, 3> &targets);

    /** The unknowns among strains and pore pressure, in the order of the residual. */
    std::vector<double *>
    unknowns(const std::array<Target, 3> &targets, Trial &trial) const;

    const PathParameters    parameters;
    std::vector<Expression> expressions;
    const double            initial_porosity;
    const double            stiffness; ///< that stresses are compared with [Pa]
    SinglePoint             point;
    std::array<double, 3>   strain_n{}, consolidated_strain{};
    double                  pore_pressure_n = 0., closed_volume = 1.;
    bool                    undrained = false; ///< whether the taps are closed now
  };
} // namespace kedge

#endif
