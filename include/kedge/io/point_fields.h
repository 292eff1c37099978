#ifndef kedge_io_point_fields_h
#define kedge_io_point_fields_h

#include <kedge/points/point_state.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace kedge
{
  enum class FieldShape
  {
    scalar,           ///< 1 value
    vector,           ///< x, y, z
    symmetric_tensor, ///< xx, yy, zz, xy, yz, xz (the order of VTK)
    tensor            ///< xx, xy, xz, yx, .. zz
  };

  /** Number of values of a shape: 1, 3, 6 or 9, in 2D too. */
  unsigned int
  n_values(const FieldShape shape);

  /** "" of a scalar, x y z, xx yy zz xy yz xz, or xx xy .. zz. */
  const std::vector<std::string> &
  value_names(const FieldShape shape);

  /**
   * A quantity of material points under a name. Its values are always those
   * of three dimensions, plane strain included: the third component of a
   * vector is 0, that of F is 1, out-of-plane normal stresses are what they
   * are.
   */
  template <int dim>
  struct PointField
  {
    /** A component that is not a constant in this dimension. */
    struct Component
    {
      std::string  suffix; ///< "" (scalar), "x", "xx" ..
      unsigned int index;  ///< into the values
    };

    std::string name;
    std::string unit;
    std::string meaning;
    FieldShape  shape;
    bool        integer; ///< its values are whole numbers (id, body)
    std::function<void(const PointRecord<dim> &point, double *values)> evaluate;

    std::vector<Component>
    components() const;

    /** name, name_x, name_xx .. of a component. */
    std::string
    component_name(const Component &component) const;
  };

  /** All fields, in the order in which they are documented. */
  template <int dim>
  const std::vector<PointField<dim>> &
  point_fields();

  /** The field of that name. Throws UserError with the nearest name. */
  template <int dim>
  const PointField<dim> &
  point_field(const std::string &name);

  /** One number per material point: a scalar field or a component such as `cauchy_stress_yy`. */
  template <int dim>
  struct PointQuantity
  {
    const PointField<dim> *field;
    unsigned int           index;

    double
    operator()(const PointRecord<dim> &point) const;
  };

  /** Throws UserError with the nearest name. */
  template <int dim>
  PointQuantity<dim>
  point_quantity(const std::string &name);
} // namespace kedge

#endif
