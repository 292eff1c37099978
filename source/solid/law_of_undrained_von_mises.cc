#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(UndrainedVonMises)
  } // namespace internal
} // namespace kedge
