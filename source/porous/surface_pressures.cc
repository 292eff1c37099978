#include <kedge/porous/surface_pressures.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  SurfacePressures<dim>::SurfacePressures(const std::vector<SurfacePressureParameters> &parameters,
                                          const std::map<std::string, double>          &constants,
                                          const LoadProgram                            &program,
                                          const std::vector<const SurfaceTerm<dim> *>  &surfaces)
    : SurfaceLoads<dim>("Surface pressure",
                        {parameters.begin(), parameters.end()},
                        constants,
                        surfaces)
    , program(program)
  {
    for (const auto &p : parameters)
      {
        expressions.emplace_back(p.pressure,
                                 std::vector<std::string>{"x", "y", "z", "t"},
                                 constants);
        is_one_way.push_back(p.one_way);
      }
  }



  template <int dim>
  bool
  SurfacePressures<dim>::has_one_way() const
  {
    return std::find(is_one_way.begin(), is_one_way.end(), true) != is_one_way.end();
  }



  template <int dim>
  std::vector<bool>
  SurfacePressures<dim>::one_way() const
  {
    std::vector<bool> result;
    for (const auto &face : this->points())
      result.push_back(is_one_way[face.surface]);
    return result;
  }



  template <int dim>
  std::vector<double>
  SurfacePressures<dim>::pressures(const double t) const
  {
    std::vector<double> result;
    for (const auto &face : this->points())
      {
        double x[4] = {0., 0., 0., program.time(t)};
        for (int d = 0; d < dim; ++d)
          x[d] = face.place[d];
        result.push_back(expressions[face.surface](x));
      }
    return result;
  }



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfacePressures<dim>::forces(const double t) const
  {
    const std::vector<double>           p = pressures(t);
    std::vector<dealii::Tensor<1, dim>> result;
    for (std::size_t f = 0; f < p.size(); ++f)
      {
        dealii::Tensor<1, dim> force;
        for (int d = 0; d < dim; ++d)
          force[d] = -p[f] * this->points()[f].area[d];
        result.push_back(force);
      }
    return result;
  }

  template class SurfacePressures<2>;
  template class SurfacePressures<3>;
} // namespace kedge
