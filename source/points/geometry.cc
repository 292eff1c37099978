#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/points/geometry.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kedge
{
  namespace
  {
    /** How far outside a surface still counts as on it, in sizes of the shape. */
    constexpr double surface_tolerance = 1e-12;

    /**
     * A region given by its level: negative inside, zero on the surface,
     * positive outside, in sizes of the shape. Union and difference are then
     * minimum and maximum, and surfaces stay part of the region.
     */
    template <int dim>
    class Shape : public Geometry<dim>
    {
    public:
      bool
      contains(const dealii::Point<dim> &x) const override
      {
        return level(x) <= surface_tolerance;
      }

      virtual double
      level(const dealii::Point<dim> &x) const = 0;
    };



    template <int dim>
    class Box : public Shape<dim>
    {
    public:
      Box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper)
        : lower(lower)
        , upper(upper)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (!(lower[d] < upper[d]))
              throw UserError("The first corner must lie below the second in every direction.");
            size = std::max(size, upper[d] - lower[d]);
          }
      }

      double
      level(const dealii::Point<dim> &x) const override
      {
        double outside = lower[0] - x[0];
        for (unsigned int d = 0; d < dim; ++d)
          outside = std::max({outside, lower[d] - x[d], x[d] - upper[d]});
        return outside / size;
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &) const override
      {
        return dealii::BoundingBox<dim>({lower, upper});
      }

    private:
      dealii::Point<dim> lower, upper;
      double             size = 0;
    };



    template <int dim>
    class Ball : public Shape<dim>
    {
    public:
      Ball(const dealii::Point<dim> &centre, const double radius)
        : centre(centre)
        , radius(radius)
      {
        if (!(radius > 0))
          throw UserError("The radius must be greater than 0.");
      }

      double
      level(const dealii::Point<dim> &x) const override
      {
        return (x.distance(centre) - radius) / (2 * radius);
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &) const override
      {
        dealii::Point<dim> lower = centre, upper = centre;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] -= radius;
            upper[d] += radius;
          }
        return dealii::BoundingBox<dim>({lower, upper});
      }

    private:
      dealii::Point<dim> centre;
      double             radius;
    };



    /** A straight circular cylinder between the centres of its two end faces. */
    template <int dim>
    class Cylinder : public Shape<dim>
    {
    public:
      Cylinder(const dealii::Point<dim> &begin, const dealii::Point<dim> &end, const double radius)
        : begin(begin)
        , end(end)
        , radius(radius)
        , length(begin.distance(end))
        , size(std::max(length, 2 * radius))
      {
        if (!(radius > 0))
          throw UserError("The radius must be greater than 0.");
        if (!(length > 0))
          throw UserError("The two ends must differ.");
        axis = (end - begin) / length;
      }

      double
      level(const dealii::Point<dim> &x) const override
      {
        const double along  = (x - begin) * axis;
        const double radial = (x - begin - along * axis).norm();
        return std::max({radial - radius, -along, along - length}) / size;
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &) const override
      {
        dealii::Point<dim> lower, upper;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // half width of the end disc in direction d
            const double reach = radius * std::sqrt(std::max(0., 1 - axis[d] * axis[d]));
            lower[d]           = std::min(begin[d], end[d]) - reach;
            upper[d]           = std::max(begin[d], end[d]) + reach;
          }
        return dealii::BoundingBox<dim>({lower, upper});
      }

    private:
      dealii::Point<dim>     begin, end;
      double                 radius, length, size;
      dealii::Tensor<1, dim> axis;
    };



    /** Inside where phi < 0. As phi has no size, only its sign is the level. */
    template <int dim>
    class Implicit : public Shape<dim>
    {
    public:
      explicit Implicit(const Expression &phi)
        : phi(phi)
      {}

      double
      level(const dealii::Point<dim> &x) const override
      {
        const double value = phi(&x[0]);
        return value < 0 ? -1 : (value > 0 || std::isnan(value) ? 1 : 0);
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &domain) const override
      {
        return domain;
      }

    private:
      Expression phi;
    };



    template <int dim>
    class Union : public Shape<dim>
    {
    public:
      Union(std::shared_ptr<Shape<dim>> a, std::shared_ptr<Shape<dim>> b)
        : a(a)
        , b(b)
      {}

      double
      level(const dealii::Point<dim> &x) const override
      {
        return std::min(a->level(x), b->level(x));
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &domain) const override
      {
        dealii::BoundingBox<dim> box = a->bounding_box(domain);
        box.merge_with(b->bounding_box(domain));
        return box;
      }

    private:
      std::shared_ptr<Shape<dim>> a, b;
    };



    template <int dim>
    class Difference : public Shape<dim>
    {
    public:
      Difference(std::shared_ptr<Shape<dim>> a, std::shared_ptr<Shape<dim>> b)
        : a(a)
        , b(b)
      {}

      double
      level(const dealii::Point<dim> &x) const override
      {
        return std::max(a->level(x), -b->level(x));
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &domain) const override
      {
        return a->bounding_box(domain);
      }

    private:
      std::shared_ptr<Shape<dim>> a, b;
    };



    /** One term of a description and the sign in front of it. */
    struct Term
    {
      char        sign = '+';
      std::string text;
    };

    /** Splits at the + and - outside all parentheses. */
    std::vector<Term>
    split_terms(const std::string &description)
    {
      std::vector<Term> terms(1);
      int               depth = 0;
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
      for (Term &term : terms)
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



    template <int dim>
    std::shared_ptr<Shape<dim>>
    make_shape(const std::string                   &kind,
               const std::string                   &arguments,
               const std::map<std::string, double> &constants)
    {
      if (kind == "box")
        {
          const auto numbers =
            read_numbers(arguments,
                         2 * dim,
                         dim == 2 ? "box(x0, y0; x1, y1)" : "box(x0, y0, z0; x1, y1, z1)",
                         constants);
          return std::make_shared<Box<dim>>(point_at<dim>(numbers, 0), point_at<dim>(numbers, dim));
        }
      if (kind == "ball")
        {
          const auto numbers =
            read_numbers(arguments,
                         dim + 1,
                         dim == 2 ? "ball(x, y; radius)" : "ball(x, y, z; radius)",
                         constants);
          return std::make_shared<Ball<dim>>(point_at<dim>(numbers, 0), numbers[dim]);
        }
      if (kind == "cylinder")
        {
          if (dim == 2)
            throw UserError("A cylinder exists in 3D only; in 2D write ball(x, y; radius).");
          const auto numbers =
            read_numbers(arguments, 2 * dim + 1, "cylinder(x, y, z; x, y, z; radius)", constants);
          return std::make_shared<Cylinder<dim>>(point_at<dim>(numbers, 0),
                                                 point_at<dim>(numbers, dim),
                                                 numbers[2 * dim]);
        }
      if (kind == "implicit")
        {
          const std::vector<std::string> variables =
            dim == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
          return std::make_shared<Implicit<dim>>(Expression(arguments, variables, constants));
        }
      throw UserError("There is no shape '" + kind + "'; did you mean " +
                      nearest_name(kind, {"box", "ball", "cylinder", "implicit"}) + "?");
    }



    template <int dim>
    std::shared_ptr<Shape<dim>>
    parse_term(const std::string &term, const std::map<std::string, double> &constants)
    {
      const std::size_t open = term.find('(');
      try
        {
          if (open == std::string::npos || term.back() != ')')
            throw UserError("A shape has the form name(numbers).");
          return make_shape<dim>(dealii::Utilities::trim(term.substr(0, open)),
                                 term.substr(open + 1, term.size() - open - 2),
                                 constants);
        }
      catch (const UserError &error)
        {
          throw UserError("The geometry's term '" + term + "' cannot be used. " + error.what());
        }
    }
  } // namespace



  template <int dim>
  std::shared_ptr<Geometry<dim>>
  parse_geometry(const std::string &description, const std::map<std::string, double> &constants)
  {
    if (dealii::Utilities::trim(description).empty())
      throw UserError("The geometry is empty; write for example box(0, 0; 1, 1).");
    std::shared_ptr<Shape<dim>> geometry;
    for (const Term &term : split_terms(description))
      {
        const auto shape = parse_term<dim>(term.text, constants);
        if (!geometry)
          geometry = shape;
        else if (term.sign == '+')
          geometry = std::make_shared<Union<dim>>(geometry, shape);
        else
          geometry = std::make_shared<Difference<dim>>(geometry, shape);
      }
    return geometry;
  }



  template std::shared_ptr<Geometry<2>>
  parse_geometry<2>(const std::string &, const std::map<std::string, double> &);
  template std::shared_ptr<Geometry<3>>
  parse_geometry<3>(const std::string &, const std::map<std::string, double> &);
} // namespace kedge
