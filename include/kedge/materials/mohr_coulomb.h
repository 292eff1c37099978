#ifndef kedge_materials_mohr_coulomb_h
#define kedge_materials_mohr_coulomb_h

#include <kedge/materials/closing_of_cracks.h>
#include <kedge/materials/friction.h>
#include <kedge/materials/hencky_plasticity.h>
#include <kedge/materials/lane.h>
#include <kedge/materials/principal_order.h>

#include <algorithm>
#include <limits>
#include <type_traits>

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
   * are positive, the stresses in their order and no plane is crossed. The matrices
   * are the same for all points and made once. What the cut-off has torn open bears pressure again
   * when it has closed (ClosingOfCracks). dD >= 0 since psi <= phi.
   */
  class MohrCoulomb : public HenckyPlasticity<MohrCoulomb>
  {
  public:
    static constexpr bool decoupled_volume   = false;
    static constexpr bool takes_packs        = true;
    static constexpr bool stiffness_of_place = true;

    static constexpr std::array<Column, 5> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_volume_strain", "-", "positive where the pores open"},
       {"cohesion", "Pa", "c of the place", ColumnKind::of_place},
       {"stiffness", "-", "factor of both moduli, of the place", ColumnKind::of_place},
       {"opening", "-", "volume strain by which tension has torn it open"}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |dev d eps^p| [-]
      Number plastic_volume_strain     = 0.; ///< positive where the pores open [-]
      Number cohesion                  = 0.; ///< c [Pa]
      Number stiffness                 = 1.; ///< of both moduli [-]
      Number opening                   = 0.; ///< volume strain by tension, to be closed first [-]
    };

    static std::array<const SpatialConstant *, 5>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.cohesion, &parameters.stiffness_factor, nullptr}};
    }

    explicit MohrCoulomb(const MaterialParameters &parameters)
      : HenckyPlasticity(parameters)
      , sin_friction(std::sin(parameters.friction_angle * radians_per_degree))
      , cos_friction(std::cos(parameters.friction_angle * radians_per_degree))
      , sin_dilation(std::sin(parameters.dilation_angle * radians_per_degree))
      , cut_off(parameters.tension_cut_off)
      , active(all_active_planes<double>())
    {}

    template <typename Number>
    void
    return_stress(const Number (&trial)[3],
                  const History<Number> &history,
                  Response<Number>      &response) const
    {
      FallingOrder<Number>          order(trial);
      const ClosingOfCracks<Number> closing((trial[0] + trial[1] + trial[2]) / 3.,
                                            bulk_modulus,
                                            history.opening);
      for (Number &value : order.value)
        value += bulk_modulus * closing.change;
      const Bounds<Number> bounds(*this, order.value, history);
      // of stresses and, over the modulus, of multipliers
      const double tolerance =
        500. * static_cast<double>(std::numeric_limits<Lane<Number>>::epsilon());
      Condition<Number> open = crosses(order.value, bounds, 0.);
      if (!any(open || closing.change > 0.))
        return;
      Return<Number> at;
      for (const auto &planes : planes_of<Lane<Number>>())
        {
          if (!any(open))
            break;
          if (!planes.meet)
            continue;
          Number     change[3];
          const auto fits = open && returns_to(planes, order.value, bounds, tolerance, change);
          if (!any(fits))
            continue;
          for (int i = 0; i < 3; ++i)
            {
              at.plastic[i] = select(fits, change[i], at.plastic[i]);
              if (planes.tear)
                at.opening = select(fits, at.opening + change[i], at.opening);
              for (int j = 0; j < 3; ++j)
                at.softer[i][j] = select(fits, Number(planes.softer[i][j]), at.softer[i][j]);
            }
          open = open && !fits;
        }
      if (any(open))
        response.valid = pull_to_corner(open, order.value, bounds, at);
      response.opening = at.opening - closing.change;
      set_return(order, closing, at, response);
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + equivalent_increment(response),
              history.plastic_volume_strain + response.plastic_strain[0] +
                response.plastic_strain[1] + response.plastic_strain[2],
              history.cohesion,
              history.stiffness,
              history.opening + response.opening};
    }

    const double sin_friction, cos_friction, sin_dilation;
    const double cut_off; ///< t, of the apex c cot phi, in [0, 1] [-]

  private:
    /** f_13, f_12, f_23, and the cut-off of tau_1, tau_2, tau_3. */
    static constexpr int n_planes = 6, n_shear_planes = 3;
    using Planes = std::array<int, 3>; ///< -1: none

    static constexpr int                               n_active_sets = 19;
    static constexpr std::array<Planes, n_active_sets> active_sets{{{{0, -1, -1}},
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

    /** What the planes' functions must not exceed. */
    template <typename Number>
    struct Bounds
    {
      Bounds(const MohrCoulomb &law, const Number (&trial)[3], const History<Number> &history)
        : excess(2. * history.cohesion * law.cos_friction)
        , tension(law.cut_off * (history.cohesion * law.cos_friction / law.sin_friction))
        , scale(0.)
      {
        using std::abs;
        for (const Number &value : trial)
          scale += abs(value);
      }

      const Number &
      of(const int plane) const
      {
        return plane < n_shear_planes ? excess : tension;
      }

      Number excess;  ///< 2 c cos phi [Pa]
      Number tension; ///< T [Pa]
      Number scale;   ///< of the stresses [Pa]
    };

    /** The return to an intersection of planes, the same for all points. */
    template <typename Scalar>
    struct ActivePlanes
    {
      bool   meet = true; ///< whether there is one
      bool   tear;        ///< whether one of them is a cut-off
      int    n = 0;
      Planes planes;
      double slope[3][3];   ///< A
      double flow[3][3];    ///< N
      Scalar image[3][3];   ///< D_e N
      Scalar inverse[3][3]; ///< (A D_e N)^{-1}
      Scalar softer[3][3];  ///< D_e N (A D_e N)^{-1} A D_e
    };

    /** Gradient of a plane's function, or of its potential, by tau_1, tau_2, tau_3. */
    static void
    gradient(const int plane, const double sine, double (&a)[3])
    {
      constexpr int plus[3] = {0, 0, 1}, minus[3] = {2, 1, 2};
      for (double &value : a)
        value = 0.;
      if (plane >= n_shear_planes)
        {
          a[plane - n_shear_planes] = 1.;
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

    template <typename Scalar>
    ActivePlanes<Scalar>
    active_planes(const Planes &planes) const
    {
      ActivePlanes<Scalar> at;
      at.planes = planes;
      at.n      = planes[1] < 0 ? 1 : planes[2] < 0 ? 2 : 3;
      at.tear   = *std::max_element(planes.begin(), planes.end()) >= n_shear_planes;
      Scalar row[3][3], matrix[3][3];
      for (int p = 0; p < at.n; ++p)
        {
          gradient(planes[p], sin_friction, at.slope[p]);
          gradient(planes[p], sin_dilation, at.flow[p]);
          times_elasticity(at.slope[p], row[p]);
          times_elasticity(at.flow[p], at.image[p]);
        }
      for (int p = 0; p < at.n; ++p)
        for (int q = 0; q < at.n; ++q)
          {
            matrix[p][q] = 0.;
            for (int i = 0; i < 3; ++i)
              matrix[p][q] += at.slope[p][i] * at.image[q][i];
          }
      at.meet = invert(matrix, at.n, at.inverse);
      for (int i = 0; i < 3 && at.meet; ++i)
        for (int j = 0; j < 3; ++j)
          {
            at.softer[i][j] = 0.;
            for (int p = 0; p < at.n; ++p)
              for (int q = 0; q < at.n; ++q)
                at.softer[i][j] += at.image[p][i] * at.inverse[p][q] * row[q][j];
          }
      return at;
    }

    template <typename Scalar>
    std::array<ActivePlanes<Scalar>, n_active_sets>
    all_active_planes() const
    {
      std::array<ActivePlanes<Scalar>, n_active_sets> result;
      for (int set = 0; set < n_active_sets; ++set)
        result[set] = active_planes<Scalar>(active_sets[set]);
      return result;
    }

    /** Those that are kept, or of other numbers, such as those of more digits, made now. */
    template <typename Scalar>
    decltype(auto)
    planes_of() const
    {
      if constexpr (std::is_same_v<Scalar, double>)
        return (active);
      else
        return all_active_planes<Scalar>();
    }

    /** Whether stresses lie beyond a plane or out of their order. */
    template <typename Number>
    Condition<Number>
    crosses(const Number (&stress)[3], const Bounds<Number> &bounds, const double tolerance) const
    {
      const Number      margin = tolerance * bounds.scale;
      Condition<Number> result =
        !(stress[0] >= stress[1] - margin) || !(stress[1] >= stress[2] - margin);
      for (int plane = 0; plane < n_planes; ++plane)
        {
          double a[3];
          gradient(plane, sin_friction, a);
          Number f = -bounds.of(plane);
          for (int i = 0; i < 3; ++i)
            f += a[i] * stress[i];
          result = result || f > margin;
        }
      return result;
    }

    /** The @p plastic strain of the return to the planes; whether it is the one. */
    template <typename Number, typename Scalar>
    Condition<Number>
    returns_to(const ActivePlanes<Scalar> &at,
               const Number (&trial)[3],
               const Bounds<Number> &bounds,
               const double          tolerance,
               Number (&plastic)[3]) const
    {
      Number excess[3], stress[3];
      for (int i = 0; i < 3; ++i)
        {
          stress[i]  = trial[i];
          plastic[i] = 0.;
        }
      for (int q = 0; q < at.n; ++q)
        {
          excess[q] = -bounds.of(at.planes[q]);
          for (int i = 0; i < 3; ++i)
            excess[q] += at.slope[q][i] * trial[i];
        }
      Condition<Number> backwards = bounds.scale < 0.;
      for (int p = 0; p < at.n; ++p)
        {
          Number m = 0.;
          for (int q = 0; q < at.n; ++q)
            m += at.inverse[p][q] * excess[q];
          backwards = backwards || m * elastic.shear_modulus < -tolerance * bounds.scale;
          for (int i = 0; i < 3; ++i)
            {
              plastic[i] += at.flow[p][i] * m;
              stress[i] -= at.image[p][i] * m;
            }
        }
      return !backwards && !crosses(stress, bounds, tolerance);
    }

    /** What a return changes, by the ranks of the stresses. */
    template <typename Number>
    struct Return
    {
      Number plastic[3]   = {0., 0., 0.}; ///< strains
      Number softer[3][3] = {};           ///< what the tangent loses [Pa]
      Number opening      = 0.;           ///< the part of the cut-off's volume strain
    };

    /** What no planes return is pulled to the corner of the cut-off; where that is possible. */
    template <typename Number>
    Condition<Number>
    pull_to_corner(const Condition<Number> &open,
                   const Number (&trial)[3],
                   const Bounds<Number> &bounds,
                   Return<Number>       &at) const
    {
      const Number mean   = (trial[0] + trial[1] + trial[2]) / 3.;
      const Number volume = (mean - bounds.tension) / bulk_modulus;
      for (int i = 0; i < 3; ++i)
        {
          const Number shear = (trial[i] - mean) / (2. * elastic.shear_modulus);
          at.plastic[i]      = select(open, shear + volume / 3., at.plastic[i]);
          for (int j = 0; j < 3; ++j)
            at.softer[i][j] = select(open, Number(elasticity(i, j)), at.softer[i][j]);
        }
      at.opening = select(open, volume, at.opening);
      return !open || mean >= bounds.tension;
    }

    double
    elasticity(const int i, const int j) const
    {
      return elastic.lame_modulus + (i == j ? 2. * elastic.shear_modulus : 0.);
    }

    /** While cracks close, changes of volume bring no stress. */
    template <typename Number>
    void
    set_return(const FallingOrder<Number>    &order,
               const ClosingOfCracks<Number> &closing,
               Return<Number>                &at,
               Response<Number>              &response) const
    {
      for (int i = 0; i < 3; ++i)
        {
          Number by_volume = 0.;
          for (int j = 0; j < 3; ++j)
            by_volume += (elasticity(i, j) - at.softer[i][j]) / 3.;
          for (int j = 0; j < 3; ++j)
            at.softer[i][j] += (1. - closing.slope) * by_volume;
          at.plastic[i] -= closing.change / 3.;
        }
      order.restore(at.plastic);
      order.restore(at.softer);
      for (int i = 0; i < 3; ++i)
        {
          response.plastic_strain[i] = at.plastic[i];
          for (int j = 0; j < 3; ++j)
            response.tangent[i][j] -= at.softer[i][j];
        }
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

    const std::array<ActivePlanes<double>, n_active_sets> active;
  };
} // namespace kedge

#endif
