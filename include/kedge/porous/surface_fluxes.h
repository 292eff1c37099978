#ifndef kedge_porous_surface_fluxes_h
#define kedge_porous_surface_fluxes_h

#include <kedge/base/load_program.h>
#include <kedge/fields/patch.h>
#include <kedge/porous/parameters.h>
#include <kedge/surfaces/surface_faces.h>

namespace kedge
{
  /**
   * Fluid that enters through outer faces of bodies at a prescribed rate: the
   * term int N_A q/rho_0 da of the fluid's balance (4.155), q/rho_0 the volume at
   * pressure 0 per area of the deformed face and time, positive inwards.
   */
  template <int dim>
  class SurfaceFluxes : public SurfaceFaces<dim>
  {
  public:
    SurfaceFluxes(const std::vector<SurfaceFluxParameters>    &parameters,
                  const std::map<std::string, double>         &constants,
                  const LoadProgram                           &program  = {},
                  const std::vector<const SurfaceTerm<dim> *> &surfaces = {});

    /**
     * Adds the volume that enters in a step @p dt at the rate of time @p t to
     * the pressure's entry among dim + 1 values per local node [m^3]: partial
     * sums. The functions of the nodes are those at the face.
     */
    void
    add_supply(const Patch<dim>    &patch,
               const double         t,
               const double         dt,
               std::vector<double> &supply) const;

  private:
    const LoadProgram       program;
    std::vector<Expression> expressions; ///< of x, y, z, t [m/s]
  };
} // namespace kedge

#endif
