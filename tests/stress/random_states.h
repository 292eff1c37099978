// Committed states and steps at random, with the spectra that make trouble.
#ifndef kedge_tests_stress_random_states_h
#define kedge_tests_stress_random_states_h

#include <kedge/fields/step_points.h>
#include <kedge/materials/material.h>

#include <random>
#include <string>
#include <vector>

namespace kedge::test
{
  enum class Spectrum
  {
    apart,
    nearly_equal, ///< stretches that differ by 1e-9
    equal,
    identity
  };

  inline const std::vector<Spectrum> all_spectra = {Spectrum::apart,
                                                    Spectrum::nearly_equal,
                                                    Spectrum::equal,
                                                    Spectrum::identity};

  inline std::string
  name(const Spectrum spectrum)
  {
    const char *names[] = {"apart", "nearly equal", "equal", "identity"};
    return names[static_cast<int>(spectrum)];
  }

  /** Writes the history of a law into the memory of a point. */
  template <class Law, int dim>
  void
  remember(const Law &law, const HistoryOf<Law> &history, PointState<dim> &state)
  {
    double values[most_law_columns] = {};
    write_history<Law>(history, values);
    const auto columns = memory_indices(law);
    for (unsigned int c = 0; c < columns.size(); ++c)
      state.memory[columns[c]] = values[c];
  }

  /** The reverse of remember(). */
  template <class Law, int dim>
  HistoryOf<Law>
  remembered(const Law &law, const PointState<dim> &state)
  {
    double     values[most_law_columns] = {};
    const auto columns                  = memory_indices(law);
    for (unsigned int c = 0; c < columns.size(); ++c)
      values[c] = state.memory[columns[c]];
    return read_history<Law>(values);
  }

  template <int dim>
  class RandomStates
  {
  public:
    explicit RandomStates(const unsigned int seed)
      : generator(seed)
    {}

    double
    uniform(const double low, const double high)
    {
      return std::uniform_real_distribution<double>(low, high)(generator);
    }

    /** A proper rotation: Gram and Schmidt on random columns. */
    dealii::Tensor<2, dim>
    rotation()
    {
      dealii::Tensor<2, dim> Q;
      for (int j = 0; j < dim; ++j)
        {
          dealii::Tensor<1, dim> column;
          for (int i = 0; i < dim; ++i)
            column[i] = uniform(-1, 1);
          for (int repeat = 0; repeat < 2; ++repeat)
            for (int k = 0; k < j; ++k)
              {
                double along = 0.;
                for (int i = 0; i < dim; ++i)
                  along += Q[i][k] * column[i];
                for (int i = 0; i < dim; ++i)
                  column[i] -= along * Q[i][k];
              }
          for (int i = 0; i < dim; ++i)
            Q[i][j] = column[i] / column.norm();
        }
      if (determinant(Q) < 0.)
        for (int i = 0; i < dim; ++i)
          Q[i][0] = -Q[i][0];
      return Q;
    }

    /**
     * A point deformed by F = V diag(stretch) Q^T, elastically throughout in
     * the plane; in plane strain with some elastic strain out of the plane.
     */
    PointState<dim>
    point(const Spectrum spectrum, const Hencky &material)
    {
      PointState<dim> state;
      std::fill_n(reinterpret_cast<double *>(&state), n_state_values<dim>, 0.);
      const dealii::Tensor<2, dim> V = rotation(), Q = rotation();
      const double                 common = uniform(0.8, 1.25);
      const bool strained_out_of_plane    = dim == 2 && spectrum != Spectrum::identity;
      state.out_of_plane_elastic_stretch  = strained_out_of_plane ? uniform(0.95, 1.05) : 1.;

      double stretch[3] = {1., 1., state.out_of_plane_elastic_stretch};
      for (int j = 0; j < dim; ++j)
        if (spectrum == Spectrum::apart)
          stretch[j] = std::exp(uniform(-0.3, 0.3));
        else if (spectrum == Spectrum::nearly_equal)
          stretch[j] = common * (1. + 1e-9 * j);
        else if (spectrum == Spectrum::equal)
          stretch[j] = common;
        else
          stretch[j] = 1.;

      const double volume = std::log(stretch[0] * stretch[1] * stretch[2]);
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          for (int j = 0; j < dim; ++j)
            {
              const double tau =
                material.lame_modulus * volume + 2. * material.shear_modulus * std::log(stretch[j]);
              if (k == 0) // at rest exactly, not up to the rounding of V
                state.elastic_frame[i][j] =
                  spectrum == Spectrum::identity ? (i == j ? 1. : 0.) : V[i][j] * stretch[j];
              state.deformation_gradient[i][k] += V[i][j] * stretch[j] * Q[k][j];
              if (i <= k)
                state.kirchhoff_stress[i][k] += V[i][j] * tau * V[k][j];
            }
      return state;
    }

    /**
     * A material for which the state is admissible, its deviatoric stress at a
     * distance @p gap [Pa] from the yield surface; hardens by @p hardening. The
     * state gets a plastic strain if the material hardens.
     */
    VonMises
    material_about(PointState<dim>          &state,
                   const MaterialParameters &elasticity,
                   const double              hardening,
                   const double              gap)
    {
      const Hencky elastic(elasticity);
      const auto   response = elastic.respond(make_stress_state(state).strain, {0., 0., 0.});
      const auto  &tau      = response.kirchhoff_stress;
      const double pressure = (tau[0] + tau[1] + tau[2]) / 3.;
      double       square   = 0.;
      for (const double principal : tau)
        square += (principal - pressure) * (principal - pressure);
      const double yield_stress = std::sqrt(1.5) * (std::sqrt(square) + gap);

      MaterialParameters parameters = elasticity;
      parameters.hardening_modulus  = hardening;
      VonMises::History<double> history;
      if (hardening > 0.)
        history.equivalent_plastic_strain =
          std::min(uniform(0., 0.3), 0.5 * yield_stress / hardening);
      history.yield_stress = yield_stress - hardening * history.equivalent_plastic_strain;
      remember(VonMises(parameters), history, state);
      return VonMises(parameters);
    }

    /** A step's displacement gradient, entries in [-size, size]. */
    void
    step(const double size, double (&A)[dim][dim])
    {
      for (auto &row : A)
        for (double &entry : row)
          entry = uniform(-size, size);
    }

  private:
    std::mt19937 generator;
  };
} // namespace kedge::test

#endif
