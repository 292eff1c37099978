#ifndef kedge_materials_material_h
#define kedge_materials_material_h

#include <kedge/materials/von_mises.h>

#include <variant>

namespace kedge
{
  /** Any material a body can have; std::visit it once per batch of points. */
  using Material = std::variant<Hencky, VonMises>;

  inline Material
  make_material(const MaterialParameters &parameters)
  {
    switch (parameters.kind)
      {
        case MaterialKind::von_mises:
          return VonMises(parameters);
        case MaterialKind::hencky:
        default:
          return Hencky(parameters);
      }
  }

  /** Whether it needs MaterialHistory: it yields, stores in hardening, dissipates. */
  inline bool
  has_history(const Material &material)
  {
    return std::visit(
      [](const auto &m) {
        return m.has_history;
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
