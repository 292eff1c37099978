#ifndef kedge_materials_history_h
#define kedge_materials_history_h

#include <kedge/base/pack.h>

namespace kedge
{
  /**
   * What a material answers by beside the elastic strain, as committed at the
   * end of the last step. A material whose has_history is false neither reads
   * nor changes it, and a scene of such materials does not store it per step.
   */
  template <typename Number>
  struct MaterialHistoryOf
  {
    Number equivalent_plastic_strain = 0.; ///< alpha [-]
    Number plastic_volume_strain     = 0.; ///< eps_v^p, positive where the pores open [-]
    Number volume_strain             = 0.; ///< eps_v = ln det F, elastic and plastic [-]
  };

  using MaterialHistory = MaterialHistoryOf<double>;
} // namespace kedge

#endif
