#include <kedge/fields/step_points.h>
#include <kedge/porous/surface_fluxes.h>

namespace kedge
{
  namespace
  {
    /** The supply of one face to the nodes that its point reaches. */
    template <int dim>
    struct SupplyKernel
    {
      const Patch<dim>        &patch;
      const SurfacePoint<dim> &face;
      const double             volume;
      std::vector<double>     &supply;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        const auto at_face = expand<dim, pattern>(face.functions);
        for (int A = 0; A < stencil_size<dim>(pattern); ++A)
          {
            const auto node = patch.nodes.local(face.functions.first_node + offsets[A]);
            supply[std::size_t(node) * (dim + 1) + dim] += volume * at_face.value[A];
          }
      }
    };
  } // namespace



  template <int dim>
  SurfaceFluxes<dim>::SurfaceFluxes(const std::vector<SurfaceFluxParameters> &parameters,
                                    const std::map<std::string, double>      &constants,
                                    const LoadProgram                        &program)
    : SurfaceFaces<dim>("Surface flux", {parameters.begin(), parameters.end()}, constants)
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
    for (const auto &batch : patch.points.batches)
      for (const SurfacePoint<dim> &face : this->points())
        {
          if (face.slot < batch.begin || face.slot >= batch.end)
            continue;
          double x[4] = {0, 0, 0, program.time(t)}, square = 0.;
          for (int d = 0; d < dim; ++d)
            {
              x[d] = patch.points.location[face.slot][d] + face.offset[d];
              square += face.area[d] * face.area[d];
            }
          dispatch_pattern<dim>(batch.pattern,
                                SupplyKernel<dim>{patch,
                                                  face,
                                                  expressions[face.surface](x) * std::sqrt(square) *
                                                    dt,
                                                  supply});
        }
  }

  template class SurfaceFluxes<2>;
  template class SurfaceFluxes<3>;
} // namespace kedge
