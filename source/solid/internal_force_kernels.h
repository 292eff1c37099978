#ifndef kedge_solid_internal_force_kernels_h
#define kedge_solid_internal_force_kernels_h

#include <kedge/solid/block_sum.h>
#include <kedge/solid/points_in_lanes.h>

namespace kedge
{
  namespace internal
  {
    /** f_A = sum_p V0 P dN_A/dx_n over a batch. */
    template <int dim>
    struct ForceKernel
    {
      const BatchContext<dim> &context;
      const BatchLaw<dim>     &law;
      std::vector<double>     &force;
      PointStatus             &status;

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int               n      = stencil_size<dim>(pattern);
        const StepPoints<dim>      &points = context.patch.points;
        LanesOfPoints<dim, pattern> lanes(context);
        ForceStress<dim, Pack>      stress;
        alignas(64) double          sum[dim][n] = {};
        for (unsigned int begin = context.batch.begin; begin < context.batch.end;)
          {
            const PackOfSlots slots(begin, context.batch.end);
            lanes.read(slots);
            law.evaluate(slots, lanes.gradient, stress);
            status.failed_slot = slots.first_failure(stress.valid, PointStatus::none);
            if (!status.ok())
              return;
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                const unsigned int slot  = slots.slot(lane);
                const auto        &basis = lanes.basis[lane];
                for (int p = 0; p < dim; ++p)
                  for (int R = 0; R < dim; ++R)
                    {
                      const double factor = points.volume[slot] * stress.stress[p][R][lane];
                      for (int A = 0; A < n; ++A)
                        sum[p][A] += factor * basis.gradient[R][A];
                    }
                if (lanes.is_last(slot))
                  for (int A = 0; A < n; ++A)
                    for (int p = 0; p < dim; ++p)
                      {
                        force[std::size_t(lanes.local[lane][A]) * dim + p] += sum[p][A];
                        sum[p][A] = 0.;
                      }
              }
          }
      }
    };

    /** The point in a lane for BlockSum: dN_A/dx_R D_pRmS dN_B/dx_S, times its volume. */
    template <int dim, int n>
    struct StiffnessOfPoint
    {
      const unsigned int lane;
      const double       volume;
      const Pack (&tangent)[dim][dim][dim][dim];
      const BasisValues<dim, n> &basis;

      static constexpr int max_tests = dim;

      static constexpr int
      n_tests(const int)
      {
        return dim;
      }

      const double *
      test(const int R) const
      {
        return basis.gradient[R];
      }

      void
      contract(const int p, const int R, double (&column)[dim][n]) const
      {
        for (int m = 0; m < dim; ++m)
          {
            double weight[dim];
            for (int S = 0; S < dim; ++S)
              weight[S] = volume * tangent[p][R][m][S][lane];
            for (int B = 0; B < n; ++B)
              {
                column[m][B] = weight[0] * basis.gradient[0][B];
                for (int S = 1; S < dim; ++S)
                  column[m][B] += weight[S] * basis.gradient[S][B];
              }
          }
      }
    };

    /** K_ApBm = sum_p V0 dN_A/dx_R (dP_pR/dA_mS) dN_B/dx_S over a batch. */
    template <int dim>
    struct StiffnessKernel
    {
      const BatchContext<dim> &context;
      const BatchLaw<dim>     &law;
      NodeMatrix<dim>         &stiffness;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto                  rows   = row_slots<dim, pattern>(stiffness);
        const StepPoints<dim>      &points = context.patch.points;
        LanesOfPoints<dim, pattern> lanes(context);
        ForceStress<dim, Pack>      stress;
        BlockSum<dim, pattern>      sum;
        for (unsigned int begin = context.batch.begin; begin < context.batch.end;)
          {
            const PackOfSlots slots(begin, context.batch.end);
            lanes.read(slots);
            law.evaluate(slots, lanes.gradient, stress);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                const unsigned int                                      slot = slots.slot(lane);
                const StiffnessOfPoint<dim, stencil_size<dim>(pattern)> point{lane,
                                                                              points.volume[slot],
                                                                              stress.tangent,
                                                                              lanes.basis[lane]};
                if (lanes.is_last(slot))
                  sum.add_last_point(point, rows, lanes.local[lane], stiffness);
                else
                  sum.add_point(point);
              }
          }
      }
    };
  } // namespace internal
} // namespace kedge

#endif
