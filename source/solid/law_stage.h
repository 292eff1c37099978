#ifndef kedge_solid_law_stage_h
#define kedge_solid_law_stage_h

#include <kedge/materials/lane_by_lane.h>
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
      const BatchContext<dim>   &context;
      const InPacks<MaterialLaw> material;

      template <bool with_tangent>
      ForceStress<dim, Pack>
      evaluate(const StressState<dim, Pack> &state,
               const Pack (&gradient)[dim][dim],
               const HistoryOf<Law, Pack> &history,
               const Pack &) const
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
      const BatchContext<dim>   &context;
      const InPacks<MaterialLaw> material;

      template <bool with_tangent>
      ForceStress<dim, Pack>
      evaluate(const StressState<dim, Pack> &state,
               const Pack (&gradient)[dim][dim],
               const HistoryOf<Law, Pack> &history,
               const Pack                 &strain) const
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
        return context.dilatation->force_strain(rule, context.patch.points.group[slot]);
      }
    };

    /** Force stresses of the points in the lanes. */
    template <int dim, bool with_tangent, class Law>
    void
    evaluate_law(const BatchContext<dim> &context,
                 const Material          &material,
                 const PackOfSlots       &slots,
                 const Pack (&gradient)[dim][dim],
                 ForceStress<dim, Pack> &result)
    {
      using MaterialLaw             = typename Law::Law;
      const StepPoints<dim> &points = context.patch.points;
      const Law law{context, InPacks<MaterialLaw>(*std::get_if<MaterialLaw>(&material))};
      Pack      strain = 0.;
      for (unsigned int lane = 0; lane < pack_width; ++lane)
        strain.set(lane, law.strain_of_group(slots.slot(lane)));
      result = law.template evaluate<with_tangent>(pack_of_states(points, slots),
                                                   gradient,
                                                   pack_of_histories<MaterialLaw>(points, slots),
                                                   strain);
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
