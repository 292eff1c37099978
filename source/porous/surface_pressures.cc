#include <kedge/porous/surface_pressures.h>

namespace kedge
{
  template <int dim>
  SurfacePressures<dim>::SurfacePressures(const std::vector<SurfacePressureParameters> &parameters,
                                          const std::map<std::string, double>          &constants,
                                          const LoadProgram                            &program)
    : SurfaceFaces<dim>("Surface pressure", {parameters.begin(), parameters.end()}, constants)
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
  void
  SurfacePressures<dim>::add_force(const StepPoints<dim> &,
                                   const double                         t,
                                   std::vector<dealii::Tensor<1, dim>> &forces) const
  {
    const std::vector<double> p = pressures(t);
    for (const auto &face : this->points())
      for (int d = 0; d < dim; ++d)
        forces[face.slot][d] -= p[face.surface] * face.area[d];
  }

  template class SurfacePressures<2>;
  template class SurfacePressures<3>;
} // namespace kedge
