#include <kedge/rigid/rotation.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace kedge
{
  Matrix33
  cross_matrix(const Vector3 &v)
  {
    Matrix33 result;
    result[0][1] = -v[2];
    result[0][2] = v[1];
    result[1][0] = v[2];
    result[1][2] = -v[0];
    result[2][0] = -v[1];
    result[2][1] = v[0];
    return result;
  }



  Matrix33
  cayley(const Vector3 &theta)
  {
    const Matrix33 cross  = cross_matrix(theta);
    Matrix33       result = (cross + 0.5 * cross * cross) / (1. + 0.25 * theta.norm_square());
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] += 1.;
    return result;
  }



  Matrix33
  cayley_inverse(const Vector3 &theta)
  {
    // the mean of I and of cay(theta)
    Matrix33 result = 0.5 * cayley(theta);
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] += 0.5;
    return result;
  }



  Vector3
  cayley_vector(const Vector3 &axis, const double angle)
  {
    return 2. * std::tan(0.5 * angle) * axis;
  }



  Matrix33
  matrix_of(const Attitude &attitude)
  {
    Vector3 v;
    for (unsigned int i = 0; i < 3; ++i)
      v[i] = attitude[i + 1];
    const Matrix33 cross  = cross_matrix(v);
    Matrix33       result = 2. * (attitude[0] * cross + cross * cross);
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] += 1.;
    return result;
  }



  Attitude
  turned_by(const Attitude &attitude, const Vector3 &theta)
  {
    // the quaternion of cay(theta) is (1, theta/2), normalised
    Vector3 v;
    for (unsigned int i = 0; i < 3; ++i)
      v[i] = attitude[i + 1];
    const double  w      = attitude[0] - 0.5 * (theta * v);
    const Vector3 vector = v + 0.5 * (attitude[0] * theta + cross_product_3d(theta, v));
    const double  size   = std::sqrt(w * w + vector.norm_square());
    return {{w / size, vector[0] / size, vector[1] / size, vector[2] / size}};
  }



  Vector3
  rotation_vector(const Attitude &attitude, const Vector3 &previous)
  {
    Vector3 v;
    for (unsigned int i = 0; i < 3; ++i)
      v[i] = attitude[i + 1];
    const double size = v.norm();
    if (!(size > 0.))
      {
        // whole turns about the previous axis
        const double turns = std::round(previous.norm() / (2. * dealii::numbers::PI));
        return turns > 0. ? 2. * dealii::numbers::PI * turns / previous.norm() * previous
                          : Vector3();
      }
    const Vector3 axis    = v / size;
    const double  angle   = 2. * std::atan2(size, attitude[0]);
    const double  nearest = std::round((previous * axis - angle) / (2. * dealii::numbers::PI));
    return (angle + 2. * dealii::numbers::PI * nearest) * axis;
  }
} // namespace kedge
