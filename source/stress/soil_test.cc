#include <kedge/stress/soil_test.h>

#include <deal.II/lac/full_matrix.h>

namespace kedge
{
  namespace
  {
    /** Steps of the pressure in which a specimen is consolidated. */
    constexpr unsigned int n_consolidation_steps = 20;
    constexpr unsigned int most_iterations       = 50;
    /** Of the strains (or the pore pressure over the stiffness): the correction that is the last.
     */
    constexpr double last_correction = 1e-12;
    /** Of the differences that make the tangent: compression, which soil without stress bears. */
    constexpr double difference = -1e-8;
  } // namespace



  SoilTest::SoilTest(const PathParameters                &parameters,
                     const MaterialParameters            &material,
                     const std::map<std::string, double> &constants)
    : parameters(parameters)
    , initial_porosity(material.initial_porosity)
    , stiffness(p_wave_modulus(make_material(material)))
    , point(material, parameters.initial_pressure)
  {
    for (const AxisControl &axis : parameters.control)
      expressions.emplace_back(axis.expression, std::vector<std::string>{"t"}, constants);
  }



  bool
  SoilTest::consolidate()
  {
    if (parameters.consolidation_pressure > 0.)
      for (unsigned int step = 1; step <= n_consolidation_steps; ++step)
        {
          const Target pressure{true,
                                -parameters.consolidation_pressure * step / n_consolidation_steps};
          if (!solve({{pressure, pressure, pressure}}))
            return false;
        }
    consolidated_strain = strain_n;
    closed_volume       = determinant(point.state().deformation_gradient);
    point.set_time_step(parameters.end / parameters.n_steps);
    undrained = parameters.undrained;
    return true;
  }



  bool
  SoilTest::advance_to(const double t)
  {
    std::array<Target, 3> targets;
    for (unsigned int i = 0; i < 3; ++i)
      {
        targets[i] = {parameters.control[i].is_stress, expressions[i]({t})};
        if (!targets[i].is_stress)
          targets[i].value += consolidated_strain[i];
      }
    return solve(targets);
  }



  bool
  SoilTest::evaluate(const std::array<Target, 3> &targets,
                     Trial                       &trial,
                     std::vector<double>         &residual) const
  {
    dealii::Tensor<2, 3> F;
    double               volume_strain = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        F[i][i] = std::exp(trial.strain[i]);
        volume_strain += trial.strain[i];
      }
    if (!point.evaluate(F, trial.update))
      return false;
    const double J     = std::exp(volume_strain);
    const double water = J - 1. + initial_porosity, water_0 = closed_volume - 1. + initial_porosity;
    const double K_f = parameters.fluid_bulk_modulus;
    if (undrained && K_f > 0.)
      {
        if (!(water > 0.))
          return false;
        trial.pore_pressure = K_f * std::log(water_0 / water);
      }
    residual.clear();
    for (unsigned int i = 0; i < 3; ++i)
      if (targets[i].is_stress)
        residual.push_back(
          (trial.update.kirchhoff_stress[i] / J - trial.pore_pressure - targets[i].value) /
          stiffness);
    if (undrained && !(K_f > 0.))
      residual.push_back(volume_strain - std::log(closed_volume));
    return true;
  }



  std::vector<double *>
  SoilTest::unknowns(const std::array<Target, 3> &targets, Trial &trial) const
  {
    std::vector<double *> result;
    for (unsigned int i = 0; i < 3; ++i)
      if (targets[i].is_stress)
        result.push_back(&trial.strain[i]);
    if (undrained && !(parameters.fluid_bulk_modulus > 0.))
      result.push_back(&trial.pore_pressure);
    return result;
  }



  bool
  SoilTest::solve(const std::array<Target, 3> &targets)
  {
    const bool is_pressure_unknown = undrained && !(parameters.fluid_bulk_modulus > 0.);
    Trial      trial{strain_n, pore_pressure_n, {}};
    for (unsigned int i = 0; i < 3; ++i)
      if (!targets[i].is_stress)
        trial.strain[i] = targets[i].value;
    std::vector<double> residual, other;
    if (!evaluate(targets, trial, residual))
      return false;

    const unsigned int n    = residual.size();
    const auto         unit = [&](const unsigned int k) {
      return is_pressure_unknown && k + 1 == n ? stiffness : 1.;
    };
    bool converged = n == 0;
    for (unsigned int iteration = 0; iteration < most_iterations && !converged; ++iteration)
      {
        dealii::FullMatrix<double> jacobian(n, n);
        for (unsigned int k = 0; k < n; ++k)
          {
            Trial moved = trial;
            *unknowns(targets, moved)[k] += difference * unit(k);
            if (!evaluate(targets, moved, other))
              return false;
            for (unsigned int i = 0; i < n; ++i)
              jacobian(i, k) = (other[i] - residual[i]) / difference;
          }
        jacobian.gauss_jordan();
        std::vector<double> correction(n, 0.);
        double              largest = 0.;
        for (unsigned int k = 0; k < n; ++k)
          {
            for (unsigned int i = 0; i < n; ++i)
              correction[k] -= jacobian(k, i) * residual[i];
            largest = std::max(largest, std::abs(correction[k]));
          }
        // halved where the material has no answer
        bool ok = false;
        for (double fraction = 1.; !ok && fraction > 1e-4; fraction *= 0.5)
          {
            Trial next = trial;
            for (unsigned int k = 0; k < n; ++k)
              *unknowns(targets, next)[k] += fraction * correction[k] * unit(k);
            ok = evaluate(targets, next, other);
            if (ok)
              {
                trial    = next;
                residual = other;
              }
          }
        if (!ok)
          return false;
        converged = largest < last_correction;
      }
    if (!converged)
      return false;
    point.accept(trial.update);
    strain_n        = trial.strain;
    pore_pressure_n = trial.pore_pressure;
    return true;
  }
} // namespace kedge
