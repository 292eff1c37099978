#ifndef kedge_solid_internal_force_kernels_h
#define kedge_solid_internal_force_kernels_h

#include "block_sum.h"

#include <kedge/solid/group_dilatation.h>
#include <kedge/stress/mean_dilatation.h>
#include <kedge/fields/point_packs.h>

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
    template <int dim, StressRule rule, class MaterialLaw>
    struct PointwiseLaw
    {
      using Law = MaterialLaw;
      const BatchContext<dim> &context;
      const Law               &material;

      template <bool with_tangent, typename Number>
      ForceStress<dim, Number>
      evaluate(const StressState<dim, Number> &state,
               const Number (&gradient)[dim][dim],
               const HistoryOf<Law, Number> &history,
               const Number &) const
      {
        return evaluate_force_stress<dim, with_tangent, rule>(material,
                                                              state,
                                                              gradient,
                                                              context.alpha,
                                                              history);
      }

      double
      strain_of_group(const unsigned int) const
      {
        return 0.;
      }
    };

    /** The force stress with the pressure of the point's group; the tangent is at this pressure. */
    template <int dim, StressRule rule, class MaterialLaw>
    struct GroupLaw
    {
      using Law = MaterialLaw;
      const BatchContext<dim> &context;
      const Law               &material;

      template <bool with_tangent, typename Number>
      ForceStress<dim, Number>
      evaluate(const StressState<dim, Number> &state,
               const Number (&gradient)[dim][dim],
               const HistoryOf<Law, Number> &history,
               const Number                 &strain) const
      {
        return evaluate_mean_force_stress<dim, with_tangent, rule>(material,
                                                                   material.bulk_modulus * strain,
                                                                   state,
                                                                   gradient,
                                                                   context.alpha,
                                                                   history);
      }

      double
      strain_of_group(const unsigned int slot) const
      {
        return context.dilatation->force_strain(rule, context.points.group[slot]);
      }
    };

    /** Force stresses of the points in the lanes. */
    template <int dim, bool with_tangent, class Law>
    inline ForceStress<dim, Pack>
    evaluate_pack(const Law             &law,
                  const StepPoints<dim> &points,
                  const PackOfSlots     &slots,
                  const Pack (&gradient)[dim][dim])
    {
      using Material = typename Law::Law;
      if constexpr (Material::takes_packs)
        {
          Pack strain = 0.;
          for (unsigned int lane = 0; lane < pack_width; ++lane)
            strain.set(lane, law.strain_of_group(slots.slot(lane)));
          return law.template evaluate<with_tangent>(pack_of_states(points, slots),
                                                     gradient,
                                                     pack_of_histories<Material>(points, slots),
                                                     strain);
        }
      else
        {
          ForceStress<dim, Pack> result{};
          for (unsigned int lane = 0; lane < slots.count; ++lane)
            {
              const unsigned int slot = slots.slot(lane);
              double             A[dim][dim];
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  A[i][j] = gradient[i][j][lane];
              const auto one =
                law.template evaluate<with_tangent>(points.stress_state[slot],
                                                    A,
                                                    points.template history_of<Material>(slot),
                                                    law.strain_of_group(slot));
              result.valid.lanes[lane] = one.valid ? -1 : 0;
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  {
                    result.stress[i][j].set(lane, one.stress[i][j]);
                    if constexpr (with_tangent)
                      for (int k = 0; k < dim; ++k)
                        for (int l = 0; l < dim; ++l)
                          result.tangent[i][j][k][l].set(lane, one.tangent[i][j][k][l]);
                  }
            }
          return result;
        }
    }

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

    /** Points in the lanes: their nodes, basis functions and displacement gradients. */
    template <int dim, unsigned int pattern>
    class LanesOfPoints
    {
    public:
      static constexpr int n = stencil_size<dim>(pattern);

      LanesOfPoints(const BatchContext<dim> &context)
        : context(context)
        , offsets(node_offsets<dim, pattern>(context.window.node_strides()))
      {}

      void
      read(const PackOfSlots &slots)
      {
        for (unsigned int lane = 0; lane < slots.count; ++lane)
          {
            const Stencil<dim> &stencil = context.points.stencil[slots.begin + lane];
            if (stencil.first_node != last_node)
              read_displacement(stencil.first_node);
            local[lane] = last_local;
            basis[lane] = expand<dim, pattern>(stencil);
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j)
                {
                  double sum = 0.;
                  for (int A = 0; A < n; ++A)
                    sum += displacement[i][A] * basis[lane].gradient[j][A];
                  gradient[i][j].set(lane, sum);
                }
          }
        for (unsigned int lane = slots.count; lane < pack_width; ++lane)
          for (auto &row : gradient)
            for (Pack &value : row)
              value.set(lane, value[slots.count - 1]);
      }

      std::array<int, n>  local[pack_width]; ///< node numbers
      BasisValues<dim, n> basis[pack_width];
      Pack                gradient[dim][dim] = {}; ///< A = du/dx_n

    private:
      void
      read_displacement(const unsigned int first_node)
      {
        last_node = first_node;
        for (int A = 0; A < n; ++A)
          {
            last_local[A]   = context.nodes.local(first_node + offsets[A]);
            const double *u = &context.displacement[std::size_t(last_local[A]) * dim];
            for (int d = 0; d < dim; ++d)
              displacement[d][A] = u[d];
          }
      }

      const BatchContext<dim>          &context;
      const std::array<unsigned int, n> offsets;
      unsigned int                      last_node = static_cast<unsigned int>(-1);
      std::array<int, n>                last_local{};
      double                            displacement[dim][n];
    };

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
        constexpr int               n      = stencil_size<dim>(pattern);
        const StepPoints<dim>      &points = context.points;
        LanesOfPoints<dim, pattern> lanes(context);
        double                      sum[dim][n] = {};
        for (unsigned int begin = context.batch.begin; begin < context.batch.end;)
          {
            const PackOfSlots slots(begin, context.batch.end);
            lanes.read(slots);
            const auto stress  = evaluate_pack<dim, false>(law, points, slots, lanes.gradient);
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
                if (slot + 1 == context.batch.end ||
                    points.stencil[slot + 1].first_node != points.stencil[slot].first_node)
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

    /** K_ApBm = sum_p V0 dN_A/dx_R (dP_pR/dA_mS) dN_B/dx_S over a batch. */
    template <int dim, class Law>
    struct StiffnessKernel
    {
      const BatchContext<dim> &context;
      const Law               &law;
      NodeMatrix<dim>         &stiffness;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto                  rows   = row_slots<dim, pattern>(stiffness);
        const StepPoints<dim>      &points = context.points;
        LanesOfPoints<dim, pattern> lanes(context);
        BlockSum<dim, pattern>      sum;
        for (unsigned int begin = context.batch.begin; begin < context.batch.end;)
          {
            const PackOfSlots slots(begin, context.batch.end);
            lanes.read(slots);
            const auto stress = evaluate_pack<dim, true>(law, points, slots, lanes.gradient);
            begin += slots.count;
            for (unsigned int lane = 0; lane < slots.count; ++lane)
              {
                const unsigned int slot = slots.slot(lane);
                const bool         last =
                  slot + 1 == context.batch.end ||
                  points.stencil[slot + 1].first_node != points.stencil[slot].first_node;
                if (last)
                  sum.add_last_point(lane,
                                     points.volume[slot],
                                     stress.tangent,
                                     lanes.basis[lane],
                                     rows,
                                     lanes.local[lane],
                                     stiffness);
                else
                  sum.add_point(lane, points.volume[slot], stress.tangent, lanes.basis[lane]);
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
