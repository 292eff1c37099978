#include <kedge/contact/nodal_law.h>

#include <deal.II/base/exceptions.h>

#include <array>
#include <cmath>

namespace kedge
{
  double
  nonlinear_penalty(const NodalLaw &law, const double gap, double &slope)
  {
    const double c0 = law.begin, c1 = law.first_bend, c2 = law.last_bend;
    const double begin = law.stiffness, end = law.final_stiffness, rise = end - begin;
    slope = 0.;
    if (gap > c0)
      return 0.;
    if (gap > c1)
      {
        slope = begin;
        return begin * (gap - c0);
      }
    if (gap <= c2)
      {
        slope = end;
        return -begin * c0 - 0.5 * rise * (c1 + c2) + end * gap;
      }
    const double cube = (c2 - c1) * (c2 - c1) * (c2 - c1);
    const double a0   = -begin * c0 + 0.5 * rise * c1 * c1 * c1 * (c1 - 2. * c2) / cube;
    const double a1   = (c2 * c2 * (c2 - 3. * c1) * begin + c1 * c1 * (3. * c2 - c1) * end) / cube;
    const double a2 = -3. * c1 * c2 * rise / cube, a3 = rise * (c1 + c2) / cube;
    const double a4 = -0.5 * rise / cube;
    slope           = a1 + gap * (2. * a2 + gap * (3. * a3 + gap * 4. * a4));
    return a0 + gap * (a1 + gap * (a2 + gap * (a3 + gap * a4)));
  }

  namespace
  {
    /** The pressure at a node [N] and what it depends on. */
    struct NodalPressure
    {
      double value = 0., by_multiplier = 0., by_gap = 0.;
      bool   closed = false;
    };

    NodalPressure
    linear_pressure(const NodalLaw &law, const double multiplier, const double gap)
    {
      const double sum = multiplier + law.stiffness * gap;
      return sum <= 0. ? NodalPressure{-sum, -1., -law.stiffness, true} : NodalPressure();
    }

    NodalPressure
    nonlinear_pressure(const NodalLaw &law, const double, const double gap)
    {
      double       slope = 0.;
      const double p     = nonlinear_penalty(law, gap, slope);
      return gap <= law.begin ? NodalPressure{-p, 0., -slope, true} : NodalPressure();
    }

    NodalPressure
    pressure_of_multiplier(const NodalLaw &, const double multiplier, const double)
    {
      return multiplier <= 0. ? NodalPressure{-multiplier, -1., 0., true} : NodalPressure();
    }

    /** Coulomb's projection of a trial force along the surface, and its slopes. */
    template <int dim>
    void
    add_friction(const NodalLaw               &law,
                 const unsigned int            n_directions,
                 const NodalPressure          &pressure,
                 const dealii::Tensor<1, dim> &trial,
                 const double                  stiffness,
                 const NodalHold               hold,
                 NodalResponse<dim>           &response)
    {
      double square = 0.;
      for (unsigned int i = 1; i < n_directions; ++i)
        square += trial[i] * trial[i];
      const double size = std::sqrt(square), bound = law.friction * pressure.value;
      response.slides    = size > bound && hold != NodalHold::sticks;
      const double scale = response.slides ? bound / size : 1.;
      for (unsigned int i = 1; i < n_directions; ++i)
        {
          response.force[i] = scale * trial[i];
          for (unsigned int j = 1; j < n_directions; ++j)
            {
              double slope = i == j ? scale : 0.;
              if (response.slides)
                slope -= scale * trial[i] * trial[j] / square;
              response.force_by_multiplier[i][j]   = slope;
              response.force_by_displacement[i][j] = -stiffness * slope;
            }
          if (!response.slides)
            continue;
          const double by_pressure             = law.friction * trial[i] / size;
          response.force_by_multiplier[i][0]   = by_pressure * pressure.by_multiplier;
          response.force_by_displacement[i][0] = -law.alpha * by_pressure * pressure.by_gap;
        }
    }

    /** F of a law, with the pressure of its kind; augmented ones add r D to the multiplier. */
    template <int dim, typename Pressure>
    NodalResponse<dim>
    force_of_law(const NodalLaw               &law,
                 const unsigned int            n_directions,
                 const dealii::Tensor<1, dim> &multiplier,
                 const dealii::Tensor<1, dim> &displacement,
                 const NodalHold               hold,
                 const bool                    augmented,
                 const Pressure               &pressure_of)
    {
      NodalResponse<dim>  response;
      const NodalPressure pressure =
        hold == NodalHold::open ? NodalPressure()
                                : pressure_of(law, multiplier[0], -law.alpha * displacement[0]);
      response.closed                      = pressure.closed;
      response.force[0]                    = -pressure.value;
      response.force_by_multiplier[0][0]   = -pressure.by_multiplier;
      response.force_by_displacement[0][0] = law.alpha * pressure.by_gap;
      if (!pressure.closed)
        return response;
      const double stiffness = augmented ? law.stiffness : 0.;
      add_friction(law,
                   n_directions,
                   pressure,
                   multiplier - stiffness * displacement,
                   stiffness,
                   hold,
                   response);
      return response;
    }

    template <int dim>
    NodalResponse<dim>
    penalty(const NodalLaw               &law,
            const unsigned int            n_directions,
            const dealii::Tensor<1, dim> &multiplier,
            const dealii::Tensor<1, dim> &displacement,
            const NodalHold               hold)
    {
      return force_of_law(law, n_directions, multiplier, displacement, hold, true, linear_pressure);
    }

    template <int dim>
    NodalResponse<dim>
    stiffening_penalty(const NodalLaw               &law,
                       const unsigned int            n_directions,
                       const dealii::Tensor<1, dim> &multiplier,
                       const dealii::Tensor<1, dim> &displacement,
                       const NodalHold               hold)
    {
      return force_of_law(law,
                          n_directions,
                          multiplier,
                          displacement,
                          hold,
                          true,
                          nonlinear_pressure);
    }

    /** C = lambda - F (5.80). */
    template <int dim>
    void
    set_constraint(const unsigned int            n_directions,
                   const dealii::Tensor<1, dim> &multiplier,
                   NodalResponse<dim>           &response)
    {
      response.constraint_by_displacement = -response.force_by_displacement;
      response.constraint_by_multiplier   = -response.force_by_multiplier;
      for (unsigned int i = 0; i < n_directions; ++i)
        {
          response.constraint[i] = multiplier[i] - response.force[i];
          response.constraint_by_multiplier[i][i] += 1.;
        }
    }

    template <int dim>
    NodalResponse<dim>
    augmented_lagrangian(const NodalLaw               &law,
                         const unsigned int            n_directions,
                         const dealii::Tensor<1, dim> &multiplier,
                         const dealii::Tensor<1, dim> &displacement,
                         const NodalHold               hold)
    {
      NodalResponse<dim> response =
        force_of_law(law, n_directions, multiplier, displacement, hold, true, linear_pressure);
      set_constraint(n_directions, multiplier, response);
      return response;
    }

    /** r D_t of multipliers that stick, of those that slide its part across them, and its slopes.
     */
    template <int dim>
    void
    add_slip(const NodalLaw               &law,
             const unsigned int            n_directions,
             const dealii::Tensor<1, dim> &multiplier,
             const dealii::Tensor<1, dim> &displacement,
             NodalResponse<dim>           &response)
    {
      std::array<double, dim> m{}, slip{};
      double                  square = 0., along = 0.;
      for (unsigned int i = 1; i < n_directions; ++i)
        square += multiplier[i] * multiplier[i];
      const double size = std::sqrt(square);
      for (unsigned int i = 1; i < n_directions; ++i)
        {
          m[i]    = response.slides ? multiplier[i] / size : 0.;
          slip[i] = displacement[i];
          along += m[i] * slip[i];
        }
      for (unsigned int i = 1; i < n_directions; ++i)
        {
          response.constraint[i] += law.stiffness * (slip[i] - along * m[i]);
          for (unsigned int j = 1; j < n_directions; ++j)
            {
              const double across = (i == j ? 1. : 0.) - m[i] * m[j];
              response.constraint_by_displacement[i][j] += law.stiffness * across;
              if (response.slides)
                response.constraint_by_multiplier[i][j] -=
                  law.stiffness / size * (across * along + m[i] * (slip[j] - along * m[j]));
            }
        }
    }

    template <int dim>
    NodalResponse<dim>
    multipliers(const NodalLaw               &law,
                const unsigned int            n_directions,
                const dealii::Tensor<1, dim> &multiplier,
                const dealii::Tensor<1, dim> &displacement,
                const NodalHold               hold)
    {
      // what has begun to slide has |lambda_t| = mu p to round-off, and goes on sliding
      NodalLaw with_bound = law;
      with_bound.friction *= 1. - 1e-10;
      NodalResponse<dim> response = force_of_law(with_bound,
                                                 n_directions,
                                                 multiplier,
                                                 displacement,
                                                 hold,
                                                 false,
                                                 pressure_of_multiplier);
      set_constraint(n_directions, multiplier, response);
      if (!response.closed)
        return response;
      response.constraint[0] += law.stiffness * law.alpha * displacement[0];
      response.constraint_by_displacement[0][0] += law.stiffness * law.alpha;
      add_slip(law, n_directions, multiplier, displacement, response);
      return response;
    }
  } // namespace



  template <int dim>
  NodalFunction<dim>
  nodal_function(const ContactMethod method)
  {
    switch (method)
      {
        case ContactMethod::augmented_lagrangian:
          return &augmented_lagrangian<dim>;
        case ContactMethod::lagrange_multipliers:
          return &multipliers<dim>;
        case ContactMethod::penalty:
          return &penalty<dim>;
        case ContactMethod::nonlinear_penalty:
          return &stiffening_penalty<dim>;
        default:
          Assert(false, dealii::ExcInternalError());
          return nullptr;
      }
  }

  template NodalFunction<2>
  nodal_function(const ContactMethod);
  template NodalFunction<3>
  nodal_function(const ContactMethod);
} // namespace kedge
