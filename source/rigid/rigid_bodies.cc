#include <kedge/rigid/rigid_bodies.h>

namespace kedge
{
  template <int dim>
  RigidBodies<dim>::RigidBodies(const double alpha, const MPI_Comm communicator)
    : alpha(alpha)
    , first(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {}



  template <int dim>
  const std::vector<unsigned int> &
  RigidBodies<dim>::freedoms()
  {
    static const std::vector<unsigned int> in_space = {0, 1, 2, 3, 4, 5}, in_plane = {0, 1, 5};
    return dim == 3 ? in_space : in_plane;
  }



  template <int dim>
  void
  RigidBodies<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    for (RigidBody &body : bodies)
      for (unsigned int &unknown : body.unknowns)
        if (unknown != RigidBody::held)
          {
            unknown = unknowns.add_others(1);
            // rows as long as the surface that is touched: for direct methods only
            unknowns.traits.multipliers = true;
          }
  }



  template <int dim>
  void
  RigidBodies<dim>::begin()
  {
    for (RigidBody &body : bodies)
      {
        body.attitude_start = body.attitude_end = matrix_of(body.state.attitude);
        body.displacement = body.theta = Vector3();
      }
  }



  template <int dim>
  void
  RigidBodies<dim>::hold(const unsigned int body, const unsigned int freedom, const double value)
  {
    (freedom < 3 ? bodies[body].displacement : bodies[body].theta)[freedom % 3] = value;
  }



  template <int dim>
  void
  RigidBodies<dim>::read(const UnknownVector &unknowns)
  {
    for (RigidBody &body : bodies)
      {
        for (unsigned int k = 0; k < 6; ++k)
          if (body.unknowns[k] != RigidBody::held)
            {
              const double value = unknowns.others[body.unknowns[k]];
              if (k < 3)
                body.displacement[k] = value;
              else
                body.theta[k - 3] = value / body.size;
            }
        body.attitude_end = cayley(body.theta) * body.attitude_start;
      }
  }



  template <int dim>
  RigidPoint
  RigidBodies<dim>::point(const unsigned int body, const Vector3 &place) const
  {
    const RigidBody &of = bodies[body];
    RigidPoint       result;
    result.body  = body;
    result.start = of.attitude_start * place;
    result.end   = of.attitude_end * place;
    result.lever = (1. - alpha) * result.start + alpha * result.end;
    result.slope =
      -0.5 * cayley_inverse(of.theta) * cross_matrix(result.start + result.end); // of theta x r_mid
    return result;
  }



  template <int dim>
  void
  RigidBodies<dim>::add(const unsigned int   body,
                        const Vector3       &force,
                        const Vector3       &moment,
                        std::vector<double> &residual)
  {
    RigidBody &on = bodies[body];
    on.force += force;
    on.moment += moment;
    if (first)
      for (unsigned int k = 0; k < 6; ++k)
        if (on.unknowns[k] != RigidBody::held)
          residual[on.unknowns[k]] += k < 3 ? force[k] : moment[k - 3] / on.size;
  }



  template <int dim>
  void
  RigidBodies<dim>::clear_sums()
  {
    for (RigidBody &body : bodies)
      body.force = body.moment = Vector3();
  }



  template <int dim>
  void
  RigidBodies<dim>::add_lever_slope(const RigidPoint &point,
                                    const Vector3    &force,
                                    Tangent<dim>     &tangent) const
  {
    const RigidBody &body = bodies[point.body];
    for (unsigned int l = 3; l < 6; ++l)
      if (body.unknowns[l] != RigidBody::held)
        {
          Vector3 axis;
          axis[l - 3]          = 1.;
          const Vector3 moment = cross_product_3d(alpha * point.slope * axis, force);
          for (unsigned int k = 3; k < 6; ++k)
            if (body.unknowns[k] != RigidBody::held)
              tangent.add(UnknownIndex::other(body.unknowns[k]),
                          UnknownIndex::other(body.unknowns[l]),
                          -moment[k - 3] / (body.size * body.size));
        }
  }

  template class RigidBodies<2>;
  template class RigidBodies<3>;
} // namespace kedge
