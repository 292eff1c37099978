#include <kedge/surfaces/covered_part.h>

#include <array>
#include <cmath>
#include <vector>

namespace kedge
{
  namespace
  {
    /** Samples between which bisection looks for an edge. */
    constexpr int    n_samples       = 8;
    constexpr int    n_bisections    = 50;
    constexpr double gauss_point[3]  = {-0.7745966692414834, 0., 0.7745966692414834};
    constexpr double gauss_weight[3] = {5. / 18., 8. / 18., 5. / 18.};

    struct Interval
    {
      double begin, end;
    };

    /** The parts of [-1, 1] where a condition holds; samples are the ends and the middles of
     * eighths. */
    template <typename Condition>
    std::vector<Interval>
    parts_where(const Condition &holds)
    {
      const auto edge = [&](double a, double b, const bool at_a) {
        for (int k = 0; k < n_bisections; ++k)
          {
            const double middle             = 0.5 * (a + b);
            (holds(middle) == at_a ? a : b) = middle;
          }
        return 0.5 * (a + b);
      };
      std::vector<Interval> parts;
      double                last = -1., begin = -1.;
      bool                  inside = holds(last);
      for (int k = 0; k <= n_samples; ++k)
        {
          const double next = k < n_samples ? -1. + (2. * k + 1.) / n_samples : 1.;
          if (holds(next) != inside)
            {
              const double at = edge(last, next, inside);
              if (inside)
                parts.push_back({begin, at});
              begin  = at;
              inside = !inside;
            }
          last = next;
        }
      if (inside)
        parts.push_back({begin, 1.});
      return parts;
    }
  } // namespace



  template <int dim>
  CoveredPart<dim>
  covered_part(const Expression             &where,
               const dealii::Point<dim>     &centre,
               const unsigned int            side,
               const dealii::Tensor<1, dim> &half_lengths)
  {
    const unsigned int                direction = side / 2;
    std::array<unsigned int, dim - 1> along; // the directions along the face
    for (unsigned int d = 0, k = 0; d < dim; ++d)
      if (d != direction)
        along[k++] = d;
    double x[6]      = {0., 0., 0., 0., 0., 0.};
    x[3 + direction] = side % 2 == 0 ? -1. : 1.;
    const auto set   = [&](const unsigned int k, const double xi) {
      x[along[k]] = centre[along[k]] + xi * half_lengths[along[k]];
    };
    const auto parts_of_line = [&]() { // along the first of them
      return parts_where([&](const double xi) {
        set(0, xi);
        return where(x) != 0.;
      });
    };
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = centre[d];

    double     area = 0., moment[2] = {0., 0.}; // over [-1, 1]^(dim - 1)
    const auto add_line = [&](const double weight, const double eta) {
      for (const Interval &part : parts_of_line())
        {
          const double length = weight * (part.end - part.begin);
          area += length;
          moment[0] += 0.5 * (part.begin + part.end) * length;
          moment[1] += eta * length;
        }
    };
    if constexpr (dim == 2)
      add_line(1., 0.);
    else
      {
        // between the lines on which something begins or ends to hold, by Gauss points of eighths
        const auto any_on_line = [&](const double eta) {
          set(1, eta);
          return !parts_of_line().empty();
        };
        for (const Interval &part : parts_where(any_on_line))
          for (int k = 0; k < n_samples; ++k)
            {
              const double width = (part.end - part.begin) / n_samples;
              for (int g = 0; g < 3; ++g)
                {
                  const double eta = part.begin + (k + 0.5 * (1. + gauss_point[g])) * width;
                  set(1, eta);
                  add_line(width * gauss_weight[g], eta);
                }
            }
      }
    CoveredPart<dim> result;
    result.fraction = area / (dim == 2 ? 2. : 4.);
    if (area > 0.)
      for (unsigned int k = 0; k < dim - 1; ++k)
        result.offset[along[k]] = moment[k] / area * half_lengths[along[k]];
    return result;
  }

  template struct CoveredPart<2>;
  template struct CoveredPart<3>;
  template CoveredPart<2>
  covered_part(const Expression &,
               const dealii::Point<2> &,
               const unsigned int,
               const dealii::Tensor<1, 2> &);
  template CoveredPart<3>
  covered_part(const Expression &,
               const dealii::Point<3> &,
               const unsigned int,
               const dealii::Tensor<1, 3> &);
} // namespace kedge
