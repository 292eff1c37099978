#include <kedge/points/split_points.h>

namespace kedge
{
  template <int dim>
  void
  split_point(const PointRecord<dim>        &point,
              const PointParts<dim>         &parts,
              std::uint64_t                 &last_id,
              std::vector<PointRecord<dim>> &result)
  {
    unsigned int n = 1;
    for (const unsigned int in_direction : parts)
      n *= in_direction;
    const auto to_reference = dealii::invert(point.state.deformation_gradient);
    for (unsigned int k = 0; k < n; ++k)
      {
        PointRecord<dim>       part = point;
        dealii::Tensor<1, dim> offset;
        unsigned int           rest = k;
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int in_direction = parts[d], number = rest % in_direction;
            rest /= in_direction;
            // (2 i + 1 - n)/n of the half length: symmetric to the last bit
            offset[d] =
              (2. * number + 1. - in_direction) / in_direction * part.state.half_lengths[d];
            part.state.half_lengths[d] /= in_direction;
            part.state.reference_half_lengths[d] /= in_direction;
          }
        part.location += offset;
        part.state.reference_position += to_reference * offset;
        part.state.displacement += offset - to_reference * offset;
        part.state.mass /= n;
        part.state.reference_volume /= n;
        if (k > 0)
          part.id = ++last_id;
        result.push_back(part);
      }
  }

  template void
  split_point<2>(const PointRecord<2> &,
                 const PointParts<2> &,
                 std::uint64_t &,
                 std::vector<PointRecord<2>> &);
  template void
  split_point<3>(const PointRecord<3> &,
                 const PointParts<3> &,
                 std::uint64_t &,
                 std::vector<PointRecord<3>> &);
} // namespace kedge
