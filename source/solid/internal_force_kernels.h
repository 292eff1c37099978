#ifndef kedge_solid_internal_force_kernels_h
#define kedge_solid_internal_force_kernels_h

#include <kedge/solid/group_dilatation.h>
#include <kedge/stress/mean_dilatation.h>

namespace kedge
{
  namespace internal
  {
    /** What the kernels of one batch share. */
    template <int dim>
    struct BatchContext
    {
      const StepPoints<dim>                 &points;
      const LatticeWindow<dim>              &window;
      const ActiveNodes<dim>                &nodes;
      const std::vector<double>             &displacement;
      const typename StepPoints<dim>::Batch &batch;
      double                                 alpha;
      const GroupDilatation                 *dilatation; ///< if points.is_grouped(batch)
    };

    /** The force stress of each point by itself. */
    template <int dim, StressRule rule, class Material>
    struct PointwiseLaw
    {
      const BatchContext<dim> &context;
      const Material          &material;

      template <bool with_tangent>
      ForceStress<dim>
      evaluate(const unsigned int slot, const double (&gradient)[dim][dim]) const
      {
        return evaluate_force_stress<dim, with_tangent, rule>(
          material,
          context.points.stress_state[slot],
          gradient,
          context.alpha,
          context.points.template history_of<Material>(slot));
      }
    };

    /** The force stress with the pressure of the point's group; the tangent is at this pressure. */
    template <int dim, StressRule rule, class Material>
    struct GroupLaw
    {
      const BatchContext<dim> &context;
      const Material          &material;

      template <bool with_tangent>
      ForceStress<dim>
      evaluate(const unsigned int slot, const double (&gradient)[dim][dim]) const
      {
        const double strain = context.dilatation->force_strain(rule, context.points.group[slot]);
        return evaluate_mean_force_stress<dim, with_tangent, rule>(
          material,
          material.bulk_modulus * strain,
          context.points.stress_state[slot],
          gradient,
          context.alpha,
          context.points.template history_of<Material>(slot));
      }
    };

    /** Calls run(law) with the law of a batch: once per batch. */
    template <int dim, typename Run>
    void
    dispatch_law(const BatchContext<dim> &context,
                 const Material          &material,
                 const StressRule         rule,
                 const Run               &run)
    {
      const bool conserving = rule == StressRule::conserving;
      std::visit(
        [&](const auto &m) {
          using M = std::decay_t<decltype(m)>;
          if (context.dilatation)
            {
              if constexpr (M::decoupled_volume)
                {
                  if (conserving)
                    run(GroupLaw<dim, StressRule::conserving, M>{context, m});
                  else
                    run(GroupLaw<dim, StressRule::at_configuration, M>{context, m});
                }
              else
                AssertThrow(false,
                            dealii::ExcMessage("This material cannot share its change of volume."));
            }
          else if (conserving)
            run(PointwiseLaw<dim, StressRule::conserving, M>{context, m});
          else
            run(PointwiseLaw<dim, StressRule::at_configuration, M>{context, m});
        },
        material);
    }

    /** Local node numbers and displacements, component-major, of a stencil. */
    template <int dim, int n>
    struct StencilDisplacement
    {
      std::array<int, n> local;
      double             value[dim][n];

      void
      read(const BatchContext<dim>           &context,
           const std::array<unsigned int, n> &offsets,
           const unsigned int                 first_node)
      {
        for (int A = 0; A < n; ++A)
          {
            local[A]        = context.nodes.local(first_node + offsets[A]);
            const double *u = &context.displacement[std::size_t(local[A]) * dim];
            for (int d = 0; d < dim; ++d)
              value[d][A] = u[d];
          }
      }
    };

    template <int dim, int n>
    inline void
    displacement_gradient(const StencilDisplacement<dim, n> &u,
                          const BasisValues<dim, n>         &basis,
                          double (&gradient)[dim][dim])
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            double sum = 0.;
            for (int A = 0; A < n; ++A)
              sum += u.value[i][A] * basis.gradient[j][A];
            gradient[i][j] = sum;
          }
    }

    /** f_A = sum_p V0 P dN_A/dx_n over a batch. */
    template <int dim, class Law>
    struct ForceKernel
    {
      const BatchContext<dim> &context;
      const Law               &law;
      std::vector<double>     &force;
      PointStatus             &status;

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int          n       = stencil_size<dim>(pattern);
        const auto             offsets = node_offsets<dim, pattern>(context.window.node_strides());
        const StepPoints<dim> &points  = context.points;
        StencilDisplacement<dim, n> u;
        for (unsigned int slot = context.batch.begin; slot < context.batch.end;)
          {
            const unsigned int first       = points.stencil[slot].first_node;
            double             sum[dim][n] = {};
            u.read(context, offsets, first);
            for (; slot < context.batch.end && points.stencil[slot].first_node == first; ++slot)
              {
                const auto basis = expand<dim, pattern>(points.stencil[slot]);
                double     gradient[dim][dim];
                displacement_gradient(u, basis, gradient);
                const ForceStress<dim> stress = law.template evaluate<false>(slot, gradient);
                if (!stress.valid)
                  {
                    status.failed_slot = slot;
                    return;
                  }
                for (int p = 0; p < dim; ++p)
                  for (int R = 0; R < dim; ++R)
                    {
                      const double factor = points.volume[slot] * stress.stress[p][R];
                      for (int A = 0; A < n; ++A)
                        sum[p][A] += factor * basis.gradient[R][A];
                    }
              }
            for (int A = 0; A < n; ++A)
              for (int p = 0; p < dim; ++p)
                force[std::size_t(u.local[A]) * dim + p] += sum[p][A];
          }
      }
    };

    /** K_ApBm = sum_p V0 dN_A/dx_R (dP_pR/dA_mS) dN_B/dx_S over a batch. */
    template <int dim, class Law>
    struct StiffnessKernel
    {
      const BatchContext<dim> &context;
      const Law               &law;
      NodeMatrix<dim>         &stiffness;

      template <int n>
      struct Sum
      {
        double value[n][dim][dim][n]; ///< [A][p][m][B]
      };

      template <int n>
      static void
      add_point(const double               volume,
                const ForceStress<dim>    &stress,
                const BasisValues<dim, n> &basis,
                Sum<n>                    &sum)
      {
        for (int A = 0; A < n; ++A)
          for (int p = 0; p < dim; ++p)
            for (int m = 0; m < dim; ++m)
              {
                double factor[dim];
                for (int S = 0; S < dim; ++S)
                  {
                    factor[S] = 0.;
                    for (int R = 0; R < dim; ++R)
                      factor[S] += basis.gradient[R][A] * stress.tangent[p][R][m][S];
                    factor[S] *= volume;
                  }
                double *entry = sum.value[A][p][m];
                for (int B = 0; B < n; ++B)
                  {
                    double add = factor[0] * basis.gradient[0][B];
                    for (int S = 1; S < dim; ++S)
                      add += factor[S] * basis.gradient[S][B];
                    entry[B] += add;
                  }
              }
      }

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int          n       = stencil_size<dim>(pattern);
        const auto             offsets = node_offsets<dim, pattern>(context.window.node_strides());
        const auto             slots   = pair_slots<dim, pattern>(stiffness);
        const StepPoints<dim> &points  = context.points;
        StencilDisplacement<dim, n> u;
        Sum<n>                      sum;
        for (unsigned int slot = context.batch.begin; slot < context.batch.end;)
          {
            const unsigned int first = points.stencil[slot].first_node;
            u.read(context, offsets, first);
            std::fill_n(&sum.value[0][0][0][0], n * dim * dim * n, 0.);
            for (; slot < context.batch.end && points.stencil[slot].first_node == first; ++slot)
              {
                const auto basis = expand<dim, pattern>(points.stencil[slot]);
                double     gradient[dim][dim];
                displacement_gradient(u, basis, gradient);
                const ForceStress<dim> stress = law.template evaluate<true>(slot, gradient);
                add_point<n>(points.volume[slot], stress, basis, sum);
              }
            for (int A = 0; A < n; ++A)
              for (int p = 0; p < dim; ++p)
                {
                  double *row = stiffness.row(u.local[A], p);
                  for (int B = 0; B < n; ++B)
                    for (int m = 0; m < dim; ++m)
                      row[slots[A][B] * dim + m] += sum.value[A][p][m][B];
                }
          }
      }
    };

    template <int dim>
    void
    add_batch_force(const BatchContext<dim> &context,
                    const Material          &material,
                    const StressRule         rule,
                    std::vector<double>     &force,
                    PointStatus             &status)
    {
      dispatch_law(context, material, rule, [&](const auto &law) {
        using Law = std::decay_t<decltype(law)>;
        dispatch_pattern<dim>(context.batch.pattern,
                              ForceKernel<dim, Law>{context, law, force, status});
      });
    }

    template <int dim>
    void
    add_batch_stiffness(const BatchContext<dim> &context,
                        const Material          &material,
                        const StressRule         rule,
                        NodeMatrix<dim>         &stiffness)
    {
      dispatch_law(context, material, rule, [&](const auto &law) {
        using Law = std::decay_t<decltype(law)>;
        dispatch_pattern<dim>(context.batch.pattern,
                              StiffnessKernel<dim, Law>{context, law, stiffness});
      });
    }
  } // namespace internal
} // namespace kedge

#endif
