#ifndef kedge_solid_law_stage_h
#define kedge_solid_law_stage_h

#include <kedge/solid/batch_law.h>
#include <kedge/stress/mean_dilatation.h>

namespace kedge
{
  namespace internal
  {
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
    inline void
    evaluate_pack(const Law             &law,
                  const StepPoints<dim> &points,
                  const PackOfSlots     &slots,
                  const Pack (&gradient)[dim][dim],
                  ForceStress<dim, Pack> &result)
    {
      using Material = typename Law::Law;
      if constexpr (Material::takes_packs)
        {
          Pack strain = 0.;
          for (unsigned int lane = 0; lane < pack_width; ++lane)
            strain.set(lane, law.strain_of_group(slots.slot(lane)));
          result = law.template evaluate<with_tangent>(pack_of_states(points, slots),
                                                       gradient,
                                                       pack_of_histories<Material>(points, slots),
                                                       strain);
        }
      else
        {
          result.valid = PackMask{};
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
        }
    }

    template <int dim, bool with_tangent, class Law>
    void
    evaluate_law(const BatchContext<dim> &context,
                 const Material          &material,
                 const PackOfSlots       &slots,
                 const Pack (&gradient)[dim][dim],
                 ForceStress<dim, Pack> &result)
    {
      const Law law{context, *std::get_if<typename Law::Law>(&material)};
      evaluate_pack<dim, with_tangent>(law, context.points, slots, gradient, result);
    }

    template <int dim, template <int, StressRule, class> class Kind, class MaterialLaw>
    LawFunction<dim>
    law_function_of_kind(const LawChoice &choice)
    {
      using Conserving = Kind<dim, StressRule::conserving, MaterialLaw>;
      using Configured = Kind<dim, StressRule::at_configuration, MaterialLaw>;
      if (choice.rule == StressRule::conserving)
        return choice.with_tangent ? &evaluate_law<dim, true, Conserving>
                                   : &evaluate_law<dim, false, Conserving>;
      return choice.with_tangent ? &evaluate_law<dim, true, Configured>
                                 : &evaluate_law<dim, false, Configured>;
    }

    template <int dim, class MaterialLaw>
    LawFunction<dim>
    law_function_of(const LawChoice &choice)
    {
      if (choice.grouped)
        {
          if constexpr (MaterialLaw::decoupled_volume)
            return law_function_of_kind<dim, GroupLaw, MaterialLaw>(choice);
          else
            AssertThrow(false,
                        dealii::ExcMessage("This material cannot share its change of volume."));
        }
      return law_function_of_kind<dim, PointwiseLaw, MaterialLaw>(choice);
    }

/** Compiles the stage of a law. */
#define KEDGE_INSTANTIATE_LAW(MaterialLaw)                                    \
  template LawFunction<2> law_function_of<2, MaterialLaw>(const LawChoice &); \
  template LawFunction<3> law_function_of<3, MaterialLaw>(const LawChoice &);
  } // namespace internal
} // namespace kedge

#endif
