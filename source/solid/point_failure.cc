#include <kedge/solid/point_failure.h>
#include <kedge/transfer/node_sums.h>

#include <sstream>

namespace kedge
{
  template <int dim>
  std::string
  describe_failure(const Patch<dim>          &patch,
                   const unsigned int         slot,
                   const std::vector<double> &displacement,
                   const double               fraction,
                   const std::vector<double> &grains,
                   const std::string         &otherwise)
  {
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(patch, displacement, gradients);
    std::ostringstream text;
    text << patch.describe_point(slot);
    double least = 0.;
    for (const auto &batch : patch.points.batches)
      if (slot >= batch.begin && slot < batch.end && !grains.empty())
        least = grains[batch.body];
    for (const double part : {fraction, 1.})
      {
        dealii::Tensor<2, dim> step = part * gradients[slot];
        for (int d = 0; d < dim; ++d)
          step[d][d] += 1.;
        const double J = patch.points.determinant[slot] * determinant(step);
        if (!(J > 0.))
          {
            text << " would be turned inside out: det F = " << J;
            return text.str();
          }
        if (!(J > least))
          {
            text << " would have no pores left: det F = " << J << ", its grains take " << least;
            return text.str();
          }
      }
    text << " has " << otherwise << " at det F = " << patch.points.determinant[slot]
         << " before the step";
    return text.str();
  }

#define KEDGE_INSTANTIATE(dim)                                       \
  template std::string describe_failure(const Patch<dim> &,          \
                                        const unsigned int,          \
                                        const std::vector<double> &, \
                                        const double,                \
                                        const std::vector<double> &, \
                                        const std::string &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
