#ifndef kedge_materials_mohr_coulomb_h
#define kedge_materials_mohr_coulomb_h

#include <kedge/materials/friction.h>
#include <kedge/materials/hencky_plasticity.h>
#include <kedge/materials/principal_order.h>

#include <limits>

namespace kedge
{
  /**
   * Mohr and Coulomb's law with a tension cut-off, on Hencky's elasticity. Of
   * the principal stresses tau_1 >= tau_2 >= tau_3
   *   f_ij = (1 + sin phi) tau_i - (1 - sin phi) tau_j - 2 c cos phi <= 0,
   *   tau_i <= T = t c cot phi,
   * the flow of f_ij by the angle of dilation psi <= phi, that of the cut-off
   * associated. In principal space all of it is flat: with the rows A of the
   * active planes' gradients and the columns N of their flows
   *   m = (A D_e N)^{-1} (A tau^tr - c'),  tau = tau^tr - D_e N m,
   *   d tau/d eps^tr = D_e - D_e N (A D_e N)^{-1} A D_e,
   * exactly. Faces, edges and corners are tried in turn, until the multipliers m
   * are positive, the stresses in their order and no plane is crossed. dD >= 0
   * since psi <= phi. Points are answered one by one.
   */
  class MohrCoulomb : public HenckyPlasticity<MohrCoulomb>
  {
  public:
    static constexpr bool decoupled_volume   = false;
    static constexpr bool takes_packs        = false;
    static constexpr bool stiffness_of_place = true;

    static constexpr std::array<Column, 4> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_volume_strain", "-", "positive where the pores open"},
       {"cohesion", "Pa", "c of the place", ColumnKind::of_place},
       {"stiffness", "-", "factor of both moduli, of the place", ColumnKind::of_place}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |dev d eps^p| [-]
      Number plastic_volume_strain     = 0.; ///< positive where the pores open [-]
      Number cohesion                  = 0.; ///< c [Pa]
      Number stiffness                 = 1.; ///< of both moduli [-]
    };

    static std::array<const SpatialConstant *, 4>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.cohesion, &parameters.stiffness_factor}};
    }

    explicit MohrCoulomb(const MaterialParameters &parameters)
      : HenckyPlasticity(parameters)
      , sin_friction(std::sin(parameters.friction_angle * radians_per_degree))
      , cos_friction(std::cos(parameters.friction_angle * radians_per_degree))
      , sin_dilation(std::sin(parameters.dilation_angle * radians_per_degree))
      , cut_off(parameters.tension_cut_off)
    {}

    template <typename Number>
    void
    return_stress(const Number (&trial)[3],
                  const History<Number> &history,
                  Response<Number>      &response) const
    {
      Return<Number> at;
      at.order = falling_order(trial);
      for (int i = 0; i < 3; ++i)
        at.trial[i] = trial[at.order[i]];
      const Number excess = 2. * history.cohesion * cos_friction;
      const Number apex   = history.cohesion * cos_friction / sin_friction;
      for (int plane = 0; plane < n_planes; ++plane)
        at.bound[plane] = plane < 3 ? excess : Number(cut_off * apex);
      at.scale = 0.;
      for (const Number &value : at.trial)
        at.scale += value < 0. ? Number(-value) : value;

      if (is_admissible(at.trial, at, 0.))
        return;
      for (const auto &planes : active_sets)
        if (try_planes(planes, at))
          {
            set_return(planes, at, response);
            return;
          }
      // all that is left is pulled to the corner of the cut-off
      at.plastic[0] = at.plastic[1] = at.plastic[2] = 0.;
      response.valid = at.trial[0] + at.trial[1] + at.trial[2] >= 3. * cut_off * apex;
      if (response.valid)
        {
          const Number mean = (at.trial[0] + at.trial[1] + at.trial[2]) / 3.;
          for (int i = 0; i < 3; ++i)
            {
              response.plastic_strain[at.order[i]] =
                (at.trial[i] - mean) / (2. * elastic.shear_modulus) +
                (mean - cut_off * apex) / (3. * bulk_modulus);
              for (int j = 0; j < 3; ++j)
                response.tangent[i][j] = 0.;
            }
        }
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + equivalent_increment(response),
              history.plastic_volume_strain + response.plastic_strain[0] +
                response.plastic_strain[1] + response.plastic_strain[2],
              history.cohesion,
              history.stiffness};
    }

    const double sin_friction, cos_friction, sin_dilation;
    const double cut_off; ///< t, of the apex c cot phi, in [0, 1] [-]

  private:
    /** f_13, f_12, f_23, and the cut-off of tau_1, tau_2, tau_3. */
    static constexpr int n_planes = 6;
    using Planes                  = std::array<int, 3>; ///< -1: none

    static constexpr std::array<Planes, 19> active_sets{{{{0, -1, -1}},
                                                         {{0, 1, -1}},
                                                         {{0, 2, -1}},
                                                         {{3, -1, -1}},
                                                         {{0, 3, -1}},
                                                         {{3, 4, -1}},
                                                         {{3, 4, 5}},
                                                         {{0, 1, 3}},
                                                         {{0, 2, 3}},
                                                         {{0, 3, 4}},
                                                         {{0, 2, 4}},
                                                         {{0, 1, 2}},
                                                         {{1, 3, -1}},
                                                         {{1, 3, 4}},
                                                         {{2, 3, 4}},
                                                         {{0, 4, 5}},
                                                         {{0, 3, 5}},
                                                         {{1, 3, 5}},
                                                         {{2, 4, 5}}}};

    template <typename Number>
    struct Return
    {
      std::array<int, 3> order; ///< where the principal stresses stand, the largest first
      Number             trial[3], stress[3], plastic[3];
      Number             bound[n_planes]; ///< c'
      Number             scale;           ///< of the stresses [Pa]
      Number             inverse[3][3];   ///< (A D_e N)^{-1}
    };

    /** Gradient of a plane's function, or of its potential, by tau_1, tau_2, tau_3. */
    static void
    gradient(const int plane, const double sine, double (&a)[3])
    {
      constexpr int plus[3] = {0, 0, 1}, minus[3] = {2, 1, 2};
      for (double &value : a)
        value = 0.;
      if (plane >= 3)
        {
          a[plane - 3] = 1.;
          return;
        }
      a[plus[plane]]  = 1. + sine;
      a[minus[plane]] = -(1. - sine);
    }

    /** D_e a, ordered as a. */
    template <typename Number>
    void
    times_elasticity(const double (&a)[3], Number (&result)[3]) const
    {
      const Number trace = a[0] + a[1] + a[2];
      for (int i = 0; i < 3; ++i)
        result[i] = elastic.lame_modulus * trace + 2. * elastic.shear_modulus * a[i];
    }

    template <typename Number>
    bool
    is_admissible(const Number (&stress)[3], const Return<Number> &at, const double tolerance) const
    {
      for (int plane = 0; plane < n_planes; ++plane)
        {
          double a[3];
          gradient(plane, sin_friction, a);
          Number f = -at.bound[plane];
          for (int i = 0; i < 3; ++i)
            f += a[i] * stress[i];
          if (f > tolerance * at.scale)
            return false;
        }
      return stress[0] >= stress[1] - tolerance * at.scale &&
             stress[1] >= stress[2] - tolerance * at.scale;
    }

    /** The return to the planes' intersection; whether it is the one. */
    template <typename Number>
    bool
    try_planes(const Planes &planes, Return<Number> &at) const
    {
      // of stresses and, over the modulus, of multipliers
      const double tolerance = 500. * static_cast<double>(std::numeric_limits<Number>::epsilon());
      const int    n         = planes[1] < 0 ? 1 : planes[2] < 0 ? 2 : 3;
      double       a[3][3], flow[3][3];
      Number       image[3][3], matrix[3][3];
      for (int p = 0; p < n; ++p)
        {
          gradient(planes[p], sin_friction, a[p]);
          gradient(planes[p], sin_dilation, flow[p]);
          times_elasticity(flow[p], image[p]);
        }
      for (int p = 0; p < n; ++p)
        for (int q = 0; q < n; ++q)
          {
            matrix[p][q] = 0.;
            for (int i = 0; i < 3; ++i)
              matrix[p][q] += a[p][i] * image[q][i];
          }
      if (!invert(matrix, n, at.inverse))
        return false;
      for (int i = 0; i < 3; ++i)
        {
          at.stress[i]  = at.trial[i];
          at.plastic[i] = 0.;
        }
      for (int p = 0; p < n; ++p)
        {
          Number m = 0.;
          for (int q = 0; q < n; ++q)
            {
              Number f = -at.bound[planes[q]];
              for (int i = 0; i < 3; ++i)
                f += a[q][i] * at.trial[i];
              m += at.inverse[p][q] * f;
            }
          if (m * elastic.shear_modulus < -tolerance * at.scale)
            return false;
          for (int i = 0; i < 3; ++i)
            {
              at.plastic[i] += flow[p][i] * m;
              at.stress[i] -= image[p][i] * m;
            }
        }
      return is_admissible(at.stress, at, tolerance);
    }

    /** Inverse of an n x n matrix by Gauss and Jordan; false if it is singular. */
    template <typename Number>
    static bool
    invert(const Number (&matrix)[3][3], const int n, Number (&inverse)[3][3])
    {
      constexpr double smallest_pivot = 1e-10;
      Number           work[3][3];
      double           size = 0.;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          {
            work[i][j]    = matrix[i][j];
            inverse[i][j] = i == j ? 1. : 0.;
            size          = std::max(size, std::abs(static_cast<double>(matrix[i][j])));
          }
      for (int k = 0; k < n; ++k)
        {
          int pivot = k;
          for (int i = k + 1; i < n; ++i)
            if (work[i][k] * work[i][k] > work[pivot][k] * work[pivot][k])
              pivot = i;
          if (!(work[pivot][k] * work[pivot][k] > smallest_pivot * size * smallest_pivot * size))
            return false;
          std::swap(work[k], work[pivot]);
          std::swap(inverse[k], inverse[pivot]);
          const Number divisor = work[k][k];
          for (int j = 0; j < n; ++j)
            {
              work[k][j] /= divisor;
              inverse[k][j] /= divisor;
            }
          for (int i = 0; i < n; ++i)
            if (i != k)
              {
                const Number multiple = work[i][k];
                for (int j = 0; j < n; ++j)
                  {
                    work[i][j] -= multiple * work[k][j];
                    inverse[i][j] -= multiple * inverse[k][j];
                  }
              }
        }
      return true;
    }

    template <typename Number>
    void
    set_return(const Planes &planes, const Return<Number> &at, Response<Number> &response) const
    {
      const int n = planes[1] < 0 ? 1 : planes[2] < 0 ? 2 : 3;
      Number    rows[3][3], images[3][3];
      for (int p = 0; p < n; ++p)
        {
          double a[3];
          gradient(planes[p], sin_friction, a);
          times_elasticity(a, rows[p]);
          gradient(planes[p], sin_dilation, a);
          times_elasticity(a, images[p]);
        }
      for (int i = 0; i < 3; ++i)
        {
          response.plastic_strain[at.order[i]] = at.plastic[i];
          for (int j = 0; j < 3; ++j)
            for (int p = 0; p < n; ++p)
              for (int q = 0; q < n; ++q)
                response.tangent[at.order[i]][at.order[j]] -=
                  images[p][i] * at.inverse[p][q] * rows[q][j];
        }
    }
  };
} // namespace kedge

#endif
