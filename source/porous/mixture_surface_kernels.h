#ifndef kedge_porous_mixture_surface_kernels_h
#define kedge_porous_mixture_surface_kernels_h

#include "mixture_kernels.h"

namespace kedge
{
  namespace internal
  {
    /**
     * A place on a surface with a prescribed pressure p_s in the conserving balance:
     *   d_A += N_A o/rho_0,   e_A += N_A o U_f/dt,   o = a [dt q.n + dt gamma (pi_f - pi_s)],
     *   pi_f = lambda_f + rho_0 (|U_f|^2 + |U_f - v_nf|^2)/2,   gamma = penalty kappa_0/(g h),
     * with f at the place: what leaves takes the velocity of the surface along. q as in
     * SurfaceKernel. Of a seepage face only a positive bracket counts.
     */
    template <int dim>
    struct MixtureSurfaceKernel
    {
      const MixtureBatch<dim> &b;
      const SurfacePoint<dim> &face;
      const double             prescribed; ///< pi_s [Pa]
      const SurfaceFlow        flow;

      double
      density() const
      {
        return b.step.soil.fluid.reference_density;
      }

      /** Volume for each Pascal of the difference [m^3/Pa]. */
      double
      penalty() const
      {
        const PoreFluid &fluid  = b.step.soil.fluid;
        double           square = 0.;
        for (const double a : face.area)
          square += a * a;
        return b.field.surface_penalty * fluid.reference_conductivity / fluid.reference_gravity /
               b.field.cell_size * b.step.dt / density() * std::sqrt(square);
      }

      /** The nodes' fields at the place. */
      template <unsigned int pattern>
      struct Values
      {
        static constexpr int n = stencil_size<dim>(pattern);

        explicit Values(const MixtureSurfaceKernel &k)
          : basis(expand<dim, pattern>(k.face.gradients))
          , at_face(expand<dim, pattern>(k.face.functions))
        {
          const Patch<dim> &patch   = k.b.context.patch;
          const auto        offsets = node_offsets<dim, pattern>(patch.window().node_strides());
          const MixtureField<dim> &field                  = k.b.field;
          const unsigned int       slot                   = k.face.slot;
          double                   sums[dim + 1][dim + 2] = {}, started[dim] = {};
          for (int A = 0; A < n; ++A)
            {
              local[A]        = patch.nodes.local(k.face.functions.first_node + offsets[A]);
              const double *x = &field.values[std::size_t(local[A]) * (dim + 1)];
              for (int i = 0; i <= dim; ++i)
                {
                  for (int j = 0; j < dim; ++j)
                    sums[i][j] += x[i] * basis.gradient[j][A];
                  sums[i][dim] += x[i] * basis.value[A];
                  sums[i][dim + 1] += x[i] * at_face.value[A];
                }
              for (int i = 0; i < dim; ++i)
                started[i] += field.velocity_n[std::size_t(local[A]) * dim + i] * at_face.value[A];
            }
          trial.volume        = patch.points.volume[slot];
          trial.determinant   = patch.points.determinant[slot];
          trial.pressure_n    = k.b.points.end_pressure[slot];
          trial.fluctuation_n = trial.potential_fluctuation = 0.; // of no effect on q
          trial.potential                                   = sums[dim][dim];
          potential                                         = sums[dim][dim + 1];
          kinetic                                           = 0.;
          for (int i = 0; i < dim; ++i)
            {
              trial.fluid_velocity_n[i]   = k.b.points.fluid_velocity[slot][i];
              trial.potential_gradient[i] = sums[dim][i];
              trial.velocity[i] = trial.constant_velocity[i] = sums[i][dim] / field.dt;
              velocity[i]                                    = sums[i][dim + 1] / field.dt;
              const double gap                               = velocity[i] - started[i];
              twice[i]                                       = velocity[i] + gap;
              kinetic += 0.5 * (velocity[i] * velocity[i] - gap * gap);
              potential += 0.5 * k.density() * (velocity[i] * velocity[i] + gap * gap);
              for (int j = 0; j < dim; ++j)
                trial.displacement[i][j] = sums[i][j];
            }
        }

        std::array<int, n>      local;
        BasisValues<dim, n>     basis, at_face;
        MixtureTrial<dim, Pack> trial;         ///< the same in all lanes
        double                  potential;     ///< pi_f [Pa]
        double                  velocity[dim]; ///< U_f [m/s]
        double                  twice[dim];    ///< 2 U_f - v_nf [m/s]
        double                  kinetic;       ///< |U_f|^2/2 - |U_f - v_nf|^2/2 [m^2/s^2]
      };

      template <bool with_tangent>
      void
      respond(const MixtureTrial<dim, Pack> &trial, MixtureResponse<dim, Pack> &response) const
      {
        ForceStress<dim, Pack> no_stress{};
        no_stress.valid = Pack(0.) <= Pack(0.);
        evaluate_mixture_response<dim, with_tangent>(no_stress, b.step, trial, response);
      }

      /** What would leave an open place [m^3]. */
      template <class Values>
      double
      volume(const Values &v, const MixtureResponse<dim, Pack> &r) const
      {
        double result = penalty() * (v.potential - prescribed);
        for (int R = 0; R < dim; ++R)
          result -= area(v, R) * r.fluid_gradient[R][0];
        return result;
      }

      bool
      passes(const double volume) const
      {
        return flow == SurfaceFlow::both_ways || (flow == SurfaceFlow::one_way && volume > 0.);
      }

      /** The face's area over the volume whose factors a response holds. */
      template <class Values>
      double
      area(const Values &v, const int R) const
      {
        return face.area[R] / (v.trial.volume[0] * v.trial.determinant[0]);
      }
    };

    template <int dim>
    struct MixtureSurfaceResidual : MixtureSurfaceKernel<dim>
    {
      std::vector<double> &residual;
      MixtureOutflow      &outflow;
      PointStatus         &status;

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename MixtureSurfaceKernel<dim>::template Values<pattern> Values;
        const Values                                                         v(*this);
        MixtureResponse<dim, Pack>                                           r;
        this->template respond<false>(v.trial, r);
        if (!r.valid[0])
          {
            status = {this->face.slot, r.has_stress[0]};
            return;
          }
        double volume = this->volume(v, r);
        if (!this->passes(volume))
          volume = 0.;
        const double mass   = this->density() * volume;
        outflow.mass        = mass;
        outflow.dissipation = volume * (v.potential - this->prescribed);
        outflow.energy      = volume * this->prescribed + mass * v.kinetic;
        for (int A = 0; A < Values::n; ++A)
          {
            double *row = &residual[std::size_t(v.local[A]) * (dim + 1)];
            for (int i = 0; i < dim; ++i)
              row[i] += v.at_face.value[A] * mass * v.velocity[i] / this->b.step.dt;
            row[dim] += v.at_face.value[A] * volume;
          }
      }
    };

    template <int dim>
    struct MixtureSurfaceTangent : MixtureSurfaceKernel<dim>
    {
      NodeMatrix<dim> &tangent;

      /** Slopes of the volume that leaves by displacement and potential of node B. */
      template <class Values>
      void
      find_slopes(const Values                     &v,
                  const MixtureResponse<dim, Pack> &r,
                  double (&slope)[dim + 1][Values::n]) const
      {
        using Input          = MixtureInput<dim>;
        const double penalty = this->penalty(), dt = this->b.step.dt;
        for (int B = 0; B < Values::n; ++B)
          {
            const double N = v.basis.value[B], at_face = penalty * v.at_face.value[B];
            for (int m = 0; m <= dim; ++m)
              slope[m][B] = m < dim ? at_face * this->density() * v.twice[m % dim] / dt : at_face;
            for (int R = 0; R < dim; ++R)
              for (int m = 0; m <= dim; ++m)
                {
                  const auto &of    = r.fluid_gradient_slope[R].of;
                  const int   first = m < dim ? m * dim : Input::gradient;
                  double      sum   = m < dim ? of[Input::velocity + m % dim][0] / dt * N
                                              : of[Input::potential][0] * N;
                  for (int S = 0; S < dim; ++S)
                    sum += of[first + S][0] * v.basis.gradient[S][B];
                  slope[m][B] -= this->area(v, R) * sum;
                }
          }
      }

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename MixtureSurfaceKernel<dim>::template Values<pattern> Values;
        constexpr int                                                        n = Values::n;
        const auto                 rows = row_slots<dim, pattern>(tangent);
        const Values               v(*this);
        MixtureResponse<dim, Pack> r;
        this->template respond<true>(v.trial, r);
        const double volume = this->volume(v, r), dt = this->b.step.dt;
        if (!this->passes(volume))
          return;
        double slope[dim + 1][n], values[n * (dim + 1)];
        find_slopes(v, r, slope);
        for (int A = 0; A < n; ++A)
          for (int i = 0; i <= dim; ++i)
            {
              const double test = v.at_face.value[A] * (i < dim ? this->density() / dt : 1.);
              for (int B = 0; B < n; ++B)
                for (int m = 0; m <= dim; ++m)
                  values[B * (dim + 1) + m] =
                    test * (i < dim ? v.velocity[i % dim] * slope[m][B] +
                                        (m == i ? volume * v.at_face.value[B] / dt : 0.)
                                    : slope[m][B]);
              add_to_row<dim, pattern, dim + 1>(rows[A], values, tangent.row(v.local[A], i));
            }
      }
    };

    /** Calls run(MixtureSurfaceKernel, number of the face) for the faces of a batch's points. */
    template <int dim, typename Run>
    inline void
    for_mixture_faces(const MixtureBatch<dim> &b, const Run &run)
    {
      for (std::size_t f = 0; f < b.field.surface.size(); ++f)
        {
          const SurfacePoint<dim> &face = b.field.surface[f];
          if (face.slot >= b.context.batch.begin && face.slot < b.context.batch.end)
            run(MixtureSurfaceKernel<dim>{b,
                                          face,
                                          b.field.surface_potentials[f],
                                          b.field.surface_flows[f]},
                f);
        }
    }
  } // namespace internal
} // namespace kedge

#endif
