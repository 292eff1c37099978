#include <kedge/solid/surface_loads.h>
#include <kedge/surfaces/face_nodes.h>

namespace kedge
{
  template <int dim>
  void
  add_face_forces(const Patch<dim>                          &patch,
                  const std::vector<SurfacePoint<dim>>      &faces,
                  const std::vector<dealii::Tensor<1, dim>> &forces,
                  std::vector<double>                       &sums)
  {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for_nodes_of_face(patch, faces[f], [&](const unsigned int node, const double value) {
        for (int d = 0; d < dim; ++d)
          sums[std::size_t(node) * dim + d] += value * forces[f][d];
      });
  }



  template <int dim>
  double
  work_of_face_forces(const Patch<dim>                          &patch,
                      const std::vector<SurfacePoint<dim>>      &faces,
                      const std::vector<dealii::Tensor<1, dim>> &forces,
                      const std::vector<double>                 &displacement)
  {
    double work = 0.;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for_nodes_of_face(patch, faces[f], [&](const unsigned int node, const double value) {
        for (int d = 0; d < dim; ++d)
          work += value * forces[f][d] * displacement[std::size_t(node) * dim + d];
      });
    return work;
  }



  template <int dim>
  SurfaceTractions<dim>::SurfaceTractions(const std::vector<TractionParameters<dim>>  &parameters,
                                          const std::map<std::string, double>         &constants,
                                          const LoadProgram                           &program,
                                          const std::vector<const SurfaceTerm<dim> *> &surfaces)
    : SurfaceLoads<dim>("Traction", {parameters.begin(), parameters.end()}, constants, surfaces)
    , program(program)
  {
    for (const auto &p : parameters)
      {
        std::array<Expression, std::size_t(dim)> of_surface;
        for (int d = 0; d < dim; ++d)
          of_surface[d] =
            Expression(p.traction[d], {"x", "y", "z", "t", "nx", "ny", "nz"}, constants);
        expressions.push_back(of_surface);
        resultants.push_back(p.resultant);
      }
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfaceTractions<dim>::forces(const double t) const
  {
    std::vector<dealii::Tensor<1, dim>> result;
    for (const auto &face : this->points())
      {
        double values[7] = {0., 0., 0., program.time(t), 0., 0., 0.};
        for (int d = 0; d < dim; ++d)
          {
            values[d]     = face.reference_place[d];
            values[4 + d] = face.reference_normal[d];
          }
        dealii::Tensor<1, dim> force;
        for (int d = 0; d < dim; ++d)
          force[d] = program.factor(t) * face.reference_area * expressions[face.surface][d](values);
        result.push_back(force);
      }
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                                     \
  template void   add_face_forces(const Patch<dim> &,                              \
                                  const std::vector<SurfacePoint<dim>> &,          \
                                  const std::vector<dealii::Tensor<1, dim>> &,     \
                                  std::vector<double> &);                          \
  template double work_of_face_forces(const Patch<dim> &,                          \
                                      const std::vector<SurfacePoint<dim>> &,      \
                                      const std::vector<dealii::Tensor<1, dim>> &, \
                                      const std::vector<double> &);                \
  template class SurfaceTractions<dim>;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
