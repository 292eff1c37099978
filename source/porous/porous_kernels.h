#ifndef kedge_porous_porous_kernels_h
#define kedge_porous_porous_kernels_h

#include <kedge/porous/pore_response.h>
#include <kedge/porous/porous_force.h>

namespace kedge
{
  namespace internal
  {
    /** What the kernels of one batch share. */
    template <int dim, class Material>
    struct PorousBatch
    {
      const StepPoints<dim>                 &points;
      const PorePoints<dim>                 &pores;
      const LatticeWindow<dim>              &window;
      const ActiveNodes<dim>                &nodes;
      const PorousTrial<dim>                &trial;
      const typename StepPoints<dim>::Batch &batch;
      const PoreStep<dim>                   &step;
      const Material                        &material;
    };

    /** N^0_A of (4.138), (4.140): the share of a point in the cells around A, over 2^dim. */
    template <int dim, unsigned int pattern>
    inline void
    expand_constants(const Stencil<dim> &stencil, double (&constant)[stencil_size<dim>(pattern)])
    {
      double factor[3][3] = {{1., 0., 0.}, {1., 0., 0.}, {1., 0., 0.}};
      for (int d = 0; d < dim; ++d)
        {
          factor[d][0] = factor[d][1] = 0.5;
          if (stencil_width(pattern, d) == 3)
            {
              // the slopes of the outer nodes are the shares of the two cells
              const double *slope = stencil.slope[d];
              factor[d][2]        = 0.5 * slope[2] / (slope[2] - slope[0]);
              factor[d][0]        = 0.5 - factor[d][2];
            }
        }
      int A = 0;
      for (int k = 0; k < (dim == 3 ? stencil_width(pattern, 2) : 1); ++k)
        for (int j = 0; j < stencil_width(pattern, 1); ++j)
          for (int i = 0; i < stencil_width(pattern, 0); ++i)
            constant[A++] = factor[0][i] * factor[1][j] * factor[2][k];
    }

    /** Local node numbers and nodal values, component-major, of a stencil. */
    template <int dim, int n>
    struct StencilTrial
    {
      std::array<int, n> local;
      double             unknown[dim + 1][n];
      double             acceleration[dim][n] = {};

      void
      read(const ActiveNodes<dim>            &nodes,
           const PorousTrial<dim>            &trial,
           const std::array<unsigned int, n> &offsets,
           const unsigned int                 first_node)
      {
        for (int A = 0; A < n; ++A)
          {
            local[A]        = nodes.local(first_node + offsets[A]);
            const double *x = &trial.unknowns[std::size_t(local[A]) * (dim + 1)];
            for (int c = 0; c <= dim; ++c)
              unknown[c][A] = x[c];
            for (int d = 0; d < dim && !trial.acceleration.empty(); ++d)
              acceleration[d][A] = trial.acceleration[std::size_t(local[A]) * dim + d];
          }
      }
    };

    /** Basis of a point with the functions (N - N^0) of the stabilisation. */
    template <int dim, unsigned int pattern>
    struct PorousBasis
    {
      static constexpr int n = stencil_size<dim>(pattern);

      explicit PorousBasis(const Stencil<dim> &stencil)
        : linear(expand<dim, pattern>(stencil))
      {
        expand_constants<dim, pattern>(stencil, fluctuation);
        for (int A = 0; A < n; ++A)
          fluctuation[A] = linear.value[A] - fluctuation[A];
      }

      BasisValues<dim, n> linear;
      double              fluctuation[n];
    };

    template <int dim, unsigned int pattern, class Material>
    inline PoreTrial<dim>
    trial_at_point(const PorousBatch<dim, Material>                    &b,
                   const unsigned int                                   slot,
                   const StencilTrial<dim, stencil_size<dim>(pattern)> &x,
                   const PorousBasis<dim, pattern>                     &basis)
    {
      constexpr int  n = stencil_size<dim>(pattern);
      PoreTrial<dim> t;
      const auto     sum = [](const double(&values)[n], const double(&weights)[n]) {
        double result = 0.;
        for (int A = 0; A < n; ++A)
          result += values[A] * weights[A];
        return result;
      };
      t.volume        = b.points.volume[slot];
      t.determinant   = b.points.determinant[slot];
      t.pressure_n    = b.pores.pressure[slot];
      t.fluctuation_n = b.pores.fluctuation[slot];
      t.known_rate =
        b.pores.rate.empty()
          ? 0.
          : b.step.scheme.known_rate(b.pores.rate[slot], b.pores.rate_change[slot], b.step.dt);
      for (int j = 0; j < dim; ++j)
        {
          for (int i = 0; i < dim; ++i)
            t.displacement[i][j] = sum(x.unknown[i], basis.linear.gradient[j]);
          t.pressure_gradient[j] = sum(x.unknown[dim], basis.linear.gradient[j]);
          t.acceleration[j]      = sum(x.acceleration[j], basis.linear.value);
        }
      t.pressure    = sum(x.unknown[dim], basis.linear.value);
      t.fluctuation = sum(x.unknown[dim], basis.fluctuation);
      return t;
    }

    /** Calls visit(slot, trial, basis) for the points of a batch until it is false, begin() and
     * end(local nodes) around those with the same nodes. */
    template <int dim, unsigned int pattern, class Material, class Begin, class Visit, class End>
    inline void
    for_points_of_batch(const PorousBatch<dim, Material> &b,
                        const Begin                      &begin,
                        const Visit                      &visit,
                        const End                        &end)
    {
      constexpr int        n       = stencil_size<dim>(pattern);
      const auto           offsets = node_offsets<dim, pattern>(b.window.node_strides());
      StencilTrial<dim, n> x;
      for (unsigned int slot = b.batch.begin; slot < b.batch.end;)
        {
          const unsigned int first = b.points.stencil[slot].first_node;
          x.read(b.nodes, b.trial, offsets, first);
          begin();
          for (; slot < b.batch.end && b.points.stencil[slot].first_node == first; ++slot)
            {
              const PorousBasis<dim, pattern> basis(b.points.stencil[slot]);
              if (!visit(slot, trial_at_point<dim, pattern>(b, slot, x, basis), basis))
                return;
            }
          end(x.local);
        }
    }

    template <bool with_tangent, int dim, class Material>
    inline PoreResponse<dim>
    respond(const PorousBatch<dim, Material> &b,
            const unsigned int                slot,
            const PoreTrial<dim>             &trial)
    {
      return evaluate_pore_response<dim, with_tangent>(b.material,
                                                       b.points.stress_state[slot],
                                                       b.points.template history_of<Material>(slot),
                                                       b.step,
                                                       trial);
    }

    /** The residuals of a batch. */
    template <int dim, class Material>
    struct PorousResidualKernel
    {
      const PorousBatch<dim, Material> &b;
      std::vector<double>              &residual;
      PorousSize                       &size;
      PointStatus                      &status;

      /** Adds the terms of a point as they would cancel among cells, gradients being 2/h. */
      void
      add_size(const PoreTrial<dim> &trial, const PoreResponse<dim> &r, double (&terms)[2]) const
      {
        double stress = 0., force = 0., strain = 0., flow = 0.;
        for (int i = 0; i < dim; ++i)
          {
            force += std::abs(trial.acceleration[i]) + std::abs(b.step.acceleration[i]);
            flow += std::abs(r.fluid_gradient[i]);
            for (int R = 0; R < dim; ++R)
              {
                stress += std::abs(r.momentum_gradient[i][R]);
                strain += std::abs(trial.displacement[i][R]);
              }
          }
        terms[0] += 2. * b.step.inverse_length * stress + r.mass * force;
        terms[1] +=
          2. * b.step.inverse_length * flow + trial.volume * strain + std::abs(r.fluid_value) +
          r.pp_fluctuation * (std::abs(trial.fluctuation) + std::abs(trial.fluctuation_n));
      }

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int n = stencil_size<dim>(pattern);
        double        sum[dim + 1][n], terms[2];
        for_points_of_batch<dim, pattern>(
          b,
          [&]() {
            std::fill_n(&sum[0][0], (dim + 1) * n, 0.);
            terms[0] = terms[1] = 0.;
          },
          [&](const unsigned int slot, const PoreTrial<dim> &trial, const auto &basis) {
            const PoreResponse<dim> r = respond<false>(b, slot, trial);
            if (!r.valid)
              {
                status.failed_slot = slot;
                return false;
              }
            add_size(trial, r, terms);
            const auto &N = basis.linear.value;
            for (int i = 0; i < dim; ++i)
              for (int A = 0; A < n; ++A)
                {
                  double add = r.momentum_value[i] * N[A];
                  for (int R = 0; R < dim; ++R)
                    add += r.momentum_gradient[i][R] * basis.linear.gradient[R][A];
                  sum[i][A] += add;
                }
            for (int A = 0; A < n; ++A)
              {
                double add = r.fluid_value * N[A] + r.fluid_fluctuation * basis.fluctuation[A];
                for (int R = 0; R < dim; ++R)
                  add += r.fluid_gradient[R] * basis.linear.gradient[R][A];
                sum[dim][A] += add;
              }
            return true;
          },
          [&](const std::array<int, n> &local) {
            size.momentum += terms[0] * terms[0];
            size.fluid += terms[1] * terms[1];
            for (int A = 0; A < n; ++A)
              for (int c = 0; c <= dim; ++c)
                residual[std::size_t(local[A]) * (dim + 1) + c] += sum[c][A];
          });
      }
    };

    /** The Jacobian of a batch. */
    template <int dim, class Material>
    struct PorousTangentKernel
    {
      const PorousBatch<dim, Material> &b;
      NodeMatrix<dim>                  &tangent;

      template <int n>
      struct Sum
      {
        double value[n][dim + 1][dim + 1][n]; ///< [A][row][column][B]
      };

      /** entry_B += gradient_S dN_B/dx_S + value N_B. */
      template <int n>
      static void
      add_row(const double (&gradient)[dim],
              const double               value,
              const BasisValues<dim, n> &basis,
              double (&entry)[n])
      {
        for (int B = 0; B < n; ++B)
          {
            double add = value * basis.value[B];
            for (int S = 0; S < dim; ++S)
              add += gradient[S] * basis.gradient[S][B];
            entry[B] += add;
          }
      }

      template <int n>
      static void
      add_momentum(const PoreResponse<dim>   &r,
                   const BasisValues<dim, n> &basis,
                   const int                  A,
                   Sum<n>                    &sum)
      {
        const double N = basis.value[A];
        for (int i = 0; i < dim; ++i)
          {
            for (int m = 0; m < dim; ++m)
              {
                double factor[dim];
                for (int S = 0; S < dim; ++S)
                  {
                    factor[S] = N * r.uu_value[i][m][S];
                    for (int R = 0; R < dim; ++R)
                      factor[S] += basis.gradient[R][A] * r.uu[i][R][m][S];
                  }
                add_row<n>(factor, i == m ? r.mass_inertia * N : 0., basis, sum.value[A][i][m]);
              }
            double value = N * r.up_value[i];
            for (int R = 0; R < dim; ++R)
              value += basis.gradient[R][A] * r.up[i][R];
            for (int B = 0; B < n; ++B)
              sum.value[A][i][dim][B] += value * basis.value[B];
          }
      }

      template <int n>
      static void
      add_fluid(const PoreResponse<dim>   &r,
                const BasisValues<dim, n> &basis,
                const double (&fluctuation)[n],
                const int A,
                Sum<n>   &sum)
      {
        const double N = basis.value[A];
        for (int m = 0; m < dim; ++m)
          {
            double factor[dim], value = 0.;
            for (int R = 0; R < dim; ++R)
              value += basis.gradient[R][A] * r.pu_inertia[R][m];
            for (int S = 0; S < dim; ++S)
              {
                factor[S] = N * r.pu_value[m][S];
                for (int R = 0; R < dim; ++R)
                  factor[S] += basis.gradient[R][A] * r.pu[R][m][S];
              }
            add_row<n>(factor, value, basis, sum.value[A][dim][m]);
          }
        double factor[dim], value = N * r.pp_value;
        for (int R = 0; R < dim; ++R)
          value += basis.gradient[R][A] * r.pp_weight[R];
        for (int S = 0; S < dim; ++S)
          {
            factor[S] = 0.;
            for (int R = 0; R < dim; ++R)
              factor[S] += basis.gradient[R][A] * r.pp[R][S];
          }
        add_row<n>(factor, value, basis, sum.value[A][dim][dim]);
        const double stabilisation = r.pp_fluctuation * fluctuation[A];
        for (int B = 0; B < n; ++B)
          sum.value[A][dim][dim][B] += stabilisation * fluctuation[B];
      }

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int n     = stencil_size<dim>(pattern);
        const auto    slots = pair_slots<dim, pattern>(tangent);
        Sum<n>        sum;
        for_points_of_batch<dim, pattern>(
          b,
          [&]() {
            std::fill_n(&sum.value[0][0][0][0], n * (dim + 1) * (dim + 1) * n, 0.);
          },
          [&](const unsigned int slot, const PoreTrial<dim> &trial, const auto &basis) {
            const PoreResponse<dim> r = respond<true>(b, slot, trial);
            for (int A = 0; A < n; ++A)
              {
                add_momentum<n>(r, basis.linear, A, sum);
                add_fluid<n>(r, basis.linear, basis.fluctuation, A, sum);
              }
            return true;
          },
          [&](const std::array<int, n> &local) {
            for (int A = 0; A < n; ++A)
              for (int c = 0; c <= dim; ++c)
                {
                  double *row = tangent.row(local[A], c);
                  for (int B = 0; B < n; ++B)
                    for (int m = 0; m <= dim; ++m)
                      row[slots[A][B] * (dim + 1) + m] += sum.value[A][c][m][B];
                }
          });
      }
    };

    /** (N - N^0) p at the points of a batch. */
    template <int dim>
    struct FluctuationKernel
    {
      const StepPoints<dim>                 &points;
      const LatticeWindow<dim>              &window;
      const ActiveNodes<dim>                &nodes;
      const std::vector<double>             &nodal_pressure;
      const typename StepPoints<dim>::Batch &batch;
      std::vector<double>                   &result;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(window.node_strides());
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const Stencil<dim>             &stencil = points.stencil[slot];
            const PorousBasis<dim, pattern> basis(stencil);
            result[slot] = 0.;
            for (int A = 0; A < basis.n; ++A)
              result[slot] +=
                basis.fluctuation[A] * nodal_pressure[nodes.local(stencil.first_node + offsets[A])];
          }
      }
    };

    /** The pores at the end of a step. */
    template <int dim, class Material>
    struct PoreUpdateKernel
    {
      const PorousBatch<dim, Material> &b;
      std::vector<PoreUpdate<dim>>     &updates;

      void
      set(const unsigned int slot, const PoreTrial<dim> &trial, const PoreResponse<dim> &r) const
      {
        const PoreStep<dim> &step   = b.step;
        const PoreFluid     &fluid  = step.soil.fluid;
        PoreUpdate<dim>     &update = updates[slot];
        double               unused[dim][dim];
        const double         J = trial.determinant * (1. + invert<dim>(trial.displacement, unused));
        const double         grains = 1. - fluid.initial_porosity;
        update.pressure             = r.end_pressure;
        update.fluctuation =
          trial.fluctuation_n + (trial.fluctuation - trial.fluctuation_n) / step.scheme.theta;
        update.porosity     = fluid.porosity(J);
        update.mass         = trial.volume * (step.soil.grain_density * grains +
                                      fluid.density(r.end_pressure) * (J - grains));
        update.content_rate = update.content_rate_change = 0.;
        if (step.scheme.carries_rates)
          {
            const double rate = b.pores.rate[slot], change = b.pores.rate_change[slot];
            update.content_rate = step.scheme.end_rate(r.content_increment, rate, change, step.dt);
            update.content_rate_change =
              step.scheme.end_rate_change(r.content_increment, rate, change, step.dt);
          }
        std::copy_n(r.darcy_velocity, dim, update.darcy_velocity);
        update.darcy_dissipation = trial.volume * step.dt * r.darcy_power;
        update.flow_work         = trial.volume * step.dt * r.flow_work_rate;
        update.known_inflow      = trial.volume * step.dt * trial.known_rate;
        // what flows at n + 1 alone, if rates are carried, flows on between the means of two steps
        update.stabilisation_work =
          r.fluid_fluctuation * (step.scheme.carries_rates
                                   ? 0.5 * (trial.fluctuation_n + trial.fluctuation)
                                   : trial.fluctuation);
      }

      template <unsigned int pattern>
      void
      run() const
      {
        for_points_of_batch<dim, pattern>(
          b,
          []() {},
          [&](const unsigned int slot, const PoreTrial<dim> &trial, const auto &) {
            set(slot, trial, respond<false>(b, slot, trial));
            return true;
          },
          [](const auto &) {});
      }
    };
  } // namespace internal
} // namespace kedge

#endif
