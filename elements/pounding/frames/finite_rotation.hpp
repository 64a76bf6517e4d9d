#pragma once
/// Rotations of any size in space, by rotation vectors [rad].

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <utility>

namespace pounding::finite_rotation {

/// Matrix of the cross product: cross(v) w = v x w.
inline Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// A map I + first cross(t) + second cross(t)^2 of a rotation vector t; the slopes are the derivatives of both factors
/// with respect to |t|, divided by |t|.
struct RotationMap {
  double first, first_slope, second, second_slope;

  /// Matrix of the map.
  Eigen::Matrix3d matrix(const Eigen::Vector3d& t) const {
    const Eigen::Matrix3d c = cross(t);
    return Eigen::Matrix3d::Identity() + first * c + second * c * c;
  }
  /// Derivative of matrix(t) v with respect to t, for constant v.
  Eigen::Matrix3d derivative(const Eigen::Vector3d& t, const Eigen::Vector3d& v) const {
    const Eigen::Vector3d once = t.cross(v), twice = t.cross(once);
    return -first * cross(v) + first_slope * once * t.transpose() + second_slope * twice * t.transpose() +
           second * (t.dot(v) * Eigen::Matrix3d::Identity() + t * v.transpose() - 2 * v * t.transpose());
  }
};

/// Below this angle the closed forms suffer from cancellation, and six terms of the series are exact to round-off.
inline constexpr double small_angle_squared = 0.09;

/// Sum of c_k x^k with x = t^2, and its derivative with respect to t, divided by t.
inline std::pair<double, double> series(double x, const std::array<double, 6>& c) {
  double sum = 0, slope = 0;
  for (int k = 5; k >= 0; --k) {
    sum = sum * x + c[k];
    if (k > 0) slope = slope * x + 2 * k * c[k];
  }
  return {sum, slope};
}

/// Factors (1 - cos t)/t^2 and (t - sin t)/t^3 for x = t^2.
inline RotationMap spin_coefficients(double x) {
  if (x < small_angle_squared) {
    const auto [a, da] = series(x, {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800, -1.0 / 479001600});
    const auto [b, db] = series(x, {1.0 / 6, -1.0 / 120, 1.0 / 5040, -1.0 / 362880, 1.0 / 39916800, -1.0 / 6227020800});
    return {a, da, b, db};
  }
  const double t = std::sqrt(x), sinc = std::sin(t) / t, a = (1 - std::cos(t)) / x, b = (1 - sinc) / x;
  return {a, (sinc - 2 * a) / x, b, (a - 3 * b) / x};
}

/// Transpose of the map from the rate of a rotation vector to the spin (axes fixed in space).
inline RotationMap spin_transposed(const Eigen::Vector3d& t) {
  RotationMap map = spin_coefficients(t.squaredNorm());
  map.first = -map.first;
  map.first_slope = -map.first_slope;
  return map;
}

/// Transpose of the map from the spin to the rate of the rotation vector.
inline RotationMap inverse_spin_transposed(const Eigen::Vector3d& t) {
  const double x = t.squaredNorm();
  if (x < small_angle_squared) {
    const auto [c, dc] =
        series(x, {1.0 / 12, 1.0 / 720, 1.0 / 30240, 1.0 / 1209600, 1.0 / 47900160, 691.0 / 1307674368000.0});
    return {0.5, 0, c, dc};
  }
  const double angle = std::sqrt(x), s = std::sin(angle / 2), cot = std::cos(angle / 2) / s;
  return {0.5, 0, (1 - angle / 2 * cot) / x, (-2 / x + 1 / (4 * s * s) + cot / (2 * angle)) / x};
}

/// Change of v due to a rotation by the vector t; accurate also for small angles.
inline Eigen::Vector3d turned_by(const Eigen::Vector3d& t, const Eigen::Vector3d& v) {
  const RotationMap map = spin_coefficients(t.squaredNorm());
  const Eigen::Vector3d once = t.cross(v);
  return once + map.first * t.cross(once) + map.second * t.cross(t.cross(once));
}

/// Rotation matrix of a rotation vector.
inline Eigen::Matrix3d rotation(const Eigen::Vector3d& t) {
  const RotationMap map = spin_coefficients(t.squaredNorm());
  const Eigen::Matrix3d c = cross(t);
  return Eigen::Matrix3d::Identity() + (1 - map.second * t.squaredNorm()) * c + map.first * c * c;
}

/// Rotation vector of a rotation matrix, with an angle of at most pi.
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& r) {
  Eigen::Quaterniond q(r);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  return (s < 1e-12 ? 2.0 : 2 * std::atan2(s, q.w()) / s) * q.vec();
}

}  // namespace pounding::finite_rotation
