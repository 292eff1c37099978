#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(VonMises)
  } // namespace internal
} // namespace kedge
