#include <kedge/contact/ray_contact.h>

#include <deal.II/base/tensor.h>

namespace kedge
{
  namespace
  {
    template <int dim, typename Number>
    Number
    product(const NumberVector<dim, Number> &a, const NumberVector<dim, Number> &b)
    {
      Number sum = a[0] * b[0];
      for (int d = 1; d < dim; ++d)
        sum = sum + a[d] * b[d];
      return sum;
    }

    /** a + s b */
    template <int dim, typename Number>
    NumberVector<dim, Number>
    sum(const NumberVector<dim, Number> &a, const Number &s, const NumberVector<dim, Number> &b)
    {
      NumberVector<dim, Number> result;
      for (int d = 0; d < dim; ++d)
        result[d] = a[d] + s * b[d];
      return result;
    }

    /** Where a part of the displacements brings a face's corners, weighted. */
    template <int dim, typename Number, typename Weights>
    NumberVector<dim, Number>
    interpolated(const typename RayPlace<dim>::Corners         &corners,
                 const typename RayState<dim, Number>::Corners &displacements,
                 const Weights                                 &weights,
                 const double                                   of_place,
                 const double                                   of_displacement)
    {
      NumberVector<dim, Number> result;
      for (int d = 0; d < dim; ++d)
        {
          result[d] = Number(0.);
          for (unsigned int a = 0; a < n_face_corners<dim>; ++a)
            result[d] =
              result[d] + Number(weights[a]) * (Number(of_place * corners[a][d]) +
                                                Number(of_displacement) * displacements[a][d]);
        }
      return result;
    }

    /** Unit normal of the first face after a part of the step. */
    template <int dim, typename Number>
    NumberVector<dim, Number>
    normal_of(const RayPlace<dim> &place, const RayState<dim, Number> &state, const double part)
    {
      std::array<NumberVector<dim, Number>, dim - 1> along;
      for (int k = 0; k < dim - 1; ++k)
        along[k] = interpolated<dim, Number>(place.first, state.first, place.slope[k], 1., part);
      NumberVector<dim, Number> normal;
      if constexpr (dim == 2)
        normal = {{along[0][1], Number(0.) - along[0][0]}};
      else
        for (int d = 0; d < 3; ++d)
          normal[d] = along[0][(d + 1) % 3] * along[1][(d + 2) % 3] -
                      along[0][(d + 2) % 3] * along[1][(d + 1) % 3];
      using std::sqrt; // not that of packs
      const Number size = sqrt(product<dim, Number>(normal, normal));
      for (int d = 0; d < dim; ++d)
        normal[d] = Number(place.outward) * normal[d] / size;
      return normal;
    }

    /** Functions of a face's corners at coordinates from 0 to 1, or their slopes with one. */
    template <int dim, typename Number>
    std::array<Number, n_face_corners<dim>>
    face_functions(const std::array<Number, dim - 1> &at, const int slope_with = -1)
    {
      std::array<Number, n_face_corners<dim>> result;
      for (unsigned int a = 0; a < n_face_corners<dim>; ++a)
        {
          result[a] = Number(1.);
          for (int k = 0; k < dim - 1; ++k)
            {
              const bool upper = (a >> k) & 1u;
              if (k == slope_with)
                result[a] = result[a] * Number(upper ? 1. : -1.);
              else
                result[a] = result[a] * (upper ? at[k] : Number(1.) - at[k]);
            }
        }
      return result;
    }

    /** What a ray meets: coordinates on the second face, and the way. */
    template <int dim, typename Number>
    struct Hit
    {
      std::array<Number, dim - 1> at;
      Number                      gap;
    };

    /** y(at) - x - g n */
    template <int dim, typename Number>
    NumberVector<dim, Number>
    miss(const RayPlace<dim>             &place,
         const RayState<dim, Number>     &state,
         const double                     part,
         const Hit<dim, Number>          &hit,
         const NumberVector<dim, Number> &x,
         const NumberVector<dim, Number> &n)
    {
      const auto y = interpolated<dim, Number>(place.second,
                                               state.second,
                                               face_functions<dim, Number>(hit.at),
                                               1.,
                                               part);
      return sum<dim, Number>(sum<dim, Number>(y, Number(-1.), x), Number(0.) - hit.gap, n);
    }

    template <int dim, typename Number>
    NumberVector<dim, double>
    values(const NumberVector<dim, Number> &a)
    {
      NumberVector<dim, double> result;
      for (int d = 0; d < dim; ++d)
        result[d] = value_of(a[d]);
      return result;
    }

    template <int dim, typename Number>
    RayState<dim, double>
    values(const RayState<dim, Number> &state)
    {
      RayState<dim, double> result;
      for (unsigned int a = 0; a < n_face_corners<dim>; ++a)
        {
          result.first[a]  = values<dim, Number>(state.first[a]);
          result.second[a] = values<dim, Number>(state.second[a]);
        }
      return result;
    }

    /** Inverse of d miss / d (at, gap). */
    template <int dim>
    dealii::Tensor<2, dim>
    inverse_slope(const RayPlace<dim>             &place,
                  const RayState<dim, double>     &state,
                  const double                     part,
                  const Hit<dim, double>          &hit,
                  const NumberVector<dim, double> &n)
    {
      dealii::Tensor<2, dim> slope;
      for (int k = 0; k < dim - 1; ++k)
        {
          const auto along = interpolated<dim, double>(place.second,
                                                       state.second,
                                                       face_functions<dim, double>(hit.at, k),
                                                       1.,
                                                       part);
          for (int d = 0; d < dim; ++d)
            slope[d][k] = along[d];
        }
      for (int d = 0; d < dim; ++d)
        slope[d][dim - 1] = -n[d];
      return invert(slope);
    }

    template <int dim, typename Number>
    void
    correct(Hit<dim, Number>                &hit,
            const dealii::Tensor<2, dim>    &inverse,
            const NumberVector<dim, Number> &missed)
    {
      for (int i = 0; i < dim; ++i)
        {
          Number change(0.);
          for (int d = 0; d < dim; ++d)
            change = change + Number(inverse[i][d]) * missed[d];
          Number &target = i < dim - 1 ? hit.at[i] : hit.gap;
          target         = target - change;
        }
    }

    /** By Newton's method in plain numbers, whose last step is taken with slopes: they are exact,
     * for the matrix is. */
    template <int dim, typename Number>
    Hit<dim, Number>
    trace(const RayPlace<dim>             &place,
          const RayState<dim, Number>     &state,
          const double                     part,
          const NumberVector<dim, Number> &x,
          const NumberVector<dim, Number> &n)
    {
      constexpr unsigned int n_steps = 6;
      const auto             plain   = values<dim, Number>(state);
      const auto             x_plain = values<dim, Number>(x), n_plain = values<dim, Number>(n);
      Hit<dim, double>       hit;
      hit.at.fill(0.5);
      hit.gap = 0.;
      for (unsigned int k = 0; k < n_steps; ++k)
        correct<dim, double>(hit,
                             inverse_slope<dim>(place, plain, part, hit, n_plain),
                             miss<dim, double>(place, plain, part, hit, x_plain, n_plain));
      Hit<dim, Number> result;
      for (int k = 0; k < dim - 1; ++k)
        result.at[k] = Number(hit.at[k]);
      result.gap = Number(hit.gap);
      correct<dim, Number>(result,
                           inverse_slope<dim>(place, plain, part, hit, n_plain),
                           miss<dim, Number>(place, state, part, result, x, n));
      return result;
    }

    /** P: a trial traction along the surface, not larger than mu p. */
    template <int dim, typename Number>
    NumberVector<dim, Number>
    limited(NumberVector<dim, Number> trial, const Number &limit)
    {
      const Number square = product<dim, Number>(trial, trial);
      if (value_of(square) <= value_of(limit) * value_of(limit))
        return trial;
      using std::sqrt; // not that of packs
      const Number scale = limit / sqrt(square);
      for (Number &component : trial)
        component = component * scale;
      return trial;
    }
  } // namespace



  template <int dim, typename Number>
  RayResponse<dim, Number>
  ray_contact(const RayLaw &law, const RayPlace<dim> &place, const RayState<dim, Number> &state)
  {
    const auto x = interpolated<dim, Number>(place.first, state.first, place.value, 1., law.alpha);
    const auto n = normal_of<dim, Number>(place, state, law.alpha);
    Hit<dim, Number> hit = trace<dim, Number>(place, state, law.alpha, x, n);

    RayResponse<dim, Number> result;
    result.normal   = n;
    result.partner  = face_functions<dim, Number>(hit.at);
    result.gap      = hit.gap + Number(place.overlap);
    const auto u_x  = interpolated<dim, Number>(place.first, state.first, place.value, 0., 1.);
    const auto u_y  = interpolated<dim, Number>(place.second, state.second, result.partner, 0., 1.);
    const auto turn = sum<dim, Number>(normal_of<dim, Number>(place, state, 1.),
                                       Number(-1.),
                                       normal_of<dim, Number>(place, state, 0.));
    result.slip     = sum<dim, Number>(sum<dim, Number>(u_x, Number(-1.), u_y), result.gap, turn);
    const auto lambda =
      interpolated<dim, Number>(place.first, state.multiplier, place.value, 0., 1.);

    const Number r(law.stiffness);
    const Number pressure = Number(0.) - product<dim, Number>(lambda, n) - r * result.gap;
    result.force.fill(Number(0.));
    result.closed = value_of(pressure) >= 0.;
    if (result.closed)
      {
        if (law.friction > 0.)
          {
            const auto   trial = sum<dim, Number>(lambda, Number(0.) - r, result.slip);
            const Number along = product<dim, Number>(trial, n);
            result.force = limited<dim, Number>(sum<dim, Number>(trial, Number(0.) - along, n),
                                                Number(law.friction) * pressure);
          }
        result.force = sum<dim, Number>(result.force, Number(0.) - pressure, n);
      }
    result.constraint = sum<dim, Number>(lambda, Number(-1.), result.force);
    return result;
  }

#define KEDGE_INSTANTIATE(dim, Number)                                 \
  template RayResponse<dim, Number> ray_contact(const RayLaw &,        \
                                                const RayPlace<dim> &, \
                                                const RayState<dim, Number> &);
  KEDGE_INSTANTIATE(2, double)
  KEDGE_INSTANTIATE(3, double)
  KEDGE_INSTANTIATE(2, SlopedNumber<12>)
  KEDGE_INSTANTIATE(3, SlopedNumber<36>)
#undef KEDGE_INSTANTIATE
} // namespace kedge
