// Internal forces of a cloud of points: values, and slopes by differences.
#ifndef kedge_tests_solid_force_checks_h
#define kedge_tests_solid_force_checks_h

#include "../transfer/cloud.h"

#include <kedge/solid/internal_force.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

namespace kedge::test
{
  template <int dim>
  std::vector<double>
  force_at(const Cloud<dim>          &cloud,
           const InternalForce<dim>  &internal,
           const std::vector<double> &u)
  {
    std::vector<double> force(u.size(), 0.);
    EXPECT_TRUE(internal.add_force(cloud.patch, u, force).ok());
    return force;
  }

  inline double
  norm(const std::vector<double> &x)
  {
    double sum = 0.;
    for (const double entry : x)
      sum += entry * entry;
    return std::sqrt(sum);
  }

  /** dforce/du as a full matrix. */
  template <int dim>
  dealii::FullMatrix<double>
  stiffness_at(const Cloud<dim>          &cloud,
               const InternalForce<dim>  &internal,
               const std::vector<double> &u,
               const int                  radius)
  {
    NodeMatrix<dim> stiffness;
    stiffness.reinit(cloud.nodes.n_local(), dim, radius);
    stiffness.set_zero();
    internal.add_stiffness(cloud.patch, u, stiffness);
    const std::vector<int>     strides = stiffness.slot_strides(cloud.window());
    dealii::FullMatrix<double> full(u.size(), u.size());
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      for (unsigned int j = 0; j < cloud.nodes.n_local(); ++j)
        for (unsigned int s = 0; s < stiffness.n_slots(); ++s)
          if (static_cast<int>(cloud.nodes.window_node(i)) + strides[s] ==
              static_cast<int>(cloud.nodes.window_node(j)))
            for (int p = 0; p < dim; ++p)
              for (int m = 0; m < dim; ++m)
                full(i * dim + p, j * dim + m) = stiffness.row(i, p)[s * dim + m];
    return full;
  }

  /** Column by column: dforce/du_j by central differences against the matrix. */
  template <int dim>
  void
  check_stiffness(const Cloud<dim> &cloud, const InternalForce<dim> &internal, const int radius)
  {
    const std::vector<double> u         = cloud.random_nodal(0.03, 1);
    const auto                stiffness = stiffness_at(cloud, internal, u, radius);
    const double              h         = 1e-5;
    double                    largest = 0., largest_error = 0.;
    for (unsigned int j = 0; j < u.size(); ++j)
      {
        std::vector<double> plus = u, minus = u;
        plus[j] += h;
        minus[j] -= h;
        const auto f_plus  = force_at(cloud, internal, plus),
                   f_minus = force_at(cloud, internal, minus);
        for (unsigned int i = 0; i < u.size(); ++i)
          {
            largest = std::max(largest, std::abs(stiffness(i, j)));
            largest_error =
              std::max(largest_error,
                       std::abs(stiffness(i, j) - (f_plus[i] - f_minus[i]) / (2. * h)));
          }
      }
    // differences: round-off 1e-16/h and curvature h^2 of O(1) stresses both give 1e-10
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(largest_error, 1e-8 * largest);
  }

  /** No resulting force, and no torque about the middle of the step. */
  template <int dim>
  void
  check_balance(const Cloud<dim>          &cloud,
                const std::vector<double> &u,
                const std::vector<double> &force)
  {
    const double scale    = norm(force);
    double       sum[dim] = {}, moment[dim][dim] = {};
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      {
        const auto x = cloud.node_position(i);
        for (int d = 0; d < dim; ++d)
          {
            sum[d] += force[i * dim + d];
            for (int e = 0; e < dim; ++e)
              moment[d][e] += (x[d] + 0.5 * u[i * dim + d]) * force[i * dim + e] -
                              (x[e] + 0.5 * u[i * dim + e]) * force[i * dim + d];
          }
      }
    // round-off of some hundred terms of size 1e-16 |f|; lever arms are below 5 m
    for (int d = 0; d < dim; ++d)
      {
        EXPECT_NEAR(sum[d], 0., 1e-14 * scale);
        for (int e = 0; e < dim; ++e)
          EXPECT_NEAR(moment[d][e], 0., 1e-13 * scale);
      }
  }

  inline double
  dot(const std::vector<double> &x, const std::vector<double> &y)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += x[i] * y[i];
    return sum;
  }
} // namespace kedge::test

#endif
