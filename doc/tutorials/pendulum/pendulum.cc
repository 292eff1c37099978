// A first program with the library: an elastic rod, hung at one end and let go
// from the horizontal, swings down. No scene file and no output folder: the
// scene is built here, and the step is driven by hand. The page library.md, beside
// this folder, explains it.
//
// What to expect. A rigid rod of length L and width b turns about its end with
//   I theta'' = -m g L/2 sin(theta),  I = m (L^2/3 + b^2/12),
// and is at theta, measured from the vertical, at the time
//   t = (K(k) - F(psi, k)) / w,  sin(psi) = sin(theta/2)/k,  w^2 = m g L / (2 I),
// F the elliptic integral of the first kind, k = sin(45 degrees), K(k) = F(90 degrees, k): at the
// vertical after K(k)/w = 1.854074677/w. Ours bends by a hundredth of its length on the way, too
// little to matter: 0.5 % are allowed below.

#include <kedge/base/single_process.h>
#include <kedge/simulation/step.h>
#include <kedge/time_integration/clock.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

namespace
{
  constexpr double length = 1., width = 0.125, gravity = 10.;
  const double     vertical = std::acos(0.);

  // A Scene is a collection of parameter structs: section "Grid" of a scene file
  // is scene.grid here, and so on. All in SI units.
  kedge::Scene<2>
  make_scene()
  {
    kedge::Scene<2> scene;
    scene.name = "pendulum";

    // The box in which the rod may move. Empty cells cost nothing.
    scene.grid.origin  = {-1.5, -1.5};
    scene.grid.extent  = dealii::Tensor<1, 2>({3., 3.});
    scene.grid.n_cells = {{48, 48}}; // cells of 0.0625 m, two over the rod's width

    kedge::MaterialParameters rubber;
    rubber.name          = "rubber";
    rubber.density       = 1000.;
    rubber.young_modulus = 1e8;
    rubber.poisson_ratio = 0.3;
    scene.materials      = {rubber};

    // The rod along the x axis, its left end in the middle of the box.
    kedge::BodyParameters<2> rod;
    rod.name     = "rod";
    rod.geometry = kedge::parse_geometry<2>("box(0, -b/2; L, b/2)", {{"L", length}, {"b", width}});
    rod.material = 0; // index into scene.materials
    rod.points_per_cell  = {{3, 3}};
    rod.initial_velocity = {{"0", "0"}}; // expressions, as in a scene file
    scene.bodies         = {rod};

    // The hinge: one node of the grid that does not move.
    kedge::NodeConditionParameters<2> hinge;
    hinge.name    = "hinge";
    hinge.on_side = false;
    hinge.where   = "abs(x) < 1e-6 && abs(y) < 1e-6";
    for (auto &component : hinge.components)
      component.kind = kedge::ConditionKind::fixed;
    scene.node_conditions = {hinge};

    scene.constants  = {{"g", gravity}};
    scene.body_force = {{"0", "-g"}}; // may depend on t

    // The scheme that conserves energy; about 50 steps to the vertical.
    scene.time.scheme = kedge::SchemeKind::clc_midpoint;
    scene.time.end    = 1.;
    scene.time.step   = 0.01;
    return scene;
  }

  // The angle between the horizontal and the line from hinge to centre of mass.
  double
  angle(const kedge::Model<2> &model)
  {
    dealii::Tensor<1, 2> first_moment;
    model.points.points().for_each([&](unsigned int,
                                       std::uint64_t,
                                       const dealii::Point<2>     &location,
                                       const kedge::PointState<2> &state) {
      first_moment += state.mass * location;
    });
    return std::atan2(-first_moment[1], first_moment[0]);
  }

  // When a rigid rod has turned by an angle from the horizontal, see above.
  double
  rigid_time(const double angle)
  {
    const double k = std::sqrt(0.5), psi = std::asin(std::sin(0.5 * (vertical - angle)) / k);
    const double w =
      std::sqrt(gravity * length / 2. / (length * length / 3. + width * width / 12.));
    return (std::comp_ellint_1(k) - std::ellint_1(k, psi)) / w;
  }
} // namespace



int
main(int argc, char **argv)
{
  kedge::hasten_single_process_start();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const kedge::Scene<2> scene = make_scene();
  kedge::Model<2>       model(scene, MPI_COMM_WORLD);
  kedge::Step<2>        step(model);
  model.create_points();

  // The books of the committed state: energies, momenta, counts, by the names that they
  // have in history.csv. All balances start here.
  const kedge::Ledger &books = model.ledger;
  step.book_state();
  model.ledger.set_start();
  std::cout << books.value("n_points") << " material points in " << books.value("n_active_cells")
            << " cells, " << books.value("n_dofs") << " unknowns\n";

  kedge::Clock clock(scene.time);
  clock.set_nominal_step(scene.time.step);
  double        largest_error = 0., largest_energy = 0., time_down = 0.;
  std::ofstream table("pendulum.csv"); // for the picture
  table << "angle,kedge,rigid rod\n0,0,0\n";
  while (!clock.finished() && time_down == 0.)
    {
      // An attempt changes nothing that is committed. If it is refused (no
      // convergence, a point turned inside out) try again with half the step.
      const kedge::StepReport report = step.attempt({clock.time(), clock.step_size()});
      if (!report.accepted)
        {
          std::cout << "step refused: " << report.cause << '\n';
          if (report.hopeless || !clock.cut_step())
            return 1;
          continue;
        }
      const double angle_before = angle(model), time_before = clock.time();
      step.commit();
      clock.advance();

      // What gravity put in must be what the rod has gained.
      largest_energy = std::max(largest_energy, books.value("kinetic_energy"));
      largest_error  = std::max(largest_error, std::abs(books.value("energy_error")));

      const double angle_now = angle(model); // taken as linear within the step
      table << angle_now * 90. / vertical << ',' << clock.time() << ',' << rigid_time(angle_now)
            << '\n';
      if (angle_now >= vertical)
        time_down = time_before + (clock.time() - time_before) * (vertical - angle_before) /
                                    (angle_now - angle_before);
    }

  const double rigid = rigid_time(vertical);
  std::cout << "vertical after " << time_down << " s, a rigid rod after " << rigid << " s\n"
            << "largest error of the energy books, relative: " << largest_error / largest_energy
            << std::endl;
  const bool good =
    std::abs(time_down / rigid - 1.) < 0.005 && largest_error < 1e-9 * largest_energy;
  return good ? 0 : 1;
}
