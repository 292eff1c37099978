#include <kedge/simulation/bodies.h>

#include <algorithm>
#include <set>

namespace kedge
{
  namespace
  {
    /** Storage of dry bodies in that of the skeleton: it must not matter beside any other. */
    constexpr double dry_storage = 1e-10;

    /** Whether a contact keeps two bodies apart. */
    bool
    is_between(const ContactParameters &contact, const std::string &a, const std::string &b)
    {
      const auto holds = [](const std::vector<std::string> &group, const std::string &name) {
        return std::find(group.begin(), group.end(), name) != group.end();
      };
      return (holds(contact.first, a) && holds(contact.second, b)) ||
             (holds(contact.first, b) && holds(contact.second, a));
    }

    /** Each body takes the first field without a body that it may move apart from: one that a
     * contact sets apart, or another piece of what was one body. */
    template <int dim>
    void
    find_fields(const Scene<dim> &scene, Bodies &bodies)
    {
      const auto is_piece_of_same = [&](const std::string &a, const std::string &b) {
        std::string of_a, of_b;
        for (const auto &body : scene.bodies)
          {
            of_a = body.name == a ? body.piece_of : of_a;
            of_b = body.name == b ? body.piece_of : of_b;
          }
        return !of_a.empty() && of_a == of_b;
      };
      std::vector<std::vector<std::string>> members;
      for (const std::string &name : bodies.names)
        {
          const auto fits = [&](const std::vector<std::string> &field) {
            return std::none_of(field.begin(), field.end(), [&](const std::string &other) {
              return is_piece_of_same(name, other) ||
                     std::any_of(scene.contacts.begin(),
                                 scene.contacts.end(),
                                 [&](const auto &contact) {
                                   return is_between(contact, name, other);
                                 });
            });
          };
          auto found = std::find_if(members.begin(), members.end(), fits);
          if (found == members.end())
            found = members.insert(members.end(), std::vector<std::string>());
          found->push_back(name);
          bodies.field.push_back(static_cast<unsigned int>(found - members.begin()));
        }
      if (members.empty()) // rigid bodies alone
        members.push_back({"none"});
      for (const auto &field : members)
        bodies.field_names.push_back(field.front());
    }
  } // namespace



  template <int dim>
  PointLayout<dim>
  layout_of_points(const Bodies &bodies, const bool pores, const Scheme &scheme)
  {
    AssertThrow(memory_columns().size() <= most_memory_columns, dealii::ExcInternalError());
    std::set<unsigned int> used;
    for (const auto &columns : bodies.columns)
      used.insert(columns.begin(), columns.end());
    used.erase(not_in_memory);
    used.erase(is_time_step);
    const bool plastic = std::any_of(bodies.materials.begin(), bodies.materials.end(), yields);
    return PointLayout<dim>({used.begin(), used.end()},
                            plastic,
                            pores,
                            pores && scheme.carries_fluid_velocity(),
                            scheme.carries_acceleration);
  }



  int
  Bodies::stencil_radius() const
  {
    int radius = 1;
    for (const BasisKind basis : bases)
      radius = std::max(radius,
                        basis == BasisKind::linear   ? 1
                        : basis == BasisKind::spline ? most_stencil_nodes - 1
                                                     : 2);
    return radius;
  }



  int
  Bodies::tangent_radius() const
  {
    for (std::size_t b = 0; b < bases.size(); ++b)
      if (bases[b] == BasisKind::gimp && shared_volume[b])
        return 3;
    return stencil_radius();
  }



  template <int dim>
  Bodies
  read_bodies(const Scene<dim> &scene)
  {
    Bodies result;
    for (const auto &body : scene.bodies)
      {
        const MaterialParameters &material = scene.materials[body.material];
        result.names.push_back(body.name);
        result.materials.push_back(make_material(material));
        result.columns.push_back(memory_indices(result.materials.back()));
        result.young_moduli.push_back(material.young_modulus);
        result.viscosities.push_back(material.viscosity);
        result.densities.push_back(material.density);
        result.bases.push_back(body.basis);
        result.shared_volume.push_back(material.volume_change == VolumeChange::cell_mean);
        // in saturated bodies the balance itself applies it, to a mass that changes
        // of saturated bodies a term of their own holds what else weighs
        result.has_body_force.push_back(
          body.body_force && (!scene.pore_fluid || Scheme(scene.time).carries_fluid_velocity()));
        if (!scene.pore_fluid)
          continue;
        const double        G        = 0.5 * material.young_modulus / (1. + material.poisson_ratio);
        const BodyPores    &pores    = scene.pore_fluid->bodies[result.soils.size()];
        PoreFluidParameters fluid    = scene.pore_fluid->fluid;
        fluid.initial_porosity       = material.initial_porosity;
        fluid.hydraulic_conductivity = pores.hydraulic_conductivity;
        fluid.kozeny_carman          = pores.kozeny_carman;
        result.soils.push_back({PoreFluid(fluid),
                                material.density,
                                0.5 * scene.pore_fluid->stabilisation / G,
                                body.body_force,
                                0.});
        if (pores.is_dry)
          result.soils.back().dry_storage = dry_storage / p_wave_modulus(result.materials.back());
        result.initial_pore_pressure.push_back(body.initial_pore_pressure);
      }
    find_fields(scene, result);
    return result;
  }

  template PointLayout<2>
  layout_of_points(const Bodies &, const bool, const Scheme &);
  template PointLayout<3>
  layout_of_points(const Bodies &, const bool, const Scheme &);
  template Bodies
  read_bodies(const Scene<2> &);
  template Bodies
  read_bodies(const Scene<3> &);
} // namespace kedge
