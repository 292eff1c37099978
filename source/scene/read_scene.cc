#include <kedge/base/expression.h>
#include <kedge/base/user_errors.h>
#include <kedge/scene/body_condition_section.h>
#include <kedge/scene/body_section.h>
#include <kedge/scene/contact_section.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/joint_section.h>
#include <kedge/scene/load_control_section.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/read_checks.h>
#include <kedge/scene/read_geometry.h>
#include <kedge/scene/read_materials.h>
#include <kedge/scene/read_numerics.h>
#include <kedge/scene/read_pore_fluid.h>
#include <kedge/scene/read_scene.h>
#include <kedge/scene/refinement_checks.h>
#include <kedge/scene/rigid_section.h>
#include <kedge/scene/values.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** Pictures of a run whose scene does not say how many. */
    constexpr unsigned int default_n_pictures = 50;

    using ReadSection = std::function<void(const SectionReader &)>;

    void
    for_each_name(const ParameterReader &reader,
                  const std::string     &section,
                  const ReadSection     &read)
    {
      UserErrors errors;
      for (const std::string &name : reader.names(section))
        errors.attempt([&]() {
          read(SectionReader(reader, {section, name}));
        });
      errors.throw_if_any();
    }

    template <int dim>
    std::array<std::string, dim>
    components(const SectionReader &section, const std::string &entry)
    {
      const std::vector<std::string> parts = section.list(entry);
      std::array<std::string, dim>   result;
      std::copy_n(parts.begin(), dim, result.begin());
      return result;
    }

    template <int dim>
    dealii::Point<dim>
    point(const SectionReader &section, const std::string &entry)
    {
      const std::vector<double> numbers = section.numbers(entry);
      dealii::Point<dim>        result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = numbers[d];
      return result;
    }

    /** A number for each direction, or one for all. */
    template <int dim>
    std::array<unsigned int, dim>
    counts(const SectionReader &section, const std::string &entry)
    {
      const std::vector<std::string> parts = section.list(entry);
      std::array<unsigned int, dim>  result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = parse_whole_number(parts[parts.size() == 1 ? 0 : d], section.constants());
      return result;
    }

    /** Refuses grids whose nodes cannot be numbered or told apart. */
    template <int dim>
    void
    check_grid(const SectionReader &section, const GridParameters<dim> &grid)
    {
      constexpr double most_nodes = 2147483647.; // numbers of nodes are of 31 bits
      constexpr double digits     = 1e-9; // of coordinates; leaves seven for places within a cell
      double           n_nodes    = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double low = grid.origin[d], high = low + grid.extent[d];
          const double cell    = grid.extent[d] / grid.n_cells[d];
          const double largest = std::max(std::abs(low), std::abs(high));
          n_nodes *= 2. * grid.n_cells[d] + 1.;
          if (std::isfinite(high) && cell > digits * largest)
            continue;
          std::ostringstream problem;
          problem << "In direction "
                  << "xyz"[d] << " the cells are " << cell << " m long and the coordinates up to "
                  << largest
                  << " m, too large to tell places within a cell apart. Move the scene nearer to "
                     "the origin (Grid/Origin), or take larger cells.";
          throw section.error("Extent", problem.str());
        }
      if (n_nodes > most_nodes)
        {
          std::ostringstream problem;
          problem << "The grid would have up to " << n_nodes
                  << " nodes, with those in the middle of edges; there may be " << most_nodes
                  << ". Take fewer cells.";
          throw section.error("Cells", problem.str());
        }
    }

    template <int dim>
    GridParameters<dim>
    read_grid(const ParameterReader &reader)
    {
      const SectionReader section(reader, {"Grid"});
      GridParameters<dim> grid;
      if (reader.names("Bodies").empty() && !reader.names("Rigid bodies").empty() &&
          section.is_empty("Extent") && section.is_empty("Cells"))
        {
          // nothing is computed on it
          for (unsigned int d = 0; d < dim; ++d)
            grid.extent[d] = grid.n_cells[d] = 1;
          return grid;
        }
      for (const std::string entry : {"Extent", "Cells"})
        if (section.is_empty(entry))
          throw UserError(reader.place({"Grid"}, entry) + ": Grid/" + entry +
                          " must be given, but for scenes of Rigid bodies alone.");
      grid.origin     = point<dim>(section, "Origin");
      grid.extent     = point<dim>(section, "Extent");
      grid.n_cells    = counts<dim>(section, "Cells");
      grid.refinement = section.text("Refinement");
      check_grid(section, grid);
      return grid;
    }



    template <int dim>
    std::vector<NodeConditionParameters<dim>>
    read_node_conditions(const ParameterReader &reader)
    {
      const std::string                         directions = "xyz";
      std::vector<NodeConditionParameters<dim>> conditions;
      for_each_name(reader, "Node conditions", [&](const SectionReader &section) {
        NodeConditionParameters<dim> condition;
        condition.name = section.name();
        if (!section.is_empty("Body"))
          find_name(reader, section, "Body", "Bodies");
        condition.body    = section.text("Body");
        condition.on_side = first_is_given(section, "Side", "Where");
        if (condition.on_side)
          condition.side = parse_side<dim>(section.text("Side"));
        else
          condition.where = section.text("Where");
        condition.reaction      = section.truth("Reaction");
        condition.pore_pressure = section.text("Pore pressure");
        bool acts               = !condition.pore_pressure.empty();
        for (unsigned int d = 0; d < dim; ++d)
          {
            condition.components[d] =
              parse_component_condition(section.text(std::string("Component ") + directions[d]),
                                        section.constants());
            acts = acts || condition.components[d].kind != ConditionKind::free;
          }
        if (!acts)
          throw section.error("Component x",
                              "All components are free, so the condition does nothing; fix or "
                              "move one, give a Pore pressure, or leave the condition out.");
        conditions.push_back(condition);
      });
      return conditions;
    }



    template <int dim>
    std::vector<PointLoadParameters<dim>>
    read_point_loads(const ParameterReader &reader)
    {
      std::vector<PointLoadParameters<dim>> loads;
      for_each_name(reader, "Point loads", [&](const SectionReader &section) {
        find_name(reader, section, "Body", "Bodies");
        PointLoadParameters<dim> load;
        load.name     = section.name();
        load.body     = section.text("Body");
        load.place    = point<dim>(section, "Place");
        load.n_points = section.whole_number("Points");
        load.force    = components<dim>(section, "Force");
        loads.push_back(load);
      });
      return loads;
    }

    template <int dim>
    std::vector<TractionParameters<dim>>
    read_tractions(const ParameterReader &reader)
    {
      std::vector<TractionParameters<dim>> tractions;
      for_each_name(reader, "Tractions", [&](const SectionReader &section) {
        find_name(reader, section, "Body", "Bodies");
        TractionParameters<dim> traction;
        traction.name  = section.name();
        traction.body  = section.text("Body");
        traction.side  = parse_side_or_all<dim>(section.text("Side"));
        traction.where = section.text("Where");
        if (!section.is_empty("Traction"))
          traction.traction = components<dim>(section, "Traction");
        traction.pressure  = section.text("Pressure");
        traction.resultant = section.truth("Resultant");
        if (section.is_empty("Traction") && section.is_empty("Pressure"))
          throw section.error("Traction", "The load has neither a Traction nor a Pressure.");
        tractions.push_back(traction);
      });
      return tractions;
    }



    OutputParameters
    read_output(const ParameterReader &reader, const TimeParameters &time)
    {
      const SectionReader            section(reader, {"Output"});
      const std::vector<std::string> formats = section.list("Formats");
      const auto                     has     = [&](const std::string &format) {
        return std::find(formats.begin(), formats.end(), format) != formats.end();
      };

      OutputParameters output;
      output.points_every_steps = section.whole_number("Points every steps");
      if (!section.is_empty("Points interval"))
        {
          output.points_interval = section.number("Points interval");
          // fixed steps that do not divide the interval stay what the user asked for
          const double n       = output.points_interval / time.step;
          const bool   divides = std::abs(n - std::round(n)) < 1e-6 * n && n > 0.5;
          output.hit_output_times =
            time.adapt_step || (time.step_kind == StepSizeKind::fixed && divides);
        }
      else if (output.points_every_steps == 0)
        output.points_interval = (time.end - time.start) / default_n_pictures;
      output.fields                 = section.list("Fields");
      output.vtu                    = has("vtu");
      output.hdf5                   = has("hdf5");
      output.grid                   = section.truth("Grid");
      output.checkpoint_every_steps = section.whole_number("Checkpoint every steps");
      output.checkpoint_interval    = section.number("Checkpoint interval");
      output.progress_interval      = section.number("Progress interval");
      return output;
    }



    template <int dim>
    std::vector<ProbeParameters<dim>>
    read_probes(const ParameterReader &reader)
    {
      std::vector<ProbeParameters<dim>> probes;
      for_each_name(reader, "Probes", [&](const SectionReader &section) {
        ProbeParameters<dim> probe;
        probe.name = section.name();
        if (!section.is_empty("Body"))
          find_name(reader, section, "Body", "Bodies");
        probe.body      = section.text("Body");
        probe.face_mean = !first_is_given(section, "Place", "Face");
        if (probe.face_mean)
          probe.side = parse_side<dim>(section.text("Face"));
        else
          probe.place = point<dim>(section, "Place");
        probes.push_back(probe);
      });
      return probes;
    }

    /** Refuses initial stresses where a mean strain of a cell would not know of them. */
    template <int dim>
    void
    check_initial_stress(const ParameterReader &reader, const Scene<dim> &scene)
    {
      for (const BodyParameters<dim> &body : scene.bodies)
        if (body.initial_stress.empty() &&
            scene.materials[body.material].kind == MaterialKind::modified_cam_clay)
          throw SectionReader(reader, {"Bodies", body.name})
            .error("Initial stress",
                   "Model modified_cam_clay cannot be without stress: give it one in compression.");
        else if (!body.initial_stress.empty() &&
                 scene.materials[body.material].volume_change == VolumeChange::cell_mean)
          throw SectionReader(reader, {"Bodies", body.name})
            .error("Initial stress",
                   "The volume change of material '" + scene.materials[body.material].name +
                     "' must be pointwise.");
    }

    /** Gives the grid the nodes in the middles of its edges, if a basis wants them. */
    template <int dim>
    void
    set_elements(const ParameterReader &reader, Scene<dim> &scene)
    {
      const bool is_quadratic =
        !scene.bodies.empty() && scene.bodies[0].basis == BasisKind::quadratic;
      if (is_quadratic || (scene.pore_fluid && scene.pore_fluid->coarse_pressure))
        scene.grid.node_intervals = 2;
      std::set<BasisKind> bases;
      for (const auto &body : scene.bodies)
        bases.insert(body.basis);
      check_stabilisation(reader, scene.stabilisation.method, bases, scene.time);
      if (!is_quadratic)
        return;
      for (const MaterialParameters &material : scene.materials)
        if (material.volume_change == VolumeChange::cell_mean)
          throw SectionReader(reader, {"Materials", material.name})
            .error("Volume change",
                   "The mean over a cell is made for linear elements, which lock; with the "
                   "quadratic basis take pointwise.");
    }
    /** What needs several sections. */
    template <int dim>
    void
    read_together(const ParameterReader &reader, Scene<dim> &scene)
    {
      UserErrors errors;
      scale_softening(scene.grid.extent[0] / scene.grid.n_cells[0], scene.materials);
      if (!errors.attempt([&]() {
            scene.pore_fluid = read_pore_fluid<dim>(reader, scene);
          }))
        errors.throw_if_any(); // the rest would ask for it
      errors.attempt([&]() {
        const LinearSolverKind kind = scene.linear_solver.kind;
        if (!scene.body_conditions.empty() && kind != LinearSolverKind::automatic &&
            kind != LinearSolverKind::direct && kind != LinearSolverKind::banded)
          throw SectionReader(reader, {"Linear solver"})
            .error("Method",
                   "Body conditions add equations without a diagonal, which iterative methods "
                   "cannot solve; take auto or direct.");
      });
      errors.attempt([&]() {
        set_elements(reader, scene);
        check_refinement(reader, scene);
        scene.newton.to_round_off =
          scene.pore_fluid && scene.time.scheme == SchemeKind::clc_midpoint;
      });
      errors.attempt([&]() {
        for (const ContactParameters &contact : scene.contacts)
          if (!scene.open_sides.empty() && is_nodal(contact.method))
            throw SectionReader(reader, {"Contact", contact.name})
              .error("Method", "With Grid/Open sides bodies must not be in contact at nodes.");
      });
      errors.attempt([&]() {
        check_initial_stress(reader, scene);
      });
      if (!scene.pore_fluid)
        for (const BodyParameters<dim> &body : scene.bodies)
          errors.attempt([&]() {
            const Expression pressure(body.initial_pore_pressure, {"x", "y", "z"}, scene.constants);
            if (!(pressure.is_constant() && pressure.value() == 0.))
              throw SectionReader(reader, {"Bodies", body.name})
                .error("Initial pore pressure", "The body is dry: there is no Pore fluid/Density.");
          });
      errors.attempt([&]() {
        read_surfaces(reader, scene);
      });
      errors.attempt([&]() {
        scene.load_control = read_load_control(reader, scene);
      });
      errors.throw_if_any();
    }
  } // namespace



  unsigned int
  scene_dimension(const ParameterFile &file)
  {
    for (const ParameterEntry &entry : file.entries)
      if (entry.section.empty() && entry.name == "Dimension")
        {
          if (entry.value != "2" && entry.value != "3")
            throw UserError(entry.origin.describe() + ": Dimension = " + entry.value +
                            ": It must be 2 (plane strain) or 3.");
          return entry.value == "2" ? 2 : 3;
        }
    // the reader says which entry is misspelt or that Dimension is missing
    ParameterFile top_level;
    top_level.file_name = file.file_name;
    for (const ParameterEntry &entry : file.entries)
      if (entry.section.empty())
        top_level.entries.push_back(entry);
    ParameterReader(top_level, {declare_scene<2>({}).front()}, {});
    Assert(false, dealii::ExcInternalError());
    return dealii::numbers::invalid_unsigned_int;
  }



  namespace
  {
    /** Reads the sections that need no other, all of them, so that the user sees all errors. */
    template <int dim>
    void
    read_alone(const ParameterReader &reader, const ParameterFile &file, Scene<dim> &scene)
    {
      UserErrors errors;
      const bool has_grid = errors.attempt([&]() {
        scene.grid = read_grid<dim>(reader);
      });
      for (const std::string &side : SectionReader(reader, {"Grid"}).list("Open sides"))
        scene.open_sides.push_back(parse_side<dim>(side));
      errors.attempt([&]() {
        scene.node_conditions = read_node_conditions<dim>(reader);
      });
      errors.attempt([&]() {
        scene.materials = read_materials(reader);
        reduce_strength(reader, scene.materials);
      });
      if (has_grid)
        errors.attempt([&]() {
          scene.bodies = read_bodies<dim>(reader,
                                          scene.grid,
                                          std::filesystem::path(file.file_name).parent_path());
        });
      if (has_grid)
        errors.attempt([&]() {
          scene.rigid_bodies =
            read_rigid_bodies<dim>(reader,
                                   scene.grid,
                                   std::filesystem::path(file.file_name).parent_path());
          scene.lines  = read_lines(reader);
          scene.joints = read_joints<dim>(reader);
        });
      errors.attempt([&]() {
        scene.contacts = read_contacts<dim>(reader);
      });
      errors.attempt([&]() {
        scene.body_conditions = read_body_conditions<dim>(reader);
      });
      errors.attempt([&]() {
        scene.point_loads = read_point_loads<dim>(reader);
      });
      errors.attempt([&]() {
        scene.tractions = read_tractions<dim>(reader);
      });
      const bool has_time = errors.attempt([&]() {
        scene.time = read_time(reader);
      });
      errors.attempt([&]() {
        scene.probes = read_probes<dim>(reader);
      });
      if (has_time)
        errors.attempt([&]() {
          scene.output = read_output(reader, scene.time);
          scene.checks = read_checks(reader, scene.time);
        });
      errors.throw_if_any();
    }
  } // namespace



  template <int dim>
  Scene<dim>
  read_scene(const ParameterFile &file)
  {
    Scene<dim> scene;
    scene.constants = read_constants(file);
    const ParameterReader reader(file, declare_scene<dim>(scene.constants), scene.constants);
    if (scene_dimension(file) != dim)
      throw UserError("A scene with Dimension = " + std::to_string(scene_dimension(file)) +
                      " cannot be read as one of " + std::to_string(dim) + " dimensions.");

    scene.name  = file.scene_name();
    scene.title = SectionReader(reader, {}).text("Title");
    read_alone(reader, file, scene);
    scene.body_force    = components<dim>(SectionReader(reader, {"Body force"}), "Acceleration");
    scene.equilibrium   = {SectionReader(reader, {"Equilibrium"}).whole_number("Steps"),
                           SectionReader(reader, {"Equilibrium"}).number("Duration")};
    scene.newton        = read_newton(reader);
    scene.linear_solver = read_linear_solver(reader);
    scene.transfer      = read_mapping(reader);
    scene.stabilisation = read_stabilisation(reader);
    read_together<dim>(reader, scene);
    if (scene.pore_fluid)
      scene.time.pore_theta = SectionReader(reader, {"Pore fluid"}).number("Theta");
    scene.parameters = reader.print();
    scene.settings   = reader.settings();
    return scene;
  }



  template Scene<2>
  read_scene<2>(const ParameterFile &);
  template Scene<3>
  read_scene<3>(const ParameterFile &);
} // namespace kedge
