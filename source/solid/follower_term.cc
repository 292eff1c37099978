#include <kedge/solid/follower_term.h>
#include <kedge/solid/load_columns.h>

namespace kedge
{
  namespace
  {
    /** Part of a cell over which the slope of a pressure by the place is taken. */
    constexpr double part_for_slope = 1e-4;

    /** cof(F): cofactors, d det F/dF_ij at [i][j]. */
    template <int dim>
    dealii::Tensor<2, dim>
    cofactors(const dealii::Tensor<2, dim> &F)
    {
      dealii::Tensor<2, dim> result;
      if constexpr (dim == 2)
        {
          result[0][0] = F[1][1];
          result[0][1] = -F[1][0];
          result[1][0] = -F[0][1];
          result[1][1] = F[0][0];
        }
      else
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            {
              const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
              result[i][j] = F[a][c] * F[b][d] - F[a][d] * F[b][c];
            }
      return result;
    }

    /** The derivative of cofactors() in the direction @p dF; cof is of degree dim - 1 in F. */
    template <int dim>
    dealii::Tensor<2, dim>
    cofactor_slope(const dealii::Tensor<2, dim> &F, const dealii::Tensor<2, dim> &dF)
    {
      if constexpr (dim == 2)
        return cofactors<dim>(dF);
      else
        return cofactors<dim>(F + dF) - cofactors<dim>(F) - cofactors<dim>(dF);
    }

    /** A face in a trial state of the grid. */
    template <int dim, unsigned int pattern>
    struct TrialFace
    {
      static constexpr int n = stencil_size<dim>(pattern);

      TrialFace(const Patch<dim>          &patch,
                const SurfacePoint<dim>   &face,
                const std::vector<double> &u,
                const double               fraction)
        : point(expand<dim, pattern>(face.gradients))
        , at_face(expand<dim, pattern>(face.functions))
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        for (int d = 0; d < dim; ++d)
          {
            x[d]    = patch.points.location[face.slot][d] + face.offset[d];
            area[d] = face.area[d];
            F[d][d] = 1.;
          }
        for (int B = 0; B < n; ++B)
          {
            local[B] = patch.nodes.local(face.functions.first_node + offsets[B]);
            for (int i = 0; i < dim && !u.empty(); ++i)
              {
                const double u_i = fraction * u[std::size_t(local[B]) * dim + i];
                x[i] += at_face.value[B] * u_i;
                for (int j = 0; j < dim; ++j)
                  F[i][j] += u_i * point.gradient[j][B];
              }
          }
      }

      std::array<int, n>     local;
      BasisValues<dim, n>    point, at_face;
      dealii::Point<dim>     x; ///< of the face's centre
      dealii::Tensor<2, dim> F; ///< I + fraction A
      dealii::Tensor<1, dim> area;
    };

    /** Calls use(TrialFace, force) for a face. */
    template <int dim, typename Use>
    struct WithForce
    {
      const Patch<dim>             &patch;
      const FollowerPressures<dim> &pressures;
      const SurfacePoint<dim>      &face;
      const std::vector<double>    &u;
      const double                  fraction, t;
      const Use                    &use;

      template <unsigned int pattern>
      void
      run() const
      {
        const TrialFace<dim, pattern> trial(patch, face, u, fraction);
        use(trial,
            -pressures.pressure(face.surface, trial.x, t) * (cofactors<dim>(trial.F) * trial.area));
      }
    };

    /** The same for all faces: use(surface, TrialFace, force). */
    template <int dim, typename Use>
    void
    for_forces(const Patch<dim>             &patch,
               const FollowerPressures<dim> &pressures,
               const std::vector<double>    &u,
               const double                  fraction,
               const double                  t,
               const Use                    &use)
    {
      for (const auto &face : pressures.points())
        {
          const auto of_surface = [&](const auto &trial, const dealii::Tensor<1, dim> &force) {
            use(face.surface, trial, force);
          };
          dispatch_pattern<dim>(face.functions.pattern,
                                WithForce<dim, decltype(of_surface)>{patch,
                                                                     pressures,
                                                                     face,
                                                                     u,
                                                                     fraction,
                                                                     t,
                                                                     of_surface});
        }
    }

    /** Adds the derivative of the forces on a face to the tangent of a residual, -d f/d u. */
    template <int dim>
    struct AddSlope
    {
      const Patch<dim>             &patch;
      const FollowerPressures<dim> &pressures;
      const SurfacePoint<dim>      &face;
      const std::vector<double>    &u;
      const double                  alpha, t, length;
      NodeMatrix<dim>              &tangent;

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int                 n = stencil_size<dim>(pattern);
        const TrialFace<dim, pattern> trial(patch, face, u, alpha);
        const double                  p     = pressures.pressure(face.surface, trial.x, t);
        const dealii::Tensor<1, dim>  dp    = pressures.slope(face.surface, trial.x, t, length);
        const dealii::Tensor<1, dim>  now   = cofactors<dim>(trial.F) * trial.area;
        const unsigned int            width = patch.n_components();
        for (int B = 0; B < n; ++B)
          for (int m = 0; m < dim; ++m)
            {
              dealii::Tensor<2, dim> dF; // of a displacement of component m at B
              for (int j = 0; j < dim; ++j)
                dF[m][j] = alpha * trial.point.gradient[j][B];
              const dealii::Tensor<1, dim> slope =
                p * (cofactor_slope<dim>(trial.F, dF) * trial.area) +
                alpha * trial.at_face.value[B] * dp[m] * now;
              for (int A = 0; A < n; ++A)
                {
                  LatticeIndex<dim> offset;
                  for (int d = 0, a = A, b = B; d < dim; ++d)
                    {
                      offset[d] = b % stencil_width(pattern, d) - a % stencil_width(pattern, d);
                      a /= stencil_width(pattern, d);
                      b /= stencil_width(pattern, d);
                    }
                  const unsigned int column = tangent.slot(offset) * width + m;
                  for (int i = 0; i < dim; ++i)
                    tangent.row(trial.local[A], i)[column] += trial.at_face.value[A] * slope[i];
                }
            }
      }
    };
  } // namespace



  template <int dim>
  FollowerPressures<dim>::FollowerPressures(const std::vector<TractionParameters<dim>>  &parameters,
                                            const std::map<std::string, double>         &constants,
                                            const LoadProgram                           &program,
                                            const std::vector<const SurfaceTerm<dim> *> &surfaces)
    : SurfaceFaces<dim>("Traction", {parameters.begin(), parameters.end()}, constants, surfaces)
    , program(program)
  {
    for (const auto &p : parameters)
      {
        expressions.emplace_back(p.pressure,
                                 std::vector<std::string>{"x", "y", "z", "t"},
                                 constants);
        resultants.push_back(p.resultant);
      }
  }



  template <int dim>
  double
  FollowerPressures<dim>::pressure(const unsigned int        surface,
                                   const dealii::Point<dim> &x,
                                   const double              t) const
  {
    double values[4] = {0., 0., 0., program.time(t)};
    for (int d = 0; d < dim; ++d)
      values[d] = x[d];
    return program.factor(t) * expressions[surface](values);
  }



  template <int dim>
  dealii::Tensor<1, dim>
  FollowerPressures<dim>::slope(const unsigned int        surface,
                                const dealii::Point<dim> &x,
                                const double              t,
                                const double              length) const
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      {
        dealii::Point<dim> below = x, above = x;
        below[d] -= length;
        above[d] += length;
        result[d] = (pressure(surface, above, t) - pressure(surface, below, t)) / (2. * length);
      }
    return result;
  }



  template <int dim>
  FollowerTerm<dim>::FollowerTerm(const unsigned int              field,
                                  const Patch<dim>               &patch,
                                  const FollowerPressures<dim>   &pressures,
                                  const std::vector<std::string> &body_names,
                                  const Scheme                   &scheme)
    : ControlledLoads<dim>(scheme)
    , field(field)
    , patch(patch)
    , pressures(pressures)
    , body_names(body_names)
    , alpha(scheme.conserving_stress ? 0.5 : scheme.alpha_f)
  {}



  template <int dim>
  void
  FollowerTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    pressures.attach(points, body_names);
  }



  template <int dim>
  void
  FollowerTerm<dim>::declare_books(Ledger &ledger)
  {
    work = ledger.declare(external_work);
    resultants.assign(pressures.names().size() * dim, 0);
    for (std::size_t s = 0; s < pressures.names().size(); ++s)
      for (int d = 0; d < dim && pressures.shows_resultant(s); ++d)
        resultants[s * dim + d] = ledger.declare(force_column("load", pressures.names()[s], d));
  }



  template <int dim>
  void
  FollowerTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    pressures.reinit(cloud, patch);
  }



  template <int dim>
  Answer
  FollowerTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    std::vector<double> &sums  = residual.partial(field);
    const std::size_t    width = patch.n_components();
    for_forces(patch,
               pressures,
               trial.displacement(field),
               alpha,
               this->balance_time(trial),
               [&](const unsigned int, const auto &face, const dealii::Tensor<1, dim> &force) {
                 for (std::size_t A = 0; A < face.local.size(); ++A)
                   for (int d = 0; d < dim; ++d)
                     sums[face.local[A] * width + d] -= face.at_face.value[A] * force[d];
               });
    return {};
  }



  template <int dim>
  void
  FollowerTerm<dim>::add_residual_at_rest(const double t, Residual<dim> &residual)
  {
    std::vector<double> &sums  = residual.partial(field);
    const std::size_t    width = patch.n_components();
    for_forces(patch,
               pressures,
               {},
               0.,
               t,
               [&](const unsigned int, const auto &face, const dealii::Tensor<1, dim> &force) {
                 for (std::size_t A = 0; A < face.local.size(); ++A)
                   for (int d = 0; d < dim; ++d)
                     sums[face.local[A] * width + d] -= face.at_face.value[A] * force[d];
               });
  }



  template <int dim>
  void
  FollowerTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    const double t      = this->balance_time(trial);
    const double length = part_for_slope * patch.grid().lattice().smallest_cell_size();
    for (const auto &face : pressures.points())
      dispatch_pattern<dim>(face.functions.pattern,
                            AddSlope<dim>{patch,
                                          pressures,
                                          face,
                                          trial.displacement(field),
                                          alpha,
                                          t,
                                          length,
                                          tangent.lattice(field)});
  }



  template <int dim>
  std::vector<double>
  FollowerTerm<dim>::slope_at_nodes(const Trial<dim> &trial) const
  {
    const double        l          = this->balance_time(trial);
    const double        difference = this->small_difference(l);
    std::vector<double> sums(std::size_t(patch.nodes.n_local()) * dim, 0.);
    for (const double sign : {1., -1.})
      for_forces(patch,
                 pressures,
                 trial.displacement(field),
                 alpha,
                 l + sign * difference,
                 [&](const unsigned int, const auto &face, const dealii::Tensor<1, dim> &force) {
                   for (std::size_t A = 0; A < face.local.size(); ++A)
                     for (int d = 0; d < dim; ++d)
                       sums[std::size_t(face.local[A]) * dim + d] +=
                         sign / (2. * difference) * face.at_face.value[A] * force[d];
                 });
    patch.ties.restrict_sums(sums);
    patch.nodes.add_to_owners(sums, dim);
    return sums;
  }



  template <int dim>
  double
  FollowerTerm<dim>::square_of_slope(const Trial<dim> &trial) const
  {
    const std::vector<double> slope = slope_at_nodes(trial);
    double                    sum   = 0.;
    for (std::size_t i = 0; i < patch.nodes.n_owned() * dim; ++i)
      sum += slope[i] * slope[i];
    return sum;
  }



  template <int dim>
  void
  FollowerTerm<dim>::add_slope(const Trial<dim>   &trial,
                               const double        s,
                               const UnknownIndex &x,
                               Tangent<dim>       &tangent) const
  {
    const std::vector<double> slope = slope_at_nodes(trial);
    for (unsigned int node = 0; node < patch.nodes.n_owned(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (const double value = slope[std::size_t(node) * dim + d]; value != 0.)
          tangent.add({field, node, d}, x, -s * value);
  }



  template <int dim>
  void
  FollowerTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    const std::vector<double> &u   = trial.displacement(field);
    double                     sum = 0.;
    for_forces(patch,
               pressures,
               u,
               0.5,
               this->middle_time(trial),
               [&](const unsigned int, const auto &face, const dealii::Tensor<1, dim> &f) {
                 for (std::size_t A = 0; A < face.local.size(); ++A)
                   for (int d = 0; d < dim; ++d)
                     sum += face.at_face.value[A] * f[d] * u[std::size_t(face.local[A]) * dim + d];
               });
    for_forces(patch,
               pressures,
               u,
               alpha,
               this->balance_time(trial),
               [&](const unsigned int surface, const auto &, const dealii::Tensor<1, dim> &f) {
                 for (int d = 0; d < dim && pressures.shows_resultant(surface); ++d)
                   ledger.book(resultants[surface * dim + d], f[d]);
               });
    ledger.book(work, sum);
  }

  template class FollowerPressures<2>;
  template class FollowerPressures<3>;
  template class FollowerTerm<2>;
  template class FollowerTerm<3>;
} // namespace kedge
