#ifndef kedge_solid_batch_law_h
#define kedge_solid_batch_law_h

#include <kedge/fields/point_packs.h>
#include <kedge/solid/group_dilatation.h>
#include <kedge/stress/viscous_stress.h>

namespace kedge
{
  namespace internal
  {
    /** What the kernels of one batch share. */
    template <int dim>
    struct BatchContext
    {
      const Patch<dim>                      &patch;
      const std::vector<double>             &displacement; ///< or more values per node, it first
      const typename StepPoints<dim>::Batch &batch;
      double                                 alpha;
      const GroupDilatation                 *dilatation; ///< if patch.points.is_grouped(batch)
      double                                 viscous_modulus = 0.; ///< 2 eta/dt of the body [Pa]
    };

    /**
     * The stage of the law: the force stresses of the points in the lanes, for the
     * displacement gradients of the whole step, by the material of the batch. It knows no
     * nodes. It is compiled once per law, and looked up once per batch.
     */
    template <int dim>
    using LawFunction = void (*)(const BatchContext<dim> &context,
                                 const Material          &material,
                                 const PackOfSlots       &slots,
                                 const Pack (&gradient)[dim][dim],
                                 ForceStress<dim, Pack> &result);

    /** Which LawFunction. */
    struct LawChoice
    {
      StressRule rule;
      bool       grouped; ///< whether the points share their change of volume
      bool       with_tangent;
    };

    /** The LawFunction of a class of material; instantiated in law_of_NAME.cc. */
    template <int dim, class MaterialLaw>
    LawFunction<dim>
    law_function_of(const LawChoice &choice);

    template <int dim>
    inline LawFunction<dim>
    law_function(const Material &material, const LawChoice &choice)
    {
      return std::visit(
        [&](const auto &m) {
          return law_function_of<dim, std::decay_t<decltype(m)>>(choice);
        },
        material);
    }

    /** The law of a batch as its kernels call it. */
    template <int dim>
    struct BatchLaw
    {
      BatchLaw(const BatchContext<dim> &context,
               const Material          &material,
               const StressRule         rule,
               const bool               with_tangent)
        : context(context)
        , material(material)
        , function(law_function<dim>(material, {rule, context.dilatation != nullptr, with_tangent}))
        , with_tangent(with_tangent)
      {}

      void
      evaluate(const PackOfSlots &slots,
               const Pack (&gradient)[dim][dim],
               ForceStress<dim, Pack> &result) const
      {
        function(context, material, slots, gradient, result);
        if (context.viscous_modulus > 0.)
          add_viscosity(slots, gradient, result);
      }

      void
      add_viscosity(const PackOfSlots &slots,
                    const Pack (&gradient)[dim][dim],
                    ForceStress<dim, Pack> &result) const
      {
        Pack modulus;
        for (unsigned int lane = 0; lane < pack_width; ++lane)
          modulus.set(lane,
                      context.viscous_modulus * context.patch.points.determinant[slots.slot(lane)]);
        add_viscous_stress<dim, Pack>(gradient, modulus, with_tangent, result);
      }

      const BatchContext<dim> &context;
      const Material          &material;
      const LawFunction<dim>   function;
      const bool               with_tangent;
    };
  } // namespace internal
} // namespace kedge

#endif
