#include <kedge/base/exceptions.h>
#include <kedge/contact/shear_limit.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace kedge
{
  namespace
  {
    template <class Law>
    constexpr bool is_clay =
      std::is_same_v<HistoryOf<Law>, UndrainedStrength::template History<double>>;

    /** Sums over points by volume: 1, the place from x_0 in cells, their products, s_u, products.
     */
    template <int dim>
    struct Moments
    {
      static constexpr unsigned int n = (dim + 1) * (dim + 2);

      std::array<double, n> sums{}; ///< rows of (1, dx) (1, dx)^T, then s_u (1, dx)

      void
      add(const double volume, const dealii::Tensor<1, dim> &dx, const double strength)
      {
        for (unsigned int i = 0; i <= dim; ++i)
          {
            const double left = volume * (i == 0 ? 1. : dx[i - 1]);
            for (unsigned int j = 0; j <= dim; ++j)
              sums[i * (dim + 1) + j] += left * (j == 0 ? 1. : dx[j - 1]);
            sums[(dim + 1) * (dim + 1) + i] += left * strength;
          }
      }

      /** Adds those of @p other, whose places are counted from @p offset away. */
      void
      add(const Moments &other, const dealii::Tensor<1, dim> &offset)
      {
        // (1, dx + o) = T (1, dx)
        dealii::Tensor<2, dim + 1> T, A;
        dealii::Tensor<1, dim + 1> b;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            T[i][i] = 1.;
            if (i > 0)
              T[i][0] = offset[i - 1];
            for (unsigned int j = 0; j <= dim; ++j)
              A[i][j] = other.sums[i * (dim + 1) + j];
            b[i] = other.sums[(dim + 1) * (dim + 1) + i];
          }
        A = T * A * transpose(T);
        b = T * b;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            for (unsigned int j = 0; j <= dim; ++j)
              sums[i * (dim + 1) + j] += A[i][j];
            sums[(dim + 1) * (dim + 1) + i] += b[i];
          }
      }

      /** The nearest linear function at x_0; constant in directions in which there are no points.
       */
      double
      fitted() const
      {
        constexpr double           least_spread = 1e-6; // of places, squared, in cells
        dealii::Tensor<2, dim + 1> A;
        dealii::Tensor<1, dim + 1> b;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            for (unsigned int j = 0; j <= dim; ++j)
              A[i][j] = sums[i * (dim + 1) + j] / sums[0];
            b[i] = sums[(dim + 1) * (dim + 1) + i] / sums[0];
          }
        // about the mean place m: s = mean + g.(dx - m), (A_xx - m m + least) g = b_x - m mean
        dealii::Tensor<2, dim> spread;
        dealii::Tensor<1, dim> mean, slope;
        for (unsigned int i = 0; i < dim; ++i)
          {
            mean[i]  = A[0][i + 1];
            slope[i] = b[i + 1] - mean[i] * b[0];
            for (unsigned int j = 0; j < dim; ++j)
              spread[i][j] = A[i + 1][j + 1] - A[0][i + 1] * A[0][j + 1];
            if (spread[i][i] < least_spread)
              spread[i][i] += least_spread;
          }
        return b[0] - (invert(spread) * slope) * mean;
      }
    };

    /** The cells around a place, itself in the middle, that the window holds. */
    template <int dim, typename Visit>
    void
    for_cells_around(const Patch<dim> &patch, const dealii::Point<dim> &x, const Visit &visit)
    {
      const LatticeIndex<dim> here = patch.grid().lattice().cell_of(x);
      unsigned int            n    = 1;
      for (int d = 0; d < dim; ++d)
        n *= 3;
      for (unsigned int k = 0; k < n; ++k)
        {
          LatticeIndex<dim> cell;
          unsigned int      rest = k;
          for (int d = 0; d < dim; ++d, rest /= 3)
            cell[d] = here[d] + static_cast<int>(rest % 3) - 1;
          if (patch.window().contains_cell(cell))
            visit(patch.window().cell_number(cell), cell);
        }
    }

    /** The middle of a cell. */
    template <int dim>
    dealii::Point<dim>
    middle_of(const Lattice<dim> &lattice, const LatticeIndex<dim> &cell)
    {
      dealii::Point<dim> x = lattice.node_position(cell);
      return x + 0.5 * lattice.h;
    }

    /** A distance in cells. */
    template <int dim>
    dealii::Tensor<1, dim>
    in_cells(const Lattice<dim> &lattice, dealii::Tensor<1, dim> distance)
    {
      for (int d = 0; d < dim; ++d)
        distance[d] /= lattice.h[d];
      return distance;
    }

    /** Adds up the points of the surface's body that lie in the cells of @p moments. */
    template <int dim, class Law>
    void
    add_points(const BodySurface<dim>                     &surface,
               const Law                                  &law,
               const std::map<unsigned int, unsigned int> &number_of_cell,
               std::vector<Moments<dim>>                  &moments)
    {
      const Patch<dim>      &patch   = surface.patch;
      const Lattice<dim>    &lattice = patch.grid().lattice();
      const StepPoints<dim> &points  = patch.points;
      for (const auto &batch : points.batches)
        if (batch.body == surface.body)
          for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
            {
              const LatticeIndex<dim> cell  = lattice.cell_of(points.location[slot]);
              const auto              known = number_of_cell.find(patch.window().cell_number(cell));
              if (known == number_of_cell.end())
                continue;
              const double strength =
                law.strength.slow_strength(points.template history_of<Law>(slot), 0.);
              moments[known->second].add(
                points.volume[slot] * points.determinant[slot],
                in_cells<dim>(lattice, points.location[slot] - middle_of<dim>(lattice, cell)),
                strength);
            }
    }
  } // namespace



  bool
  has_undrained_strength(const Material &material)
  {
    return std::visit(
      [](const auto &law) {
        return is_clay<std::decay_t<decltype(law)>>;
      },
      material);
  }



  template <int dim>
  std::vector<double>
  undrained_strengths(const BodySurface<dim> &surface, const Material &material)
  {
    const Patch<dim>                    &patch   = surface.patch;
    const Lattice<dim>                  &lattice = patch.grid().lattice();
    std::map<unsigned int, unsigned int> number_of_cell;
    for (const auto &x : surface.mesh().vertices)
      for_cells_around<dim>(patch, x, [&](const unsigned int number, const LatticeIndex<dim> &) {
        number_of_cell.emplace(number, number_of_cell.size());
      });
    std::vector<Moments<dim>> moments(number_of_cell.size());
    std::visit(
      [&](const auto &law) {
        if constexpr (is_clay<std::decay_t<decltype(law)>>)
          add_points(surface, law, number_of_cell, moments);
      },
      material);
    static_assert(sizeof(Moments<dim>) == Moments<dim>::n * sizeof(double));
    if (dealii::Utilities::MPI::n_mpi_processes(patch.grid().communicator()) > 1)
      MPI_Allreduce(MPI_IN_PLACE, // points of a cell are all on one rank: the sums are exact
                    moments.data(),
                    static_cast<int>(moments.size() * Moments<dim>::n),
                    MPI_DOUBLE,
                    MPI_SUM,
                    patch.grid().communicator());
    std::vector<double> result;
    for (const auto &x : surface.mesh().vertices)
      {
        Moments<dim> here;
        for_cells_around<dim>(patch,
                              x,
                              [&](const unsigned int number, const LatticeIndex<dim> &cell) {
                                here.add(moments[number_of_cell.at(number)],
                                         in_cells<dim>(lattice, middle_of<dim>(lattice, cell) - x));
                              });
        result.push_back(here.sums[0] > 0. ? std::max(here.fitted(), 0.)
                                           : std::numeric_limits<double>::quiet_NaN());
      }
    return result;
  }



  template <int dim>
  ShearLimit<dim>::ShearLimit(const ContactParameters             &parameters,
                              const std::map<std::string, double> &constants)
    : contact(parameters.name)
    , expression(parameters.shear_limit.empty()
                   ? Expression(std::numeric_limits<double>::infinity())
                   : Expression(parameters.shear_limit, shear_limit_variables(), constants))
  {}



  template <int dim>
  void
  ShearLimit<dim>::count_from(const BodySurface<dim> &surface)
  {
    for (const auto &x : surface.mesh().vertices)
      top = std::max(top, x[1]);
  }



  template <int dim>
  double
  ShearLimit<dim>::value(const dealii::Point<dim> &place, const double strength) const
  {
    if (expression.is_constant())
      return expression.value();
    const double z = dim == 3 ? place[dim - 1] : 0.;
    return expression({place[0], place[1], z, top - place[1], strength});
  }



  template <int dim>
  double
  ShearLimit<dim>::operator()(const dealii::Point<dim> &place, const double strength) const
  {
    const double limit = value(place, strength);
    return limit > 0. ? limit : 0.; // where no soil is left to have a strength too
  }



  template <int dim>
  void
  ShearLimit<dim>::check(const BodySurface<dim> &surface, const bool has_strength) const
  {
    for (unsigned int f = 0; f < surface.n_facets(); ++f)
      {
        dealii::Point<dim> x;
        for (const auto &corner : surface.mesh().corners(f))
          x += corner / dim;
        const double none = std::numeric_limits<double>::quiet_NaN();
        const double here = value(x, has_strength ? 1. : none);
        if (here >= 0.)
          continue;
        std::ostringstream message;
        message << "Contact/" << contact << "/Shear limit ";
        if (!has_strength && value(x, 1.) >= 0.)
          message
            << "asks for s_u, but body '" << surface.body_name
            << "' and what it may touch have no undrained strength. Give the soil a Model that "
               "has one (tresca, von_mises with Undrained strength), or a limit without s_u.";
        else
          message << "is " << here << " on body '" << surface.body_name << "' at (" << x
                  << "); it must be >= 0. Change the expression, for instance with max(..).";
        throw UserError(message.str());
      }
  }

  template std::vector<double>
  undrained_strengths(const BodySurface<2> &, const Material &);
  template std::vector<double>
  undrained_strengths(const BodySurface<3> &, const Material &);
  template class ShearLimit<2>;
  template class ShearLimit<3>;
} // namespace kedge
