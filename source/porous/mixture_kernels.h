#ifndef kedge_porous_mixture_kernels_h
#define kedge_porous_mixture_kernels_h

#include <kedge/porous/mixture_force.h>
#include <kedge/porous/mixture_response.h>

#include "porous_kernels.h"

namespace kedge
{
  namespace internal
  {
    /** What the kernels of one batch share. */
    template <int dim>
    struct MixtureBatch
    {
      const BatchContext<dim>   context; ///< with the field's values as nodal values
      const MixturePoints<dim> &points;
      const MixtureField<dim>  &field;
      const MixtureStep<dim>   &step;
      const Material           &material;
      const LawFunction<dim>    stress, stress_and_tangent; ///< conserving, effective
    };

    /** Points in the lanes with their trial states. */
    template <int dim, unsigned int pattern>
    class MixtureLanes
    {
    public:
      static constexpr int n = stencil_size<dim>(pattern);

      explicit MixtureLanes(const MixtureBatch<dim> &b)
        : of_points(b.context)
        , b(b)
      {}

      void
      read(const PackOfSlots &slots)
      {
        of_points.read(slots, [&](const unsigned int lane, const bool) {
          const auto        &N    = of_points.basis[lane].value;
          const unsigned int slot = slots.slot(lane);
          expand_fluctuations<dim, pattern>(b.context.patch.points.stencil[slot],
                                            N,
                                            fluctuation[lane]);
          const double(&potential)[n] = of_points.nodal[dim];
          trial.potential.set(lane, of_points.sum(potential, N));
          trial.potential_fluctuation.set(lane, of_points.sum(potential, fluctuation[lane]));
          for (int d = 0; d < dim; ++d)
            {
              const double u = of_points.sum(of_points.nodal[d], N);
              trial.velocity[d].set(lane, u / b.step.dt);
              trial.constant_velocity[d]
                .set(lane, (u - of_points.sum(of_points.nodal[d], fluctuation[lane])) / b.step.dt);
              trial.fluid_velocity_n[d].set(lane, b.points.fluid_velocity[slot][d]);
            }
          trial.volume.set(lane, b.context.patch.points.volume[slot]);
          trial.determinant.set(lane, b.context.patch.points.determinant[slot]);
          trial.pressure_n.set(lane, b.points.end_pressure[slot]);
          trial.fluctuation_n.set(lane, b.points.fluctuation[slot]);
        });
        for (unsigned int lane = slots.count; lane < pack_width; ++lane)
          repeat_last(lane, slots.count - 1);
        for (int j = 0; j < dim; ++j)
          {
            for (int i = 0; i < dim; ++i)
              trial.displacement[i][j] = of_points.gradient[i][j];
            trial.potential_gradient[j] = of_points.gradient[dim][j];
          }
      }

      LanesOfPoints<dim, pattern, dim + 1> of_points;
      double                               fluctuation[pack_width][n]; ///< N - N^0
      MixtureTrial<dim, Pack>              trial;

    private:
      void
      repeat_last(const unsigned int lane, const unsigned int last)
      {
        static_assert(sizeof(trial) % sizeof(Pack) == 0, "nothing but packs");
        auto *values = reinterpret_cast<Pack *>(&trial);
        for (std::size_t i = 0; i < sizeof(trial) / sizeof(Pack); ++i)
          values[i].set(lane, values[i][last]);
      }

      const MixtureBatch<dim> &b;
    };

    /** The skeleton alone, of a dry body in a saturated scene; see Soil::dry_storage. */
    template <int dim, bool with_tangent>
    inline void
    respond_dry(const ForceStress<dim, Pack>  &stress,
                const MixtureStep<dim>        &step,
                const MixtureTrial<dim, Pack> &trial,
                MixtureResponse<dim, Pack>    &r)
    {
      using Input = MixtureInput<dim>;
      Pack       inverse[dim][dim];
      const Pack growth = invert_gradient<dim>(trial.displacement, 1., inverse);
      r                 = MixtureResponse<dim, Pack>{};
      r.has_stress      = stress.valid;
      r.valid           = stress.valid && growth > -1.;
      r.end_determinant = trial.determinant * (1. + growth);
      const Pack V      = trial.volume;
      for (int i = 0; i < dim; ++i)
        for (int R = 0; R < dim; ++R)
          {
            r.momentum_gradient[i][R] = V * stress.stress[i][R];
            for (int m = 0; m < dim && with_tangent; ++m)
              for (int S = 0; S < dim; ++S)
                r.momentum_gradient_slope[i][R].of[m * dim + S] = V * stress.tangent[i][R][m][S];
          }
      r.fluid_value                            = V * (step.soil.dry_storage * trial.potential);
      r.fluid_value_slope.of[Input::potential] = V * step.soil.dry_storage;
      r.darcy_power = step.soil.dry_storage / step.dt * trial.potential * trial.potential;
    }

    /** The law of the skeleton, then the fluid. */
    template <bool with_tangent, int dim>
    inline void
    respond(const MixtureBatch<dim>       &b,
            const PackOfSlots             &slots,
            const MixtureTrial<dim, Pack> &trial,
            MixtureResponse<dim, Pack>    &response)
    {
      ForceStress<dim, Pack> stress;
      const auto             law = with_tangent ? b.stress_and_tangent : b.stress;
      law(b.context, b.material, slots, trial.displacement, stress);
      if (b.step.soil.dry_storage > 0.)
        respond_dry<dim, with_tangent>(stress, b.step, trial, response);
      else
        evaluate_mixture_response<dim, with_tangent>(stress, b.step, trial, response);
    }

    /** The residuals of a batch. */
    template <int dim>
    struct MixtureResidualKernel
    {
      const MixtureBatch<dim> &b;
      std::vector<double>     &residual;
      PorousSize              &size;
      PointStatus             &status;

      /** The terms of the points as they would cancel among cells, gradients being 2/h. */
      void
      evaluate_size(const MixtureTrial<dim, Pack>    &trial,
                    const MixtureResponse<dim, Pack> &r,
                    Pack (&terms)[2]) const
      {
        Pack stress = 0., speed = 0., strain = 0., flow = 0., weight = 0.;
        for (int i = 0; i < dim; ++i)
          {
            speed += abs(trial.velocity[i]) + abs(trial.fluid_velocity_n[i]);
            weight += std::abs(b.step.acceleration[i]);
            flow += abs(r.fluid_gradient[i]);
            for (int R = 0; R < dim; ++R)
              {
                stress += abs(r.momentum_gradient[i][R]);
                strain += abs(trial.displacement[i][R]);
              }
          }
        const double scale = 2. / b.field.cell_size;
        terms[0] =
          scale * stress + trial.volume * r.end_content * (2. / b.step.dt * speed + weight);
        terms[1] = scale * flow + trial.volume * strain + abs(r.fluid_value) +
                   r.stabilisation_slope * (abs(r.fluctuation) + abs(trial.fluctuation_n));
      }

      template <int n>
      void
      add_point(const unsigned int                lane,
                const MixtureTrial<dim, Pack>    &trial,
                const MixtureResponse<dim, Pack> &r,
                const BasisValues<dim, n>        &basis,
                const double (&fluctuation)[n],
                double (&sum)[dim + 1][n]) const
      {
        const double carried = 0.5 * b.step.soil.fluid.reference_density / b.step.dt;
        for (int i = 0; i <= dim; ++i)
          {
            const bool   of_fluid = i == dim;
            const double value    = (of_fluid ? r.fluid_value : r.momentum_value[i % dim])[lane];
            double       gradient[dim], stabilisation = r.stabilisation[lane];
            for (int R = 0; R < dim; ++R)
              gradient[R] =
                (of_fluid ? r.fluid_gradient[R] : r.momentum_gradient[i % dim][R])[lane];
            if (!of_fluid)
              stabilisation *=
                carried * (trial.velocity[i % dim][lane] + trial.constant_velocity[i % dim][lane]);
            for (int A = 0; A < n; ++A)
              {
                double add = value * basis.value[A] + stabilisation * fluctuation[A];
                for (int R = 0; R < dim; ++R)
                  add += gradient[R] * basis.gradient[R][A];
                sum[i][A] += add;
              }
          }
      }

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int              n     = stencil_size<dim>(pattern);
        const auto                &batch = b.context.batch;
        MixtureLanes<dim, pattern> lanes(b);
        MixtureResponse<dim, Pack> r;
        Pack                       pack_terms[2];
        double                     sum[dim + 1][n] = {}, terms[2] = {};
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<false>(b, slots, lanes.trial, r);
            status.failed_slot = slots.first_failure(r.valid, PointStatus::none);
            if (!status.ok())
              {
                const unsigned int of_law = slots.first_failure(r.has_stress, PointStatus::none);
                status.has_stress         = of_law != status.failed_slot;
                return;
              }
            evaluate_size(lanes.trial, r, pack_terms);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                for (int t = 0; t < 2; ++t)
                  terms[t] += pack_terms[t][lane];
                add_point<n>(lane,
                             lanes.trial,
                             r,
                             lanes.of_points.basis[lane],
                             lanes.fluctuation[lane],
                             sum);
                if (!lanes.of_points.is_last(slots.slot(lane)))
                  continue;
                size.momentum += terms[0] * terms[0];
                size.fluid += terms[1] * terms[1];
                terms[0] = terms[1] = 0.;
                for (int A = 0; A < n; ++A)
                  for (int c = 0; c <= dim; ++c)
                    {
                      residual[std::size_t(lanes.of_points.local[lane][A]) * (dim + 1) + c] +=
                        sum[c][A];
                      sum[c][A] = 0.;
                    }
              }
          }
      }
    };

    /**
     * The point in a lane for BlockSum, see MixtureResponse. Test functions are the gradients, the
     * values and the fluctuations of the basis.
     */
    template <int dim, int n>
    struct MixtureTangentOfPoint
    {
      using Input  = MixtureInput<dim>;
      using Slopes = MixtureSlopes<dim, Pack>;

      const unsigned int                lane;
      const double                      dt, density; ///< rho_0
      const MixtureTrial<dim, Pack>    &trial;
      const MixtureResponse<dim, Pack> &r;
      const BasisValues<dim, n>        &basis;
      const double (&fluctuation)[n];

      static constexpr int max_tests = dim + 2;

      /** Without stabilisation its test has no part in any row. */
      int
      n_tests(const int) const
      {
        return r.stabilisation_slope[lane] != 0. ? dim + 2 : dim + 1;
      }

      const double *
      test(const int T) const
      {
        return T < dim ? basis.gradient[T % dim] : T == dim ? basis.value : fluctuation;
      }

      void
      contract(const int row, const int T, double (&column)[dim + 1][n]) const
      {
        const int i = row % dim, R = T % dim;
        if (T == dim + 1)
          of_stabilisation(row, column);
        else if (T == dim)
          of_slopes(row < dim ? r.momentum_value_slope[i] : r.fluid_value_slope, column);
        else
          of_slopes(row < dim ? r.momentum_gradient_slope[i][R] : r.fluid_gradient_slope[R],
                    column);
      }

    private:
      void
      of_slopes(const Slopes &slopes, double (&column)[dim + 1][n]) const
      {
        for (int m = 0; m <= dim; ++m)
          {
            const int    gradient = m < dim ? m * dim : Input::gradient;
            const double value    = m < dim ? slopes.of[Input::velocity + m % dim][lane] / dt
                                            : slopes.of[Input::potential][lane];
            for (int B = 0; B < n; ++B)
              column[m][B] = value * basis.value[B];
            for (int S = 0; S < dim; ++S)
              {
                const double weight = slopes.of[gradient + S][lane];
                for (int B = 0; B < n; ++B)
                  column[m][B] += weight * basis.gradient[S][B];
              }
          }
      }

      void
      of_stabilisation(const int row, double (&column)[dim + 1][n]) const
      {
        double scale = 1.;
        if (row < dim)
          scale = 0.5 * density / dt *
                  (trial.velocity[row % dim][lane] + trial.constant_velocity[row % dim][lane]);
        const double slope = scale * r.stabilisation_slope[lane];
        for (int m = 0; m < dim; ++m)
          {
            const double by_value    = slope * density / dt * trial.velocity[m][lane];
            const double by_constant = slope * density / dt * trial.constant_velocity[m][lane];
            for (int B = 0; B < n; ++B)
              column[m][B] =
                by_value * basis.value[B] - by_constant * (basis.value[B] - fluctuation[B]);
          }
        for (int B = 0; B < n; ++B)
          column[dim][B] = slope * fluctuation[B];
        if (row == dim)
          return;
        const double carried = 0.5 * density / (dt * dt) * r.stabilisation[lane];
        for (int B = 0; B < n; ++B)
          column[row][B] += carried * (2. * basis.value[B] - fluctuation[B]);
      }
    };

    /** The Jacobian of a batch. */
    template <int dim>
    struct MixtureTangentKernel
    {
      const MixtureBatch<dim> &b;
      NodeMatrix<dim>         &tangent;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto                      rows  = row_slots<dim, pattern>(tangent);
        const auto                     &batch = b.context.batch;
        MixtureLanes<dim, pattern>      lanes(b);
        MixtureResponse<dim, Pack>      r;
        BlockSum<dim, pattern, dim + 1> sum;
        const double                    density = b.step.soil.fluid.reference_density;
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<true>(b, slots, lanes.trial, r);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                const MixtureTangentOfPoint<dim, stencil_size<dim>(pattern)> point{
                  lane,
                  b.step.dt,
                  density,
                  lanes.trial,
                  r,
                  lanes.of_points.basis[lane],
                  lanes.fluctuation[lane]};
                if (lanes.of_points.is_last(slots.slot(lane)))
                  sum.add_last_point(point, rows, lanes.of_points.local[lane], tangent);
                else
                  sum.add_point(point);
              }
          }
      }
    };

    /** The fluid at the end of a step. */
    template <int dim>
    struct MixtureUpdateKernel
    {
      const MixtureBatch<dim>         &b;
      std::vector<MixtureUpdate<dim>> &updates;

      void
      set(const unsigned int                slot,
          const unsigned int                lane,
          const MixtureTrial<dim, Pack>    &trial,
          const MixtureResponse<dim, Pack> &r) const
      {
        const MixtureStep<dim> &step   = b.step;
        MixtureUpdate<dim>     &update = updates[slot];
        const double            volume = trial.volume[lane];
        update.pressure                = r.pressure[lane];
        update.end_pressure            = r.end_pressure[lane];
        update.fluctuation             = r.end_fluctuation[lane];
        update.porosity                = step.soil.fluid.porosity(r.end_determinant[lane]);
        update.darcy_dissipation       = volume * step.dt * r.darcy_power[lane];
        update.swallowed               = step.soil.dry_storage > 0. ? r.fluid_value[lane] : 0.;
        update.weight_work             = volume * step.dt * r.weight_power[lane];
        update.mass                    = volume * r.end_content[lane];
        update.skeleton_change         = 0.;
        update.filter_loss             = 0.;
        const double change            = update.fluctuation - trial.fluctuation_n[lane];
        update.stabilisation_loss =
          volume * step.soil.stabilisation * (step.theta - 0.5) * change * change;
        for (int d = 0; d < dim; ++d)
          {
            update.fluid_velocity[d] = r.end_fluid_velocity[d][lane];
            update.darcy_velocity[d] = r.darcy_velocity[d][lane];
            update.relative[d]       = r.relative[d][lane];
          }
      }

      /**
       * The moment of the momentum that the stabilisation moves: -s d x (U + U^0)/2 with
       * d = sum (N_A - N^0_A) x_A, the nodes in the middle of the step.
       */
      template <int n>
      void
      set_torque(const unsigned int                slot,
                 const unsigned int                lane,
                 const MixtureTrial<dim, Pack>    &trial,
                 const MixtureResponse<dim, Pack> &r,
                 const std::array<int, n>         &local,
                 const double (&fluctuation)[n]) const
      {
        double arm[3] = {0., 0., 0.}, momentum[3] = {0., 0., 0.};
        for (int A = 0; A < n; ++A)
          {
            const auto x = b.context.patch.node_position(local[A]);
            for (int d = 0; d < dim; ++d)
              arm[d] += fluctuation[A] *
                        (x[d] + 0.5 * b.field.values[std::size_t(local[A]) * (dim + 1) + d]);
          }
        const double mass = b.step.soil.fluid.reference_density * r.stabilisation[lane];
        for (int d = 0; d < dim; ++d)
          momentum[d] = -0.5 * mass * (trial.velocity[d][lane] + trial.constant_velocity[d][lane]);
        double *torque = updates[slot].stabilisation_torque;
        for (int d = 0; d < 3; ++d)
          torque[d] =
            arm[(d + 1) % 3] * momentum[(d + 2) % 3] - arm[(d + 2) % 3] * momentum[(d + 1) % 3];
      }

      template <unsigned int pattern>
      void
      run() const
      {
        const auto                &batch = b.context.batch;
        MixtureLanes<dim, pattern> lanes(b);
        MixtureResponse<dim, Pack> r;
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<false>(b, slots, lanes.trial, r);
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                set(slots.slot(lane), lane, lanes.trial, r);
                set_torque<stencil_size<dim>(pattern)>(slots.slot(lane),
                                                       lane,
                                                       lanes.trial,
                                                       r,
                                                       lanes.of_points.local[lane],
                                                       lanes.fluctuation[lane]);
              }
            begin += slots.count;
          }
      }
    };
  } // namespace internal
} // namespace kedge

#endif
