#ifndef kedge_porous_surface_pressures_h
#define kedge_porous_surface_pressures_h

#include <kedge/porous/parameters.h>
#include <kedge/porous/surface_valves.h>
#include <kedge/solid/surface_loads.h>

namespace kedge
{
  /**
   * Pore pressures prescribed on outer faces of bodies. What stands on such a
   * surface as water also presses on the mixture, traction -p n, (4.198).
   */
  template <int dim>
  class SurfacePressures : public SurfaceLoads<dim>
  {
  public:
    SurfacePressures(const std::vector<SurfacePressureParameters> &parameters,
                     const std::map<std::string, double>          &constants,
                     const LoadProgram                            &program  = {},
                     const std::vector<const SurfaceTerm<dim> *>  &surfaces = {});

    /** The prescribed pressure at each of points() at time @p t [Pa]. */
    std::vector<double>
    pressures(const double t) const;

    SurfaceValves valves; ///< which of points() are open

    /** Whether there are seepage faces. */
    bool
    has_one_way() const;

    /** Which of points() belong to seepage faces. */
    std::vector<bool>
    one_way() const;

    /** The force of the water on each of points() at time @p t [N]. */
    std::vector<dealii::Tensor<1, dim>>
    forces(const double t) const override;

  private:
    const LoadProgram       program;
    std::vector<Expression> expressions; ///< of x, y, z, t [Pa]
    std::vector<bool>       is_one_way;  ///< by surface
  };
} // namespace kedge

#endif
