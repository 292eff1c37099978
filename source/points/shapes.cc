#include <kedge/base/exceptions.h>
#include <kedge/points/outline.h>

#include "shapes.h"
#include "stretches.h"

namespace kedge
{
  namespace
  {
    template <int dim>
    double
    half_diagonal(const dealii::BoundingBox<dim> &box)
    {
      const auto &[lower, upper] = box.get_boundary_points();
      return 0.5 * lower.distance(upper);
    }

    /** Of a box whose centre is so far outside (inside if negative). */
    Filling
    filling_at_distance(const double distance, const double half_diagonal)
    {
      return distance > half_diagonal    ? Filling::empty
             : distance < -half_diagonal ? Filling::full
                                         : Filling::cut;
    }

    /** Where the parabola a s^2 + 2 b s + c is negative (a >= 0), within [0, length]. */
    Stretches
    below_parabola(const double a, const double b, const double c, const double length)
    {
      if (a == 0.)
        return c < 0 ? Stretches{{0., length}} : Stretches(); // lines along the axis: b is 0
      const double discriminant = b * b - a * c;
      if (discriminant <= 0)
        return {};
      // the root of larger magnitude first: the other one without cancellation
      const double q      = -b - std::copysign(std::sqrt(discriminant), b);
      const double first  = q / a;
      const double second = q == 0. ? 0. : c / q;
      return one_stretch(std::min(first, second), std::max(first, second), length);
    }



    template <int dim>
    class Box
      : public Geometry<dim>
      , public Outlined<dim>
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

      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        const auto &[low, high] = box.get_boundary_points();
        bool full               = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (high[d] <= lower[d] || low[d] >= upper[d])
              return Filling::empty;
            full = full && low[d] >= lower[d] && high[d] <= upper[d];
          }
        return full ? Filling::full : Filling::cut;
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              length) const override
      {
        for (unsigned int d = 0; d < dim; ++d)
          if (d != direction && (start[d] < lower[d] || start[d] > upper[d]))
            return {};
        return one_stretch(lower[direction] - start[direction],
                           upper[direction] - start[direction],
                           length);
      }

      std::optional<VolumeMoments<dim>>
      exact_moments(const dealii::BoundingBox<dim> &box) const override
      {
        const auto &[low, high] = box.get_boundary_points();
        dealii::Tensor<1, dim> half, to_centre;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double from = std::max(low[d], lower[d]), to = std::min(high[d], upper[d]);
            if (from >= to)
              return VolumeMoments<dim>();
            half[d]      = 0.5 * (to - from);
            to_centre[d] = 0.5 * (low[d] - from + (high[d] - to));
          }
        return VolumeMoments<dim>::of_box(half).about(to_centre);
      }

      std::optional<SurfaceMesh<dim>>
      outline(const double spacing) const override
      {
        return mesh_of_box(lower, upper, spacing);
      }

    private:
      dealii::Point<dim> lower, upper;
      double             size = 0;
    };



    template <int dim>
    class Ball
      : public Geometry<dim>
      , public Outlined<dim>
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

      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        return filling_at_distance(box.center().distance(centre) - radius, half_diagonal(box));
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              length) const override
      {
        const dealii::Tensor<1, dim> r = start - centre;
        return below_parabola(1., r[direction], r * r - radius * radius, length);
      }

      std::optional<SurfaceMesh<dim>>
      outline(const double spacing) const override
      {
        return mesh_of_ball(centre, radius, spacing);
      }

    private:
      dealii::Point<dim> centre;
      double             radius;
    };



    template <int dim>
    class Cylinder
      : public Geometry<dim>
      , public Outlined<dim>
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
        return outside(x) / size;
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

      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        return filling_at_distance(outside(box.center()), half_diagonal(box));
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              segment) const override
      {
        // r + s e less its part along the axis, and that part itself
        const dealii::Tensor<1, dim> r      = start - begin;
        const double                 along  = r * axis;
        const double                 slope  = axis[direction];
        const double                 square = r * r - along * along;
        const double                 a      = slope * slope < 1. - 1e-15 ? 1. - slope * slope : 0.;
        const Stretches              curved =
          below_parabola(a, r[direction] - along * slope, square - radius * radius, segment);
        if (curved.empty() || (slope == 0. && (along < 0. || along > length)))
          return {};
        if (slope == 0.)
          return curved;
        const double first = -along / slope, last = (length - along) / slope;
        return one_stretch(std::max(curved[0].first, std::min(first, last)),
                           std::min(curved[0].second, std::max(first, last)),
                           segment);
      }

      std::optional<SurfaceMesh<dim>>
      outline(const double spacing) const override
      {
        if constexpr (dim == 3)
          return mesh_of_cylinder(begin, end, radius, spacing);
        else
          return std::nullopt;
      }

    private:
      /** How far outside at least [m]; negative inside. */
      double
      outside(const dealii::Point<dim> &x) const
      {
        const double along  = (x - begin) * axis;
        const double radial = (x - begin - along * axis).norm();
        return std::max({radial - radius, -along, along - length});
      }

      dealii::Point<dim>     begin, end;
      double                 radius, length, size;
      dealii::Tensor<1, dim> axis;
    };
  } // namespace



  template <int dim>
  Shape<dim>
  make_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper)
  {
    return std::make_shared<Box<dim>>(lower, upper);
  }



  template <int dim>
  Shape<dim>
  make_ball(const dealii::Point<dim> &centre, const double radius)
  {
    return std::make_shared<Ball<dim>>(centre, radius);
  }



  template <int dim>
  Shape<dim>
  make_cylinder(const dealii::Point<dim> &begin, const dealii::Point<dim> &end, const double radius)
  {
    return std::make_shared<Cylinder<dim>>(begin, end, radius);
  }

  template Shape<2>
  make_box(const dealii::Point<2> &, const dealii::Point<2> &);
  template Shape<2>
  make_ball(const dealii::Point<2> &, const double);
  template Shape<2>
  make_cylinder(const dealii::Point<2> &, const dealii::Point<2> &, const double);
  template Shape<3>
  make_box(const dealii::Point<3> &, const dealii::Point<3> &);
  template Shape<3>
  make_ball(const dealii::Point<3> &, const double);
  template Shape<3>
  make_cylinder(const dealii::Point<3> &, const dealii::Point<3> &, const double);
} // namespace kedge
