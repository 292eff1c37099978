#include "internal_force_kernels.h"

namespace kedge
{
  namespace internal
  {
    template void
    add_batch_force(const BatchContext<3> &,
                    const Material &,
                    const StressRule,
                    std::vector<double> &,
                    PointStatus &);
    template void
    add_batch_stiffness(const BatchContext<3> &,
                        const Material &,
                        const StressRule,
                        NodeMatrix<3> &);
  } // namespace internal
} // namespace kedge
