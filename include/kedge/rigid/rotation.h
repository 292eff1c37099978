#ifndef kedge_rigid_rotation_h
#define kedge_rigid_rotation_h

#include <deal.II/base/tensor.h>

#include <array>

namespace kedge
{
  // Rotations in space. A step turns a body by cay(theta), the Cayley map of a vector theta
  // along the axis, of length 2 tan(angle / 2).

  using Vector3  = dealii::Tensor<1, 3>;
  using Matrix33 = dealii::Tensor<2, 3>;

  /** The matrix of a cross product, [v] w = v x w. */
  Matrix33
  cross_matrix(const Vector3 &v);

  /** cay(theta) = (I - [theta]/2)^-1 (I + [theta]/2), a rotation. */
  Matrix33
  cayley(const Vector3 &theta);

  /** (I - [theta]/2)^-1, in closed form. */
  Matrix33
  cayley_inverse(const Vector3 &theta);

  /** The vector whose Cayley map turns by @p angle about the axis of a unit vector. */
  Vector3
  cayley_vector(const Vector3 &axis, const double angle);

  /** How a body is turned: a unit quaternion w, x, y, z, which round-off cannot distort. */
  using Attitude = std::array<double, 4>;

  /** The rotation matrix of an attitude. */
  Matrix33
  matrix_of(const Attitude &attitude);

  /** The attitude after a further rotation cay(theta) in space. */
  Attitude
  turned_by(const Attitude &attitude, const Vector3 &theta);

  /**
   * Angle times axis of an attitude [rad]. Of the many that are the same rotation, angles
   * apart by full turns, the one nearest to @p previous.
   */
  Vector3
  rotation_vector(const Attitude &attitude, const Vector3 &previous);
} // namespace kedge

#endif
