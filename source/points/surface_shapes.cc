#include <kedge/base/exceptions.h>
#include <kedge/points/outline.h>

#include "shapes.h"
#include "stretches.h"

namespace kedge
{
  namespace
  {
    double
    cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double
    distance_to_segment(const dealii::Point<2> &x,
                        const dealii::Point<2> &a,
                        const dealii::Point<2> &b)
    {
      const dealii::Tensor<1, 2> edge = b - a;
      const double               s    = std::clamp((x - a) * edge / edge.norm_square(), 0., 1.);
      return (a + s * edge).distance(x);
    }

    /** Whether two segments have a point in common. */
    bool
    segments_meet(const dealii::Point<2> &a,
                  const dealii::Point<2> &b,
                  const dealii::Point<2> &c,
                  const dealii::Point<2> &d,
                  const double            tolerance)
    {
      if (std::min({distance_to_segment(a, c, d),
                    distance_to_segment(b, c, d),
                    distance_to_segment(c, a, b),
                    distance_to_segment(d, a, b)}) <= tolerance)
        return true;
      return cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
             cross(d - c, a - c) * cross(d - c, b - c) < 0;
    }



    class Polygon
      : public Geometry<2>
      , public Outlined<2>
    {
    public:
      explicit Polygon(const std::vector<dealii::Point<2>> &corners)
        : corners(corners)
        , lower(corners[0])
        , upper(corners[0])
      {
        for (const auto &corner : corners)
          for (unsigned int d = 0; d < 2; ++d)
            {
              lower[d] = std::min(lower[d], corner[d]);
              upper[d] = std::max(upper[d], corner[d]);
            }
        size = lower.distance(upper);
        check();
        double twice_area = 0;
        for (std::size_t i = 0; i < corners.size(); ++i)
          twice_area += cross(corners[i] - lower, next(i) - lower);
        if (twice_area < 0)
          std::reverse(this->corners.begin(), this->corners.end());
      }

      double
      level(const dealii::Point<2> &x) const override
      {
        double distance  = std::numeric_limits<double>::max();
        bool   is_inside = false;
        for (std::size_t i = 0; i < corners.size(); ++i)
          {
            const auto &a = corners[i], &b = next(i);
            distance = std::min(distance, distance_to_segment(x, a, b));
            // crossings of the ray along x
            if ((a[1] > x[1]) != (b[1] > x[1]) &&
                a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > x[0])
              is_inside = !is_inside;
          }
        return (is_inside ? -distance : distance) / size;
      }

      dealii::BoundingBox<2>
      bounding_box(const dealii::BoundingBox<2> &) const override
      {
        return dealii::BoundingBox<2>({lower, upper});
      }

      Filling
      filling(const dealii::BoundingBox<2> &box) const override
      {
        const auto &[low, high] = box.get_boundary_points();
        const double outside    = level(box.center()) * size;
        return std::abs(outside) <= 0.5 * low.distance(high) ? Filling::cut
               : outside < 0                                 ? Filling::full
                                                             : Filling::empty;
      }

      Stretches
      inside(const dealii::Point<2> &start,
             const unsigned int      direction,
             const double            length) const override
      {
        const unsigned int  across = 1 - direction;
        std::vector<double> cuts;
        for (std::size_t i = 0; i < corners.size(); ++i)
          {
            const auto  &a = corners[i], &b = next(i);
            const double of_a = a[across] - start[across], of_b = b[across] - start[across];
            if (of_a * of_b > 0)
              continue;
            const double s = of_a == of_b ? 0. : of_a / (of_a - of_b);
            cuts.push_back(a[direction] + s * (b[direction] - a[direction]) - start[direction]);
            if (of_a == of_b)
              cuts.push_back(b[direction] - start[direction]);
          }
        return stretches_between(std::move(cuts), length, [&](const double s) {
          dealii::Point<2> x = start;
          x[direction] += s;
          return level(x) < 0;
        });
      }

      /**
       * The sum over edges of what lies behind them along x within the box, counted
       * with the sign of -n_x.
       */
      std::optional<VolumeMoments<2>>
      exact_moments(const dealii::BoundingBox<2> &box) const override
      {
        const auto                 centre = box.center();
        const dealii::Tensor<1, 2> half   = box.get_boundary_points().second - centre;
        VolumeMoments<2>           result;
        for (std::size_t i = 0; i < corners.size(); ++i)
          {
            dealii::Tensor<1, 2> a = corners[i] - centre, b = next(i) - centre;
            // the part between the lines y = -half and half, whole or cut at x = -half and half
            std::vector<double> cuts = {0., 1.};
            for (unsigned int d = 0; d < 2; ++d)
              for (const double bound : {-half[d], half[d]})
                if ((a[d] < bound) != (b[d] < bound) && a[d] != b[d])
                  cuts.push_back(std::clamp((bound - a[d]) / (b[d] - a[d]), 0., 1.));
            std::sort(cuts.begin(), cuts.end());
            for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
              take_behind(a + cuts[k] * (b - a), a + cuts[k + 1] * (b - a), half, result);
          }
        return result;
      }

      std::optional<SurfaceMesh<2>>
      outline(const double spacing) const override
      {
        return mesh_of_polygon(corners, spacing);
      }

    private:
      const dealii::Point<2> &
      next(const std::size_t i) const
      {
        return corners[(i + 1) % corners.size()];
      }

      void
      check() const
      {
        const double tolerance = 1e-12 * size;
        const auto   edge      = [&](const std::size_t i) {
          return "the edge from corner " + std::to_string(i + 1) + " to corner " +
                 std::to_string((i + 1) % corners.size() + 1);
        };
        for (std::size_t i = 0; i < corners.size(); ++i)
          if (corners[i].distance(next(i)) <= tolerance)
            throw UserError("It has no length: " + edge(i) + ".");
        for (std::size_t i = 0; i < corners.size(); ++i)
          {
            const std::size_t after = (i + 1) % corners.size();
            if (distance_to_segment(next(after), corners[i], corners[after]) <= tolerance ||
                distance_to_segment(corners[i], corners[after], next(after)) <= tolerance)
              throw UserError("The line runs back on itself: " + edge(after) + " lies on " +
                              edge(i) + ".");
            for (std::size_t j = i + 2; j < corners.size(); ++j)
              if ((j + 1) % corners.size() != i &&
                  segments_meet(corners[i], next(i), corners[j], next(j), tolerance))
                throw UserError("The line cuts itself: " + edge(i) + " meets " + edge(j) + ".");
          }
      }

      /** Takes away what lies behind a piece of edge that no bound of the box cuts. */
      static void
      take_behind(dealii::Tensor<1, 2>        a,
                  dealii::Tensor<1, 2>        b,
                  const dealii::Tensor<1, 2> &half,
                  VolumeMoments<2>           &moments)
      {
        const dealii::Tensor<1, 2> middle = 0.5 * (a + b);
        if (std::abs(middle[1]) > half[1] || middle[0] > half[0])
          return;
        if (middle[0] < -half[0])
          a[0] = b[0] = -half[0];
        const double end = half[0];
        for (const double sign : {-1., 1.}) // Gauss's two points are exact for cubic polynomials
          {
            const dealii::Tensor<1, 2> x      = 0.5 * (a + b) + sign / std::sqrt(12.) * (b - a);
            const double               weight = -0.5 * (b[1] - a[1]); // n_x dl, counter-clockwise
            const double               powers[3] = {end - x[0],
                                                    (end * end - x[0] * x[0]) / 2.,
                                                    (end * end * end - x[0] * x[0] * x[0]) / 3.};
            moments.volume += weight * powers[0];
            moments.first[0] += weight * powers[1];
            moments.first[1] += weight * x[1] * powers[0];
            moments.second[0][0] += weight * powers[2];
            moments.second[0][1] += weight * x[1] * powers[1];
            moments.second[1][1] += weight * x[1] * x[1] * powers[0];
          }
      }

      std::vector<dealii::Point<2>> corners; ///< counter-clockwise
      dealii::Point<2>              lower, upper;
      double                        size;
    };



    class Enclosed
      : public Geometry<3>
      , public Outlined<3>
    {
    public:
      explicit Enclosed(const std::shared_ptr<const TriangleSurface> &surface)
        : surface(surface)
        , size(surface->bounding_box().get_boundary_points().first.distance(
            surface->bounding_box().get_boundary_points().second))
      {}

      double
      level(const dealii::Point<3> &x) const override
      {
        return surface->closest_point(x).distance / size;
      }

      dealii::BoundingBox<3>
      bounding_box(const dealii::BoundingBox<3> &) const override
      {
        return surface->bounding_box();
      }

      Filling
      filling(const dealii::BoundingBox<3> &box) const override
      {
        if (!surface->facets_near(box).empty())
          return Filling::cut;
        return level(box.center()) < 0 ? Filling::full : Filling::empty;
      }

      Stretches
      inside(const dealii::Point<3> &start,
             const unsigned int      direction,
             const double            length) const override
      {
        dealii::Point<3> end = start;
        end[direction] += length;
        std::vector<double> cuts;
        for (const unsigned int f : surface->facets_near(dealii::BoundingBox<3>({start, end})))
          {
            const Triangle t = surface->triangle(f);
            const auto    &n = surface->normal(f);
            if (n[direction] != 0.)
              cuts.push_back((t[0] - start) * n / n[direction]);
          }
        return stretches_between(std::move(cuts), length, [&](const double s) {
          dealii::Point<3> x = start;
          x[direction] += s;
          return level(x) < 0;
        });
      }

      std::optional<VolumeMoments<3>>
      exact_moments(const dealii::BoundingBox<3> &box) const override
      {
        return surface->moments_within(box);
      }

      std::optional<SurfaceMesh<3>>
      outline(const double spacing) const override
      {
        return mesh_of_triangles(*surface, spacing);
      }

    private:
      std::shared_ptr<const TriangleSurface> surface;
      double                                 size;
    };
  } // namespace



  Shape<2>
  make_polygon(const std::vector<dealii::Point<2>> &corners)
  {
    return std::make_shared<Polygon>(corners);
  }



  Shape<3>
  make_enclosed(const std::shared_ptr<const TriangleSurface> &surface)
  {
    return std::make_shared<Enclosed>(surface);
  }
} // namespace kedge
