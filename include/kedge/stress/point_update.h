#ifndef kedge_stress_point_update_h
#define kedge_stress_point_update_h

#include <kedge/stress/relative_stress.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace kedge
{
  /** The history of a material point at the end of a converged step, not yet committed. */
  template <int dim, typename Number = double>
  struct PointUpdate
  {
    Number relative_gradient[dim][dim];        ///< A = d(Delta u)/dx_n
    Number elastic_frame[dim][dim];            ///< B_{n+1}
    Number kirchhoff_stress[n_symmetric<dim>]; ///< tau_{n+1} [Pa]
    Number out_of_plane_stress;                ///< [Pa]
    Number out_of_plane_stretch_factor;        ///< of the elastic stretch, plane strain
    Number strain_energy;                      ///< per V0 [J/m^3]
    Number hardening_energy;                   ///< per V0 [J/m^3]
    Number dissipation;                        ///< of this step, per V0 [J/m^3]
    Number history[most_law_columns];          ///< at the end of the step, in the law's columns
  };

  /**
   * The stress state of a committed history: B with B B^T = b^e_n, the elastic
   * stretch out of the plane (plane strain, else 1), and tau_n.
   */
  template <int dim>
  inline StressState<dim>
  make_stress_state(const dealii::Tensor<2, dim>          &elastic_frame,
                    const double                           out_of_plane_elastic_stretch,
                    const dealii::SymmetricTensor<2, dim> &kirchhoff_stress)
  {
    StressState<dim> result;
    for (int i = 0; i < dim; ++i)
      {
        double square = 0.;
        for (int k = 0; k < dim; ++k)
          {
            result.elastic_frame[k][i] = elastic_frame[k][i];
            square += elastic_frame[k][i] * elastic_frame[k][i];
          }
        result.squared_stretch[i] = square;
        result.strain[i]          = 0.5 * std::log(square);
      }
    if (dim == 2)
      result.strain[2] = std::log(out_of_plane_elastic_stretch);
    for (int s = 0; s < n_symmetric<dim>; ++s)
      {
        const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
        double    sum = 0.;
        for (int k = 0; k < dim; ++k)
          sum += elastic_frame[i][k] * elastic_frame[j][k];
        result.elastic_left_cauchy_green[s] = sum;
        result.kirchhoff_stress[s]          = kirchhoff_stress[i][j];
      }
    return result;
  }

  namespace internal
  {
    /**
     * Energies and history at the end of the step, and the stretches
     * exp(d eps^p_i) by which the trial elastic stretches are too long.
     * @p volume_change is added to each principal elastic strain.
     */
    template <int dim, class Material, typename Number>
    inline void
    update_history(const Material                              &material,
                   const StressState<dim, Number>              &state,
                   const HistoryOf<Material, Number>           &history,
                   const RelativeStress<dim, Material, Number> &r,
                   const Number                                &volume_change,
                   Number (&plastic_stretch)[3],
                   PointUpdate<dim, Number> &update)
    {
      using std::exp;
      Number strain[3];
      for (int i = 0; i < 3; ++i)
        {
          strain[i]          = state.strain[i] + r.increment[i] + volume_change;
          plastic_stretch[i] = 1.;
          if constexpr (Material::yields)
            {
              const Number plastic = material.plastic_increment(r.response, i);
              if (any(plastic * plastic > 0.))
                {
                  strain[i] -= plastic;
                  plastic_stretch[i] = exp(plastic);
                }
            }
        }
      HistoryOf<Material, Number> end{};
      if constexpr (has_columns<Material>)
        end = material.updated(r.response, history);
      update.strain_energy    = material.energy(strain, end);
      update.hardening_energy = 0.;
      update.dissipation      = 0.;
      for (Number &value : update.history)
        value = 0.;
      write_history<Material>(end, update.history);
      if constexpr (Material::yields)
        {
          update.hardening_energy = material.hardening_energy(end);
          update.dissipation      = material.dissipation(r.response);
        }
    }
  } // namespace internal

  /**
   * Evaluates a point at the end of a step dF = I + A.
   *
   * @param history       of the material at the start of the step
   * @param volume_change added to each principal elastic strain: a third of what
   *                      the point's volume strain differs from its group's
   *                      (MeanDilatation), else 0
   *
   * @return false if det(I + A) or an elastic stretch is not positive, or the
   * material has no answer; the update is of no use then
   */
  template <int dim, class Material, typename Number>
  inline Condition<Number>
  update_point(const Material                    &material,
               const StressState<dim, Number>    &state,
               const HistoryOf<Material, Number> &history,
               const Number (&A)[dim][dim],
               PointUpdate<dim, Number> &update,
               const Number             &volume_change = 0.)
  {
    using std::exp;
    Number E[n_symmetric<dim>];
    relative_strain<dim>(A, E);
    const auto r     = evaluate_relative_stress<dim>(material, state, E, history);
    const auto valid = r.valid && relative_determinant<dim>(A) > 0.;
    if (!any(valid))
      return valid;

    const auto &tau = r.response.kirchhoff_stress;
    Number      plastic_stretch[3];
    internal::update_history(material, state, history, r, volume_change, plastic_stretch, update);
    update.out_of_plane_stress         = dim == 2 ? tau[2] : Number(0.);
    update.out_of_plane_stretch_factor = 1. / plastic_stretch[2];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          update.relative_gradient[i][j] = A[i][j];
          update.elastic_frame[i][j]     = r.frame[i][j];
          for (int k = 0; k < dim; ++k)
            update.elastic_frame[i][j] += A[i][k] * r.frame[k][j];
        }
    for (int s = 0; s < n_symmetric<dim>; ++s)
      {
        const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
        update.kirchhoff_stress[s] = 0.;
        for (int k = 0; k < dim; ++k)
          update.kirchhoff_stress[s] +=
            tau[k] / r.lambda[k] * update.elastic_frame[i][k] * update.elastic_frame[j][k];
      }
    if constexpr (Material::yields)
      for (auto &row : update.elastic_frame)
        for (int k = 0; k < dim; ++k)
          row[k] /= plastic_stretch[k];
    if (any(volume_change * volume_change > 0.))
      {
        const Number stretch = exp(volume_change);
        update.out_of_plane_stretch_factor *= stretch;
        for (auto &row : update.elastic_frame)
          for (Number &entry : row)
            entry *= stretch;
      }
    return valid;
  }
} // namespace kedge

#endif
