#ifndef kedge_materials_material_h
#define kedge_materials_material_h

#include <kedge/materials/critical_state.h>
#include <kedge/materials/drucker_prager.h>
#include <kedge/materials/modified_cam_clay.h>
#include <kedge/materials/mohr_coulomb.h>
#include <kedge/materials/tresca.h>
#include <kedge/materials/undrained_von_mises.h>
#include <kedge/materials/von_mises.h>

#include <string>
#include <variant>
#include <vector>

namespace kedge
{
  /** Any material a body can have; std::visit it once per batch of points. */
  using Material = std::variant<Hencky,
                                VonMises,
                                ImprovedHencky,
                                CriticalState<Hencky>,
                                CriticalState<ImprovedHencky>,
                                Tresca,
                                UndrainedVonMises,
                                DruckerPrager,
                                MohrCoulomb,
                                ModifiedCamClay>;

  inline Material
  make_material(const MaterialParameters &parameters)
  {
    switch (parameters.kind)
      {
        case MaterialKind::von_mises:
          return VonMises(parameters);
        case MaterialKind::improved_hencky:
          return ImprovedHencky(parameters);
        case MaterialKind::critical_state:
          return CriticalState<Hencky>(parameters);
        case MaterialKind::critical_state_improved:
          return CriticalState<ImprovedHencky>(parameters);
        case MaterialKind::tresca:
          return Tresca(parameters);
        case MaterialKind::undrained_von_mises:
          return UndrainedVonMises(parameters);
        case MaterialKind::drucker_prager:
          return DruckerPrager(parameters);
        case MaterialKind::mohr_coulomb:
          return MohrCoulomb(parameters);
        case MaterialKind::modified_cam_clay:
          return ModifiedCamClay(parameters);
        case MaterialKind::hencky:
        default:
          return Hencky(parameters);
      }
  }

  /** The columns of its history. */
  std::vector<Column>
  columns_of(const Material &material);

  /** Whether it answers by more than the elastic strain. */
  inline bool
  has_history(const Material &material)
  {
    return !columns_of(material).empty();
  }

  /**
   * What laws remember or take from the place, of all laws, each name once: a
   * point's memory in this order. Columns of several laws that have the same
   * name mean the same.
   */
  const std::vector<Column> &
  memory_columns();

  /** The place of a column in memory_columns(); their number if there is none of that name. */
  unsigned int
  memory_index(const std::string &name);

  /** For each of the columns of a material its memory_index(), not_in_memory or is_time_step. */
  std::vector<unsigned int>
  memory_indices(const Material &material);

  /**
   * For each of the columns of a material of these @p parameters the constant
   * of place that it is, or a null pointer.
   */
  std::vector<const SpatialConstant *>
  constants_of_place(const Material &material, const MaterialParameters &parameters);

  /** The numbers of the columns at the start: constants at X = 0, else 0. */
  std::vector<double>
  start_history(const Material &material, const MaterialParameters &parameters);

  /** Whether it has plastic strains, stores energy in hardening and dissipates. */
  inline bool
  yields(const Material &material)
  {
    return std::visit(
      [](const auto &m) {
        return m.yields;
      },
      material);
  }

  /** P-wave modulus in the undeformed state [Pa]. */
  inline double
  p_wave_modulus(const Material &material)
  {
    return std::visit(
      [](const auto &m) {
        return m.p_wave_modulus();
      },
      material);
  }
} // namespace kedge

#endif
