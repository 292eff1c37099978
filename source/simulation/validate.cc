#include <kedge/points/volume_report.h>
#include <kedge/rigid/rigid_bodies.h>
#include <kedge/simulation/attachments.h>
#include <kedge/simulation/run.h>
#include <kedge/stress/point_update.h>

#include <cmath>

namespace kedge
{
  namespace
  {
    template <int dim>
    void
    describe_rigid_bodies(std::ostream &out, const RigidBodies<dim> &bodies)
    {
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          const RigidBody &body = bodies[b];
          out << "rigid body:       " << body.name << ", " << body.mass
              << (dim == 2 ? " kg/m at (" : " kg at (");
          for (int d = 0; d < dim; ++d)
            out << (d > 0 ? ", " : "") << body.state.centre[d];
          out << ") m, moments of inertia about it ";
          for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
            out << body.inertia[d][d] << (d < 2 ? ", " : "");
          out << (dim == 2 ? " kg m, " : " kg m^2, ") << bodies.surface(b).facets.size()
              << " facets\n";
        }
    }
  } // namespace



  template <int dim>
  void
  validate_scene(const Scene<dim> &scene, std::ostream &out, const MPI_Comm communicator)
  {
    Model<dim> model(scene, communicator);
    model.create_points();
    Step<dim> first(model, false);
    first.book_state();
    const double step = scene.time.step_kind == StepSizeKind::fixed
                          ? scene.time.step
                          : scene.time.cfl_factor * cfl_step(model, first, scene.time.step_kind);

    std::vector<std::uint64_t> points_of_body(model.scene.bodies.size(), 0);
    for (const auto &point : model.generated_points())
      ++points_of_body[point.body];
    const double memory   = peak_memory(communicator);
    const auto   n_points = static_cast<std::uint64_t>(model.ledger.value("n_points"));
    const auto   n_dofs   = static_cast<std::uint64_t>(model.ledger.value("n_dofs"));
    const auto   n_cells  = static_cast<std::uint64_t>(model.ledger.value("n_active_cells"));
    const bool   is_root  = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    std::ostream silence(nullptr);
    describe_attachments(model, first, is_root ? out : silence);
    if (!is_root)
      return;
    out << "scene:            " << (scene.title.empty() ? scene.name : scene.title) << "\n";
    for (unsigned int b = 0; b < model.scene.bodies.size(); ++b)
      out << "body:             " << model.scene.bodies[b].name << ", " << points_of_body[b]
          << " material points of " << scene.materials[model.scene.bodies[b].material].name << "\n";
    if (model.rigid() != nullptr)
      describe_rigid_bodies(out, *model.rigid());
    const Lattice<dim> &lattice = model.points.grid().lattice();
    write_volumes(out, model.scene.bodies, lattice, model.generated_points());
    // a block row of the tangent reaches 3^dim nodes, 5^dim with GIMP
    const double per_point = sizeof(PointRecord<dim>) + sizeof(Stencil<dim>) +
                             sizeof(StressState<dim>) + sizeof(PointUpdate<dim>) + 200.;
    const double per_dof = 8. * dim * std::pow(5., dim) * 3.;
    out << "material points:  " << n_points << "\n"
        << "active cells:     " << n_cells << "\n"
        << "unknowns:         " << n_dofs << "\n"
        << "mass:             " << model.ledger.value("mass") << (dim == 2 ? " kg/m" : " kg")
        << "\n"
        << "first time step:  " << step << " s\n"
        << "estimated memory: "
        << std::ceil((memory + per_point * static_cast<double>(n_points) +
                      per_dof * static_cast<double>(n_dofs)) /
                     1e6)
        << " MB" << std::endl;
  }

  template void
  validate_scene(const Scene<2> &, std::ostream &, const MPI_Comm);
  template void
  validate_scene(const Scene<3> &, std::ostream &, const MPI_Comm);
} // namespace kedge
