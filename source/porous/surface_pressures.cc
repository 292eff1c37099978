#include <kedge/porous/surface_pressures.h>

namespace kedge
{
  template <int dim>
  SurfacePressures<dim>::SurfacePressures(const std::vector<SurfacePressureParameters> &parameters,
                                          const std::map<std::string, double>          &constants,
                                          const LoadProgram                            &program)
    : SurfaceLoads<dim>("Surface pressure", {parameters.begin(), parameters.end()}, constants)
    , program(program)
  {
    for (const auto &p : parameters)
      expressions.emplace_back(p.pressure, std::vector<std::string>{"t"}, constants);
  }



  template <int dim>
  std::vector<double>
  SurfacePressures<dim>::pressures(const double t) const
  {
    std::vector<double> result;
    for (const auto &expression : expressions)
      result.push_back(expression({program.time(t)}));
    return result;
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfacePressures<dim>::forces(const double t) const
  {
    const std::vector<double>           p = pressures(t);
    std::vector<dealii::Tensor<1, dim>> result;
    for (const auto &face : this->points())
      {
        dealii::Tensor<1, dim> force;
        for (int d = 0; d < dim; ++d)
          force[d] = -p[face.surface] * face.area[d];
        result.push_back(force);
      }
    return result;
  }

  template class SurfacePressures<2>;
  template class SurfacePressures<3>;
} // namespace kedge
