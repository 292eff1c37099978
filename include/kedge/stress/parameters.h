#ifndef kedge_stress_parameters_h
#define kedge_stress_parameters_h

#include <array>
#include <string>

namespace kedge
{
  /** How a single material point is deformed; expressions of t and the user's constants. */
  struct PathParameters
  {
    bool                       by_strain = false;    ///< which of the next two is meant
    std::array<std::string, 9> deformation_gradient; ///< F row by row [-]
    std::array<std::string, 3> logarithmic_strain;   ///< of the fixed directions x, y, z [-]
    double                     end     = 1;          ///< from t = 0 to here [s]
    unsigned int               n_steps = 1;
  };
} // namespace kedge

#endif
