#include <kedge/surfaces/facet_part.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Of a facet's area: less is round-off of a cut through a corner. */
    constexpr double smallest_fraction = 1e-12;

    constexpr int n_bisections = 50;

    /** A part is halved so often before its corners tell where a condition holds. */
    constexpr int n_halvings = 2;

    template <int dim>
    using Weights = typename FacetPart<dim>::Weights;

    template <int dim>
    Weights<dim>
    between(const Weights<dim> &a, const Weights<dim> &b, const double s)
    {
      Weights<dim> result;
      for (int i = 0; i < dim; ++i)
        result[i] = (1. - s) * a[i] + s * b[i];
      return result;
    }

    template <int dim>
    void
    add(const FacetPart<dim> &part, std::vector<FacetPart<dim>> &parts)
    {
      if (part.fraction() > smallest_fraction)
        parts.push_back(part);
    }

    /**
     * Splits a part into what lies at its corners of one kind and of the other;
     * crossing(i, j) is the weight of corner j where the line from corner i to j is cut.
     */
    template <int dim, typename Crossing>
    void
    split(const FacetPart<dim>        &part,
          const std::array<bool, dim> &is_first,
          const Crossing              &crossing,
          std::vector<FacetPart<dim>> &first,
          std::vector<FacetPart<dim>> &second)
    {
      const auto n_first = std::count(is_first.begin(), is_first.end(), true);
      if (n_first == dim || n_first == 0)
        return add(part, n_first == dim ? first : second);
      // the corner that is alone of its kind, and the others after it in turn
      const bool         kind  = 2 * n_first <= dim;
      const unsigned int alone = static_cast<unsigned int>(
        std::find(is_first.begin(), is_first.end(), kind) - is_first.begin());
      auto &here = kind ? first : second, &there = kind ? second : first;

      std::array<Weights<dim>, dim> cut; // towards each of the other corners
      for (unsigned int k = 0; k < dim; ++k)
        if (k != alone)
          cut[k] = between<dim>(part.corners[alone],
                                part.corners[k],
                                std::clamp(crossing(alone, k), 0., 1.));
      FacetPart<dim> tip = part;
      for (unsigned int k = 0; k < dim; ++k)
        if (k != alone)
          tip.corners[k] = cut[k];
      add(tip, here);
      FacetPart<dim> rest = part;
      rest.corners[alone] = cut[(alone + 1) % dim];
      add(rest, there);
      if constexpr (dim == 3)
        {
          const unsigned int next = (alone + 1) % 3, last = (alone + 2) % 3;
          add(FacetPart<dim>{{{cut[next], part.corners[last], cut[last]}}}, there);
        }
    }

    /** Two halves, cut between corners @p i and @p j. */
    template <int dim>
    void
    halve(const FacetPart<dim>        &part,
          const unsigned int           i,
          const unsigned int           j,
          std::vector<FacetPart<dim>> &halves)
    {
      const auto middle = between<dim>(part.corners[i], part.corners[j], 0.5);
      for (const unsigned int corner : {j, i})
        {
          halves.push_back(part);
          halves.back().corners[corner] = middle;
        }
    }
  } // namespace



  template <int dim>
  FacetPart<dim>
  FacetPart<dim>::whole()
  {
    FacetPart result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result.corners[i][j] = i == j ? 1. : 0.;
    return result;
  }



  template <int dim>
  double
  FacetPart<dim>::fraction() const
  {
    dealii::Tensor<2, dim> matrix;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        matrix[i][j] = corners[i][j];
    return determinant(matrix);
  }



  template <int dim>
  typename FacetPart<dim>::Weights
  FacetPart<dim>::place(const Weights &own) const
  {
    Weights result{};
    for (int k = 0; k < dim; ++k)
      for (int i = 0; i < dim; ++i)
        result[i] += own[k] * corners[k][i];
    return result;
  }



  template <int dim>
  const std::vector<FacetQuadraturePoint<dim>> &
  facet_quadrature()
  {
    static const std::vector<FacetQuadraturePoint<dim>> points = [] {
      std::vector<FacetQuadraturePoint<dim>> result;
      if constexpr (dim == 2)
        for (const int side : {-1, 0, 1})
          {
            const double s = 0.5 * (1. + side * std::sqrt(0.6));
            result.push_back({{{1. - s, s}}, side == 0 ? 8. / 18. : 5. / 18.});
          }
      else
        for (const int side : {-1, 1})
          {
            // of the weight 2 (1 - r): how much of the triangle lies at a distance r from its
            // base
            const double r = 0.4 - side * std::sqrt(0.06), weight = 0.25 + side / std::sqrt(216.);
            for (const int across : {-1, 1})
              {
                const double s = 0.5 * (1. + across / std::sqrt(3.)) * (1. - r);
                result.push_back({{{1. - r - s, s, r}}, weight});
              }
          }
      return result;
    }();
    return points;
  }



  template <int dim>
  dealii::Point<dim>
  place_on_facet(const std::array<dealii::Point<dim>, dim> &corners,
                 const typename FacetPart<dim>::Weights    &weights)
  {
    dealii::Point<dim> x;
    for (int i = 0; i < dim; ++i)
      x += weights[i] * corners[i];
    return x;
  }



  template <int dim>
  std::vector<FacetPart<dim>>
  parts_where(const Expression &where, const std::array<dealii::Point<dim>, dim> &corners)
  {
    auto normal = area_vector<dim>(corners);
    normal /= normal.norm();
    const auto holds = [&](const Weights<dim> &weights) {
      double     values[6] = {0., 0., 0., 0., 0., 0.};
      const auto x         = place_on_facet<dim>(corners, weights);
      for (int d = 0; d < dim; ++d)
        {
          values[d]     = x[d];
          values[3 + d] = normal[d];
        }
      return where(values) != 0.;
    };
    std::vector<FacetPart<dim>> parts = {FacetPart<dim>::whole()}, inside, outside;
    for (unsigned int k = 0; k < n_halvings; ++k)
      {
        std::vector<FacetPart<dim>> halves;
        for (const auto &part : parts)
          halve(part, k % dim, (k + 1) % dim, halves);
        parts.swap(halves);
      }
    for (const auto &part : parts)
      {
        std::array<bool, dim> at_corner;
        for (int i = 0; i < dim; ++i)
          at_corner[i] = holds(part.corners[i]);
        const auto crossing = [&](const unsigned int i, const unsigned int j) {
          double low = 0., high = 1.;
          for (int k = 0; k < n_bisections; ++k)
            {
              const double s = 0.5 * (low + high);
              (holds(between<dim>(part.corners[i], part.corners[j], s)) == at_corner[i] ? low
                                                                                        : high) = s;
            }
          return 0.5 * (low + high);
        };
        split<dim>(part, at_corner, crossing, inside, outside);
      }
    if (outside.empty())
      return {FacetPart<dim>::whole()};
    return inside;
  }



  template <int dim>
  std::vector<FacetPart<dim>>
  cut_to_cells(const Lattice<dim>                        &lattice,
               const std::array<dealii::Point<dim>, dim> &corners,
               const FacetPart<dim>                      &part)
  {
    constexpr double            tolerance = 1e-9; // of a cell
    std::vector<FacetPart<dim>> to_cut    = {part}, result;
    for (int d = 0; d < dim; ++d)
      {
        result.clear();
        while (!to_cut.empty())
          {
            const FacetPart<dim> whole = to_cut.back();
            to_cut.pop_back();
            std::array<double, dim> s;
            for (int i = 0; i < dim; ++i)
              s[i] = lattice.scaled(place_on_facet<dim>(corners, whole.corners[i])[d], d);
            const auto [low, high] = std::minmax_element(s.begin(), s.end());
            const double plane     = std::floor(*low + tolerance) + 1.;
            if (plane >= *high - tolerance)
              {
                result.push_back(whole);
                continue;
              }
            std::array<bool, dim> is_below;
            for (int i = 0; i < dim; ++i)
              is_below[i] = s[i] <= plane;
            const auto crossing = [&](const unsigned int i, const unsigned int j) {
              return (plane - s[i]) / (s[j] - s[i]);
            };
            split<dim>(whole, is_below, crossing, result, to_cut);
          }
        to_cut.swap(result);
      }
    return to_cut;
  }

#define KEDGE_INSTANTIATE(dim)                                                           \
  template struct FacetPart<dim>;                                                        \
  template const std::vector<FacetQuadraturePoint<dim>> &facet_quadrature<dim>();        \
  template dealii::Point<dim>                            place_on_facet<dim>(            \
    const std::array<dealii::Point<dim>, std::size_t(dim)> &, \
    const std::array<double, std::size_t(dim)> &);            \
  template std::vector<FacetPart<dim>> parts_where<dim>(                                 \
    const Expression &,                                                                  \
    const std::array<dealii::Point<dim>, std::size_t(dim)> &);                           \
  template std::vector<FacetPart<dim>> cut_to_cells<dim>(                                \
    const Lattice<dim> &,                                                                \
    const std::array<dealii::Point<dim>, std::size_t(dim)> &,                            \
    const FacetPart<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
