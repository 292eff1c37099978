#ifndef kedge_porous_porous_kernels_h
#define kedge_porous_porous_kernels_h

#include <kedge/porous/pore_response.h>
#include <kedge/porous/porous_force.h>
#include <kedge/solid/block_sum.h>
#include <kedge/solid/points_in_lanes.h>

namespace kedge
{
  namespace internal
  {
    /** What the kernels of one batch share. */
    template <int dim>
    struct PorousBatch
    {
      const BatchContext<dim> context; ///< with the trial's unknowns as nodal values
      const PorePoints<dim>  &pores;
      const PorousTrial<dim> &trial;
      const PoreStep<dim>    &step;
      const Material         &material;
      const LawFunction<dim>  stress, stress_and_tangent; ///< effective
    };

    /** N^0_A of (4.138), (4.140): the share of a point in the cells around A, over 2^dim. */
    template <int dim, unsigned int pattern>
    inline void
    expand_constants(const Stencil<dim> &stencil, double (&constant)[stencil_size<dim>(pattern)])
    {
      double factor[3][most_stencil_nodes + 1] = {{}, {}, {}};
      if constexpr (dim == 2)
        factor[2][0] = 1.;
      for (int d = 0; d < dim; ++d)
        {
          double *of_lower = factor[d] + stencil.lower_cell[d];
          of_lower[0]      = 0.5 * stencil.lower_part[d];
          of_lower[1]      = 0.5;
          of_lower[2]      = 0.5 - of_lower[0];
        }
      int A = 0;
      for (int k = 0; k < (dim == 3 ? stencil_width(pattern, 2) : 1); ++k)
        for (int j = 0; j < stencil_width(pattern, 1); ++j)
          for (int i = 0; i < stencil_width(pattern, 0); ++i)
            constant[A++] = factor[0][i] * factor[1][j] * factor[2][k];
    }

    /** The functions (N - N^0) of the stabilisation. */
    template <int dim, unsigned int pattern>
    inline void
    expand_fluctuations(const Stencil<dim> &stencil,
                        const double (&value)[stencil_size<dim>(pattern)],
                        double (&fluctuation)[stencil_size<dim>(pattern)])
    {
      expand_constants<dim, pattern>(stencil, fluctuation);
      for (int A = 0; A < stencil_size<dim>(pattern); ++A)
        fluctuation[A] = value[A] - fluctuation[A];
    }

    /** Points in the lanes with their trial states. */
    template <int dim, unsigned int pattern>
    class PorousLanes
    {
    public:
      static constexpr int n = stencil_size<dim>(pattern);

      explicit PorousLanes(const PorousBatch<dim> &b)
        : of_points(b.context)
        , b(b)
      {}

      void
      read(const PackOfSlots &slots)
      {
        of_points.read(slots, [&](const unsigned int lane, const bool new_nodes) {
          if (new_nodes)
            read_acceleration(of_points.local[lane]);
          const auto &N = of_points.basis[lane].value;
          expand_fluctuations<dim, pattern>(b.context.patch.points.stencil[slots.slot(lane)],
                                            N,
                                            fluctuation[lane]);
          const double(&pressure)[n] = of_points.nodal[dim];
          trial.pressure.set(lane, of_points.sum(pressure, N));
          trial.fluctuation.set(lane, of_points.sum(pressure, fluctuation[lane]));
          for (int d = 0; d < dim; ++d)
            trial.acceleration[d].set(lane, of_points.sum(acceleration[d], N));
          read_point(lane, slots.slot(lane));
        });
        for (unsigned int lane = slots.count; lane < pack_width; ++lane)
          repeat_last(lane, slots.count - 1);
        for (int j = 0; j < dim; ++j)
          {
            for (int i = 0; i < dim; ++i)
              trial.displacement[i][j] = of_points.gradient[i][j];
            trial.pressure_gradient[j] = of_points.gradient[dim][j];
          }
      }

      LanesOfPoints<dim, pattern, dim + 1> of_points;
      double                               fluctuation[pack_width][n];
      PoreTrial<dim>                       trial;

    private:
      void
      read_acceleration(const std::array<int, n> &local)
      {
        for (int A = 0; A < n; ++A)
          for (int d = 0; d < dim && !b.trial.acceleration.empty(); ++d)
            acceleration[d][A] = b.trial.acceleration[std::size_t(local[A]) * dim + d];
      }

      void
      read_point(const unsigned int lane, const unsigned int slot)
      {
        const double rate =
          b.pores.rate.empty()
            ? 0.
            : b.step.scheme.known_rate(b.pores.rate[slot], b.pores.rate_change[slot], b.step.dt);
        trial.volume.set(lane, b.context.patch.points.volume[slot]);
        trial.determinant.set(lane, b.context.patch.points.determinant[slot]);
        trial.pressure_n.set(lane, b.pores.pressure[slot]);
        trial.fluctuation_n.set(lane, b.pores.fluctuation[slot]);
        trial.known_rate.set(lane, rate);
      }

      void
      repeat_last(const unsigned int lane, const unsigned int last)
      {
        static_assert(sizeof(trial) % sizeof(Pack) == 0, "nothing but packs");
        auto *values = reinterpret_cast<Pack *>(&trial);
        for (std::size_t i = 0; i < sizeof(trial) / sizeof(Pack); ++i)
          values[i].set(lane, values[i][last]);
      }

      const PorousBatch<dim> &b;
      double                  acceleration[dim][n] = {};
    };

    /** The law of the skeleton, then the pores. */
    template <bool with_tangent, int dim>
    inline void
    respond(const PorousBatch<dim> &b,
            const PackOfSlots      &slots,
            const PoreTrial<dim>   &trial,
            PoreResponse<dim>      &response)
    {
      ForceStress<dim, Pack> stress;
      const auto             law = with_tangent ? b.stress_and_tangent : b.stress;
      law(b.context, b.material, slots, trial.displacement, stress);
      evaluate_pore_response<dim, with_tangent>(stress, b.step, trial, response);
    }

    /** The residuals of a batch. */
    template <int dim>
    struct PorousResidualKernel
    {
      const PorousBatch<dim> &b;
      std::vector<double>    &residual;
      PorousSize             &size;
      PointStatus            &status;

      /** The terms of the points as they would cancel among cells, gradients being 2/h. */
      void
      evaluate_size(const PoreTrial<dim> &trial, const PoreResponse<dim> &r, Pack (&terms)[2]) const
      {
        Pack stress = 0., force = 0., strain = 0., flow = 0.;
        for (int i = 0; i < dim; ++i)
          {
            force += abs(trial.acceleration[i]) + std::abs(b.step.acceleration[i]);
            flow += abs(r.fluid_gradient[i]);
            for (int R = 0; R < dim; ++R)
              {
                stress += abs(r.momentum_gradient[i][R]);
                strain += abs(trial.displacement[i][R]);
              }
          }
        terms[0] = 2. * b.step.inverse_length * stress + r.mass * force;
        terms[1] = 2. * b.step.inverse_length * flow + trial.volume * strain + abs(r.fluid_value) +
                   r.pp_fluctuation * (abs(trial.fluctuation) + abs(trial.fluctuation_n));
      }

      template <int n>
      static void
      add_point(const unsigned int         lane,
                const PoreResponse<dim>   &r,
                const BasisValues<dim, n> &basis,
                const double (&fluctuation)[n],
                double (&sum)[dim + 1][n])
      {
        for (int i = 0; i <= dim; ++i)
          {
            const double value = (i < dim ? r.momentum_value[i % dim] : r.fluid_value)[lane];
            double       gradient[dim];
            for (int R = 0; R < dim; ++R)
              gradient[R] = (i < dim ? r.momentum_gradient[i % dim][R] : r.fluid_gradient[R])[lane];
            for (int A = 0; A < n; ++A)
              {
                double add = value * basis.value[A];
                for (int R = 0; R < dim; ++R)
                  add += gradient[R] * basis.gradient[R][A];
                sum[i][A] += add;
              }
          }
        const double stabilisation = r.fluid_fluctuation[lane];
        for (int A = 0; A < n; ++A)
          sum[dim][A] += stabilisation * fluctuation[A];
      }

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int             n     = stencil_size<dim>(pattern);
        const auto               &batch = b.context.batch;
        PorousLanes<dim, pattern> lanes(b);
        PoreResponse<dim>         r;
        Pack                      pack_terms[2];
        double                    sum[dim + 1][n] = {}, terms[2] = {};
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<false>(b, slots, lanes.trial, r);
            status.failed_slot = slots.first_failure(r.valid, PointStatus::none);
            if (!status.ok())
              return;
            evaluate_size(lanes.trial, r, pack_terms);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                for (int t = 0; t < 2; ++t)
                  terms[t] += pack_terms[t][lane];
                add_point<n>(lane, r, lanes.of_points.basis[lane], lanes.fluctuation[lane], sum);
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
     * The point in a lane for BlockSum, see PoreResponse. Test functions are the gradients and
     * the values of the basis and, for the pressure, the fluctuations.
     */
    template <int dim, int n>
    struct PorousTangentOfPoint
    {
      const unsigned int         lane;
      const PoreResponse<dim>   &r;
      const BasisValues<dim, n> &basis;
      const double (&fluctuation)[n];

      static constexpr int max_tests = dim + 2;

      static constexpr int
      n_tests(const int row)
      {
        return row < dim ? dim + 1 : dim + 2;
      }

      const double *
      test(const int T) const
      {
        return T < dim ? basis.gradient[T % dim] : T == dim ? basis.value : fluctuation;
      }

      void
      contract(const int row, const int T, double (&column)[dim + 1][n]) const
      {
        if (T == dim + 1)
          of_fluctuation(column);
        else if (row < dim)
          of_momentum(row, T, column);
        else
          of_fluid(T, column);
      }

    private:
      using Column = double[n];

      /** What is known to be zero in a column of the sum is not multiplied: see PoreResponse. */
      void
      set_to_gradients(const Pack (&weight)[dim], Column &column) const
      {
        for (int B = 0; B < n; ++B)
          {
            column[B] = weight[0][lane] * basis.gradient[0][B];
            for (int S = 1; S < dim; ++S)
              column[B] += weight[S][lane] * basis.gradient[S][B];
          }
      }

      void
      set_to_values(const Pack &weight, Column &column) const
      {
        for (int B = 0; B < n; ++B)
          column[B] = weight[lane] * basis.value[B];
      }

      void
      add_values(const Pack &weight, Column &column) const
      {
        for (int B = 0; B < n; ++B)
          column[B] += weight[lane] * basis.value[B];
      }

      void
      of_momentum(const int i, const int T, Column (&column)[dim + 1]) const
      {
        const bool of_gradient = T < dim;
        for (int m = 0; m < dim; ++m)
          set_to_gradients(of_gradient ? r.uu[i][T % dim][m] : r.uu_value[i][m], column[m]);
        if (!of_gradient)
          add_values(r.mass_inertia, column[i]);
        set_to_values(of_gradient ? r.up[i][T % dim] : r.up_value[i], column[dim]);
      }

      void
      of_fluid(const int T, Column (&column)[dim + 1]) const
      {
        const int  R           = T % dim;
        const bool of_gradient = T < dim;
        for (int m = 0; m < dim; ++m)
          {
            set_to_gradients(of_gradient ? r.pu[R][m] : r.pu_value[m], column[m]);
            if (of_gradient)
              add_values(r.pu_inertia[R][m], column[m]);
          }
        if (!of_gradient)
          return set_to_values(r.pp_value, column[dim]);
        set_to_gradients(r.pp[R], column[dim]);
        add_values(r.pp_weight[R], column[dim]);
      }

      void
      of_fluctuation(Column (&column)[dim + 1]) const
      {
        for (int m = 0; m < dim; ++m)
          std::fill_n(column[m], n, 0.);
        for (int B = 0; B < n; ++B)
          column[dim][B] = r.pp_fluctuation[lane] * fluctuation[B];
      }
    };

    /** The Jacobian of a batch. */
    template <int dim>
    struct PorousTangentKernel
    {
      const PorousBatch<dim> &b;
      NodeMatrix<dim>        &tangent;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto                      rows  = row_slots<dim, pattern>(tangent);
        const auto                     &batch = b.context.batch;
        PorousLanes<dim, pattern>       lanes(b);
        PoreResponse<dim>               r;
        BlockSum<dim, pattern, dim + 1> sum;
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<true>(b, slots, lanes.trial, r);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                const PorousTangentOfPoint<dim, stencil_size<dim>(pattern)>
                  point{lane, r, lanes.of_points.basis[lane], lanes.fluctuation[lane]};
                if (lanes.of_points.is_last(slots.slot(lane)))
                  sum.add_last_point(point, rows, lanes.of_points.local[lane], tangent);
                else
                  sum.add_point(point);
              }
          }
      }
    };

    /** (N - N^0) p at the points of a batch. */
    template <int dim>
    struct FluctuationKernel
    {
      const Patch<dim>                      &patch;
      const std::vector<double>             &nodal_pressure;
      const typename StepPoints<dim>::Batch &batch;
      std::vector<double>                   &result;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            constexpr int       n       = stencil_size<dim>(pattern);
            const Stencil<dim> &stencil = patch.points.stencil[slot];
            double              fluctuation[n];
            expand_fluctuations<dim, pattern>(stencil,
                                              expand<dim, pattern>(stencil).value,
                                              fluctuation);
            result[slot] = 0.;
            for (int A = 0; A < n; ++A)
              result[slot] +=
                fluctuation[A] * nodal_pressure[patch.nodes.local(stencil.first_node + offsets[A])];
          }
      }
    };

    /** The pores at the end of a step. */
    template <int dim>
    struct PoreUpdateKernel
    {
      const PorousBatch<dim>       &b;
      std::vector<PoreUpdate<dim>> &updates;

      void
      set(const unsigned int       slot,
          const unsigned int       lane,
          const PoreTrial<dim>    &trial,
          const PoreResponse<dim> &r) const
      {
        const PoreStep<dim> &step        = b.step;
        const PoreFluid     &fluid       = step.soil.fluid;
        PoreUpdate<dim>     &update      = updates[slot];
        const double         J           = r.end_determinant[lane];
        const double         grains      = 1. - fluid.initial_porosity;
        const double         volume      = trial.volume[lane];
        const double         fluctuation = trial.fluctuation[lane],
                     fluctuation_n       = trial.fluctuation_n[lane];
        update.pressure                  = r.end_pressure[lane];
        update.fluctuation = fluctuation_n + (fluctuation - fluctuation_n) / step.scheme.theta;
        update.porosity    = fluid.porosity(J);
        const double fluid_density =
          step.soil.dry_storage > 0. ? 0. : fluid.density(update.pressure);
        update.mass = volume * (step.soil.grain_density * grains + fluid_density * (J - grains));
        update.content_rate = update.content_rate_change = 0.;
        if (step.scheme.carries_rates)
          {
            const double rate = b.pores.rate[slot], change = b.pores.rate_change[slot];
            const double increment = r.content_increment[lane];
            update.content_rate    = step.scheme.end_rate(increment, rate, change, step.dt);
            update.content_rate_change =
              step.scheme.end_rate_change(increment, rate, change, step.dt);
          }
        for (int d = 0; d < dim; ++d)
          update.darcy_velocity[d] = r.darcy_velocity[d][lane];
        update.darcy_dissipation = volume * step.dt * r.darcy_power[lane];
        update.flow_work         = volume * step.dt * r.flow_work_rate[lane];
        update.inertia_work      = volume * step.dt * r.inertia_work_rate[lane];
        update.known_inflow      = volume * step.dt * trial.known_rate[lane];
        // what flows at n + 1 alone, if rates are carried, flows on between the means of two steps
        update.stabilisation_work =
          r.fluid_fluctuation[lane] *
          (step.scheme.carries_rates ? 0.5 * (fluctuation_n + fluctuation) : fluctuation);
      }

      template <unsigned int pattern>
      void
      run() const
      {
        const auto               &batch = b.context.batch;
        PorousLanes<dim, pattern> lanes(b);
        PoreResponse<dim>         r;
        for (unsigned int begin = batch.begin; begin < batch.end;)
          {
            const PackOfSlots slots(begin, batch.end);
            lanes.read(slots);
            respond<false>(b, slots, lanes.trial, r);
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              set(slots.slot(lane), lane, lanes.trial, r);
            begin += slots.count;
          }
      }
    };
  } // namespace internal
} // namespace kedge

#endif
