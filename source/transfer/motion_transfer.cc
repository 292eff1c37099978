#include <kedge/transfer/motion_transfer.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  MotionTransfer<dim>::MotionTransfer(const unsigned int        field,
                                      const Patch<dim>         &patch,
                                      const TransferParameters &parameters,
                                      const Scheme             &scheme,
                                      const int                 radius)
    : field(field)
    , patch(patch)
    , parameters(parameters)
    , scheme(scheme)
    , radius(radius)
  {}



  template <int dim>
  void
  MotionTransfer<dim>::reinit(const std::function<void(NodeMatrix<dim> &)> &add)
  {
    if (patch.new_nodes())
      effective_mass.reinit(patch.nodes.n_local(), 1, radius);
    assemble_mass(patch, effective_mass);
    blend_mass(parameters.lumping, effective_mass, patch.nodes.n_local());
    has_own_mass = static_cast<bool>(add);
    if (has_own_mass)
      {
        mapped_mass = effective_mass;
        add(mapped_mass);
      }
    mapping.reinit(patch, mapping_mass());
  }



  template <int dim>
  LinearStatus
  MotionTransfer<dim>::project(const std::vector<dealii::Tensor<1, dim>> &at_points,
                               std::vector<double>                       &at_nodes)
  {
    std::vector<double> momentum(at_nodes.size(), 0.);
    add_to_nodes(patch, patch.points.mass, at_points, momentum);
    patch.ties.restrict_sums(momentum);
    patch.nodes.add_to_owners(momentum, dim);
    return mapping.solve(momentum, at_nodes);
  }



  template <int dim>
  LinearStatus
  MotionTransfer<dim>::to_nodes(Trial<dim> &trial)
  {
    auto             &motion = trial.motion[field];
    const std::size_t size   = std::size_t(patch.nodes.n_local()) * dim;
    motion.velocity_n.assign(size, 0.);
    motion.acceleration_n.assign(size, 0.);
    patch.constraints.prescribe_velocity(trial.times.t_n, trial.times.dt, motion.velocity_n);
    LinearStatus status = project(patch.points.velocity, motion.velocity_n);
    if (status.success && scheme.carries_acceleration)
      status = project(patch.points.acceleration, motion.acceleration_n);
    return status;
  }



  template <int dim>
  std::vector<double>
  MotionTransfer<dim>::velocity_change(const Trial<dim>          &trial,
                                       const double               kept,
                                       const std::vector<double> &v_end) const
  {
    std::vector<double> change(v_end.size());
    for (std::size_t i = 0; i < v_end.size(); ++i)
      change[i] = v_end[i] - kept * trial.motion[field].velocity_n[i];
    return change;
  }



  template <int dim>
  double
  MotionTransfer<dim>::loss(const Trial<dim> &trial) const
  {
    const double               epsilon = parameters.lumping;
    const double               kept    = parameters.kept_part(trial.times.dt);
    const std::vector<double>  v_end   = trial.end_velocity(scheme, field);
    const std::vector<double> &v_n     = trial.motion[field].velocity_n;
    double                     result  = 0.;
    if (epsilon > 0.)
      result += epsilon * lumping_energy(patch, velocity_change(trial, kept, v_end));
    if (kept < 1.)
      result += (1. - kept * kept) * (filtered_energy(patch, v_n) +
                                      (epsilon > 0. ? epsilon * lumping_energy(patch, v_n) : 0.));
    return result;
  }



  template <int dim>
  void
  MotionTransfer<dim>::to_points(const Trial<dim> &trial)
  {
    kept                             = parameters.kept_part(trial.times.dt);
    const auto               &motion = trial.motion[field];
    const std::vector<double> v_end  = trial.end_velocity(scheme, field);
    interpolate_to_points(patch, velocity_change(trial, kept, v_end), velocities);
    if (scheme.carries_acceleration)
      interpolate_to_points(patch, trial.end_acceleration(scheme, field), accelerations);
    if (!parameters.audit)
      return;
    auto new_velocities = velocities;
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      new_velocities[slot] += kept * patch.points.velocity[slot];
    audit_ = audit_transfer(patch,
                            new_velocities,
                            effective_mass,
                            parameters.lumping,
                            kept,
                            motion.velocity_n,
                            v_end,
                            trial.displacement(field));
  }



  template <int dim>
  void
  MotionTransfer<dim>::update(const unsigned int slot, PointCore<dim> &state) const
  {
    state.velocity = kept * state.velocity + velocities[slot];
  }



  template <int dim>
  void
  MotionTransfer<dim>::update(const unsigned int slot, PointState<dim> &state) const
  {
    update(slot, static_cast<PointCore<dim> &>(state));
    state.acceleration = accelerations[slot];
  }



  template <int dim>
  void
  MotionTransfer<dim>::accelerate(const std::vector<double> &force, MaterialPoints<dim> &cloud)
  {
    std::vector<double> at_nodes(std::size_t(patch.nodes.n_local()) * dim, 0.);
    const LinearStatus  status = mapping.solve(force, at_nodes);
    AssertThrow(status.success, dealii::ExcMessage("mass matrix: " + status.cause));
    interpolate_to_points(patch, at_nodes, accelerations);
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        state.acceleration = accelerations[slot];
    });
  }

  template class MotionTransfer<2>;
  template class MotionTransfer<3>;
} // namespace kedge
