#include <kedge/base/expression.h>
#include <kedge/scene/body_condition_section.h>
#include <kedge/scene/body_section.h>
#include <kedge/scene/contact_section.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/joint_section.h>
#include <kedge/scene/load_control_section.h>
#include <kedge/scene/material_declarations.h>
#include <kedge/scene/numerics_declarations.h>
#include <kedge/scene/output_declarations.h>
#include <kedge/scene/rigid_section.h>
#include <kedge/scene/value_pattern.h>

#include <utility>

namespace kedge
{
  namespace
  {
    /** Declares one section after the other. */
    template <int dim>
    class SceneDeclarations
    {
    public:
      explicit SceneDeclarations(const std::map<std::string, double> &constants)
        : allow(constants)
      {}

      std::vector<SectionDeclaration>
      all() const
      {
        std::vector<SectionDeclaration> sections = {top_level(),
                                                    user_constants(),
                                                    grid(),
                                                    declare_materials(allow),
                                                    declare_pore_fluid<dim>(allow),
                                                    declare_bodies(allow),
                                                    declare_rigid_bodies(allow),
                                                    declare_lines(allow),
                                                    declare_joints(allow),
                                                    declare_contact(allow),
                                                    node_conditions(),
                                                    declare_body_conditions(allow),
                                                    body_force(),
                                                    point_loads(),
                                                    tractions(),
                                                    surface_pressures(),
                                                    surface_fluxes(),
                                                    declare_load_control<dim>(allow),
                                                    equilibrium(),
                                                    declare_time(allow)};
        for (SectionDeclaration &section : declare_numerics<dim>(allow))
          sections.push_back(std::move(section));
        sections.insert(sections.end(), {declare_output<dim>(allow), probes(), checks()});
        return sections;
      }

    private:
      using Range = NumberRange;

      static constexpr std::nullopt_t required = std::nullopt;

      // values that differ in 2D and 3D

      static std::string
      per_direction(const std::string &value, const std::string &separator)
      {
        std::string values = value;
        for (unsigned int d = 1; d < dim; ++d)
          values += separator + value;
        return values;
      }

      static std::vector<std::string>
      coordinates(const std::string &letters)
      {
        std::vector<std::string> names;
        for (unsigned int d = 0; d < dim; ++d)
          names.emplace_back(1, letters[d]);
        return names;
      }

      static std::string
      coordinate_words(const std::string &letters)
      {
        return dim == 2
                 ? letters.substr(0, 1) + ", " + letters.substr(1, 1)
                 : letters.substr(0, 1) + ", " + letters.substr(1, 1) + ", " + letters.substr(2, 1);
      }

      // sections

      SectionDeclaration
      top_level() const
      {
        return {"",
                "A scene of kedge. SI units, tension positive.",
                SectionKind::plain,
                {{"Dimension",
                  required,
                  allow.one_of({"2", "3"}),
                  "Space dimension. 2 is plane strain: masses, forces and energies are per metre "
                  "of thickness."},
                 {"Title", "", allow.text("any text").or_empty(), "What the scene shows."},
                 {"Strength reduction",
                  "1",
                  allow.number(Range::positive()),
                  "F: the strengths of all materials that yield are divided by it: cohesion, tan "
                  "phi, undrained strength, yield stress; psi is phi at most. `kedge safety` finds "
                  "the largest F that a slope bears, its safety factor [-]."}}};
      }

      SectionDeclaration
      user_constants() const
      {
        return {
          "Constants",
          "Numbers under names of your own, for use in all expressions and in place of all "
          "numbers; pi is there already.",
          SectionKind::free_entries,
          {{"<name>", required, allow.number(), "Any number, also an expression of others."}}};
      }

      SectionDeclaration
      grid() const
      {
        std::vector<std::string> variables = coordinates("xyz");
        variables.insert(variables.end(), {"t", "plastic_strain", "distance"});
        return {
          "Grid",
          "The box with the background grid, divided into equal cells.",
          SectionKind::plain,
          {{"Origin",
            per_direction("0", ", "),
            allow.vector(),
            "Corner with the lowest x, y, z [m]."},
           {"Extent",
            "",
            allow.vector(Range::positive()).or_empty(),
            "Lengths of the edges [m]; empty: for scenes of Rigid bodies alone."},
           {"Cells",
            "",
            allow.counts(false).or_empty(),
            "Number of cells per direction [-]; empty: likewise."},
           {"Refinement",
            "",
            allow.expression(variables, coordinate_words("xyz") + ", t, plastic_strain, distance")
              .or_empty(),
            "How often a cell with its middle at this place is halved in every direction, a "
            "whole number from 0 to 6 [-], for example if(abs(x) < 1, 2, 0) or "
            "if(plastic_strain > 0.02, 1, 0); empty: never. t is the time; plastic_strain "
            "the largest equivalent plastic strain of the points in the cell; distance that of "
            "its middle from the nearest surface of a rigid body [m]. Neighbours "
            "differ by one at most, so that more cells may be halved. Points per cell "
            "counts for each cell as it is at the start."},
           {"Open sides",
            "",
            allow.sides().or_empty(),
            "Sides through which material leaves the grid: its points are taken out of the "
            "run, and history.csv shows what they take with them. At other sides a point "
            "that would leave ends the run."}}};
      }

      SectionDeclaration
      node_conditions() const
      {
        std::vector<std::string> variables = coordinates("xyz");
        variables.emplace_back("t");
        SectionDeclaration section = {
          "Node conditions",
          "What moves the nodes of the grid. Either Side or Where says which.",
          SectionKind::named,
          {{"Side", "", allow.side().or_empty(), "All nodes on this side of the grid."},
           {"Where",
            "",
            allow.expression(variables, coordinate_words("xyz") + ", t").or_empty(),
            "All nodes where this is true, for example abs(x) < 1e-6 && y > 2; t is the time at "
            "which a step starts, and just after it."},
           {"Body",
            "",
            allow.text("the name of a section of Bodies").or_empty(),
            "Where a Contact lets bodies move apart: only the nodes of this body and of those that "
            "move with it. Empty: those of all bodies."}}};
        section.entries.push_back(
          {"Reaction",
           "false",
           allow.truth(),
           "Whether history.csv shows the force on the body, reaction_NAME_x.. [N; N/m in 2D]."});
        section.entries.push_back(
          {"Pore pressure",
           "",
           allow.expression(variables, coordinate_words("xyz") + ", t").or_empty(),
           "Of a saturated body there [Pa]; empty: whatever comes, no flow through the surface."});
        for (const std::string &coordinate : coordinates("xyz"))
          section.entries.push_back({"Component " + coordinate,
                                     "free",
                                     allow.component_condition(),
                                     "Motion in direction " + coordinate + "."});
        return section;
      }

      SectionDeclaration
      body_force() const
      {
        return {"Body force",
                "Acts on every body that does not say otherwise.",
                SectionKind::plain,
                {{"Acceleration",
                  per_direction("0", "; "),
                  allow.expressions({"t"}, "t"),
                  "Force per mass [m/s^2], such as gravity."}}};
      }

      SectionDeclaration
      point_loads() const
      {
        return {
          "Point loads",
          "Dead forces on the material points nearest to a place.",
          SectionKind::named,
          {{"Body",
            required,
            allow.text("the name of a section of Bodies"),
            "The body that carries the force."},
           {"Place", required, allow.vector(), "Place in the initial configuration [m]."},
           {"Points", "1", allow.whole_number(1), "How many points share the force equally [-]."},
           {"Force", required, allow.expressions({"t"}, "t"), "The whole force [N; N/m in 2D]."}}};
      }

      /** Entries that say which faces a section is about, and more. */
      std::vector<EntryDeclaration>
      faces_of_a_body(const std::vector<EntryDeclaration> &more) const
      {
        std::vector<EntryDeclaration> entries = {
          {"Body",
           required,
           allow.text("the name of a section of Bodies"),
           "The body whose faces they are."},
          {"Side",
           required,
           allow.side_or_all(),
           "The side to which the faces look at the start, rather than to another one."},
          {"Where",
           "",
           allow
             .expression(with_normal(coordinates("xyz")), coordinate_words("xyz") + normal_words())
             .or_empty(),
           "The part of the faces where this is true at the start, of the place and the outward "
           "normal; empty: all; 0: none."}};
        entries.insert(entries.end(), more.begin(), more.end());
        return entries;
      }

      /** And nx, ny, nz of a surface. */
      static std::vector<std::string>
      with_normal(std::vector<std::string> names)
      {
        for (const std::string name : {"nx", "ny", "nz"})
          if (dim == 3 || name != "nz")
            names.push_back(name);
        return names;
      }

      static std::string
      normal_words()
      {
        return dim == 2 ? ", nx, ny" : ", nx, ny, nz";
      }

      ValuePattern
      of_place_and_time() const
      {
        return allow.expression({"x", "y", "z", "t"}, coordinate_words("xyz") + ", t");
      }

      SectionDeclaration
      tractions() const
      {
        return {
          "Tractions",
          "Loads on the outer faces of a body that look to one side or to all; on sides that are "
          "oblique or curved on facets of its surface.",
          SectionKind::named,
          faces_of_a_body(
            {{"Traction",
              "",
              allow
                .expressions(with_normal({"x", "y", "z", "t"}),
                             coordinate_words("xyz") + ", t" + normal_words())
                .or_empty(),
              "Dead force per area of the undeformed face [Pa]; x, y, z is its place at the "
              "start, nx, ny, nz its outward normal."},
             {"Pressure",
              "",
              of_place_and_time().or_empty(),
              "Pressure that follows the face as it moves, turns and stretches, positive "
              "inwards [Pa]; x, y, z is its present place."},
             {"Resultant",
              "false",
              allow.truth(),
              "Whether history.csv gets its force in the balance of the step, load_NAME_x, "
              ".._y, .._z."}})};
      }

      SectionDeclaration
      surface_pressures() const
      {
        return {
          "Surface pressures",
          "Pore pressures on the outer faces of a saturated body that look to one side or to all; "
          "they move with the body, and press on it as water does.",
          SectionKind::named,
          faces_of_a_body({{"Pressure",
                            required,
                            of_place_and_time(),
                            "Of the fluid there [Pa]; x, y, z is the face's present place."},
                           {"Flow",
                            "both ways",
                            allow.one_of({"both ways", "out"}),
                            "out: a seepage face, through which no fluid comes in."}})};
      }

      SectionDeclaration
      surface_fluxes() const
      {
        return {"Surface fluxes",
                "Fluid that enters through the outer faces of a saturated body that look to one "
                "side or to all; they move with the body.",
                SectionKind::named,
                faces_of_a_body(
                  {{"Flux",
                    required,
                    of_place_and_time(),
                    "Volume, as at pressure 0, per area of the face as it is and time, positive "
                    "inwards [m/s]; x, y, z is its present place."}})};
      }

      SectionDeclaration
      equilibrium() const
      {
        return {"Equilibrium",
                "A quasi-static stage before time starts: loads as they are at Time/Start grow "
                "from zero, or act in full on bodies with an Initial stress. Then the points "
                "stand where they came to, with their stress, at rest and without displacement.",
                SectionKind::plain,
                {{"Steps", "0", allow.whole_number(0), "Of the stage [-]; 0: there is none."},
                 {"Duration",
                  "1",
                  allow.number(Range::positive()),
                  "For saturated bodies: how long the fluid flows in it [s]."}}};
      }

      SectionDeclaration
      probes() const
      {
        return {"Probes",
                "What is followed in probes.csv. Either Place or Face says what.",
                SectionKind::named,
                {{"Body",
                  "",
                  allow.text("the name of a section of Bodies").or_empty(),
                  "The body that is followed; empty: any."},
                 {"Place",
                  "",
                  allow.vector().or_empty(),
                  "The material point nearest to it at the start is followed [m]."},
                 {"Face",
                  "",
                  allow.side().or_empty(),
                  "The mean over the points at the body's outermost face on this side."}}};
      }

      SectionDeclaration
      checks() const
      {
        Range part_of_one          = Range::positive();
        part_of_one.upper          = 1;
        part_of_one.includes_upper = false;
        return {
          "Checks",
          "Known answers; each ends the run with a line PASS or FAIL.",
          SectionKind::named,
          {{"Quantity",
            required,
            allow.quantity(),
            "What is compared. drift: largest change since Time. period: twice the mean spacing "
            "of zero crossings after Time. point_error: volume mean of |field - Exact| at the end. "
            "point_quantile: what a Part of the volume has no more of than, at the end."},
           {"Time",
            "",
            allow.number().or_empty(),
            "When (at), else from when on [s]; empty: from the start."},
           {"Exact",
            "",
            allow.expression(coordinates("XYZ"), coordinate_words("XYZ") + ", the initial place")
              .or_empty(),
            "The answer of point_error at each material point."},
           {"Part",
            "",
            allow.number(part_of_one).or_empty(),
            "Of point_quantile, of the points' initial volume; 0.5: the median [-]."},
           {"Scale", "1", allow.number(Range::positive()), "The quantity is divided by it."},
           {"Reference",
            "",
            allow.number().or_empty(),
            "The known answer; empty: 0, for drift and point_error only."},
           {"Tolerance", required, allow.tolerance(), "How far off it may be."},
           {"Source", required, allow.text("any text"), "Where the known answer comes from."}}};
      }

      const ValuePatterns<dim> allow;
    };
  } // namespace



  template <int dim>
  std::vector<SectionDeclaration>
  declare_scene(const std::map<std::string, double> &constants)
  {
    return SceneDeclarations<dim>(constants).all();
  }



  template std::vector<SectionDeclaration>
  declare_scene<2>(const std::map<std::string, double> &);
  template std::vector<SectionDeclaration>
  declare_scene<3>(const std::map<std::string, double> &);
} // namespace kedge
