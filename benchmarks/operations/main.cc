/**
 * What the kernels of an elastic material point do: floating point operations
 * and bytes per point, residual and tangent, and what this machine could do at
 * most on one core. Written as JSON for benchmarks/speed/run.py.
 */
#include "counted.h"

#include <kedge/base/pack.h>
#include <kedge/materials/hencky.h>
#include <kedge/stress/force_stress.h>
#include <kedge/fields/step_points.h>

#include <chrono>
#include <iostream>

namespace
{
  using namespace kedge;

  /** Operations of the stress of one point, strained by some percent, with and without tangent. */
  template <int dim, bool with_tangent>
  std::size_t
  stress_operations()
  {
    MaterialParameters parameters;
    parameters.young_modulus = 1e6;
    parameters.poisson_ratio = 0.3;
    const Hencky              material(parameters);
    StressState<dim, Counted> state{};
    Counted                   A[dim][dim];
    for (int i = 0; i < dim; ++i)
      {
        state.elastic_frame[i][i]          = 1.02 + 0.01 * i;
        state.squared_stretch[i]           = std::pow(1.02 + 0.01 * i, 2);
        state.strain[i]                    = std::log(1.02 + 0.01 * i);
        state.elastic_left_cauchy_green[i] = std::pow(1.02 + 0.01 * i, 2);
        for (int j = 0; j < dim; ++j)
          A[i][j] = 0.01 * (1 + i + 2 * j);
      }
    Counted::operations = 0;
    const auto stress =
      evaluate_force_stress<dim, with_tangent, StressRule::conserving>(material, state, A, 1.);
    return stress.valid ? Counted::operations : 0;
  }

  /**
   * Operations of a residual and of a tangent around the stress: basis and gradients,
   * dim^2 sums over n nodes, f_A = P dN_A/dx, K_AB = dN_A/dx D dN_B/dx in two steps
   * (solid/block_sum.h), n nodes per point.
   */
  template <int dim>
  void
  write_kernel(const std::string &name, const int n)
  {
    const int  basis = (dim + 1) * (dim - 1) * n, gradient = 2 * dim * dim * n;
    const int  force    = 2 * dim * dim * n + dim * dim;
    const int  columns  = dim * dim * (dim * n * (2 * dim - 1) + dim * dim);
    const int  rows     = dim * n * dim * n * (2 * dim - 1 + 1);
    const auto residual = basis + gradient + force + stress_operations<dim, false>();
    const auto tangent  = basis + gradient + columns + rows + stress_operations<dim, true>();
    // read once: basis, state, volume; a force and a matrix row are read and written
    const std::size_t point =
      sizeof(Stencil<dim>) + sizeof(StressState<dim>) + sizeof(double) + 8u * dim * n;
    std::cout << "    \"" << name << "\": {\"nodes\": " << n
              << ", \"residual_operations\": " << residual
              << ", \"tangent_operations\": " << tangent
              << ", \"residual_bytes\": " << point + 16u * dim * n
              << ", \"tangent_bytes\": " << point + 16u * dim * n * dim * n << "}";
  }

  double
  seconds_since(const std::chrono::steady_clock::time_point &begin)
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /** Multiplications and additions in registers alone [1/s]. */
  double
  peak_operations()
  {
    constexpr int n_chains = 12, n_rounds = 20000000;
    Pack          value[n_chains];
    const Pack    factor = 0.9999999, term = 1e-9;
    for (int k = 0; k < n_chains; ++k)
      value[k] = 1. + k;
    const auto begin = std::chrono::steady_clock::now();
    for (int round = 0; round < n_rounds; ++round)
      for (Pack &v : value)
        v = v * factor + term;
    const double time = seconds_since(begin);
    Pack         sum  = 0.;
    for (const Pack &v : value)
      sum += v;
    return sum[0] > 0. ? 2. * pack_width * n_chains * n_rounds / time : 0.;
  }

  /** Bytes of y += a x that move to and from memory, for arrays far larger than the caches [1/s].
   */
  double
  peak_bytes()
  {
    const std::size_t   n = 20000000;
    std::vector<double> x(n, 1.), y(n, 2.);
    const auto          begin    = std::chrono::steady_clock::now();
    const int           n_rounds = 5;
    for (int round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < n; ++i)
        y[i] += 0.5 * x[i];
    return n_rounds * 24. * n / seconds_since(begin);
  }
} // namespace

int
main()
{
  std::cout << "{\"lanes\": " << pack_width
            << ", \"peak_operations_per_second\": " << peak_operations()
            << ", \"peak_bytes_per_second\": " << peak_bytes() << ",\n \"kernels\": {\n";
  write_kernel<2>("2D linear", 4);
  std::cout << ",\n";
  write_kernel<2>("2D GIMP", 9);
  std::cout << ",\n";
  write_kernel<3>("3D linear", 8);
  std::cout << ",\n";
  write_kernel<3>("3D GIMP", 27);
  std::cout << "\n }}\n";
}
