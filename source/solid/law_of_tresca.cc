#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(Tresca)
  } // namespace internal
} // namespace kedge
