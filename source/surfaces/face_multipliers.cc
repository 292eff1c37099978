#include <kedge/surfaces/face_multipliers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace kedge
{
  template <int dim>
  FaceMultipliers<dim>::FaceMultipliers(const SurfaceExtent<dim>     &extent,
                                        const unsigned int            direction,
                                        const dealii::Tensor<1, dim> &cell_size)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double between = extent.high[d] - extent.low[d];
        const double length  = between + 2. * extent.half_lengths[d];
        low[d]               = extent.low[d] - extent.half_lengths[d];
        // a single row of faces tells nothing but a mean
        const bool has_one = d == direction || between <= 1e-6 * extent.half_lengths[d];
        n_intervals[d] =
          has_one
            ? 0
            : std::max(1u,
                       static_cast<unsigned int>(std::lround(length / (spacing * cell_size[d]))));
        width[d] = length / std::max(1u, n_intervals[d]);
      }
    n_functions = n_nodes();
  }



  template <int dim>
  unsigned int
  FaceMultipliers<dim>::n_nodes() const
  {
    unsigned int n = 1;
    for (int d = 0; d < dim; ++d)
      n *= n_intervals[d] + 1;
    return n;
  }

  namespace
  {
    /** Two functions say nearly the same on a surface if the cosine of the angle between them is
     * above this; of neighbours in a plane it is a quarter. */
    constexpr double nearly_the_same = 0.7;

    /** A function hardly touches the surface if it has less than this part of the largest mean. */
    constexpr double hardly_there = 0.1;

    /** Groups of functions with their scalar products. */
    class FunctionGroups
    {
    public:
      explicit FunctionGroups(const unsigned int n)
        : group(n)
        , mean(n, 0.)
        , products(n)
      {
        std::iota(group.begin(), group.end(), 0u);
      }

      void
      add(const std::vector<std::pair<unsigned int, double>> &values, const double area)
      {
        for (const auto &[a, value_a] : values)
          {
            mean[a] += area * value_a;
            for (const auto &[b, value_b] : values)
              products[a][b] += area * value_a * value_b;
          }
      }

      /** Makes @p b a part of @p a. */
      void
      unite(const unsigned int a, const unsigned int b)
      {
        for (unsigned int &of_node : group)
          if (of_node == b)
            of_node = a;
        mean[a] += mean[b];
        mean[b]            = 0.;
        const auto   of_b  = std::move(products[b]);
        const double of_ab = products[a].count(b) ? products[a][b] : 0., of_bb = of_b.at(b);
        products[b].clear();
        for (const auto &[other, product] : of_b)
          if (other != a && other != b)
            {
              products[a][other] += product;
              products[other][a] = products[a][other];
              products[other].erase(b);
            }
        products[a][a] += 2. * of_ab + of_bb;
        products[a].erase(b);
      }

      double
      cosine(const unsigned int a, const unsigned int b) const
      {
        return products[a].at(b) / std::sqrt(products[a].at(a) * products[b].at(b));
      }

      /** The other group that says most nearly the same as @p a; @p a if it meets no other. */
      unsigned int
      nearest_to(const unsigned int a) const
      {
        unsigned int best = a;
        for (const auto &[b, product] : products[a])
          if (b != a && product > 0. && (best == a || cosine(a, b) > cosine(a, best)))
            best = b;
        return best;
      }

      std::vector<unsigned int>                   group; ///< of each node
      std::vector<double>                         mean;
      std::vector<std::map<unsigned int, double>> products;
    };
  } // namespace



  namespace
  {
    /** Unites what says nearly the same, the most alike first, then what hardly touches the
     * surface, the smallest first: what is left is well apart. */
    void
    unite(FunctionGroups &groups)
    {
      const double largest = *std::max_element(groups.mean.begin(), groups.mean.end());
      while (true)
        {
          double       most = nearly_the_same, least = hardly_there * largest;
          unsigned int alike = 0, with_alike = 0, small = 0, with_small = 0;
          for (unsigned int a = 0; a < groups.mean.size(); ++a)
            {
              const unsigned int b = groups.nearest_to(a);
              if (b == a)
                continue;
              if (const double cosine = groups.cosine(a, b); cosine > most)
                {
                  most       = cosine;
                  alike      = a;
                  with_alike = b;
                }
              if (groups.mean[a] < least)
                {
                  least      = groups.mean[a];
                  small      = a;
                  with_small = b;
                }
            }
          if (alike != with_alike)
            groups.unite(with_alike, alike);
          else if (small != with_small)
            groups.unite(with_small, small);
          else
            return;
        }
    }
  } // namespace



  /** The nodes that the places touch come first, all others have the function of one nearby. */
  template <int dim>
  void
  FaceMultipliers<dim>::unite_nodes(const std::vector<PlaceOfSurface<dim>> &places)
  {
    constexpr unsigned int                                    none = -1;
    std::vector<unsigned int>                                 touched, number(n_nodes(), none);
    std::vector<std::vector<std::pair<unsigned int, double>>> values(places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
      for_functions(places[k].place, [&](const unsigned int node, const double value) {
        if (number[node] == none)
          {
            number[node] = static_cast<unsigned int>(touched.size());
            touched.push_back(node);
          }
        values[k].emplace_back(number[node], value);
      });
    FunctionGroups groups(static_cast<unsigned int>(touched.size()));
    for (std::size_t k = 0; k < places.size(); ++k)
      groups.add(values[k], places[k].area);
    unite(groups);

    std::vector<unsigned int> function(touched.size(), none);
    n_functions = 0;
    function_of_node.assign(n_nodes(), none);
    for (unsigned int k = 0; k < touched.size(); ++k)
      {
        unsigned int &of_group = function[groups.group[k]];
        if (of_group == none)
          of_group = n_functions++;
        function_of_node[touched[k]] = of_group;
      }
    for (std::size_t k = 0; k < touched.size(); ++k) // grows by the neighbours of what it holds
      for (int d = 0, stride = 1; d < dim; stride *= n_intervals[d] + 1, ++d)
        {
          const unsigned int along = touched[k] / stride % (n_intervals[d] + 1);
          for (const int step : {-1, 1})
            if (step < 0 ? along > 0 : along < n_intervals[d])
              if (const unsigned int other = touched[k] + step * stride;
                  function_of_node[other] == none)
                {
                  function_of_node[other] = function_of_node[touched[k]];
                  touched.push_back(other);
                }
        }
  }



  template <int dim>
  FaceMultipliers<dim>::FaceMultipliers(const std::vector<PlaceOfSurface<dim>> &places,
                                        const dealii::Tensor<1, dim>           &cell_size)
  {
    const auto [lower, upper] = [&]() {
      dealii::Point<dim> low = places.front().place, high = low;
      for (const auto &here : places)
        for (int d = 0; d < dim; ++d)
          {
            low[d]  = std::min(low[d], here.place[d]);
            high[d] = std::max(high[d], here.place[d]);
          }
      return std::make_pair(low, high);
    }();
    for (int d = 0; d < dim; ++d)
      {
        const double length = upper[d] - lower[d], interval = spacing * cell_size[d];
        n_intervals[d] = static_cast<unsigned int>(std::max(1l, std::lround(length / interval)));
        // flat ones lie in the middle of a layer, whose two sides then say the same
        width[d] = std::max(length / n_intervals[d], interval / 2.);
        low[d]   = 0.5 * (lower[d] + upper[d]) - 0.5 * n_intervals[d] * width[d];
      }
    unite_nodes(places);
  }

  template class FaceMultipliers<2>;
  template class FaceMultipliers<3>;
} // namespace kedge
