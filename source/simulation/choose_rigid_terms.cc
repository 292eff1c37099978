// Which terms the rigid bodies of a scene have.
#include <kedge/base/exceptions.h>
#include <kedge/rigid/joint_term.h>
#include <kedge/rigid/line_term.h>
#include <kedge/rigid/rigid_distance.h>
#include <kedge/rigid/rigid_term.h>
#include <kedge/simulation/model.h>

namespace kedge
{
  template <int dim>
  void
  Model<dim>::choose_rigid_terms(const LoadProgram &program)
  {
    if (scheme.dynamic && !scheme.conserves_contact())
      throw UserError("Rigid bodies: Time/Scheme must be clc-midpoint, midpoint, quasi-static or "
                      "clc-quasi-static.");
    const GridParameters<dim>     &grid = scene.grid;
    const dealii::BoundingBox<dim> domain({grid.origin, grid.origin + grid.extent});
    auto                           term = std::make_unique<RigidTerm<dim>>(scene.rigid_bodies,
                                                 domain,
                                                 scene.body_force,
                                                 scene.constants,
                                                 program,
                                                 scheme,
                                                 scene.time.start,
                                                 communicator);
    rigid_bodies                        = &term->bodies();
    points.set_distances([bodies = rigid_bodies](const std::vector<dealii::Point<dim>> &places) {
      return distances_to_surfaces(*bodies, places);
    });
    terms.push_back(std::move(term));
    if (!scene.joints.empty())
      terms.push_back(std::make_unique<JointTerm<dim>>(scene.joints, *rigid_bodies, scheme));
    if (!scene.lines.empty())
      terms.push_back(std::make_unique<LineTerm<dim>>(scene.lines,
                                                      *rigid_bodies,
                                                      scene.constants,
                                                      program,
                                                      scheme,
                                                      scene.time.start));
  }

  template void
  Model<2>::choose_rigid_terms(const LoadProgram &);
  template void
  Model<3>::choose_rigid_terms(const LoadProgram &);
} // namespace kedge
