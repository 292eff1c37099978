#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(Hencky)
  } // namespace internal
} // namespace kedge
