#include <kedge/porous/surface_fluxes.h>
#include <kedge/surfaces/face_nodes.h>

namespace kedge
{
  template <int dim>
  SurfaceFluxes<dim>::SurfaceFluxes(const std::vector<SurfaceFluxParameters>    &parameters,
                                    const std::map<std::string, double>         &constants,
                                    const LoadProgram                           &program,
                                    const std::vector<const SurfaceTerm<dim> *> &surfaces)
    : SurfaceFaces<dim>("Surface flux", {parameters.begin(), parameters.end()}, constants, surfaces)
    , program(program)
  {
    for (const auto &p : parameters)
      expressions.emplace_back(p.flux, std::vector<std::string>{"x", "y", "z", "t"}, constants);
  }



  template <int dim>
  void
  SurfaceFluxes<dim>::add_supply(const Patch<dim>    &patch,
                                 const double         t,
                                 const double         dt,
                                 std::vector<double> &supply) const
  {
    for (const SurfacePoint<dim> &face : this->points())
      {
        double x[4] = {0., 0., 0., program.time(t)}, square = 0.;
        for (int d = 0; d < dim; ++d)
          {
            x[d] = face.place[d];
            square += face.area[d] * face.area[d];
          }
        const double volume = expressions[face.surface](x) * std::sqrt(square) * dt;
        for_nodes_of_face(patch, face, [&](const unsigned int node, const double N) {
          supply[std::size_t(node) * (dim + 1) + dim] += volume * N;
        });
      }
  }

  template class SurfaceFluxes<2>;
  template class SurfaceFluxes<3>;
} // namespace kedge
