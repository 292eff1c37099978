#ifndef kedge_porous_soil_bodies_h
#define kedge_porous_soil_bodies_h

#include <kedge/fields/patch.h>
#include <kedge/materials/material.h>
#include <kedge/points/generation.h>
#include <kedge/porous/pore_points.h>

#include <functional>
#include <map>

namespace kedge
{
  /** The initial pore pressures of bodies and what they are made of, one per body. */
  struct SoilBodies
  {
    std::vector<Material>         materials;
    std::vector<Soil>             soils;
    std::vector<std::string>      names;
    std::vector<std::string>      initial_pore_pressure; ///< expressions of x, y, z [Pa]
    std::map<std::string, double> constants;             ///< of expressions
  };

  /**
   * Gives the points of a field's bodies their porosity and pore pressure. Their mass, which is
   * that of grains without pores before, becomes that of grains and fluid.
   */
  template <int dim>
  void
  saturate(const SoilBodies                 &bodies,
           const Patch<dim>                 &patch,
           std::vector<GeneratedPoint<dim>> &points);

  /**
   * Begins the motion of the fluid of a saturated point with its skeleton. The point's mass becomes
   * that of its grains: the fluid has a velocity of its own.
   */
  template <int dim>
  void
  begin_motion(const SoilBodies &bodies, PointState<dim> &state);

  /**
   * (N - N^0) f of the initial pore pressures at the nodes, which the grid alone can tell, of all
   * points, by slot.
   *
   * @param of what of the fluid and a pressure
   */
  template <int dim>
  std::vector<double>
  fluctuations_of(const SoilBodies                                             &bodies,
                  const Patch<dim>                                             &patch,
                  const std::function<double(const PoreFluid &, const double)> &of);
} // namespace kedge

#endif
