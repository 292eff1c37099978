#ifndef kedge_solid_surface_loads_h
#define kedge_solid_surface_loads_h

#include <kedge/base/load_program.h>
#include <kedge/solid/parameters.h>
#include <kedge/surfaces/surface_faces.h>

namespace kedge
{
  /** Something that pulls at outer faces of bodies: tractions, water. */
  template <int dim>
  class SurfaceLoads : public SurfaceFaces<dim>
  {
  public:
    using SurfaceFaces<dim>::SurfaceFaces;

    virtual ~SurfaceLoads() = default;

    /** The force at time @p t on each of points() [N]. */
    virtual std::vector<dealii::Tensor<1, dim>>
    forces(const double t) const = 0;
  };

  /** Adds the @p forces on @p faces to the nodes, dim values per local node: partial sums [N]. */
  template <int dim>
  void
  add_face_forces(const Patch<dim>                          &patch,
                  const std::vector<SurfacePoint<dim>>      &faces,
                  const std::vector<dealii::Tensor<1, dim>> &forces,
                  std::vector<double>                       &sums);

  /** The work of @p forces on @p faces that the nodes move by @p displacement [J]. */
  template <int dim>
  double
  work_of_face_forces(const Patch<dim>                          &patch,
                      const std::vector<SurfacePoint<dim>>      &faces,
                      const std::vector<dealii::Tensor<1, dim>> &forces,
                      const std::vector<double>                 &displacement);

  /** Dead tractions: force per area of the undeformed face. */
  template <int dim>
  class SurfaceTractions : public SurfaceLoads<dim>
  {
  public:
    SurfaceTractions(const std::vector<TractionParameters<dim>>  &parameters,
                     const std::map<std::string, double>         &constants,
                     const LoadProgram                           &program  = {},
                     const std::vector<const SurfaceTerm<dim> *> &surfaces = {});

    std::vector<dealii::Tensor<1, dim>>
    forces(const double t) const override;

    /** Whether history.csv is to have the force on a surface. */
    bool
    shows_resultant(const unsigned int surface) const
    {
      return resultants[surface];
    }

  private:
    const LoadProgram                                     program;
    std::vector<std::array<Expression, std::size_t(dim)>> expressions; ///< of x, y, z, t, n [Pa]
    std::vector<bool>                                     resultants;
  };
} // namespace kedge

#endif
