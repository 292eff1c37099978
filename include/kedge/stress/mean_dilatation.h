#ifndef kedge_stress_mean_dilatation_h
#define kedge_stress_mean_dilatation_h

#include <kedge/stress/force_stress.h>

#include <deal.II/base/tensor.h>

namespace kedge
{
  /**
   * A material whose pressure is given from outside, by the mean change of
   * volume of a group of points, and whose deviatoric answer is that of
   * @p Material:
   *   tau = dev tau(eps_n + dev deps) + p I,
   *   work = work(dev deps) + p tr deps.
   * It serves as a material for the force stress of a step. Volume and shape
   * must be decoupled in the energy of @p Material, with p = K theta.
   */
  template <class Material, typename Number = double>
  class MeanDilatation : public Material
  {
    static_assert(Material::decoupled_volume);

  public:
    using Response = ResponseOf<Material, Number>;

    /** @param pressure mean Kirchhoff stress p, tension positive [Pa] */
    MeanDilatation(const Material &material, const Number &pressure)
      : Material(material)
      , pressure(pressure)
    {}

    Response
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const HistoryOf<Material, Number> &history = {}) const
    {
      const Number trace         = increment[0] + increment[1] + increment[2];
      const Number deviatoric[3] = {increment[0] - trace / 3.,
                                    increment[1] - trace / 3.,
                                    increment[2] - trace / 3.};

      Response     response = Material::respond(strain_n, deviatoric, history);
      auto        &tau      = response.kirchhoff_stress;
      const Number change   = pressure - (tau[0] + tau[1] + tau[2]) / 3.;
      for (Number &value : tau)
        value += change;
      response.work_increment += pressure * trace;
      return response;
    }

    /** dtau_i / deps_j at fixed pressure [Pa]. */
    Number
    tangent(const Response &response, const int i, const int j) const
    {
      return Material::tangent(response, i, j) - this->bulk_modulus;
    }

  private:
    const Number pressure;
  };

  /** ln det(I + A), its error relative to A and not to 1; not finite where det <= 0. */
  template <int dim, typename Number>
  inline Number
  relative_volume_strain(const Number (&A)[dim][dim])
  {
    using std::log1p;
    const auto minor = [&A](const int i, const int j) {
      return A[i][i] * A[j][j] - A[i][j] * A[j][i];
    };
    if constexpr (dim == 2)
      return log1p(A[0][0] + A[1][1] + minor(0, 1));
    else
      {
        const Number determinant = A[0][0] * minor(1, 2) -
                                   A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                                   A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
        return log1p(A[0][0] + A[1][1] + A[2][2] + minor(0, 1) + minor(0, 2) + minor(1, 2) +
                     determinant);
      }
  }

  /**
   * evaluate_force_stress() of a point whose pressure is given. With
   * StressRule::conserving it does the work
   *   P : A = (dPsi + dD)(dev deps) + p ln det(I + A),
   * which is also its work_increment. (At a configuration, the pressure is
   * the one there and work_increment has no meaning.)
   */
  template <int dim, bool with_tangent, StressRule rule, class Material, typename Number>
  inline ForceStress<dim, Number>
  evaluate_mean_force_stress(const Material                 &material,
                             const Number                   &pressure,
                             const StressState<dim, Number> &state,
                             const Number (&A)[dim][dim],
                             const double                       alpha,
                             const HistoryOf<Material, Number> &history = {})
  {
    StressState<dim, Number> shared = state;
    const Number             change =
      pressure - material.bulk_modulus * (state.strain[0] + state.strain[1] + state.strain[2]);
    for (int i = 0; i < dim; ++i)
      shared.kirchhoff_stress[i] += change;
    const MeanDilatation<Material, Number> law(material, pressure);
    return evaluate_force_stress<dim, with_tangent, rule>(law, shared, A, alpha, history);
  }

  /** How a point's force stress depends on its pressure, and its volume on the displacement. */
  template <int dim>
  struct VolumeSlopes
  {
    double stress[dim][dim]; ///< dP/dp
    double strain[dim][dim]; ///< d theta/dA, theta = ln det(I + A) or ln det(I + alpha A)
  };

  /**
   * VolumeSlopes at @p A, det(I + A) > 0. P is linear in p, so dP/dp is the
   * force stress of ln det(I + A) as the energy.
   */
  template <int dim, StressRule rule>
  inline VolumeSlopes<dim>
  evaluate_volume_slopes(const StressState<dim> &state,
                         const double (&A)[dim][dim],
                         const double alpha)
  {
    const double           fraction = (rule == StressRule::conserving) ? 1. : alpha;
    dealii::Tensor<2, dim> dF;
    double                 at[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          at[i][j] = fraction * A[i][j];
          dF[i][j] = (i == j ? 1. : 0.) + at[i][j];
        }
    const dealii::Tensor<2, dim> inverse = invert(dF);

    VolumeSlopes<dim> slopes;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          slopes.strain[i][j] = fraction * inverse[j][i];
          slopes.stress[i][j] = inverse[j][i]; // dF dF^{-1} dF^{-T}
        }
    if constexpr (rule == StressRule::conserving)
      {
        double           E[n_symmetric<dim>], S[n_symmetric<dim>];
        double           unused[n_symmetric<dim>][n_symmetric<dim>] = {};
        StressState<dim> unit                                       = state;
        for (int s = 0; s < n_symmetric<dim>; ++s)
          {
            const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
            unit.kirchhoff_stress[s] = i == j ? 1. : 0.;
            S[s]                     = 0.;
            for (int k = 0; k < dim; ++k)
              S[s] += inverse[i][k] * inverse[j][k];
          }
        relative_strain<dim>(at, E);
        internal::make_conserving<dim, false>(unit,
                                              E,
                                              relative_volume_strain<dim>(at),
                                              S,
                                              S,
                                              unused);
        ForceStress<dim> force;
        internal::assemble_force_stress<dim, false>(at, 0.5, S, unused, force);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            slopes.stress[i][j] = force.stress[i][j];
      }
    return slopes;
  }
} // namespace kedge

#endif
