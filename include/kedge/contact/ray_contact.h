#ifndef kedge_contact_ray_contact_h
#define kedge_contact_ray_contact_h

#include <kedge/contact/sloped_number.h>

#include <deal.II/base/point.h>

namespace kedge
{
  /** The augmented Lagrangian on a surface (5.60)-(5.66). */
  struct RayLaw
  {
    double stiffness = 0.;  ///< r, of the gap and of the slip over the step [Pa/m]
    double friction  = 0.;  ///< mu [-]
    double alpha     = 0.5; ///< part of the step at which the balance stands
  };

  /** Corners of a face of a cell, the last direction running fastest. */
  template <int dim>
  constexpr unsigned int n_face_corners = 1u << (dim - 1);

  template <int dim, typename Number>
  using NumberVector = std::array<Number, dim>;

  /** A face of a cell of each body, and where on the first one contact is asked for. */
  template <int dim>
  struct RayPlace
  {
    using Corners = std::array<dealii::Point<dim>, n_face_corners<dim>>;

    Corners                                 first, second; ///< at the start of the step
    double                                  outward = 1.;  ///< sign that turns the normal outward
    std::array<double, n_face_corners<dim>> value;         ///< of the corners' functions
    /** Their derivatives along the face. */
    std::array<std::array<double, n_face_corners<dim>>, dim - 1> slope;
    double                                                       overlap = 0.; ///< at the start [m]
  };

  /** Displacements of the corners over the step, and multipliers. */
  template <int dim, typename Number>
  struct RayState
  {
    using Corners = std::array<NumberVector<dim, Number>, n_face_corners<dim>>;

    Corners first, second; ///< [m]
    Corners multiplier;    ///< [Pa]
  };

  template <int dim, typename Number>
  struct RayResponse
  {
    Number                                  gap;
    NumberVector<dim, Number>               force;      ///< on the first body [Pa]
    NumberVector<dim, Number>               constraint; ///< C, 0 if the multipliers hold [Pa]
    std::array<Number, n_face_corners<dim>> partner;    ///< functions of the second face's corners
    NumberVector<dim, Number>               slip;       ///< of the first body on the second [m]
    NumberVector<dim, Number>               normal;
    bool                                    closed = false;
  };

  /**
   * Contact of a point x of a face with what a ray along its normal n meets on another one, y = x
   * + g n (5.83), in the configuration of the balance. With the multiplier lambda there,
   *   p = [lambda.n + r (g - g_0)]_-,  t = T (lambda - r D),  F = -p n + P(t),  C = lambda - F,
   * where D = N u_X - N(y) u_Y + g (n_1 - n_0) is the slip (5.64) over the step. Faces are mesh
   * faces and stand for surfaces somewhere in their cells: two that overlap at the start of a step,
   * g_0 < 0, touch. With SlopedNumber all derivatives follow, those of normal and ray too.
   */
  template <int dim, typename Number>
  RayResponse<dim, Number>
  ray_contact(const RayLaw &law, const RayPlace<dim> &place, const RayState<dim, Number> &state);
} // namespace kedge

#endif
