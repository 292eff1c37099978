#include "gmres.h"

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Directions kept before a restart. */
    constexpr unsigned int most_directions = 80;

    /** A direction that loses more than this against the others is made orthogonal twice. */
    constexpr double cancellation = 0.3;

    using Vector = std::vector<double>;

    void
    sum_over_ranks(double *values, const int n, const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, communicator);
    }

    /** In eight sums, so that the compiler may compute them side by side. */
    double
    dot(const Vector &a, const Vector &b)
    {
      double            sums[8] = {};
      const std::size_t n       = a.size() - a.size() % 8;
      for (std::size_t i = 0; i < n; i += 8)
        for (unsigned int k = 0; k < 8; ++k)
          sums[k] += a[i + k] * b[i + k];
      double sum = 0.;
      for (std::size_t i = n; i < a.size(); ++i)
        sum += a[i] * b[i];
      for (const double part : sums)
        sum += part;
      return sum;
    }

    void
    add(const double factor, const Vector &a, Vector &to)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        to[i] += factor * a[i];
    }

    double
    norm(const Vector &a, const MPI_Comm communicator)
    {
      double square = dot(a, a);
      sum_over_ranks(&square, 1, communicator);
      return std::sqrt(square);
    }

    /**
     * Takes from w its parts along the first n directions, which it returns,
     * with the norm of the rest as the last one. One sum over the ranks: what
     * the parts leave of |w|^2 is the norm, accurate as long as it is not small.
     */
    Vector
    make_orthogonal(const std::vector<Vector> &directions,
                    const unsigned int         n,
                    Vector                    &w,
                    const MPI_Comm             communicator)
    {
      Vector along(n + 1, 0.), part(n + 1);
      for (unsigned int pass = 0; pass < 2; ++pass)
        {
          for (unsigned int k = 0; k < n; ++k)
            part[k] = dot(directions[k], w);
          part[n] = dot(w, w);
          sum_over_ranks(part.data(), static_cast<int>(n) + 1, communicator);
          double rest = part[n];
          for (unsigned int k = 0; k < n; ++k)
            {
              add(-part[k], directions[k], w);
              along[k] += part[k];
              rest -= part[k] * part[k];
            }
          along[n] = std::sqrt(std::max(rest, 0.));
          if (rest > cancellation * cancellation * part[n])
            break;
        }
      return along;
    }

    /** The least-squares problem min |beta e_1 - H y|, solved by rotations as H grows. */
    class Hessenberg
    {
    public:
      explicit Hessenberg(const double beta)
        : right_side(1, beta)
      {}

      /** Adds a column, returns the norm of the residual. */
      double
      add_column(Vector column)
      {
        const std::size_t n = columns.size();
        for (std::size_t k = 0; k < n; ++k)
          {
            const double upper = cosine[k] * column[k] + sine[k] * column[k + 1];
            column[k + 1]      = cosine[k] * column[k + 1] - sine[k] * column[k];
            column[k]          = upper;
          }
        const double length = std::hypot(column[n], column[n + 1]);
        cosine.push_back(length > 0. ? column[n] / length : 1.);
        sine.push_back(length > 0. ? column[n + 1] / length : 0.);
        column[n] = length;
        columns.push_back(std::move(column));
        right_side.push_back(-sine[n] * right_side[n]);
        right_side[n] *= cosine[n];
        return std::abs(right_side[n + 1]);
      }

      Vector
      solution() const
      {
        Vector y(columns.size());
        for (std::size_t i = y.size(); i-- > 0;)
          {
            double sum = right_side[i];
            for (std::size_t k = i + 1; k < y.size(); ++k)
              sum -= columns[k][i] * y[k];
            y[i] = columns[i][i] != 0. ? sum / columns[i][i] : 0.;
          }
        return y;
      }

    private:
      std::vector<Vector> columns;
      Vector              cosine, sine, right_side;
    };
  } // namespace



  GmresResult
  solve_gmres(const LinearMap           &matrix,
              const LinearMap           &preconditioner,
              const std::vector<double> &b,
              std::vector<double>       &x,
              const double               tolerance,
              const unsigned int         max_iterations,
              const MPI_Comm             communicator)
  {
    GmresResult         result;
    Vector              residual = b, z(b.size());
    std::vector<Vector> directions;
    x.assign(b.size(), 0.);
    double       size   = norm(residual, communicator);
    const double target = tolerance * size;
    for (;;)
      {
        result.success = size <= target;
        if (result.success || result.iterations >= max_iterations || !std::isfinite(size))
          return result;

        Hessenberg   hessenberg(size);
        unsigned int n        = 0;
        double       estimate = size;
        directions.resize(std::max<std::size_t>(directions.size(), 1));
        directions[0] = residual;
        for (double &value : directions[0])
          value /= size;
        while (estimate > target && n < most_directions && result.iterations < max_iterations)
          {
            preconditioner(directions[n].data(), z.data());
            if (directions.size() == n + 1)
              directions.emplace_back(b.size());
            Vector &next = directions[n + 1];
            next.resize(b.size());
            matrix(z.data(), next.data());
            const Vector along = make_orthogonal(directions, n + 1, next, communicator);
            estimate           = hessenberg.add_column(along);
            ++n;
            ++result.iterations;
            if (!(along[n] > 0.) || !std::isfinite(along[n]))
              break; // the space holds the solution, or nothing useful
            for (double &value : next)
              value /= along[n];
          }

        const Vector y = hessenberg.solution();
        Vector       sum(b.size(), 0.);
        for (unsigned int k = 0; k < n; ++k)
          add(y[k], directions[k], sum);
        preconditioner(sum.data(), z.data());
        add(1., z, x);
        matrix(x.data(), residual.data());
        for (std::size_t i = 0; i < b.size(); ++i)
          residual[i] = b[i] - residual[i];
        const double before = size;
        size                = norm(residual, communicator);
        if (!(size < 0.99 * before)) // stagnation
          {
            result.success = size <= target;
            return result;
          }
      }
  }
} // namespace kedge
