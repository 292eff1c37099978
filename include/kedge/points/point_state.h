#ifndef kedge_points_point_state_h
#define kedge_points_point_state_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/particles/property_pool.h>

#include <cstdint>
#include <type_traits>

namespace kedge
{
  /** Columns of PointState::memory: of all laws there are, each name once. */
  constexpr unsigned int most_memory_columns = 16;

  /**
   * What every material point knows at the end of the last accepted step, in
   * any scene. It consists of plain doubles.
   *
   * Tensors of a plane-strain run (dim = 2) hold the in-plane part; the
   * out-of-plane components that are not constant stand in fields of their
   * own. The total out-of-plane stretch of plane strain is 1.
   */
  template <int dim>
  struct PointCore
  {
    double                 body;                   ///< index of its body [-]
    double                 loaded;                 ///< 1 if point loads or tractions act on it
    double                 mass;                   ///< [kg; kg/m in 2D]
    double                 reference_volume;       ///< V0 [m^3; m^2 in 2D]
    dealii::Tensor<1, dim> reference_position;     ///< X [m]
    dealii::Tensor<1, dim> displacement;           ///< x - X, accumulated [m]
    dealii::Tensor<1, dim> velocity;               ///< [m/s]
    dealii::Tensor<1, dim> reference_half_lengths; ///< GIMP domain at the start [m]
    dealii::Tensor<1, dim> half_lengths;           ///< GIMP domain now [m]
    dealii::Tensor<2, dim> deformation_gradient;   ///< F = dx/dX
    /**
     * B with B B^T = b^e, the elastic left Cauchy-Green tensor: its columns
     * are the principal directions scaled by the principal elastic stretches.
     */
    dealii::Tensor<2, dim>          elastic_frame;
    double                          out_of_plane_elastic_stretch;  ///< plane strain; 1 in 3D
    dealii::SymmetricTensor<2, dim> kirchhoff_stress;              ///< tau [Pa]
    double                          out_of_plane_kirchhoff_stress; ///< plane strain; 0 in 3D [Pa]
    double                          strain_energy; ///< elastic free energy per V0 [J/m^3]
  };

  /** What a point knows besides, stored only where a scene uses it (PointLayout). */
  template <int dim>
  struct PointExtras
  {
    dealii::Tensor<1, dim> acceleration; ///< [m/s^2], if the scheme carries it
    /** What its law remembers or takes from its place, in the columns that all laws share. */
    double memory[most_memory_columns];
    // of bodies that yield
    double hardening_energy;    ///< per V0 [J/m^3]
    double plastic_dissipation; ///< accumulated, per V0 [J/m^3]
    // of saturated soil
    double                 pore_pressure;             ///< p, positive in compression [Pa]
    double                 pore_pressure_fluctuation; ///< (N - N^0) p of (4.179) [Pa]
    double                 porosity;                  ///< n, pores over volume now [-]
    double                 fluid_content_rate;        ///< m' per V0 [kg/m^3/s], if carried
    double                 fluid_content_rate_change; ///< m'' per V0 [kg/m^3/s^2], if carried
    dealii::Tensor<1, dim> darcy_velocity;            ///< fluid's volume per area and time [m/s]
    // where the scheme carries it; pore_pressure is that of the last balance then
    double                 end_pore_pressure; ///< at the end of the step [Pa]
    dealii::Tensor<1, dim> fluid_velocity;    ///< [m/s]
  };

  /**
   * The committed history of one material point: what it knows at the end of
   * the last accepted step. The cloud stores the core and those extras that its
   * scene uses in the particle handler's property pool.
   */
  template <int dim>
  struct PointState
    : PointCore<dim>
    , PointExtras<dim>
  {};

  template <int dim>
  constexpr unsigned int n_core_values = sizeof(PointCore<dim>) / sizeof(double);
  template <int dim>
  constexpr unsigned int n_state_values = sizeof(PointState<dim>) / sizeof(double);

  // both consist of doubles alone, and the state of both, one after the other
  static_assert(std::is_standard_layout_v<PointCore<2>> && std::is_standard_layout_v<PointCore<3>>);
  static_assert(std::is_standard_layout_v<PointExtras<3>>);
  static_assert(std::is_trivially_copyable_v<PointState<3>>);
  static_assert(sizeof(PointState<2>) == sizeof(PointCore<2>) + sizeof(PointExtras<2>));
  static_assert(sizeof(PointState<3>) == sizeof(PointCore<3>) + sizeof(PointExtras<3>));

  /** A material point as it leaves the cloud: for output, checkpoints, rebuilding. */
  template <int dim>
  struct PointRecord
  {
    std::uint64_t      id; ///< unique in the run, never changes
    dealii::Point<dim> location;
    PointState<dim>    state;
  };
} // namespace kedge

#endif
