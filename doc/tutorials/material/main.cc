// Tests the law of exponentiated_hencky.h and shears a point of it; the page material.md, beside
// this folder, explains it. Writes shear.csv; the exit code says whether all is as it must be.
#include "exponentiated_hencky.h"

#include <kedge/stress/point_update.h>

#include <fstream>
#include <iostream>

namespace
{
  const double              K = 2e6, G = 1e6, k = 0.25, l = 0.5;
  const ExponentiatedHencky law(K, G, k, l);

  // The stress is the slope of the work, and the tangent that of the stress: largest relative
  // error of central differences.
  double
  error_of_slopes()
  {
    const double start[3] = {0.4, -0.1, 0.2}, step = 1e-5;
    const auto   at = [&](const int j, const double h) {
      double increment[3] = {0.05, 0.3, -0.2};
      increment[j] += h;
      return law.respond(start, increment);
    };
    double error = 0.;
    for (int j = 0; j < 3; ++j)
      {
        const auto   here = at(j, 0.), left = at(j, -step), right = at(j, step);
        const double stress = (right.work_increment - left.work_increment) / (2. * step);
        error               = std::max(error, std::abs(stress / here.kirchhoff_stress[j] - 1.));
        for (int i = 0; i < 3; ++i)
          {
            const double slope =
              (right.kirchhoff_stress[i] - left.kirchhoff_stress[i]) / (2. * step);
            error = std::max(error, std::abs(slope - law.tangent(here, i, j)) / (2. * G));
          }
      }
    return error;
  }

  // A point sheared in steps from @p shear_n to @p shear, as in a run: the new Kirchhoff stress.
  struct Point
  {
    dealii::Tensor<2, 3>          F, frame; // frame frame^T = b, the elastic left Cauchy-Green
    dealii::SymmetricTensor<2, 3> stress;
    double                        work = 0.;

    Point()
      : F(dealii::unit_symmetric_tensor<3>())
      , frame(dealii::unit_symmetric_tensor<3>())
    {}

    bool
    shear_by(const double increment)
    {
      double                A[3][3] = {{0., increment, 0.}, {0., 0., 0.}, {0., 0., 0.}};
      kedge::PointUpdate<3> update;
      const auto            state = kedge::make_stress_state<3>(frame, 1., stress);
      if (!kedge::update_point<3>(law, state, {}, A, update))
        return false;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            frame[i][j] = update.elastic_frame[i][j];
            if (i <= j)
              stress[i][j] = update.kirchhoff_stress[kedge::symmetric_index<3>(i, j)];
          }
      F[0][1] += increment;
      work = update.strain_energy;
      return true;
    }
  };
} // namespace



int
main()
{
  const double slopes = error_of_slopes();
  std::cout << "slopes of work and stress are off by " << slopes << "\n";

  // Simple shear by g: principal strains +-a, a = asinh(g/2), so that e:e = 2 a^2 and
  //   tau_xy = 2 G exp(2 k a^2) a/sqrt(1 + g^2/4).
  Point         point;
  std::ofstream table("shear.csv");
  table << "shear,a point of kedge,exponentiated Hencky in theory,Hencky's law\n0,0,0,0\n";
  const auto theory = [](const double g) {
    const double a = std::asinh(0.5 * g);
    return 2. * G * std::exp(2. * k * a * a) * a / std::sqrt(1. + 0.25 * g * g);
  };
  const int    n   = 40;
  const double end = 4.;
  for (int step = 1; step <= n; ++step)
    {
      if (!point.shear_by(end / n))
        return 1;
      const double g = point.F[0][1], a = std::asinh(0.5 * g);
      table << g << ',' << point.stress[0][1] << ',' << theory(g) << ','
            << 2. * G * a / std::sqrt(1. + 0.25 * g * g) << '\n';
    }
  std::cout << "shear stress at " << end << ": " << point.stress[0][1] << " Pa, in theory "
            << theory(end) << " Pa" << std::endl;
  return slopes < 1e-8 && std::abs(point.stress[0][1] / theory(end) - 1.) < 1e-12 ? 0 : 1;
}
