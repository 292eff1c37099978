#ifndef kedge_porous_surface_kernels_h
#define kedge_porous_surface_kernels_h

#include "porous_kernels.h"

namespace kedge
{
  namespace internal
  {
    /**
     * The part of a face with a prescribed pressure p_s in the balance of
     * volume (Nitsche's method without its adjoint term, which consistency
     * does not need):
     *   d_A += N_A(face) dt/rho_0 [ q.n + gamma (p(face) - p_s) ] da,
     *   gamma = penalty kappa_0/(g h).
     * q is the flow at the point; N_A(face) = N_A + g_A.offset is linear too.
     */
    template <int dim, class Material>
    struct SurfaceKernel
    {
      const PorousBatch<dim, Material> &b;
      const SurfacePoint<dim>          &face;

      template <unsigned int pattern>
      struct Values
      {
        static constexpr int n = stencil_size<dim>(pattern);

        explicit Values(const SurfaceKernel &k)
          : basis(k.b.points.stencil[k.face.slot])
        {
          const auto offsets = node_offsets<dim, pattern>(k.b.window.node_strides());
          x.read(k.b.nodes, k.b.trial, offsets, k.b.points.stencil[k.face.slot].first_node);
          trial    = trial_at_point<dim, pattern>(k.b, k.face.slot, x, basis);
          pressure = 0.;
          for (int A = 0; A < n; ++A)
            {
              at_face[A] = basis.linear.value[A];
              for (int R = 0; R < dim; ++R)
                at_face[A] += basis.linear.gradient[R][A] * k.face.offset[R];
              pressure += at_face[A] * x.unknown[dim][A];
            }
        }

        PorousBasis<dim, pattern> basis;
        StencilTrial<dim, n>      x;
        PoreTrial<dim>            trial;
        double                    at_face[n];
        double                    pressure;
      };

      /** The face's area over the volume whose factors a PoreResponse holds. */
      void
      scale_area(const PoreTrial<dim> &trial, double (&area)[dim]) const
      {
        for (int R = 0; R < dim; ++R)
          area[R] = face.area[R] / (trial.volume * trial.determinant);
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

    template <int dim, class Material>
    struct SurfaceResidualKernel : SurfaceKernel<dim, Material>
    {
      std::vector<double> &residual;
      std::vector<double> &outflow; ///< volume that leaves, by surface

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim, Material>::template Values<pattern> Values;
        const Values                                                            v(*this);
        const PoreResponse<dim> r = respond<false>(this->b, this->face.slot, v.trial);
        if (!r.valid)
          return; // the batch's own kernel has said so
        double area[dim];
        this->scale_area(v.trial, area);
        double volume =
          this->penalty() * (v.pressure - this->b.trial.surface_pressures[this->face.surface]);
        for (int R = 0; R < dim; ++R)
          volume -= area[R] * r.fluid_gradient[R];
        outflow[this->face.surface] += volume;
        for (int A = 0; A < Values::n; ++A)
          residual[std::size_t(v.x.local[A]) * (dim + 1) + dim] += v.at_face[A] * volume;
      }
    };

    template <int dim, class Material>
    struct SurfaceTangentKernel : SurfaceKernel<dim, Material>
    {
      NodeMatrix<dim> &tangent;

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim, Material>::template Values<pattern> Values;
        constexpr int                                                           n = Values::n;
        const auto              slots = pair_slots<dim, pattern>(tangent);
        const Values            v(*this);
        const PoreResponse<dim> r = respond<true>(this->b, this->face.slot, v.trial);
        double                  area[dim];
        this->scale_area(v.trial, area);
        const double penalty = this->penalty();
        // slope of the volume that leaves by the unknowns of node B
        double slope[dim + 1][n];
        for (int B = 0; B < n; ++B)
          {
            const double N = v.basis.linear.value[B];
            slope[dim][B]  = penalty * v.at_face[B];
            for (int R = 0; R < dim; ++R)
              {
                double by_p = r.pp_weight[R] * N;
                for (int S = 0; S < dim; ++S)
                  by_p += r.pp[R][S] * v.basis.linear.gradient[S][B];
                slope[dim][B] -= area[R] * by_p;
              }
            for (int m = 0; m < dim; ++m)
              {
                slope[m][B] = 0.;
                for (int R = 0; R < dim; ++R)
                  {
                    double by_u = r.pu_inertia[R][m] * N;
                    for (int S = 0; S < dim; ++S)
                      by_u += r.pu[R][m][S] * v.basis.linear.gradient[S][B];
                    slope[m][B] -= area[R] * by_u;
                  }
              }
          }
        for (int A = 0; A < n; ++A)
          {
            double *row = tangent.row(v.x.local[A], dim);
            for (int B = 0; B < n; ++B)
              for (int m = 0; m <= dim; ++m)
                row[slots[A][B] * (dim + 1) + m] += v.at_face[A] * slope[m][B];
          }
      }
    };

    /** Calls run(face) for the faces of a batch's points. */
    template <int dim, class Material, typename Run>
    inline void
    for_faces(const PorousBatch<dim, Material> &b, const Run &run)
    {
      for (const SurfacePoint<dim> &face : b.trial.surface)
        if (face.slot >= b.batch.begin && face.slot < b.batch.end)
          run(face);
    }
  } // namespace internal
} // namespace kedge

#endif
