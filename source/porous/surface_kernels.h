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
     * q is the flow at the point; N_A(face) see functions_at_face().
     */
    template <int dim>
    struct SurfaceKernel
    {
      const PorousBatch<dim>  &b;
      const SurfacePoint<dim> &face;

      template <unsigned int pattern>
      struct Values
      {
        static constexpr int n = stencil_size<dim>(pattern);

        explicit Values(const SurfaceKernel &k)
          : slots(k.face.slot, k.face.slot + 1)
          , lanes(k.b)
          , at_face(expand<dim, pattern>(k.face.functions))
        {
          lanes.read(slots);
          pressure = 0.;
          for (int A = 0; A < n; ++A)
            pressure += at_face.value[A] * lanes.of_points.nodal[dim][A];
        }

        const BasisValues<dim, n> &
        basis() const
        {
          return lanes.of_points.basis[0];
        }

        int
        local(const int A) const
        {
          return lanes.of_points.local[0][A];
        }

        PackOfSlots               slots; ///< the point alone, in lane 0
        PorousLanes<dim, pattern> lanes;
        BasisValues<dim, n>       at_face; ///< its values
        double                    pressure;
      };

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
      std::vector<double> &outflow; ///< volume that leaves, by surface

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim>::template Values<pattern> Values;
        const Values                                                  v(*this);
        PoreResponse<dim>                                             r;
        respond<false>(this->b, v.slots, v.lanes.trial, r);
        if (!r.valid[0])
          return; // the batch's own kernel has said so
        double area[dim];
        this->scale_area(v.lanes.trial, area);
        double volume =
          this->penalty() * (v.pressure - this->b.trial.surface_pressures[this->face.surface]);
        for (int R = 0; R < dim; ++R)
          volume -= area[R] * r.fluid_gradient[R][0];
        outflow[this->face.surface] += volume;
        for (int A = 0; A < Values::n; ++A)
          residual[std::size_t(v.local(A)) * (dim + 1) + dim] += v.at_face.value[A] * volume;
      }
    };

    template <int dim>
    struct SurfaceTangentKernel : SurfaceKernel<dim>
    {
      NodeMatrix<dim> &tangent;

      template <unsigned int pattern>
      void
      run() const
      {
        typedef typename SurfaceKernel<dim>::template Values<pattern> Values;
        constexpr int                                                 n = Values::n;
        const auto        rows = row_slots<dim, pattern>(tangent);
        const Values      v(*this);
        PoreResponse<dim> r;
        respond<true>(this->b, v.slots, v.lanes.trial, r);
        double area[dim];
        this->scale_area(v.lanes.trial, area);
        const double penalty = this->penalty();
        // slope of the volume that leaves by the unknowns of node B
        double slope[dim + 1][n];
        for (int B = 0; B < n; ++B)
          {
            const double N = v.basis().value[B];
            slope[dim][B]  = penalty * v.at_face.value[B];
            for (int R = 0; R < dim; ++R)
              {
                double by_p = r.pp_weight[R][0] * N;
                for (int S = 0; S < dim; ++S)
                  by_p += r.pp[R][S][0] * v.basis().gradient[S][B];
                slope[dim][B] -= area[R] * by_p;
              }
            for (int m = 0; m < dim; ++m)
              {
                slope[m][B] = 0.;
                for (int R = 0; R < dim; ++R)
                  {
                    double by_u = r.pu_inertia[R][m][0] * N;
                    for (int S = 0; S < dim; ++S)
                      by_u += r.pu[R][m][S][0] * v.basis().gradient[S][B];
                    slope[m][B] -= area[R] * by_u;
                  }
              }
          }
        double values[n * (dim + 1)];
        for (int A = 0; A < n; ++A)
          {
            for (int B = 0; B < n; ++B)
              for (int m = 0; m <= dim; ++m)
                values[B * (dim + 1) + m] = v.at_face.value[A] * slope[m][B];
            add_to_row<dim, pattern, dim + 1>(rows[A], values, tangent.row(v.local(A), dim));
          }
      }
    };

    /** Calls run(face) for the faces of a batch's points. */
    template <int dim, typename Run>
    inline void
    for_faces(const PorousBatch<dim> &b, const Run &run)
    {
      for (const SurfacePoint<dim> &face : b.trial.surface)
        if (face.slot >= b.context.batch.begin && face.slot < b.context.batch.end)
          run(face);
    }
  } // namespace internal
} // namespace kedge

#endif
