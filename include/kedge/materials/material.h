#ifndef kedge_materials_material_h
#define kedge_materials_material_h

#include <kedge/materials/hencky.h>

#include <variant>

namespace kedge
{
  /** Any material a body can have; std::visit it once per batch of points. */
  using Material = std::variant<Hencky>;

  inline Material
  make_material(const MaterialParameters &parameters)
  {
    switch (parameters.kind)
      {
        case MaterialKind::hencky:
        default:
          return Hencky(parameters);
      }
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
