#include <pounding/frames/corotation.hpp>

#include <cmath>
#include <numbers>

namespace pounding {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace finite_rotation;

namespace {

using Row12 = Eigen::Matrix<double, 1, 12>;

// A Hessian: any asymmetry is round-off.
template <class Matrix>
Matrix symmetrized(const Matrix& k) {
  return 0.5 * (k + k.transpose());
}

// Force on the start of a plane member, for the normal force and the sum of the end moments about global y.
std::array<double, 2> plane_force(const Corotation::Plane& p, double normal_force, double moments) {
  const double across = moments / (p.length * p.length), along = normal_force / p.length;
  return {across * p.z - along * p.x, -across * p.x - along * p.z};
}

}  // namespace

Corotation::Corotation(const Beam& beam, const Vector3d& start_node, const Vector3d& end_node)
    : length_(beam.length()),
      start_offset_(beam.options().start_offset),
      end_offset_(beam.options().end_offset),
      undeformed_(end_node + end_offset_ - start_node - start_offset_),
      axes_(beam.axes().transpose()) {}

Corotation::Chord Corotation::chord(const Vector12& u) const {
  Chord c;
  const Vector3d at_start = turned_by(u.segment<3>(3), start_offset_), at_end = turned_by(u.segment<3>(9), end_offset_);
  c.arm_start = start_offset_ + at_start;
  c.arm_end = end_offset_ + at_end;
  const Vector3d change = u.segment<3>(6) + at_end - u.segment<3>(0) - at_start, now = undeformed_ + change;
  c.length = now.norm();
  c.direction = now / c.length;
  // Avoids the difference of two lengths, which cancels for a small elongation.
  c.elongation = change.dot(undeformed_ + now) / (c.length + length_);
  return c;
}

// Scalars instead of matrices: the hot path of time integration.
Corotation::Plane Corotation::plane(const Vector12& u) const {
  Plane p;
  const auto turn_arm = [](const Vector3d& offset, double turn, double& x, double& z) {
    x = offset.x();
    z = offset.z();
    if (x == 0 && z == 0) return std::array{0.0, 0.0};
    const double half = std::sin(turn / 2), s = std::sin(turn), less = -2 * half * half;
    const double by_x = less * x + s * z, by_z = -s * x + less * z;
    x += by_x;
    z += by_z;
    return std::array{by_x, by_z};
  };
  const auto [start_by_x, start_by_z] = turn_arm(start_offset_, u[4], p.start_x, p.start_z);
  const auto [end_by_x, end_by_z] = turn_arm(end_offset_, u[10], p.end_x, p.end_z);
  const double change_x = u[6] + end_by_x - u[0] - start_by_x, change_z = u[8] + end_by_z - u[2] - start_by_z;
  p.x = undeformed_.x() + change_x;
  p.z = undeformed_.z() + change_z;
  p.length = std::sqrt(p.x * p.x + p.z * p.z);
  // Avoids the difference of two lengths, which cancels for a small elongation.
  const double elongation =
      (change_x * (undeformed_.x() + p.x) + change_z * (undeformed_.z() + p.z)) / (p.length + length_);
  const double turn =
      std::atan2(undeformed_.z() * p.x - undeformed_.x() * p.z, undeformed_.x() * p.x + undeformed_.z() * p.z);
  const double sense = axes_(1, 1);  // local y is parallel or antiparallel to global y
  const auto bend = [&](double rotation) {
    const double angle = rotation - turn;
    return sense * (std::abs(angle) < std::numbers::pi ? angle : std::remainder(angle, 2 * std::numbers::pi));
  };
  p.deformations = {elongation, bend(u[4]), bend(u[10])};
  return p;
}

Vector12 Corotation::nodal_forces(const Plane& p, const Vector3d& s) const {
  const double sense = axes_(1, 1);
  const auto [x, z] = plane_force(p, s[0], sense * (s[1] + s[2]));
  Vector12 force;
  force << x, 0, z, 0, sense * s[1] + p.start_z * x - p.start_x * z, 0,  //
      -x, 0, -z, 0, sense * s[2] - p.end_z * x + p.end_x * z, 0;
  return force;
}

Vector12 Corotation::end_forces(const Plane& p, const Vector3d& s) const {
  // Rotated local z is local x turned towards it by a right angle about local y.
  const double across = (s[1] + s[2]) / p.length;
  Vector12 force;
  force << -s[0], 0, -across, 0, s[1], 0, s[0], 0, across, 0, s[2], 0;
  return force;
}

Matrix12 Corotation::tangent(const Plane& p, const Vector3d& s, const Matrix3d& stiffness) const {
  // In terms of x and z between the ends and the rotations of both ends; the rows of b are the deformations.
  const double sense = axes_(1, 1), l = p.length;
  const Eigen::Vector2d e(p.x / l, p.z / l), n(e[1], -e[0]);  // n: direction in which a positive ry moves the tip of e
  Eigen::Matrix<double, 3, 4> b;
  b.col(0) << e[0], -sense * n[0] / l, -sense * n[0] / l;
  b.col(1) << e[1], -sense * n[1] / l, -sense * n[1] / l;
  b.col(2) << 0, sense, 0;
  b.col(3) << 0, 0, sense;
  const double moments = sense * (s[1] + s[2]);
  Eigen::Matrix4d within = b.transpose() * (stiffness * b);
  within.topLeftCorner<2, 2>() +=
      s[0] / l * n * n.transpose() + moments / (l * l) * (e * n.transpose() + n * e.transpose());
  Eigen::Matrix<double, 4, 6> by_nodes;
  by_nodes << -1, 0, -p.start_z, 1, 0, p.end_z,  //
      0, -1, p.start_x, 0, 1, -p.end_x,          //
      0, 0, 1, 0, 0, 0,                          //
      0, 0, 0, 0, 0, 1;
  Matrix6 k = by_nodes.transpose() * (within * by_nodes);
  const auto [x, z] = plane_force(p, s[0], moments);
  k(2, 2) -= x * p.start_x + z * p.start_z;
  k(5, 5) += x * p.end_x + z * p.end_z;
  Matrix12 tangent = Matrix12::Zero();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) tangent(2 * i, 2 * j) = 0.5 * (k(i, j) + k(j, i));
  return tangent;
}

Corotation::Space Corotation::space(const Vector12& u) const {
  Space out;
  out.chord = chord(u);
  const double l = out.chord.length;
  const std::array node{rotation(u.segment<3>(3)), rotation(u.segment<3>(9))};
  const Vector3d mean_y = 0.5 * (node[0] + node[1]) * axes_.col(1);
  Matrix3d& e = out.axes;
  e.col(0) = out.chord.direction;
  e.col(2) = e.col(0).cross(mean_y).normalized();
  e.col(1) = e.col(2).cross(e.col(0));
  for (int i : {0, 1}) {
    const Matrix3d local = e.transpose() * node[i] * axes_;
    out.y[i] = local.col(1);
    out.turn[i] = rotation_vector(local);
    out.inverse[i] = inverse_spin_transposed(out.turn[i]);
  }
  out.deformations << out.turn[0], out.chord.elongation, out.turn[1];

  // Spin of the axes due to the motion of the ends: e stays on the chord, and mean_y in the x-y plane.
  const auto& y = out.y;
  out.mean_y = 0.5 * (y[0][1] + y[1][1]);
  out.slant = 0.5 * (y[0][0] + y[1][0]) / out.mean_y;
  out.axes_spin.setZero();
  for (int i : {0, 1}) {
    const double sign = i == 0 ? 1 : -1;
    out.axes_spin(0, 6 * i + 2) = sign * out.slant / l;
    out.axes_spin(1, 6 * i + 2) = sign / l;
    out.axes_spin(2, 6 * i + 1) = -sign / l;
    out.axes_spin(0, 6 * i + 3) = 0.5 * y[i][1] / out.mean_y;
    out.axes_spin(0, 6 * i + 4) = -0.5 * y[i][0] / out.mean_y;
  }
  out.by_ends.row(3) << -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0;
  for (int i : {0, 1}) {
    out.spin[i] = -out.axes_spin;
    out.spin[i].block<3, 3>(0, 6 * i + 3) += Matrix3d::Identity();
    out.by_ends.middleRows<3>(4 * i) = out.inverse[i].matrix(out.turn[i]).transpose() * out.spin[i];
  }
  return out;
}

Vector12 Corotation::nodal_forces(const Space& space, const Vector12& u, const Vector7& s) const {
  Vector12 force = end_forces(space, s);
  for (int i : {0, 3, 6, 9}) force.segment<3>(i) = (space.axes * force.segment<3>(i)).eval();
  // Transforms from the ends to the nodes, and from spins to rotation vectors.
  for (int i : {0, 1}) {
    const Vector3d& arm = i == 0 ? space.chord.arm_start : space.chord.arm_end;
    const Vector3d turn = u.segment<3>(6 * i + 3);
    const Vector3d moment = force.segment<3>(6 * i + 3) + arm.cross(Vector3d(force.segment<3>(6 * i)));
    force.segment<3>(6 * i + 3) = spin_transposed(turn).matrix(turn) * moment;
  }
  return force;
}

Matrix12 Corotation::tangent(const Space& space, const Vector12& u, const Vector7& s, const Matrix7& stiffness) const {
  const auto& [chord, e, d, y, turn, inverse, slant, q2, axes_spin, spin, b] = space;
  const double l = chord.length, normal_force = s[3];
  const std::array bend{Vector3d(s.head<3>()), Vector3d(s.tail<3>())};
  const Row12 lengthening = b.row(3);
  Vector12 force = end_forces(space, s);
  Vector3d sum = Vector3d::Zero();
  for (int i : {0, 1}) sum += inverse[i].matrix(turn[i]) * bend[i];

  Matrix12 k = b.transpose() * stiffness * b;
  for (int i : {0, 1}) k += spin[i].transpose() * inverse[i].derivative(turn[i], bend[i]) * b.middleRows<3>(4 * i);
  for (int direction : {1, 2})
    for (int i : {0, 6})
      for (int j : {0, 6}) k(i + direction, j + direction) += (i == j ? 1 : -1) * normal_force / l;
  const Vector12 by_moments = force - lengthening.transpose() * normal_force;
  for (int i : {0, 3, 6, 9}) k.middleRows<3>(i) -= cross(by_moments.segment<3>(i)) * axes_spin;

  // Derivative of axes_spin^T sum at constant sum.
  std::array<Space::Matrix3x12, 2> of_y;
  for (int i : {0, 1}) of_y[i] = -cross(y[i]) * spin[i];
  const Row12 of_q2 = 0.5 * (of_y[0].row(1) + of_y[1].row(1));
  const Row12 of_slant = (0.5 * (of_y[0].row(0) + of_y[1].row(0)) - slant * of_q2) / q2;
  for (int i : {0, 1}) {
    const double sign = i == 0 ? 1 : -1;
    k.row(6 * i + 1) -= sign * sum[2] / (l * l) * lengthening;
    k.row(6 * i + 2) -= sign * (sum[0] / l * of_slant - (slant * sum[0] + sum[1]) / (l * l) * lengthening);
    k.row(6 * i + 3) -= 0.5 * sum[0] / q2 * (of_y[i].row(1) - y[i][1] / q2 * of_q2);
    k.row(6 * i + 4) += 0.5 * sum[0] / q2 * (of_y[i].row(0) - y[i][0] / q2 * of_q2);
  }
  for (int i : {0, 3, 6, 9}) k.middleRows<3>(i) = (e * k.middleRows<3>(i)).eval();
  for (int i : {0, 3, 6, 9}) k.middleCols<3>(i) = (k.middleCols<3>(i) * e.transpose()).eval();
  for (int i : {0, 3, 6, 9}) force.segment<3>(i) = (e * force.segment<3>(i)).eval();

  // Transforms from the ends to the nodes, and from spins to rotation vectors.
  Matrix12 to_ends = Matrix12::Identity();
  std::array<Matrix3d, 2> curved;
  for (int i : {0, 1}) {
    const Vector3d& arm = i == 0 ? chord.arm_start : chord.arm_end;
    const Vector3d node_turn = u.segment<3>(6 * i + 3), end_force = force.segment<3>(6 * i);
    const Vector3d moment = force.segment<3>(6 * i + 3) + arm.cross(end_force);
    const RotationMap map = spin_transposed(node_turn);
    const Matrix3d to_moment = map.matrix(node_turn);
    curved[i] = to_moment * cross(end_force) * cross(arm) * to_moment.transpose() + map.derivative(node_turn, moment);
    to_ends.block<3, 3>(6 * i, 6 * i + 3) = -cross(arm) * to_moment.transpose();
    to_ends.block<3, 3>(6 * i + 3, 6 * i + 3) = to_moment.transpose();
  }
  // For such small matrices, a lazy product is faster than a blocked one.
  const Matrix12 by_ends = k.lazyProduct(to_ends);
  k = to_ends.transpose().lazyProduct(by_ends);
  for (int i : {0, 1}) k.block<3, 3>(6 * i + 3, 6 * i + 3) += curved[i];
  return symmetrized(k);
}

Matrix3d Corotation::axes(const Vector12& u, bool is_plane) const {
  Matrix3d e;
  e.row(0) = chord(u).direction;
  const Vector3d mean_y = is_plane ? Vector3d(axes_.col(1))
                                   : Vector3d((rotation(u.segment<3>(3)) + rotation(u.segment<3>(9))) * axes_.col(1));
  e.row(2) = e.row(0).cross(mean_y).normalized();
  e.row(1) = e.row(2).cross(e.row(0));
  return e;
}

}  // namespace pounding
