#include <kedge/surfaces/face_multipliers.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  template <int dim>
  FaceMultipliers<dim>::FaceMultipliers(const SurfaceExtent<dim>     &extent,
                                        const unsigned int            direction,
                                        const dealii::Tensor<1, dim> &cell_size)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double between = extent.high[d] - extent.low[d];
        const double length  = between + 2. * extent.half_lengths[d];
        low[d]               = extent.low[d] - extent.half_lengths[d];
        // a single row of faces tells nothing but a mean
        const bool has_one = d == direction || between <= 1e-6 * extent.half_lengths[d];
        n_intervals[d] =
          has_one
            ? 0
            : std::max(1u,
                       static_cast<unsigned int>(std::lround(length / (spacing * cell_size[d]))));
        width[d] = length / std::max(1u, n_intervals[d]);
      }
  }



  template <int dim>
  unsigned int
  FaceMultipliers<dim>::size() const
  {
    unsigned int n = 1;
    for (int d = 0; d < dim; ++d)
      n *= n_intervals[d] + 1;
    return n;
  }

  template class FaceMultipliers<2>;
  template class FaceMultipliers<3>;
} // namespace kedge
