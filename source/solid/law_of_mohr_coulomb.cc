#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(MohrCoulomb)
  } // namespace internal
} // namespace kedge
