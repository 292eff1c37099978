#include <kedge/geometry/mesh_moments.h>

namespace kedge
{
  template <int dim>
  VolumeMoments<dim>
  moments_of(const SurfaceMesh<dim> &mesh, const dealii::Point<dim> &place)
  {
    VolumeMoments<dim> result;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        const auto corners = mesh.corners(f);
        // of the simplex: the area of its base times the height of the place below it
        const double volume = (corners[0] - place) * area_vector<dim>(corners) / dim;
        std::array<dealii::Tensor<1, dim>, dim> r;
        dealii::Tensor<1, dim>                  sum;
        for (unsigned int i = 0; i < dim; ++i)
          sum += r[i] = corners[i] - place;
        result.volume += volume;
        result.first += volume / (dim + 1) * sum;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a; b < dim; ++b)
            {
              double second = sum[a] * sum[b];
              for (unsigned int i = 0; i < dim; ++i)
                second += r[i][a] * r[i][b];
              result.second[a][b] += volume / ((dim + 1) * (dim + 2)) * second;
            }
      }
    return result;
  }

  template VolumeMoments<2>
  moments_of(const SurfaceMesh<2> &, const dealii::Point<2> &);
  template VolumeMoments<3>
  moments_of(const SurfaceMesh<3> &, const dealii::Point<3> &);
} // namespace kedge
