#include <kedge/base/exceptions.h>
#include <kedge/geometry/mesh_moments.h>
#include <kedge/rigid/rigid_bodies.h>
#include <kedge/surfaces/seed_surface.h>

#include <cmath>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** Facets of bodies that do not say how wide they are: parts of the body's diagonal. */
    constexpr double default_spacing = 0.025;

    UserError
    error_of(const std::string &body, const std::string &entry, const std::string &problem)
    {
      return UserError("Rigid bodies/" + body + "/" + entry + ": " + problem);
    }

    /** Where a body is, what it weighs, and how hard it is to turn, about its centre. */
    struct MassProperties
    {
      double           mass = 0.;
      dealii::Point<3> centre;
      Matrix33         inertia;
    };

    /** I = rho (tr S 1 - S) with the second moments S about the centre; in 2D about z alone. */
    template <int dim>
    MassProperties
    properties_of(const SurfaceMesh<dim> &surface, const double density)
    {
      VolumeMoments<dim> moments = moments_of(surface, surface.vertices.front());
      MassProperties     result;
      result.mass       = density * moments.volume;
      const auto centre = moments.centre();
      for (int d = 0; d < dim; ++d)
        result.centre[d] = surface.vertices.front()[d] + centre[d];
      moments             = moments.about(centre);
      const double spread = dealii::trace(moments.second);
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int j = 0; j < dim && i < dim; ++j)
            result.inertia[i][j] = -density * moments.second[i][j];
          result.inertia[i][i] += density * spread;
        }
      return result;
    }

    /** What the scene gives goes before what the surface says. */
    template <int dim>
    void
    override_properties(const RigidBodyParameters<dim> &given, MassProperties &properties)
    {
      if (given.mass)
        {
          if (properties.mass > 0.)
            properties.inertia *= *given.mass / properties.mass;
          properties.mass = *given.mass;
        }
      for (std::size_t d = 0; d < given.centre.size(); ++d)
        properties.centre[d] = given.centre[d];
      if (given.inertia.empty())
        return;
      Matrix33    inertia;
      const auto &values = given.inertia;
      for (unsigned int i = 0; i < 3; ++i)
        inertia[i][i] = values[values.size() == 1 ? 0 : i];
      if (values.size() == 6)
        {
          inertia[0][1] = inertia[1][0] = values[3];
          inertia[0][2] = inertia[2][0] = values[4];
          inertia[1][2] = inertia[2][1] = values[5];
        }
      properties.inertia = inertia;
    }

    /** Masses are positive, and so are the inertias about all axes, or all are 0: a point. */
    void
    check(const std::string &name, const MassProperties &properties)
    {
      if (!(properties.mass > 0.))
        throw error_of(name, "Density", "The body has no mass: give a Density, or a Mass.");
      const Matrix33 &I     = properties.inertia;
      const double    minor = I[0][0] * I[1][1] - I[0][1] * I[1][0];
      if (I != Matrix33() && !(I[0][0] > 0. && minor > 0. && determinant(I) > 0.))
        throw error_of(name, "Inertia", "It must be positive about every axis.");
    }

    /** The surface in the body's own axes, seen from its centre. */
    template <int dim>
    SurfaceMesh<dim>
    seen_from(const dealii::Point<3> &centre, SurfaceMesh<dim> surface)
    {
      for (auto &x : surface.vertices)
        for (int d = 0; d < dim; ++d)
          x[d] -= centre[d];
      return surface;
    }

    /** Degrees of freedom that nothing holds; a point does not turn. */
    template <int dim>
    std::array<unsigned int, 6>
    free_ones(const RigidBodyParameters<dim> &given, const bool is_point)
    {
      std::array<unsigned int, 6> result;
      result.fill(RigidBody::held);
      for (const unsigned int k : RigidBodies<dim>::freedoms())
        if (given.freedoms[k].motion.kind == ConditionKind::free && (k < 3 || !is_point))
          result[k] = 0;
      return result;
    }

    template <int dim>
    void
    add_body(const RigidBodyParameters<dim> &given,
             const dealii::BoundingBox<dim> &domain,
             RigidBodies<dim>               &bodies)
    {
      SurfaceMesh<dim> surface;
      MassProperties   properties;
      if (given.geometry)
        {
          const auto [lower, upper] = given.geometry->bounding_box(domain).get_boundary_points();
          const double spacing =
            given.spacing > 0. ? given.spacing : default_spacing * lower.distance(upper);
          surface    = seed_surface(*given.geometry, spacing, domain);
          properties = properties_of(surface, given.density);
        }
      else if (given.centre.empty())
        throw error_of(given.name, "Centre", "A body without a Geometry needs one.");
      override_properties(given, properties);
      check(given.name, properties);

      RigidBody body;
      body.name             = given.name;
      body.mass             = properties.mass;
      body.inertia          = properties.inertia;
      body.state.centre     = properties.centre;
      const double gyration = std::sqrt(trace(body.inertia) / (3. * body.mass));
      body.size             = gyration > 0. ? gyration : 1.;
      for (std::size_t d = 0; d < given.velocity.size(); ++d)
        body.state.velocity[d] = given.velocity[d];
      for (std::size_t d = 0; d < given.angular_velocity.size(); ++d)
        body.state.angular_velocity[dim == 3 ? d : 2] = given.angular_velocity[d];
      body.unknowns = free_ones(given, body.inertia == Matrix33());
      bodies.append(body, seen_from(properties.centre, std::move(surface)));
    }
  } // namespace



  template <int dim>
  void
  make_rigid_bodies(const std::vector<RigidBodyParameters<dim>> &parameters,
                    const dealii::BoundingBox<dim>              &domain,
                    RigidBodies<dim>                            &bodies)
  {
    for (const auto &given : parameters)
      add_body(given, domain, bodies);
    bodies.begin();
  }

  template void
  make_rigid_bodies(const std::vector<RigidBodyParameters<2>> &,
                    const dealii::BoundingBox<2> &,
                    RigidBodies<2> &);
  template void
  make_rigid_bodies(const std::vector<RigidBodyParameters<3>> &,
                    const dealii::BoundingBox<3> &,
                    RigidBodies<3> &);
} // namespace kedge
