#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(ImprovedHencky)
  } // namespace internal
} // namespace kedge
