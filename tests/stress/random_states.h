// Committed states and steps at random, with the spectra that make trouble.
#ifndef kedge_tests_stress_random_states_h
#define kedge_tests_stress_random_states_h

#include "quad_reference.h"

#include <kedge/transfer/step_points.h>

#include <random>
#include <string>
#include <vector>

namespace kedge::reference
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
      for (int j = 0; j < dim; ++j)
        {
          double stretch = 1.;
          if (spectrum == Spectrum::apart)
            stretch = std::exp(uniform(-0.3, 0.3));
          else if (spectrum == Spectrum::nearly_equal)
            stretch = common * (1. + 1e-9 * j);
          else if (spectrum == Spectrum::equal)
            stretch = common;
          for (int i = 0; i < dim; ++i)
            {
              state.elastic_frame[i][j] = V[i][j] * stretch;
              for (int k = 0; k < dim; ++k)
                state.deformation_gradient[i][k] += V[i][j] * stretch * Q[k][j];
            }
        }
      const bool strained                = dim == 2 && spectrum != Spectrum::identity;
      state.out_of_plane_elastic_stretch = strained ? uniform(0.95, 1.05) : 1.;
      const Matrix stress =
        hencky(material, reference_state(state).elastic_left_cauchy_green).kirchhoff_stress;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          state.kirchhoff_stress[i][j] = static_cast<double>(stress[i][j]);
      return state;
    }

    /** The same state for the reference; tensors outside the plane are those of plane strain. */
    static State
    reference_state(const PointState<dim> &point)
    {
      Matrix B = Matrix::identity(), F = Matrix::identity();
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            B[i][j] = point.elastic_frame[i][j];
            F[i][j] = point.deformation_gradient[i][j];
          }
      if (dim == 2)
        B[2][2] = point.out_of_plane_elastic_stretch;
      return {B * transpose(B), F * transpose(F)};
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

  template <int dim>
  Matrix
  to_matrix(const double (&A)[dim][dim])
  {
    Matrix result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i][j] = A[i][j];
    return result;
  }
} // namespace kedge::reference

#endif
