#include <kedge/points/outline.h>

#include <boost/math/tools/roots.hpp>

#include "shapes.h"
#include "stretches.h"

namespace kedge
{
  namespace
  {
    /** Into so many parts a line is cut in search of roots of an implicit function. */
    constexpr unsigned int line_samples = 4;

    template <int dim>
    class Implicit : public Geometry<dim>
    {
    public:
      explicit Implicit(const Expression &phi)
        : phi(phi)
      {}

      double
      level(const dealii::Point<dim> &x) const override
      {
        // phi has no size: only its sign says something; what is no number is outside
        const double value = phi(&x[0]);
        return value < 0 ? -1 : (value > 0 || std::isnan(value) ? 1 : 0);
      }

      dealii::BoundingBox<dim>
      bounding_box(const dealii::BoundingBox<dim> &domain) const override
      {
        return domain;
      }

      /** By its signs at the box's centre, its corners and those of a box twice as large. */
      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        const auto centre       = box.center();
        const auto &[low, high] = box.get_boundary_points();
        const bool holds_centre = negative(centre);
        for (const double reach : {2., 1.})
          for (unsigned int corner = 0; corner < (1u << dim); ++corner)
            {
              dealii::Point<dim> x = centre;
              for (unsigned int d = 0; d < dim; ++d)
                x[d] += reach * 0.5 * (high[d] - low[d]) * (((corner >> d) & 1u) != 0 ? 1 : -1);
              if (negative(x) != holds_centre)
                return Filling::cut;
            }
        return holds_centre ? Filling::full : Filling::empty;
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              length) const override
      {
        dealii::Point<dim> x(start);
        const auto         value = [&](const double s) {
          x[direction]        = start[direction] + s;
          const double result = phi(&x[0]);
          return std::isnan(result) ? 1. : result;
        };
        std::vector<double> roots;
        double              from = 0, value_from = value(0);
        for (unsigned int i = 1; i <= line_samples; ++i)
          {
            const double to = length * i / line_samples, value_to = value(to);
            if ((value_from < 0) != (value_to < 0))
              roots.push_back(root(value, from, to, value_from, value_to));
            from       = to;
            value_from = value_to;
          }
        return stretches_between(std::move(roots), length, [&](const double s) {
          return value(s) < 0;
        });
      }

    private:
      bool
      negative(const dealii::Point<dim> &x) const
      {
        return phi(&x[0]) < 0;
      }

      template <typename Function>
      static double
      root(const Function &value,
           const double    from,
           const double    to,
           const double    value_from,
           const double    value_to)
      {
        if (value_from == 0. || value_to == 0.)
          return value_from == 0. ? from : to;
        // to the last bits of a length; a jump is found by bisection as well
        std::uintmax_t evaluations = 100;
        const auto     bracket     = boost::math::tools::toms748_solve(
          value,
          from,
          to,
          value_from,
          value_to,
          [tolerance = 1e-14 * (to - from)](const double a, const double b) {
            return b - a <= tolerance;
          },
          evaluations);
        return 0.5 * (bracket.first + bracket.second);
      }

      Expression phi;
    };



    template <int dim>
    class Union
      : public Geometry<dim>
      , public Outlined<dim>
    {
    public:
      Union(const Shape<dim> &a, const Shape<dim> &b)
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

      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        const Filling of_a = a->filling(box);
        return of_a == Filling::full ? of_a : std::max(of_a, b->filling(box));
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              length) const override
      {
        return unite(a->inside(start, direction, length), b->inside(start, direction, length));
      }

      std::optional<VolumeMoments<dim>>
      exact_moments(const dealii::BoundingBox<dim> &box) const override
      {
        if (a->filling(box) == Filling::empty)
          return b->exact_moments(box);
        if (b->filling(box) == Filling::empty)
          return a->exact_moments(box);
        return std::nullopt;
      }

      /** Of parts that lie apart. */
      std::optional<SurfaceMesh<dim>>
      outline(const double spacing) const override
      {
        auto       of_a = kedge::outline(*a, spacing);
        const auto of_b = kedge::outline(*b, spacing);
        if (!of_a || !of_b ||
            a->bounding_box({}).get_neighbor_type(b->bounding_box({})) !=
              dealii::NeighborType::not_neighbors)
          return std::nullopt;
        of_a->append(*of_b);
        return of_a;
      }

    private:
      Shape<dim> a, b;
    };



    /** Whether all vertices of a surface lie inside a shape, or all outside. */
    template <int dim>
    bool
    lies(const SurfaceMesh<dim> &surface, const bool inside, const Geometry<dim> &shape)
    {
      return std::all_of(surface.vertices.begin(), surface.vertices.end(), [&](const auto &x) {
        return inside ? shape.level(x) < -1e-9 : shape.level(x) > 1e-9;
      });
    }



    template <int dim>
    class Difference
      : public Geometry<dim>
      , public Outlined<dim>
    {
    public:
      Difference(const Shape<dim> &a, const Shape<dim> &b)
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

      Filling
      filling(const dealii::BoundingBox<dim> &box) const override
      {
        const Filling of_a = a->filling(box), of_b = b->filling(box);
        if (of_a == Filling::empty || of_b == Filling::full)
          return Filling::empty;
        return of_b == Filling::empty ? of_a : Filling::cut;
      }

      Stretches
      inside(const dealii::Point<dim> &start,
             const unsigned int        direction,
             const double              length) const override
      {
        return subtract(a->inside(start, direction, length), b->inside(start, direction, length));
      }

      std::optional<VolumeMoments<dim>>
      exact_moments(const dealii::BoundingBox<dim> &box) const override
      {
        if (b->filling(box) == Filling::empty)
          return a->exact_moments(box);
        if (a->filling(box) != Filling::full)
          return std::nullopt;
        const auto hole = b->exact_moments(box);
        if (!hole)
          return std::nullopt;
        dealii::Tensor<1, dim> half;
        for (unsigned int d = 0; d < dim; ++d)
          half[d] = 0.5 * box.side_length(d);
        auto result = VolumeMoments<dim>::of_box(half);
        result.add(*hole, -1);
        return result;
      }

      /** Of a shape with a hole within it. */
      std::optional<SurfaceMesh<dim>>
      outline(const double spacing) const override
      {
        auto outer = kedge::outline(*a, spacing), hole = kedge::outline(*b, spacing);
        if (!outer || !hole || !lies(*hole, true, *a) || !lies(*outer, false, *b))
          return std::nullopt;
        for (auto &facet : hole->facets)
          std::swap(facet[0], facet[1]);
        outer->append(*hole);
        return outer;
      }

    private:
      Shape<dim> a, b;
    };
  } // namespace



  template <int dim>
  Shape<dim>
  make_implicit(const Expression &phi)
  {
    return std::make_shared<Implicit<dim>>(phi);
  }



  template <int dim>
  Shape<dim>
  make_union(const Shape<dim> &a, const Shape<dim> &b)
  {
    return std::make_shared<Union<dim>>(a, b);
  }



  template <int dim>
  Shape<dim>
  make_difference(const Shape<dim> &a, const Shape<dim> &b)
  {
    return std::make_shared<Difference<dim>>(a, b);
  }

  template Shape<2>
  make_implicit<2>(const Expression &);
  template Shape<2>
  make_union<2>(const Shape<2> &, const Shape<2> &);
  template Shape<2>
  make_difference<2>(const Shape<2> &, const Shape<2> &);
  template Shape<3>
  make_implicit<3>(const Expression &);
  template Shape<3>
  make_union<3>(const Shape<3> &, const Shape<3> &);
  template Shape<3>
  make_difference<3>(const Shape<3> &, const Shape<3> &);
} // namespace kedge
