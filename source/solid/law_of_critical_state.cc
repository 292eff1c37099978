#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(CriticalState<Hencky>)
    KEDGE_INSTANTIATE_LAW(CriticalState<ImprovedHencky>)
  } // namespace internal
} // namespace kedge
