#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/geometry/stl_file.h>
#include <kedge/points/geometry.h>

#include <deal.II/base/utilities.h>

#include "shapes.h"

namespace kedge
{
  namespace
  {
    /** One term of a description and the sign in front of it. */
    struct SignedShape
    {
      char        sign = '+';
      std::string text;
    };

    /** Splits at the + and - outside all parentheses. */
    std::vector<SignedShape>
    split_terms(const std::string &description)
    {
      std::vector<SignedShape> terms(1);
      int                      depth = 0;
      for (const char letter : description)
        {
          depth += (letter == '(') - (letter == ')');
          if (depth < 0)
            throw UserError("The geometry '" + description + "' closes a parenthesis too many.");
          if (depth == 0 && (letter == '+' || letter == '-'))
            terms.push_back({letter, ""});
          else
            terms.back().text += letter;
        }
      if (depth != 0)
        throw UserError("The geometry '" + description + "' leaves a parenthesis open.");
      for (SignedShape &term : terms)
        {
          term.text = dealii::Utilities::trim(term.text);
          if (term.text.empty())
            throw UserError("The geometry '" + description + "' lacks a shape beside a + or -.");
        }
      return terms;
    }



    /** The numbers of "x, y, z; x, y, z; r", which must be @p n_numbers. */
    std::vector<double>
    read_numbers(const std::string                   &arguments,
                 const std::size_t                    n_numbers,
                 const std::string                   &form,
                 const std::map<std::string, double> &constants)
    {
      const std::vector<std::string> parts = split_list(arguments);
      if (parts.size() != n_numbers)
        throw UserError("It has " + std::to_string(parts.size()) + " numbers instead of " +
                        std::to_string(n_numbers) + ", its form is " + form + ".");
      std::vector<double> numbers;
      for (const std::string &part : parts)
        numbers.push_back(evaluate_constant(part, constants));
      return numbers;
    }

    template <int dim>
    dealii::Point<dim>
    point_at(const std::vector<double> &numbers, const std::size_t first)
    {
      dealii::Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = numbers[first + d];
      return point;
    }



    Shape<2>
    read_polygon(const std::string &arguments, const std::map<std::string, double> &constants)
    {
      const std::vector<std::string> parts = split_list(arguments);
      if (parts.size() < 6 || parts.size() % 2 != 0)
        throw UserError("It has " + std::to_string(parts.size()) +
                        " numbers instead of two for each of at least three corners, its form is "
                        "polygon(x0, y0; x1, y1; x2, y2; ...).");
      std::vector<dealii::Point<2>> corners(parts.size() / 2);
      for (std::size_t i = 0; i < parts.size(); ++i)
        corners[i / 2][i % 2] = evaluate_constant(parts[i], constants);
      return make_polygon(corners);
    }

    Shape<3>
    read_enclosed(const std::string                          &arguments,
                  const std::map<std::string, double>        &constants,
                  const std::optional<std::filesystem::path> &folder)
    {
      const std::string              form  = "stl(file; scale; x, y, z; a, b, c)";
      const std::vector<std::string> parts = split_list(arguments);
      if (parts.empty() || parts[0].empty())
        throw UserError("It lacks the name of a file, its form is " + form + ".");
      if (parts.size() != 1 && parts.size() != 2 && parts.size() != 5 && parts.size() != 8)
        throw UserError("After the file it has " + std::to_string(parts.size() - 1) +
                        " numbers instead of 0, 1, 4 or 7, its form is " + form + ".");
      Placement placement;
      for (std::size_t i = 1; i < parts.size(); ++i)
        {
          const double number                 = evaluate_constant(parts[i], constants);
          (i == 1  ? placement.scale
           : i < 5 ? placement.shift[i - 2]
                   : placement.angles[i - 5]) = number;
        }
      if (!(placement.scale > 0))
        throw UserError("The scale must be greater than 0.");
      if (!folder)
        return make_box(dealii::Point<3>(), dealii::Point<3>(1, 1, 1)); // stands for any shape
      return make_enclosed(
        std::make_shared<TriangleSurface>(placed(read_stl(*folder / parts[0]), placement)));
    }



    template <int dim>
    Shape<dim>
    make_shape(const std::string                          &kind,
               const std::string                          &arguments,
               const std::map<std::string, double>        &constants,
               const std::optional<std::filesystem::path> &folder)
    {
      if (kind == "box")
        {
          const auto numbers =
            read_numbers(arguments,
                         2 * dim,
                         dim == 2 ? "box(x0, y0; x1, y1)" : "box(x0, y0, z0; x1, y1, z1)",
                         constants);
          return make_box<dim>(point_at<dim>(numbers, 0), point_at<dim>(numbers, dim));
        }
      if (kind == "ball")
        {
          const auto numbers =
            read_numbers(arguments,
                         dim + 1,
                         dim == 2 ? "ball(x, y; radius)" : "ball(x, y, z; radius)",
                         constants);
          return make_ball<dim>(point_at<dim>(numbers, 0), numbers[dim]);
        }
      if (kind == "cylinder")
        {
          if (dim == 2)
            throw UserError("A cylinder exists in 3D only; in 2D write ball(x, y; radius).");
          const auto numbers =
            read_numbers(arguments, 2 * dim + 1, "cylinder(x, y, z; x, y, z; radius)", constants);
          return make_cylinder<dim>(point_at<dim>(numbers, 0),
                                    point_at<dim>(numbers, dim),
                                    numbers[2 * dim]);
        }
      if (kind == "implicit")
        {
          const std::vector<std::string> variables =
            dim == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
          return make_implicit<dim>(Expression(arguments, variables, constants));
        }
      if constexpr (dim == 2)
        {
          if (kind == "polygon")
            return read_polygon(arguments, constants);
        }
      else if (kind == "stl")
        return read_enclosed(arguments, constants, folder);
      if (kind == "below" || kind == "above")
        {
          const std::vector<std::string> variables =
            dim == 2 ? std::vector<std::string>{"x"} : std::vector<std::string>{"x", "z"};
          Expression(arguments, variables, constants); // which must not depend on y
          return make_implicit<dim>(Expression(
            (kind == "below" ? "y - (" : "(") + arguments + (kind == "below" ? ")" : ") - y"),
            dim == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"},
            constants));
        }
      if (kind == "polygon" || kind == "stl")
        throw UserError(kind == "stl" ? "A surface encloses a body in 3D only; in 2D write "
                                        "polygon(x0, y0; x1, y1; ...)."
                                      : "A polygon exists in 2D only; in 3D write stl(file).");
      throw UserError(
        "There is no shape '" + kind + "'; did you mean " +
        nearest_name(kind,
                     {"box", "ball", "cylinder", "implicit", "below", "above", "polygon", "stl"}) +
        "?");
    }



    template <int dim>
    Shape<dim>
    parse_term(const std::string                          &term,
               const std::map<std::string, double>        &constants,
               const std::optional<std::filesystem::path> &folder)
    {
      const std::size_t open = term.find('(');
      try
        {
          if (open == std::string::npos || term.back() != ')')
            throw UserError("A shape has the form name(numbers).");
          return make_shape<dim>(dealii::Utilities::trim(term.substr(0, open)),
                                 term.substr(open + 1, term.size() - open - 2),
                                 constants,
                                 folder);
        }
      catch (const UserError &error)
        {
          throw UserError("The geometry's term '" + term + "' cannot be used. " + error.what());
        }
    }
  } // namespace



  template <int dim>
  std::shared_ptr<Geometry<dim>>
  parse_geometry(const std::string                          &description,
                 const std::map<std::string, double>        &constants,
                 const std::optional<std::filesystem::path> &folder)
  {
    if (dealii::Utilities::trim(description).empty())
      throw UserError("The geometry is empty; write for example box(0, 0; 1, 1).");
    Shape<dim> geometry;
    for (const SignedShape &term : split_terms(description))
      {
        const auto shape = parse_term<dim>(term.text, constants, folder);
        if (!geometry)
          geometry = shape;
        else if (term.sign == '+')
          geometry = make_union<dim>(geometry, shape);
        else
          geometry = make_difference<dim>(geometry, shape);
      }
    return geometry;
  }



  namespace
  {
    /** Whether two shapes have a place in common, see parse_pieces(). */
    template <int dim>
    bool
    touch(const Geometry<dim> &a, const Geometry<dim> &b, const dealii::BoundingBox<dim> &domain)
    {
      constexpr int n_parts = 64;

      const auto         of_a = a.bounding_box(domain).get_boundary_points();
      const auto         of_b = b.bounding_box(domain).get_boundary_points();
      dealii::Point<dim> low, high;
      int                n_places = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          low[d]                = std::max(of_a.first[d], of_b.first[d]);
          high[d]               = std::min(of_a.second[d], of_b.second[d]);
          const double rounding = 1e-12 * (of_a.second[d] - of_a.first[d]);
          if (high[d] < low[d] - rounding)
            return false;
          n_places *= n_parts + 1;
        }
      for (int k = 0; k < n_places; ++k)
        {
          dealii::Point<dim> x;
          for (int d = 0, rest = k; d < dim; ++d, rest /= n_parts + 1)
            x[d] = low[d] + (rest % (n_parts + 1)) * (high[d] - low[d]) / n_parts;
          if (a.contains(x) && b.contains(x))
            return true;
        }
      return false;
    }
  } // namespace



  template <int dim>
  std::vector<std::shared_ptr<Geometry<dim>>>
  parse_pieces(const std::string                          &description,
               const dealii::BoundingBox<dim>             &domain,
               const std::map<std::string, double>        &constants,
               const std::optional<std::filesystem::path> &folder)
  {
    std::vector<Shape<dim>> pieces;
    for (const SignedShape &term : split_terms(description))
      {
        const auto shape = parse_term<dim>(term.text, constants, folder);
        if (pieces.empty() || term.sign == '+')
          pieces.push_back(shape);
        else
          for (auto &piece : pieces)
            piece = make_difference<dim>(piece, shape);
      }
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t j = i + 1; j < pieces.size();)
        if (touch<dim>(*pieces[i], *pieces[j], domain))
          {
            pieces[i] = make_union<dim>(pieces[i], pieces[j]);
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
            j = i + 1; // what was apart from this piece may touch it now
          }
        else
          ++j;
    return pieces;
  }

#define KEDGE_INSTANTIATE(dim)                                       \
  template std::vector<std::shared_ptr<Geometry<dim>>> parse_pieces( \
    const std::string &,                                             \
    const dealii::BoundingBox<dim> &,                                \
    const std::map<std::string, double> &,                           \
    const std::optional<std::filesystem::path> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)

  template std::shared_ptr<Geometry<2>>
  parse_geometry<2>(const std::string &,
                    const std::map<std::string, double> &,
                    const std::optional<std::filesystem::path> &);
  template std::shared_ptr<Geometry<3>>
  parse_geometry<3>(const std::string &,
                    const std::map<std::string, double> &,
                    const std::optional<std::filesystem::path> &);
} // namespace kedge
