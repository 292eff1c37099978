#include <kedge/base/user_errors.h>
#include <kedge/scene/body_section.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_geometry.h>
#include <kedge/scene/values.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    template <int dim>
    std::array<std::string, dim>
    velocity_of(const SectionReader &section)
    {
      const std::vector<std::string> parts = section.list("Initial velocity");
      std::array<std::string, dim>   result;
      std::copy_n(parts.begin(), dim, result.begin());
      return result;
    }

    /** A number for each direction, or one for all. */
    template <int dim>
    std::array<unsigned int, dim>
    points_per_cell_of(const SectionReader &section)
    {
      const std::vector<std::string> parts = section.list("Points per cell");
      std::array<unsigned int, dim>  result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = parse_whole_number(parts[parts.size() == 1 ? 0 : d], section.constants());
      return result;
    }

    BasisKind
    basis_of(const std::string &name)
    {
      return name == "gimp"        ? BasisKind::gimp
             : name == "spline"    ? BasisKind::spline
             : name == "quadratic" ? BasisKind::quadratic
                                   : BasisKind::linear;
    }
  } // namespace



  template <int dim>
  std::vector<BodyParameters<dim>>
  read_bodies(const ParameterReader       &reader,
              const GridParameters<dim>   &grid,
              const std::filesystem::path &folder)
  {
    std::vector<BodyParameters<dim>> bodies;
    UserErrors                       errors;
    for (const std::string &name : reader.names("Bodies"))
      errors.attempt([&]() {
        const SectionReader section(reader, {"Bodies", name});
        BodyParameters<dim> body;
        body.name     = section.name();
        body.geometry = read_geometry<dim>(section, grid, folder);
        if (section.text("Pieces") == "apart")
          body.pieces = read_pieces<dim>(section, grid, folder);
        body.material        = find_name(reader, section, "Material", "Materials");
        body.points_per_cell = points_per_cell_of<dim>(section);
        body.clip            = section.text("Cut cells") == "clipped";
        body.basis           = basis_of(section.text("Basis"));
        if (!bodies.empty() &&
            (bodies[0].basis == BasisKind::quadratic) != (body.basis == BasisKind::quadratic))
          throw section.error("Basis", "If a body is quadratic, all of them must be.");
        body.initial_velocity      = velocity_of<dim>(section);
        body.body_force            = section.truth("Body force");
        body.initial_stress        = section.list("Initial stress");
        body.initial_pore_pressure = section.text("Initial pore pressure");
        bodies.push_back(body);
      });
    errors.throw_if_any();
    if (bodies.empty() && reader.names("Rigid bodies").empty())
      throw UserError(reader.place({"Bodies"}, "") +
                      ": the scene has no body; add a subsection Bodies/<name>.");
    return bodies;
  }



  template <int dim>
  SectionDeclaration
  declare_bodies(const ValuePatterns<dim> &allow)
  {
    const std::vector<std::string> places =
      dim == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
    const std::string words = dim == 2 ? "x, y" : "x, y, z";
    return {
      "Bodies",
      "What the material points make up.",
      SectionKind::named,
      {{"Geometry",
        std::nullopt,
        allow.geometry(),
        "The region that the body fills at the start [m]."},
       {"Pieces",
        "together",
        allow.one_of({"together", "apart"}),
        "Shapes of the Geometry that do not touch. together: they share the nodes of the grid, "
        "and hold on to each other when they are closer than two cells. apart: each is a body "
        "of its own, NAME 1, NAME 2 .. in the order of the Geometry, that never feels the "
        "others; no other entry may then name the body, but those of Contact."},
       {"Material",
        std::nullopt,
        allow.text("the name of a section of Materials"),
        "What it is made of."},
       {"Points per cell",
        "2",
        allow.counts(true),
        "Material points per grid cell and direction [-]."},
       {"Cut cells",
        "clipped",
        allow.one_of({"clipped", "whole"}),
        "Points of sub-cells that the body's surface cuts. clipped: with volume and centre of "
        "what lies in the body. whole: of the whole sub-cell if its centre lies in the body."},
       {"Basis",
        "gimp",
        allow.one_of({"linear", "gimp", "spline", "quadratic"}),
        "linear: points without extent. gimp: with a domain, smoother. spline: B-splines averaged "
        "over it, smoothest. quadratic: without extent, quadratic elements (all bodies)."},
       {"Initial velocity",
        dim == 2 ? "0; 0" : "0; 0; 0",
        allow.expressions(places, words),
        "Velocity at the start [m/s]; x, y, z is the place at the start."},
       {"Initial stress",
        "",
        allow
          .expressions(places,
                       words,
                       dim == 2 ? std::vector<std::string>{"xx", "yy", "zz", "xy"}
                                : std::vector<std::string>{"xx", "yy", "zz", "xy", "xz", "yz"})
          .or_empty(),
        "Stress at the start, the effective one of a saturated body [Pa]; x, y, z is the "
        "place; empty: none."},
       {"Initial pore pressure",
        "0",
        allow.expression(places, words),
        "Of a saturated body at the start [Pa]; x, y, z is the place at the start."},
       {"Saturated",
        "true",
        allow.truth(),
        "Whether the Pore fluid, if there is one, is in it; false: a dry body, with pores at "
        "pressure 0."},
       {"Body force", "true", allow.truth(), "Whether the section Body force acts on it."}}};
  }


#define KEDGE_INSTANTIATE(dim)                                                          \
  template SectionDeclaration               declare_bodies(const ValuePatterns<dim> &); \
  template std::vector<BodyParameters<dim>> read_bodies(const ParameterReader &,        \
                                                        const GridParameters<dim> &,    \
                                                        const std::filesystem::path &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
