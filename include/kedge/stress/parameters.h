#ifndef kedge_stress_parameters_h
#define kedge_stress_parameters_h

#include <array>
#include <string>

namespace kedge
{
  /** What an element test prescribes of an axis, as an expression of t. */
  struct AxisControl
  {
    bool        is_stress = false; ///< total Cauchy stress [Pa], else ln(stretch) [-]
    std::string expression;
  };

  /** How a single material point is deformed; expressions of t and the user's constants. */
  struct PathParameters
  {
    enum class Kind
    {
      deformation_gradient,
      logarithmic_strain,
      control
    };

    Kind                       kind = Kind::deformation_gradient; ///< which of the next is meant
    std::array<std::string, 9> deformation_gradient;              ///< F row by row [-]
    std::array<std::string, 3> logarithmic_strain; ///< of the fixed directions x, y, z [-]
    std::array<AxisControl, 3> control;            ///< of x, y, z: an element test

    double initial_pressure = 0; ///< effective, which the undeformed point bears [Pa]

    // of an element test
    double       consolidation_pressure = 0;     ///< effective, before the test begins [Pa]
    bool         undrained              = false; ///< else the pore pressure stays 0
    double       fluid_bulk_modulus     = 0;     ///< K_f [Pa]; 0: incompressible
    double       end                    = 1;     ///< from t = 0 to here [s]
    unsigned int n_steps                = 1;
  };
} // namespace kedge

#endif
