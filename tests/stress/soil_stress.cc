// The stresses of a step for materials whose answer depends on the total
// volume strain, whose tangent is unsymmetric, and whose work has another
// slope than the stress: against differences of themselves.
#include "../materials/soils.h"
#include "random_states.h"

#include <kedge/materials/material.h>
#include <kedge/stress/force_stress.h>
#include <kedge/stress/point_update.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  /** A committed state and a step. */
  template <int dim, class Material>
  struct Step
  {
    StressState<dim>    state;
    HistoryOf<Material> history;
    double              energy; ///< elastic and frozen [J/m^3]
    double              A[dim][dim];
  };

  /** Constants of place of the laws that have them: s_u 20 kPa, c 10 kPa, p_c 100 kPa. */
  template <class Material>
  HistoryOf<Material>
  start_of(const double volume_strain)
  {
    MaterialParameters parameters;
    parameters.undrained_strength              = 2e4;
    parameters.cohesion                        = 1e4;
    parameters.start_preconsolidation_pressure = 1e5;
    const auto constants                       = Material::constants(parameters);
    double     values[most_law_columns]        = {};
    for (unsigned int c = 0; c < n_columns<Material>; ++c)
      values[c] = Material::columns[c].kind == ColumnKind::volume_strain ? volume_strain
                  : constants[c] != nullptr                              ? constants[c]->value
                                                                         : 0.;
    return read_history<Material>(values);
  }

  template <int dim, class Material>
  Step<dim, Material>
  random_step(const Material &material, RandomStates<dim> &random, const double size)
  {
    Step<dim, Material>          step;
    const dealii::Tensor<2, dim> V = random.rotation(), Q = random.rotation(),
                                 R = random.rotation();
    dealii::Tensor<2, dim> B, F;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        B[i][j] = V[i][j] * std::exp(random.uniform(-0.004, 0.001));
    for (int j = 0; j < dim; ++j) // columns of one length each
      {
        const double stretch = std::exp(random.uniform(-0.004, 0.001));
        for (int i = 0; i < dim; ++i)
          B[i][j] = V[i][j] * stretch;
        const double total = std::exp(random.uniform(-0.03, 0.01));
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            F[i][k] += Q[i][j] * total * R[k][j];
      }
    // a step of nothing puts the state on the surface if it lies outside
    double           none[dim][dim] = {};
    PointUpdate<dim> update;
    step.history = start_of<Material>(std::log(determinant(F)));
    step.state   = make_stress_state<dim>(B, 0.999, dealii::SymmetricTensor<2, dim>());
    EXPECT_TRUE(update_point<dim>(material, step.state, step.history, none, update));
    dealii::SymmetricTensor<2, dim> tau;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          B[i][j]   = update.elastic_frame[i][j];
          tau[i][j] = update.kirchhoff_stress[symmetric_index<dim>(i, j)];
        }
    step.state   = make_stress_state<dim>(B, 0.999 * update.out_of_plane_stretch_factor, tau);
    step.history = read_history<Material>(update.history);
    step.energy  = update.strain_energy + update.hardening_energy;
    random.step(size, step.A);
    return step;
  }

  template <int dim, StressRule rule, bool with_tangent, class Material>
  ForceStress<dim>
  evaluate(const Material &material, const Step<dim, Material> &step, const double alpha)
  {
    return evaluate_force_stress<dim, with_tangent, rule>(material,
                                                          step.state,
                                                          step.A,
                                                          alpha,
                                                          step.history);
  }

  /** Stiff soils that yield at strains of about 1e-3. */
  MaterialParameters
  yielding(const double dilation)
  {
    MaterialParameters parameters   = soil();
    parameters.remoulded_strength   = 0.3;
    parameters.softening_strain     = 0.5;
    parameters.friction_angle       = 30.;
    parameters.dilation_angle       = dilation;
    parameters.apex_rounding        = 0.1;
    parameters.tension_cut_off      = 0.8;
    parameters.swelling_slope       = 0.02;
    parameters.compression_slope    = 0.2;
    parameters.initial_void_ratio   = 1.;
    parameters.critical_state_ratio = 1.;
    parameters.reference_pressure   = 8e4;
    return parameters;
  }

  /** Calls check with each of the laws. */
  template <typename Check>
  void
  for_yielding_laws(const Check &check)
  {
    check(Tresca(yielding(0.)));
    check(UndrainedVonMises(yielding(0.)));
    for (const double dilation : {0., 10., 30.})
      {
        check(DruckerPrager(yielding(dilation)));
        check(MohrCoulomb(yielding(dilation)));
      }
    check(ModifiedCamClay(yielding(0.)));
  }

  /** Largest error of dP/dA against central differences with @p h, of the largest entry. */
  template <int dim, StressRule rule, class Material>
  double
  tangent_error(const Material     &material,
                Step<dim, Material> step,
                const double        alpha,
                const double        h)
  {
    const auto at    = evaluate<dim, rule, true>(material, step, alpha);
    double     error = 0., size = 0.;
    EXPECT_TRUE(at.valid);
    for (int m = 0; m < dim; ++m)
      for (int S = 0; S < dim; ++S)
        {
          step.A[m][S] += h;
          const auto up = evaluate<dim, rule, false>(material, step, alpha);
          step.A[m][S] -= 2. * h;
          const auto down = evaluate<dim, rule, false>(material, step, alpha);
          step.A[m][S] += h;
          for (int p = 0; p < dim; ++p)
            for (int R = 0; R < dim; ++R)
              {
                const double slope = (up.stress[p][R] - down.stress[p][R]) / (2. * h);
                error              = std::max(error, std::abs(slope - at.tangent[p][R][m][S]));
                size               = std::max(size, std::abs(slope));
              }
        }
    return error / size;
  }

  /**
   * Differences over h = 1e-7: (1e-7/3e-4)^2 of the CLC stress, which bends on the scale of
   * the step, and of round-off 1e-16/1e-7 of the strains of the surface, 4e-3. A yield
   * point or an edge of the surface within the difference shows as an error of order 1,
   * and no more if the difference is a tenth, whose round-off is ten times as large; a wrong
   * tangent is wrong at both.
   */
  template <int dim, StressRule rule, class Material>
  void
  expect_slope(const Material &material, const Step<dim, Material> &step, const double alpha)
  {
    if (tangent_error<dim, rule>(material, step, alpha, 1e-7) < 1e-6)
      return;
    EXPECT_LT((tangent_error<dim, rule>(material, step, alpha, 1e-8)), 1e-5);
  }

  template <int dim, class Material>
  void
  check_tangents(const Material &material)
  {
    RandomStates<dim> random(41 + dim);
    unsigned int      n_plastic = 0;
    for (const double size : {3e-3, 3e-4})
      for (int repeat = 0; repeat < 40; ++repeat)
        {
          const auto       step = random_step<dim>(material, random, size);
          PointUpdate<dim> update;
          ASSERT_TRUE(update_point<dim>(material, step.state, step.history, step.A, update));
          n_plastic += update.dissipation > 0.;
          expect_slope<dim, StressRule::at_configuration>(material, step, 1.);
          expect_slope<dim, StressRule::at_configuration>(material, step, 0.5);
          expect_slope<dim, StressRule::conserving>(material, step, 0.5);
        }
    if (Material::yields)
      {
        EXPECT_GT(n_plastic, 20u);
      }
  }

  /** The conserving stress works what is stored, frozen and dissipated. */
  template <int dim, class Material>
  void
  check_work(const Material &material)
  {
    RandomStates<dim> random(51 + dim);
    for (const double size : {1e-2, 1e-3, 1e-4, 1e-5})
      for (int repeat = 0; repeat < 20; ++repeat)
        {
          const auto step  = random_step<dim>(material, random, size);
          const auto force = evaluate<dim, StressRule::conserving, false>(material, step, 0.5);
          PointUpdate<dim> end;
          ASSERT_TRUE(force.valid);
          ASSERT_TRUE(update_point<dim>(material, step.state, step.history, step.A, end));
          EXPECT_GE(end.dissipation, 0.);
          double work = 0., scale = 0.;
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              {
                work += force.stress[i][j] * step.A[i][j];
                scale += std::abs(force.stress[i][j] * step.A[i][j]);
              }
          double stress = 0.;
          for (const double tau : step.state.kirchhoff_stress)
            stress = std::max(stress, std::abs(tau));
          // A few roundings of the terms; the energies at both ends are those of strains that
          // are known to the rounding of stretches, 1e-16.
          EXPECT_NEAR(work, force.work_increment, 1e-13 * scale);
          EXPECT_NEAR(work,
                      end.strain_energy + end.hardening_energy + end.dissipation - step.energy,
                      1e-13 * scale + 1e-15 * stress);
        }
  }
} // namespace

TEST(StressSoil, TangentsOfTheImprovedLaw)
{
  check_tangents<2>(ImprovedHencky(soil()));
  check_tangents<3>(ImprovedHencky(soil()));
}

TEST(StressSoil, TangentsOfCriticalStateOnTheOriginalLaw)
{
  check_tangents<2>(CriticalState<Hencky>(soil()));
  check_tangents<3>(CriticalState<Hencky>(soil()));
}

TEST(StressSoil, TangentsOfCriticalStateOnTheImprovedLaw)
{
  check_tangents<2>(CriticalState<ImprovedHencky>(soil()));
  check_tangents<3>(CriticalState<ImprovedHencky>(soil()));
}

TEST(StressSoil, TangentsOfLawsThatDissipateAllPlasticWorkOrHarden)
{
  for_yielding_laws([](const auto &law) {
    check_tangents<2>(law);
    check_tangents<3>(law);
  });
}

TEST(StressSoil, ConservingStressWorksWhatIsStoredAndDissipated)
{
  for_yielding_laws([](const auto &law) {
    check_work<2>(law);
    check_work<3>(law);
  });
  check_work<2>(ImprovedHencky(soil()));
  check_work<3>(ImprovedHencky(soil()));
  check_work<2>(CriticalState<Hencky>(soil()));
  check_work<3>(CriticalState<Hencky>(soil()));
  check_work<2>(CriticalState<ImprovedHencky>(soil()));
  check_work<3>(CriticalState<ImprovedHencky>(soil()));
}

TEST(StressSoil, AStepThatWouldCloseThePoresFails)
{
  RandomStates<3>      random(61);
  const ImprovedHencky material(soil());
  auto                 step = random_step<3>(material, random, 0.);
  for (int i = 0; i < 3; ++i)
    step.A[i][i] = -0.1; // det = 0.729 < 0.8 = 1 - n_0
  PointUpdate<3> update;
  EXPECT_FALSE((evaluate<3, StressRule::at_configuration, true>(material, step, 1.).valid));
  EXPECT_FALSE((evaluate<3, StressRule::conserving, true>(material, step, 0.5).valid));
  EXPECT_FALSE(update_point<3>(material, step.state, step.history, step.A, update));
}
