#ifndef kedge_porous_surface_kernels_h
#define kedge_porous_surface_kernels_h

#include "porous_kernels.h"

namespace kedge
{
  namespace internal
  {
    /**
     * A place on a surface with a prescribed pressure p_s in the balance of
     * volume (Nitsche's method without its adjoint term, which consistency
     * does not need):
     *   d_A += N_A(place) dt/rho_0 [ q.n + gamma (p(place) - p_s) ] da,
     *   gamma = penalty kappa_0/(g h).
     * q is the flow by SurfacePoint::gradients: that of the point whose face it is, or of the
     * cell that the facet lies in. N_A(place) are SurfacePoint::functions. Of a seepage face
     * only a positive bracket counts: what leaves.
     */
    template <int dim>
    struct SurfaceKernel
    {
      const PorousBatch<dim>  &b;
      const SurfacePoint<dim> &face;
      const double             prescribed; ///< p_s [Pa]
      const SurfaceFlow        flow;

      /** Whether something passes, if @p volume would leave an open place. */
      bool
      passes(const double volume) const
      {
        return flow == SurfaceFlow::both_ways || (flow == SurfaceFlow::one_way && volume > 0.);
      }

      /** What would leave an open place. */
      template <class Values>
      double
      volume(const Values &v, const PoreResponse<dim> &r) const
      {
        double area[dim];
        scale_area(v.trial, area);
        double result = penalty() * (v.pressure - prescribed);
        for (int R = 0; R < dim; ++R)
          result -= area[R] * r.fluid_gradient[R][0];
        return result;
      }

      template <unsigned int pattern>
      struct Values
      {
        static constexpr int n = stencil_size<dim>(pattern);

        explicit Values(const SurfaceKernel &k)
          : basis(expand<dim, pattern>(k.face.gradients))
          , at_face(expand<dim, pattern>(k.face.functions))
        {
          const Patch<dim> &patch   = k.b.context.patch;
          const auto        offsets = node_offsets<dim, pattern>(patch.window().node_strides());
          Nodal             sums{};
          for (int A = 0; A < n; ++A)
            {
              local[A] = patch.nodes.local(k.face.functions.first_node + offsets[A]);
              add_node(k.b.trial, A, sums);
            }
          const unsigned int slot = k.face.slot;
          trial.volume            = patch.points.volume[slot];
          trial.determinant       = patch.points.determinant[slot];
          trial.pressure_n        = k.b.pores.pressure[slot];
          trial.fluctuation_n = trial.fluctuation = trial.known_rate = 0.; // of no effect on q
          trial.pressure                                             = sums.value[dim];
          for (int i = 0; i < dim; ++i)
            {
              trial.acceleration[i]      = sums.value[i];
              trial.pressure_gradient[i] = sums.gradient[dim][i];
              for (int j = 0; j < dim; ++j)
                trial.displacement[i][j] = sums.gradient[i][j];
            }
        }

        std::array<int, n>  local;
        BasisValues<dim, n> basis, at_face;
        PoreTrial<dim>      trial;         ///< the same in all lanes
        double              pressure = 0.; ///< at the place

      private:
        /** Acceleration and pressure, gradients of displacement and pressure. */
        struct Nodal
        {
          double value[dim + 1], gradient[dim + 1][dim];
        };

        void
        add_node(const PorousTrial<dim> &at, const int A, Nodal &sums)
        {
          const double *x = &at.unknowns[std::size_t(local[A]) * (dim + 1)];
          for (int i = 0; i <= dim; ++i)
            for (int j = 0; j < dim; ++j)
              sums.gradient[i][j] += x[i] * basis.gradient[j][A];
          for (int i = 0; i < dim && !at.acceleration.empty(); ++i)
            sums.value[i] += at.acceleration[std::size_t(local[A]) * dim + i] * basis.value[A];
          sums.value[dim] += x[dim] * basis.value[A];
          pressure += x[dim] * at_face.value[A];
        }
      };

      /** The pores alone: the flow knows nothing of the skeleton's stress. */
      template <bool with_tangent>
      void
      respond(const PoreTrial<dim> &trial, PoreResponse<dim> &response) const
      {
        ForceStress<dim, Pack> no_stress{};
        no_stress.valid = Pack(0.) <= Pack(0.);
        evaluate_pore_response<dim, with_tangent>(no_stress, b.step, trial, response);
      }

      /** The face's area over the volume whose factors a PoreResponse holds. */
      void
      scale_area(const PoreTrial<dim> &trial, double (&area)[dim]) const
      {
        for (int R = 0; R < dim; ++R)
          area[R] = face.area[R] / (trial.volume[0] * trial.determinant[0]);
      }

      double
      penalty() const
      {
        const PoreFluid &fluid  = b.step.soil.fluid;
        double           square = 0.;
        for (const double a : face.area)
          square += a * a;
        return b.trial.surface_penalty * fluid.reference_conductivity / fluid.reference_gravity *
               b.step.inverse_length * b.step.dt / fluid.reference_density * std::sqrt(square);
      }
    };

    template <int dim>
    struct SurfaceResidualKernel : SurfaceKernel<dim>
    {
      std::vector<double> &residual;
      double              &outflow; ///< volume that leaves
      PointStatus         &status;

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim>::template Values<pattern> Values;
        const Values                                                  v(*this);
        PoreResponse<dim>                                             r;
        this->template respond<false>(v.trial, r);
        if (!r.valid[0])
          {
            status.failed_slot = this->face.slot;
            return;
          }
        outflow = this->volume(v, r);
        if (!this->passes(outflow))
          outflow = 0.;
        for (int A = 0; A < Values::n; ++A)
          residual[std::size_t(v.local[A]) * (dim + 1) + dim] += v.at_face.value[A] * outflow;
      }
    };

    template <int dim>
    struct SurfaceTangentKernel : SurfaceKernel<dim>
    {
      NodeMatrix<dim> &tangent;

      /** Slopes of the volume that leaves by the unknowns of node B. */
      template <class Values>
      void
      find_slopes(const Values            &v,
                  const PoreResponse<dim> &r,
                  double (&slope)[dim + 1][Values::n]) const
      {
        double area[dim];
        this->scale_area(v.trial, area);
        const double penalty = this->penalty();
        for (int B = 0; B < Values::n; ++B)
          {
            const double N = v.basis.value[B];
            slope[dim][B]  = penalty * v.at_face.value[B];
            for (int R = 0; R < dim; ++R)
              {
                double by_p = r.pp_weight[R][0] * N;
                for (int S = 0; S < dim; ++S)
                  by_p += r.pp[R][S][0] * v.basis.gradient[S][B];
                slope[dim][B] -= area[R] * by_p;
              }
            for (int m = 0; m < dim; ++m)
              {
                slope[m][B] = 0.;
                for (int R = 0; R < dim; ++R)
                  {
                    double by_u = r.pu_inertia[R][m][0] * N;
                    for (int S = 0; S < dim; ++S)
                      by_u += r.pu[R][m][S][0] * v.basis.gradient[S][B];
                    slope[m][B] -= area[R] * by_u;
                  }
              }
          }
      }

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim>::template Values<pattern> Values;
        constexpr int                                                 n = Values::n;
        const auto        rows = row_slots<dim, pattern>(tangent);
        const Values      v(*this);
        PoreResponse<dim> r;
        this->template respond<true>(v.trial, r);
        if (!this->passes(this->volume(v, r)))
          return;
        double slope[dim + 1][n];
        find_slopes(v, r, slope);
        double values[n * (dim + 1)];
        for (int A = 0; A < n; ++A)
          {
            for (int B = 0; B < n; ++B)
              for (int m = 0; m <= dim; ++m)
                values[B * (dim + 1) + m] = v.at_face.value[A] * slope[m][B];
            add_to_row<dim, pattern, dim + 1>(rows[A], values, tangent.row(v.local[A], dim));
          }
      }
    };

    /** Calls run(SurfaceKernel, number of the face) for the faces of a batch's points. */
    template <int dim, typename Run>
    inline void
    for_faces(const PorousBatch<dim> &b, const Run &run)
    {
      for (std::size_t f = 0; f < b.trial.surface.size(); ++f)
        {
          const SurfacePoint<dim> &face = b.trial.surface[f];
          if (face.slot >= b.context.batch.begin && face.slot < b.context.batch.end)
            run(SurfaceKernel<dim>{b, face, b.trial.surface_pressures[f], b.trial.surface_flows[f]},
                f);
        }
    }
  } // namespace internal
} // namespace kedge

#endif
