#ifndef kedge_materials_material_h
#define kedge_materials_material_h

#include <kedge/materials/critical_state.h>
#include <kedge/materials/von_mises.h>

#include <variant>

namespace kedge
{
  /** Any material a body can have; std::visit it once per batch of points. */
  using Material = std::
    variant<Hencky, VonMises, ImprovedHencky, CriticalState<Hencky>, CriticalState<ImprovedHencky>>;

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
        case MaterialKind::hencky:
        default:
          return Hencky(parameters);
      }
  }

  /** Whether it needs MaterialHistory. */
  inline bool
  has_history(const Material &material)
  {
    return std::visit(
      [](const auto &m) {
        return m.has_history;
      },
      material);
  }

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
