#include "law_stage.h"

namespace kedge
{
  namespace internal
  {
    KEDGE_INSTANTIATE_LAW(DruckerPrager)
  } // namespace internal
} // namespace kedge
