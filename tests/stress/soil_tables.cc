// Element tests of soils against tables of another program, which integrates the laws as ordinary
// differential equations to high order (Cam Clay undrained: by quadrature of its closed form).
// Backward Euler is compared in the limit of small steps: three numbers of steps, each twice the
// one before, are extrapolated by the first two powers of the step. Tolerance: two units of the
// last digit that the table prints.
#include <kedge/stress/single_point.h>
#include <kedge/stress/soil_test.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  /** Numbers by their names, after each of the strains asked for. */
  using Table = std::vector<std::map<std::string, double>>;

  /** A number as printed, and what its last digit stands for. */
  void
  expect_printed(const double value, const std::string &printed, const std::string &what)
  {
    const auto   point = printed.find('.');
    const double unit =
      point == std::string::npos ? 1. : std::pow(10., -double(printed.size() - point - 1));
    EXPECT_NEAR(value, std::stod(printed), 2. * unit) << what << ' ' << printed;
  }

  struct Expected
  {
    double                             at;
    std::map<std::string, std::string> printed;
  };

  /** @p run gives the Table for so many steps; all strains must be ends of steps. */
  template <typename Run>
  void
  expect_table(const Run &run, const unsigned int n_steps, const std::vector<Expected> &rows)
  {
    const Table coarse = run(n_steps), medium = run(2 * n_steps), fine = run(4 * n_steps);
    ASSERT_EQ(fine.size(), rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (const auto &[name, printed] : rows[r].printed)
        expect_printed((8. * fine[r].at(name) - 6. * medium[r].at(name) + coarse[r].at(name)) / 3.,
                       printed,
                       name + " at " + std::to_string(rows[r].at));
  }

  /** Calls @p look at the steps that end at the strains of the rows. */
  template <typename Look>
  void
  at_rows(const unsigned int           step,
          const unsigned int           n_steps,
          const double                 end,
          const std::vector<Expected> &rows,
          const Look                  &look)
  {
    for (const Expected &row : rows)
      if (std::lround(row.at / end * n_steps) == long(step))
        look();
  }

  // --- Undrained clay in simple shear

  Table
  simple_shear(const MaterialParameters    &parameters,
               const double                 end,
               const unsigned int           n_steps,
               const std::vector<Expected> &rows)
  {
    SinglePoint point(parameters);
    Table       table;
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        dealii::Tensor<2, 3> F = dealii::unit_symmetric_tensor<3>();
        F[0][1]                = end * step / n_steps;
        EXPECT_TRUE(point.deform_to(F));
        at_rows(step, n_steps, end, rows, [&]() {
          const auto &state = point.state();
          table.push_back(
            {{"tau_xy", state.kirchhoff_stress[0][1]},
             // without what rounding adds to the volume, times K
             {"tau_xx", 0.5 * (state.kirchhoff_stress[0][0] - state.kirchhoff_stress[1][1])},
             {"xi", point.column("plastic_shear_strain")},
             {"D", state.plastic_dissipation},
             {"W", state.plastic_dissipation + state.strain_energy}});
        });
      }
    return table;
  }

  MaterialParameters
  clay(const MaterialKind kind, const double remoulded)
  {
    const double       G = 1e6, K = 50. * G;
    MaterialParameters parameters;
    parameters.kind               = kind;
    parameters.young_modulus      = 9. * K * G / (3. * K + G);
    parameters.poisson_ratio      = (3. * K - 2. * G) / (6. * K + 2. * G);
    parameters.undrained_strength = 1e4;
    parameters.remoulded_strength = remoulded;
    parameters.softening_strain   = 10.;
    return parameters;
  }

  // --- Element tests

  struct Driven
  {
    MaterialParameters         material;
    double                     cell, end;
    std::array<AxisControl, 3> control;
    bool                       undrained = false;

    PathParameters
    path() const
    {
      PathParameters result;
      result.kind             = PathParameters::Kind::control;
      result.control          = control;
      result.initial_pressure = cell;
      result.undrained        = undrained;
      return result;
    }

    Table
    run(const unsigned int n_steps, const std::vector<Expected> &rows) const
    {
      SoilTest test(path(), material, {});
      EXPECT_TRUE(test.consolidate());
      const double start = test.state().strain_energy + test.state().hardening_energy;
      Table        table;
      for (unsigned int step = 1; step <= n_steps; ++step)
        {
          EXPECT_TRUE(test.advance_to(end * step / n_steps));
          at_rows(step, n_steps, end, rows, [&]() {
            const auto  &state  = test.state();
            const auto  &tau    = state.kirchhoff_stress;
            const auto   sigma  = state.cauchy_stress();
            const double stored = state.strain_energy + state.hardening_energy - start;
            table.push_back({{"s1", sigma[2][2]},
                             {"s3", sigma[1][1]},
                             {"eps_v", std::log(determinant(state.deformation_gradient))},
                             {"p", -trace(tau) / 3.},
                             {"q", tau[0][0] - tau[2][2]},
                             {"Cauchy q", sigma[0][0] - sigma[2][2]},
                             {"u", test.pore_pressure()},
                             {"D", state.plastic_dissipation},
                             {"W", state.plastic_dissipation + stored}});
          });
        }
      return table;
    }

    /** Elastic up to the strain, but for the last of its digits, and not beyond. */
    void
    expect_first_yield(const double strain, const double digit) const
    {
      for (const double side : {-1., 1.})
        {
          SoilTest test(path(), material, {});
          ASSERT_TRUE(test.consolidate());
          const double target = strain + side * digit;
          // a step for the way, elastic, and one to its end
          ASSERT_TRUE(test.advance_to(0.99 * target));
          EXPECT_EQ(test.state().plastic_dissipation, 0.);
          ASSERT_TRUE(test.advance_to(target));
          EXPECT_EQ(test.state().plastic_dissipation > 0., side > 0.) << strain;
        }
    }
  };

  Driven
  plane_strain(const double cohesion, const double dilation)
  {
    Driven result;
    result.material.kind           = MaterialKind::drucker_prager;
    result.material.young_modulus  = 20e6;
    result.material.poisson_ratio  = 0.25;
    result.material.cohesion       = cohesion;
    result.material.friction_angle = 30.;
    result.material.dilation_angle = dilation;
    result.cell                    = 100e3;
    result.end                     = 0.1;
    result.control                 = {{{true, "-100e3"}, {false, "0"}, {false, "-t"}}};
    return result;
  }

  Driven
  triaxial_of_cam_clay(const double ratio, const double end, const bool undrained)
  {
    Driven result;
    auto  &clay                          = result.material;
    clay.kind                            = MaterialKind::modified_cam_clay;
    clay.young_modulus                   = 2. * 5e6;
    clay.poisson_ratio                   = 0.;
    clay.swelling_slope                  = 0.02;
    clay.compression_slope               = 0.2;
    clay.initial_void_ratio              = 1.;
    clay.initial_porosity                = 0.5;
    clay.critical_state_ratio            = 1.;
    clay.reference_pressure              = 1e3;
    clay.start_preconsolidation_pressure = ratio;
    clay.preconsolidation_by_ratio       = true;
    result.cell                          = 1e5;
    result.end                           = end;
    result.control                       = {{{true, "-1e5"}, {true, "-1e5"}, {false, "-t"}}};
    result.undrained                     = undrained;
    return result;
  }

  void
  expect_element_test(const Driven                &driven,
                      const unsigned int           n_steps,
                      const std::vector<Expected> &rows)
  {
    expect_table(
      [&](const unsigned int n) {
        return driven.run(n, rows);
      },
      n_steps,
      rows);
  }
} // namespace

TEST(StressSoilTables, SofteningClayInSimpleShear)
{
  // tau_xx at .02: the table has 81.3646; of the flow's equations for the angle and the size of the
  // elastic strain, theta' = (coth(2 eta) cos 2 theta - 1)/2 and eta' = sin(2 theta)/2 - xi'/2 with
  // 2 G eta = s_u(xi), a Runge-Kutta integration has 81.35805 and the other numbers of the table
  const std::vector<Expected> small = {
    {.005, {{"tau_xy", "4999.98"}, {"tau_xx", "12.4999"}, {"D", "0"}}},
    {.01, {{"tau_xy", "9999.83"}, {"tau_xx", "49.9992"}, {"D", "0"}, {"W", "49.9996"}}},
    {.02,
     {{"tau_xy", "9977.15"},
      {"tau_xx", "81.3580"},
      {"xi", ".0100222"},
      {"D", "100.109"},
      {"W", "149.885"}}},
    {.1,
     {{"tau_xy", "9799.31"},
      {"tau_xx", "96.2390"},
      {"xi", ".0901962"},
      {"D", "892.892"},
      {"W", "940.909"}}}};
  const std::vector<Expected> large = {{.5,
                                        {{"tau_xy", "8972.39"},
                                         {"tau_xx", "80.6655"},
                                         {"xi", ".491006"},
                                         {"D", "4651.67"},
                                         {"W", "4691.93"}}},
                                       {1.,
                                        {{"tau_xy", "8069.41"},
                                         {"tau_xx", "65.2276"},
                                         {"xi", ".991890"},
                                         {"D", "8914.16"},
                                         {"W", "8946.72"}}},
                                       {5.,
                                        {{"tau_xy", "4175.59"},
                                         {"tau_xx", "17.4446"},
                                         {"xi", "4.99572"},
                                         {"D", "31903.9"},
                                         {"W", "31912.6"}}},
                                       {10.,
                                        {{"tau_xy", "2873.73"},
                                         {"tau_xx", "8.25929"},
                                         {"xi", "9.99699"},
                                         {"D", "48746.7"},
                                         {"W", "48750.8"}}}};
  for (const MaterialKind kind : {MaterialKind::tresca, MaterialKind::undrained_von_mises})
    {
      expect_table(
        [&](const unsigned int n) {
          return simple_shear(clay(kind, 0.25), 0.1, n, small);
        },
        2000,
        small);
      expect_table(
        [&](const unsigned int n) {
          return simple_shear(clay(kind, 0.25), 10., n, large);
        },
        10000,
        large);
    }
}

TEST(StressSoilTables, PerfectClayInSimpleShear)
{
  const std::vector<Expected> rows = {{1., {{"tau_xy", "9999.50"}, {"tau_xx", "99.9967"}}}};
  expect_table(
    [&](const unsigned int n) {
      return simple_shear(clay(MaterialKind::tresca, 1.), 1., n, rows);
    },
    1000,
    rows);
}

TEST(StressSoilTables, FasterClayInSimpleShear)
{
  // perfect: tau = R s_u, R = 1, 1.1, 1.3 at rates of 1, 10, 1000 times the reference
  for (const auto &[ratio, factor] : {std::pair{1., 1.}, {10., 1.1}, {1000., 1.3}})
    {
      MaterialParameters parameters = clay(MaterialKind::tresca, 1.);
      parameters.rate_coefficient   = 0.1;
      parameters.reference_rate     = 1e-4;
      SinglePoint  point(parameters);
      const double gamma = 0.5, rate = 1e-4 * ratio;
      const int    n_steps = 500;
      point.set_time_step(gamma / rate / n_steps);
      for (int step = 1; step <= n_steps; ++step)
        {
          dealii::Tensor<2, 3> F = dealii::unit_symmetric_tensor<3>();
          F[0][1]                = gamma * step / n_steps;
          ASSERT_TRUE(point.deform_to(F));
        }
      // shear radius sqrt(tau_xy^2 + tau_xx^2); the plastic rate is that of gamma but for (s_u/G)^2
      const auto &tau = point.state().kirchhoff_stress;
      EXPECT_NEAR(std::hypot(tau[0][1], tau[0][0]) / (1e4 * factor), 1., 2e-5);
    }
}

TEST(StressSoilTables, SandInPlaneStrainDilates)
{
  const Driven sand = plane_strain(0., 10.);
  expect_element_test(sand,
                      2000,
                      {{.005, {{"s1", "-207243"}, {"s3", "-126977"}, {"eps_v", "-.00331952"}}},
                       {.01, {{"s1", "-270111"}, {"s3", "-159922"}, {"eps_v", "-.00488257"}}},
                       {.02, {{"s1", "-293465"}, {"s3", "-200937"}, {"eps_v", "-.0029719"}}},
                       {.05, {{"s1", "-299779"}, {"s3", "-216727"}, {"eps_v", ".00861665"}}},
                       {.1,
                        {{"s1", "-299865"},
                         {"s3", "-216975"},
                         {"eps_v", ".0291685"},
                         {"D", "14065.6"},
                         {"W", "16039.3"}}}});
  sand.expect_first_yield(.0071853358, 1e-10);
}

TEST(StressSoilTables, SandInPlaneStrainKeepsItsVolume)
{
  const Driven sand = plane_strain(5e3, 0.);
  expect_element_test(sand,
                      2000,
                      {{.01, {{"s1", "-282859"}, {"s3", "-154390"}, {"eps_v", "-.00585282"}}},
                       {.02, {{"s1", "-306387"}, {"s3", "-188650"}, {"eps_v", "-.00726819"}}},
                       {.05, {{"s1", "-317032"}, {"s3", "-207878"}, {"eps_v", "-.00799828"}}},
                       {.1,
                        {{"s1", "-317458"},
                         {"s3", "-208726"},
                         {"eps_v", "-.0080294"},
                         {"D", "18993.4"},
                         {"W", "20953.3"}}}});
  sand.expect_first_yield(.0081164214, 1e-10);
}

TEST(StressSoilTables, SandInPlaneStrainFlowsAssociated)
{
  const Driven sand = plane_strain(5e3, 30.);
  expect_element_test(sand,
                      2000,
                      {{.01, {{"s1", "-284486"}, {"s3", "-170696"}, {"eps_v", "-.00420492"}}},
                       {.02, {{"s1", "-315549"}, {"s3", "-244864"}, {"eps_v", ".00715131"}}},
                       {.05, {{"s1", "-316253"}, {"s3", "-260809"}, {"eps_v", ".0629496"}}},
                       {.1,
                        {{"s1", "-314780"},
                         {"s3", "-259613"},
                         {"eps_v", ".157808"},
                         {"D", "1472.68"},
                         {"W", "4762.13"}}}});
  sand.expect_first_yield(.0076008327, 1e-10);
}

TEST(StressSoilTables, CamClayUndrained)
{
  expect_element_test(
    triaxial_of_cam_clay(1., 0.1, true),
    2000,
    {{.001, {{"p", "98092.3"}, {"q", "14427.2"}, {"u", "6716.76"}}},
     {.002, {{"p", "93475.9"}, {"q", "26080.4"}, {"u", "15217.6"}}},
     {.005, {{"p", "78713.1"}, {"q", "43447.8"}, {"u", "35769.5"}}},
     {.01, {{"p", "65655.9"}, {"q", "50686.4"}, {"u", "51239.6"}}},
     {.02, {{"p", "57031.2"}, {"q", "53082.5"}, {"u", "60662.9"}}},
     {.05,
      {{"p", "53704.2"}, {"q", "53575.7"}, {"u", "64154.3"}, {"W", "2504.05"}, {"D", "2549.50"}}},
     {.1, {{"p", "53589.1"}, {"q", "53588.6"}, {"u", "64273.8"}}}});
}

TEST(StressSoilTables, OverconsolidatedCamClayUndrained)
{
  const Driven clay = triaxial_of_cam_clay(1.5, 0.1, true);
  expect_element_test(
    clay,
    2000,
    {{.001, {{"q", "15000"}}},
     {.002, {{"q", "30000"}}},
     {.005, {{"p", "99110.5"}, {"q", "71122.8"}, {"u", "24597.1"}}},
     {.01, {{"p", "88504.4"}, {"q", "74993.3"}, {"u", "36493.4"}}},
     {.02, {{"p", "80588.5"}, {"q", "76727.7"}, {"u", "44987.4"}}},
     {.05,
      {{"p", "77305.3"}, {"q", "77175.9"}, {"u", "48420.0"}, {"W", "3627.47"}, {"D", "3460.03"}}},
     {.1, {{"p", "77189.4"}, {"q", "77188.9"}, {"u", "48540.2"}}}});
  clay.expect_first_yield(.004714045, 1e-9);
}

TEST(StressSoilTables, CamClayUndrainedFromItsCriticalState)
{
  // OCR 2 yields on the critical state: q = M p_0 from eps_a = p_0/(3 G) on
  const Driven clay = triaxial_of_cam_clay(2., 0.06, true);
  expect_element_test(clay,
                      900,
                      {{.006, {{"q", "90000"}}},
                       {.01, {{"q", "100000"}}},
                       {.06, {{"q", "100000"}}}});
  clay.expect_first_yield(1. / 150., 1e-9);
}

TEST(StressSoilTables, CamClayDrained)
{
  expect_element_test(
    triaxial_of_cam_clay(1., 0.2, false),
    2000,
    {{.005, {{"p", "105128"}, {"q", "17623.0"}, {"eps_v", "-.00749473"}, {"Cauchy q", "17755.5"}}},
     {.01, {{"p", "107845"}, {"q", "27470.5"}, {"eps_v", "-.0132100"}, {"Cauchy q", "27835.8"}}},
     {.02, {{"p", "111460"}, {"q", "40986.1"}, {"eps_v", "-.0222639"}, {"Cauchy q", "41908.8"}}},
     {.05, {{"p", "117977"}, {"q", "65991.7"}, {"eps_v", "-.0410324"}, {"Cauchy q", "68755.9"}}},
     {.1,
      {{"p", "124359"},
       {"q", "90576.4"},
       {"eps_v", "-.0601030"},
       {"Cauchy q", "96187.2"},
       {"W", "11952"},
       {"D", "7370.06"}}},
     {.2, {{"p", "131076"}, {"q", "116060"}, {"eps_v", "-.0791583"}, {"Cauchy q", "125621"}}}});
}

TEST(StressSoilTables, OverconsolidatedCamClayDrained)
{
  const Driven clay = triaxial_of_cam_clay(2., 0.2, false);
  expect_element_test(
    clay,
    2000,
    {{.005, {{"p", "121552"}, {"q", "65241.3"}, {"eps_v", "-.00195173"}}},
     {.01, {{"p", "131668"}, {"q", "96063.8"}, {"eps_v", "-.00353762"}, {"Cauchy q", "96404.3"}}},
     {.02, {{"p", "132664"}, {"q", "99875.6"}, {"eps_v", "-.00629374"}, {"Cauchy q", "100506"}}},
     {.05, {{"p", "135195"}, {"q", "109514"}, {"eps_v", "-.0131773"}, {"Cauchy q", "110966"}}},
     {.1,
      {{"p", "138262"},
       {"q", "121097"},
       {"eps_v", "-.0212563"},
       {"Cauchy q", "123699"},
       {"W", "12620.4"},
       {"D", "9754.33"}}},
     {.2, {{"p", "141725"}, {"q", "134038"}, {"eps_v", "-.0299931"}, {"Cauchy q", "138120"}}}});
  clay.expect_first_yield(.007239664, 1e-9);
}

TEST(StressSoilTables, CamClayDrainedEndsAtItsCriticalState)
{
  // the way there falls by a factor at a time: at a strain of 3 it is a millionth of what it was
  for (const auto &[ratio, p, eps_v] :
       {std::tuple{1., 136600.80, -.0935725}, {2., 144571.59, -.0368605}})
    {
      Driven                      clay = triaxial_of_cam_clay(ratio, 3., false);
      const std::vector<Expected> rows = {{3., {}}};
      const auto                  last = clay.run(6000, rows).back();
      EXPECT_NEAR(last.at("p") / p, 1., 1e-5);
      EXPECT_NEAR(last.at("q") / p, 1., 1e-5);
      EXPECT_NEAR(last.at("eps_v"), eps_v, 1e-6);
      EXPECT_NEAR(last.at("Cauchy q"), 150000., 2.);
    }
}
