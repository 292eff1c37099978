#ifndef kedge_simulation_bodies_h
#define kedge_simulation_bodies_h

#include <kedge/scene/scene.h>

#include <kedge/fields/step_points.h>
#include <kedge/materials/material.h>
#include <kedge/points/point_layout.h>
#include <kedge/porous/pore_points.h>
#include <kedge/time_integration/scheme.h>

namespace kedge
{
  /** What the bodies of a scene are, one entry per body. */
  struct Bodies
  {
    std::vector<std::string>  names;
    std::vector<Material>     materials;
    std::vector<double>       young_moduli; ///< [Pa]
    std::vector<double>       viscosities;  ///< [Pa s]
    std::vector<double>       densities;    ///< of the material, of grains in soil [kg/m^3]
    std::vector<BasisKind>    bases;
    std::vector<bool>         shared_volume;  ///< whether points in a cell share their dilatation
    std::vector<bool>         has_body_force; ///< that acts on points as they are, not on soil
    std::vector<Soil>         soils;          ///< of saturated scenes; else empty
    std::vector<std::string>  initial_pore_pressure; ///< likewise; expressions [Pa]
    std::vector<unsigned int> field;                 ///< number of the field it belongs to
    std::vector<std::string>  field_names;           ///< one per field

    MemoryColumns columns; ///< of their laws' histories, in the points' memory

    /** How far points couple nodes, in intervals of the lattice. */
    int
    stencil_radius() const;

    /** How far the points of a cell do, which is further if they share their dilatation. */
    int
    tangent_radius() const;
  };

  /** What the points of the bodies have to remember; nothing that they do not need is stored. */
  template <int dim>
  PointLayout<dim>
  layout_of_points(const Bodies &bodies, const bool pores, const Scheme &scheme);

  template <int dim>
  Bodies
  read_bodies(const Scene<dim> &scene);
} // namespace kedge

#endif
