#ifndef kedge_materials_parameters_h
#define kedge_materials_parameters_h

#include <string>

namespace kedge
{
  enum class MaterialKind
  {
    hencky
  };

  /** A material as the scene names it; density in the reference configuration. */
  struct MaterialParameters
  {
    std::string  name;
    MaterialKind kind          = MaterialKind::hencky;
    double       density       = 0; ///< [kg/m^3]
    double       young_modulus = 0; ///< [Pa]
    double       poisson_ratio = 0; ///< [-]
  };
} // namespace kedge

#endif
