#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(ModifiedCamClay)
  } // namespace internal
} // namespace kedge
