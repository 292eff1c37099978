#ifndef kedge_geometry_moments_h
#define kedge_geometry_moments_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace kedge
{
  /**
   * Volume, first and second moments of a region about a place that its user
   * keeps in mind: integrals of 1, r and r r^T over the region, where r is the
   * vector from that place [m^dim, m^(dim+1), m^(dim+2)].
   */
  template <int dim>
  struct VolumeMoments
  {
    double                          volume = 0;
    dealii::Tensor<1, dim>          first;
    dealii::SymmetricTensor<2, dim> second;

    /** Adds (or takes away, @p sign = -1) a region whose moments are about the same place. */
    void
    add(const VolumeMoments &other, const double sign = 1)
    {
      volume += sign * other.volume;
      first += sign * other.first;
      second += sign * other.second;
    }

    /** The moments of the same region about a place further on by @p shift. */
    VolumeMoments
    about(const dealii::Tensor<1, dim> &shift) const
    {
      VolumeMoments result{volume, first - volume * shift, second};
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          result.second[i][j] +=
            volume * shift[i] * shift[j] - first[i] * shift[j] - shift[i] * first[j];
      return result;
    }

    /** From the place to the centre of the region. */
    dealii::Tensor<1, dim>
    centre() const
    {
      return first / volume;
    }

    /** The moments of a box of these half edges about its centre. */
    static VolumeMoments
    of_box(const dealii::Tensor<1, dim> &half_lengths)
    {
      VolumeMoments result;
      result.volume = 1;
      for (int d = 0; d < dim; ++d)
        result.volume *= 2 * half_lengths[d];
      for (int d = 0; d < dim; ++d)
        result.second[d][d] = result.volume * half_lengths[d] * half_lengths[d] / 3;
      return result;
    }
  };
} // namespace kedge

#endif
