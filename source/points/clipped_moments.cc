#include <kedge/points/clipped_moments.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** By how much two orders of quadrature may differ, in volumes of the box. */
    constexpr double tolerance = 1e-7;

    /** The same in the directions within, whose errors would keep the outer one from an end. */
    constexpr double inner_tolerance = 1e-8;

    /** So often a piece is halved: a kink is then found to a millionth of the box. */
    constexpr unsigned int most_halvings = 20;

    /** Boxes are cut in search of bulges so often: those of an eighth are found. */
    constexpr unsigned int most_cuts = 3;

    /** Volume, first and second moments as numbers of one kind, in half edges of the box. */
    template <int dim>
    using Values = std::array<double, 1 + dim + dim *(dim + 1) / 2>;

    template <int dim>
    void
    add(Values<dim> &sum, const Values<dim> &values, const double factor)
    {
      for (unsigned int i = 0; i < sum.size(); ++i)
        sum[i] += factor * values[i];
    }

    // Kronrod's seven places and weights around the three of Gauss (every second one)
    constexpr std::array<double, 4> places          = {{0.,
                                                        0.434243749346802558002071502844628,
                                                        0.774596669241483377035853079956480,
                                                        0.960491268708020283423507092629080}};
    constexpr std::array<double, 4> kronrod_weights = {{0.450916538658474142345110087045571,
                                                        0.401397414775962222905051818618432,
                                                        0.268488089868333440728569280666710,
                                                        0.104656226026467265193823857192073}};
    constexpr std::array<double, 4> gauss_weights   = {{8. / 9., 0., 5. / 9., 0.}};

    /** The integral of @p function over [from, to]. */
    template <int dim, typename Function>
    Values<dim>
    integrate(const Function    &function,
              const double       from,
              const double       to,
              const double       allowed,
              const unsigned int halvings = most_halvings)
    {
      const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
      Values<dim>  kronrod = {}, difference = {};
      const auto   take = [&](const double x, const unsigned int i) {
        const Values<dim> values = function(x);
        add<dim>(kronrod, values, half * kronrod_weights[i]);
        add<dim>(difference, values, half * (kronrod_weights[i] - gauss_weights[i]));
      };
      take(middle, 0);
      for (unsigned int i = 1; i < places.size(); ++i)
        for (const double sign : {-1., 1.})
          take(middle + sign * half * places[i], i);

      double error = 0;
      for (const double component : difference)
        error = std::max(error, std::abs(component));
      if (error <= allowed || halvings == 0)
        return kronrod;
      Values<dim> result = {};
      add<dim>(result, integrate<dim>(function, from, middle, allowed, halvings - 1), 1.);
      add<dim>(result, integrate<dim>(function, middle, to, allowed, halvings - 1), 1.);
      return result;
    }



    /** A geometry seen in coordinates from -1 to 1 in a box, in a given order of the axes. */
    template <int dim>
    class ScaledRegion
    {
    public:
      ScaledRegion(const Geometry<dim> &geometry, const dealii::BoundingBox<dim> &box)
        : geometry(geometry)
        , centre(box.center())
      {
        for (unsigned int d = 0; d < dim; ++d)
          half[d] = 0.5 * box.side_length(d);
        find_order();
      }

      VolumeMoments<dim>
      moments() const
      {
        Values<dim>             values = {};
        std::array<double, dim> at     = {};
        integrate_axis<dim - 1>(at, values);
        return unscaled(values);
      }

    private:
      /** The stretches inside along axis @p d through the place @p at, from -1 to 1. */
      Stretches
      along(const unsigned int d, const std::array<double, dim> &at) const
      {
        dealii::Point<dim> start;
        for (unsigned int e = 0; e < dim; ++e)
          start[e] = centre[e] + (e == d ? -1. : at[e]) * half[e];
        Stretches stretches = geometry.inside(start, d, 2 * half[d]);
        for (auto &[begin, end] : stretches)
          {
            begin = begin / half[d] - 1.;
            end   = end / half[d] - 1.;
          }
        return stretches;
      }

      /**
       * First the axis whose lines, of a few, meet the surface most often once: it lies
       * across the surface, and what the lines hold varies smoothly. Lines that leave
       * the surface where they entered it touch it rather.
       */
      void
      find_order()
      {
        unsigned int n_samples = 1;
        for (unsigned int d = 1; d < dim; ++d)
          n_samples *= 3;
        std::array<int, dim> score = {};
        for (unsigned int d = 0; d < dim; ++d)
          {
            order[d] = d;
            for (unsigned int sample = 0; sample < n_samples; ++sample)
              {
                std::array<double, dim> at   = {};
                unsigned int            rest = sample;
                for (unsigned int e = 0; e < dim; ++e)
                  if (e != d)
                    {
                      at[e] = static_cast<int>(rest % 3) - 1;
                      rest /= 3;
                    }
                unsigned int crossings = 0;
                for (const auto &[begin, end] : along(d, at))
                  crossings += (begin > -1. ? 1 : 0) + (end < 1. ? 1 : 0);
                score[d] += crossings == 1 ? 1 : (crossings > 1 ? -1 : 0);
              }
          }
        std::stable_sort(order.begin(), order.end(), [&](const unsigned a, const unsigned b) {
          return score[a] > score[b];
        });
      }

      /** Integrates over the axis order[level] and all before it at the place @p at. */
      template <int level>
      void
      integrate_axis(std::array<double, dim> &at, Values<dim> &result) const
      {
        if constexpr (level == 0)
          integrate_line(at, result);
        else
          {
            const std::vector<double> ends     = pieces<level>(at);
            const auto                function = [&](const double x) {
              std::array<double, dim> place = at;
              place[order[level]]           = x;
              Values<dim> values            = {};
              integrate_axis<level - 1>(place, values);
              return values;
            };
            for (unsigned int i = 0; i + 1 < ends.size(); ++i)
              add<dim>(result,
                       integrate<dim>(function,
                                      ends[i],
                                      ends[i + 1],
                                      level == dim - 1 ? tolerance : inner_tolerance),
                       1.);
          }
      }

      /** -1, 1 and where lines along the axis on the edges of the box meet the surface. */
      template <int level>
      std::vector<double>
      pieces(const std::array<double, dim> &at) const
      {
        std::vector<double>     ends  = {-1., 1.};
        std::array<double, dim> place = at;
        for (unsigned int edge = 0; edge < (1u << level); ++edge)
          {
            for (unsigned int i = 0; i < level; ++i)
              place[order[i]] = ((edge >> i) & 1u) != 0 ? 1. : -1.;
            for (const auto &[begin, end] : along(order[level], place))
              {
                ends.push_back(std::max(-1., begin));
                ends.push_back(std::min(1., end));
              }
          }
        std::sort(ends.begin(), ends.end());
        std::vector<double> apart = {-1.};
        for (const double end : ends)
          if (end - apart.back() > 1e-10)
            apart.push_back(end);
        apart.back() = 1.;
        return apart;
      }

      void
      integrate_line(const std::array<double, dim> &at, Values<dim> &result) const
      {
        const unsigned int d = order[0];
        for (const auto &[a, b] : along(d, at))
          {
            const std::array<double, 3> powers = {
              {b - a, (b * b - a * a) / 2., (b * b * b - a * a * a) / 3.}};
            unsigned int place = 0;
            result[place++] += powers[0];
            for (unsigned int i = 0; i < dim; ++i)
              result[place++] += i == d ? powers[1] : at[i] * powers[0];
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                result[place++] +=
                  powers[(i == d) + (j == d)] * (i == d ? 1. : at[i]) * (j == d ? 1. : at[j]);
          }
      }

      VolumeMoments<dim>
      unscaled(const Values<dim> &values) const
      {
        double scale = 1;
        for (unsigned int d = 0; d < dim; ++d)
          scale *= half[d];
        VolumeMoments<dim> result;
        unsigned int       place = 0;
        result.volume            = scale * values[place++];
        for (unsigned int i = 0; i < dim; ++i)
          result.first[i] = scale * half[i] * values[place++];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            result.second[i][j] = scale * half[i] * half[j] * values[place++];
        return result;
      }

      const Geometry<dim>          &geometry;
      dealii::Point<dim>            centre;
      dealii::Tensor<1, dim>        half;
      std::array<unsigned int, dim> order;
    };

    /** True if all corners of the box lie on one side of the surface. */
    template <int dim>
    bool
    corners_agree(const Geometry<dim> &geometry, const dealii::BoundingBox<dim> &box)
    {
      unsigned int n_inside = 0;
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        n_inside += geometry.contains(box.vertex(corner)) ? 1 : 0;
      return n_inside == 0 || n_inside == (1u << dim);
    }

    /** The moments within @p box, which may be cut into 2^dim parts so often. */
    template <int dim>
    VolumeMoments<dim>
    moments_by_parts(const Geometry<dim>            &geometry,
                     const dealii::BoundingBox<dim> &box,
                     const unsigned int              most_cuts)
    {
      if (const auto exact = geometry.exact_moments(box))
        return *exact;
      if (most_cuts == 0 || !corners_agree(geometry, box))
        return ScaledRegion<dim>(geometry, box).moments();

      // the surface bulges into the box, or holes it: lines might miss that
      VolumeMoments<dim> result;
      const auto         centre = box.center();
      for (unsigned int part = 0; part < (1u << dim); ++part)
        {
          const auto             corner = box.vertex(part);
          dealii::Point<dim>     lower, upper;
          dealii::Tensor<1, dim> half;
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = std::min(centre[d], corner[d]);
              upper[d] = std::max(centre[d], corner[d]);
              half[d]  = 0.5 * (upper[d] - lower[d]);
            }
          const dealii::BoundingBox<dim> child({lower, upper});
          const Filling                  filling = geometry.filling(child);
          if (filling == Filling::empty)
            continue;
          const auto moments = filling == Filling::full
                                 ? VolumeMoments<dim>::of_box(half)
                                 : moments_by_parts(geometry, child, most_cuts - 1);
          result.add(moments.about(centre - child.center()));
        }
      return result;
    }
  } // namespace



  template <int dim>
  VolumeMoments<dim>
  clipped_moments(const Geometry<dim> &geometry, const dealii::BoundingBox<dim> &box)
  {
    return moments_by_parts(geometry, box, most_cuts);
  }

  template VolumeMoments<2>
  clipped_moments(const Geometry<2> &, const dealii::BoundingBox<2> &);
  template VolumeMoments<3>
  clipped_moments(const Geometry<3> &, const dealii::BoundingBox<3> &);
} // namespace kedge
