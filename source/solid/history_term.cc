#include <kedge/solid/history_term.h>

namespace kedge
{
  template <int dim>
  HistoryTerm<dim>::HistoryTerm(const unsigned int           field,
                                const Patch<dim>            &patch,
                                const std::vector<Material> &material_of_body,
                                const MemoryColumns         &columns_of_body)
    : field(field)
    , patch(patch)
    , material_of_body(material_of_body)
    , columns_of_body(columns_of_body)
    , has_plasticity(std::any_of(material_of_body.begin(), material_of_body.end(), yields))
  {}



  template <int dim>
  void
  HistoryTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    strain_energy = ledger.declare(
      {"strain_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    if (!has_plasticity)
      return;
    hardening_energy = ledger.declare(
      {"hardening_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    dissipation = ledger.declare(
      {"plastic_dissipation", "J", Section::energy, Kind::present, Role::lost, "energy"});
  }



  template <int dim>
  Answer
  HistoryTerm<dim>::finish(const Trial<dim> &trial)
  {
    const unsigned int failed =
      evaluate_point_updates(material_of_body, patch, trial.displacement(field), updates);
    return failed == PointStatus::none ? Answer()
                                       : Answer::failure(patch.describe_point(failed) +
                                                         " has det F <= 0 at the end of the step");
  }



  template <int dim>
  void
  HistoryTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &cloud)
  {
    const std::vector<unsigned int>    &slot_of = patch.points.slot_of;
    std::vector<dealii::Tensor<2, dim>> deformation_gradients(patch.points.size());
    const auto apply = [&](const unsigned int number, dealii::Point<dim> &, auto &state) {
      const unsigned int slot = slot_of[number];
      if (slot == StepPoints<dim>::no_slot)
        return;
      apply_point_update(updates[slot],
                         columns_of_body[static_cast<unsigned int>(state.body)],
                         state);
      deformation_gradients[slot] = state.deformation_gradient;
    };
    if (cloud.stores_extras())
      cloud.update_each(apply);
    else
      cloud.update_each_core(apply);
    const auto stretches = stretches_along_axes(deformation_gradients);
    cloud.update_each_core(
      [&](const unsigned int number, dealii::Point<dim> &, PointCore<dim> &state) {
        const unsigned int slot = slot_of[number];
        for (int d = 0; d < dim && slot != StepPoints<dim>::no_slot; ++d)
          state.half_lengths[d] = state.reference_half_lengths[d] * stretches[slot][d];
      });
  }



  template <int dim>
  void
  HistoryTerm<dim>::book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const
  {
    // in the order of the slots, which does not depend on how the run got here
    std::vector<std::array<double, 3>> energies(patch.points.size());
    cloud.for_each_core([&](const unsigned int number,
                            const std::uint64_t,
                            const dealii::Point<dim> &,
                            const PointCore<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        energies[slot] = {{state.reference_volume * state.strain_energy, 0., 0.}};
    });
    if (has_plasticity)
      cloud.for_each([&](const unsigned int number,
                         const std::uint64_t,
                         const dealii::Point<dim> &,
                         const PointState<dim> &state) {
        const unsigned int slot = patch.points.slot_of[number];
        const double       V0   = state.reference_volume;
        if (slot == StepPoints<dim>::no_slot)
          return;
        energies[slot][1] = V0 * state.hardening_energy;
        energies[slot][2] = V0 * state.plastic_dissipation;
      });
    double sums[3] = {0., 0., 0.};
    for (const auto &of_point : energies)
      for (int e = 0; e < 3; ++e)
        sums[e] += of_point[e];
    ledger.book(strain_energy, sums[0]);
    if (!has_plasticity)
      return;
    ledger.book(hardening_energy, sums[1]);
    ledger.book(dissipation, sums[2]);
  }

  template class HistoryTerm<2>;
  template class HistoryTerm<3>;
} // namespace kedge
