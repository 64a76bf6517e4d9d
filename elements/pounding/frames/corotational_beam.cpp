// A corotational member: forces and tangent in the rotating axes.

#include <pounding/frames/corotational.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include <pounding/core/refuse.hpp>
#include <pounding/frames/finite_rotation.hpp>

namespace pounding {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace finite_rotation;

namespace {

using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
using Row12 = Eigen::Matrix<double, 1, 12>;

}  // namespace

CorotationalBeam::CorotationalBeam(const Vector3d& start_node, const Vector3d& end_node, const Section& section,
                                   const Material& material, const BeamOptions& options, int dimension)
    : CorotationalBeam(Beam(start_node, end_node, section, material, options), start_node, end_node, dimension) {}

CorotationalBeam CorotationalBeam::truss(const Vector3d& start_node, const Vector3d& end_node, double area,
                                         const Material& material, int dimension) {
  return {Beam::truss(start_node, end_node, area, material), start_node, end_node, dimension};
}

CorotationalBeam::CorotationalBeam(const Beam& beam, const Vector3d& start_node, const Vector3d& end_node,
                                   int dimension)
    : is_plane_(dimension == 2),
      start_offset_(beam.options().start_offset),
      end_offset_(beam.options().end_offset),
      undeformed_(end_node + end_offset_ - start_node - start_offset_) {
  if (beam.axial_force() != 0) refuse("a corotational member computes its axial force; remove axial_force");
  length_ = beam.length();
  axes_ = beam.axes().transpose();
  // Beam has condensed the releases. Applies the nodal displacements that deform it locally, one at a time.
  constexpr std::array deformations{3, 4, 5, 6, 9, 10, 11};
  for (int j = 0; j < 7; ++j) {
    Vector12 local = Vector12::Unit(deformations[j]), global;
    for (int node : {0, 6}) {
      const Vector3d turn = axes_ * local.segment<3>(node + 3);
      global.segment<3>(node) = axes_ * local.segment<3>(node) - turn.cross(node == 0 ? start_offset_ : end_offset_);
      global.segment<3>(node + 3) = turn;
    }
    stiffness_.col(j) = beam.end_forces(global)(deformations);
  }
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
}

CorotationalBeam::Chord CorotationalBeam::chord(const Vector12& u) const {
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
CorotationalBeam::Plane CorotationalBeam::plane(const Vector12& u) const {
  Plane p{};
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
  const double d[3] = {bend(u[4]), elongation, bend(u[10])};
  double s[3];
  for (int i = 0; i < 3; ++i) {
    s[i] = 0;
    for (int j = 0; j < 3; ++j) s[i] += stiffness_(1 + 2 * i, 1 + 2 * j) * d[j];
    p.energy += 0.5 * d[i] * s[i];
  }
  p.start_moment = sense * s[0];
  p.normal_force = s[1];
  p.end_moment = sense * s[2];
  const double across = (p.start_moment + p.end_moment) / (p.length * p.length), along = p.normal_force / p.length;
  p.force_x = across * p.z - along * p.x;
  p.force_z = -across * p.x - along * p.z;
  return p;
}

CorotationalBeam::Response CorotationalBeam::plane_response(const Plane& p, Matrix12* tangent) const {
  Response out;
  out.energy = p.energy;
  out.force << p.force_x, 0, p.force_z, 0, p.start_moment + p.start_z * p.force_x - p.start_x * p.force_z, 0,
      -p.force_x, 0, -p.force_z, 0, p.end_moment - p.end_z * p.force_x + p.end_x * p.force_z, 0;
  if (!tangent) return out;
  // In terms of x and z between the ends and the rotations of both ends; the rows of b are the deformations.
  const double sense = axes_(1, 1), l = p.length;
  const Eigen::Vector2d e(p.x / l, p.z / l), n(e[1], -e[0]);  // n: direction in which a positive ry moves the tip of e
  Eigen::Matrix<double, 3, 4> b;
  b.col(0) << -sense * n[0] / l, e[0], -sense * n[0] / l;
  b.col(1) << -sense * n[1] / l, e[1], -sense * n[1] / l;
  b.col(2) << sense, 0, 0;
  b.col(3) << 0, 0, sense;
  Matrix3d stiffness;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) stiffness(i, j) = stiffness_(1 + 2 * i, 1 + 2 * j);
  Eigen::Matrix4d within = b.transpose() * (stiffness * b);
  within.topLeftCorner<2, 2>() += p.normal_force / l * n * n.transpose() +
                                  (p.start_moment + p.end_moment) / (l * l) * (e * n.transpose() + n * e.transpose());
  Eigen::Matrix<double, 4, 6> by_nodes;
  by_nodes << -1, 0, -p.start_z, 1, 0, p.end_z,  //
      0, -1, p.start_x, 0, 1, -p.end_x,          //
      0, 0, 1, 0, 0, 0,                          //
      0, 0, 0, 0, 0, 1;
  Eigen::Matrix<double, 6, 6> k = by_nodes.transpose() * (within * by_nodes);
  k(2, 2) -= p.force_x * p.start_x + p.force_z * p.start_z;
  k(5, 5) += p.force_x * p.end_x + p.force_z * p.end_z;
  tangent->setZero();
  // A Hessian: any asymmetry is round-off.
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) (*tangent)(2 * i, 2 * j) = 0.5 * (k(i, j) + k(j, i));
  return out;
}

// All quantities in the rotated axes; d and s are rotations of the start, elongation, rotations of the end.
CorotationalBeam::Response CorotationalBeam::space_ends(const Vector12& u, const Chord& chord,
                                                        Matrix12* tangent) const {
  const double l = chord.length;
  const std::array node{rotation(u.segment<3>(3)), rotation(u.segment<3>(9))};
  const Vector3d mean_y = 0.5 * (node[0] + node[1]) * axes_.col(1);
  Matrix3d e;
  e.col(0) = chord.direction;
  e.col(2) = e.col(0).cross(mean_y).normalized();
  e.col(1) = e.col(2).cross(e.col(0));

  std::array<Vector3d, 2> y, turn;
  for (int i : {0, 1}) {
    const Matrix3d local = e.transpose() * node[i] * axes_;
    y[i] = local.col(1);
    turn[i] = rotation_vector(local);
  }
  Vector7 d;
  d << turn[0], chord.elongation, turn[1];
  const Vector7 s = stiffness_ * d;
  const std::array bend{Vector3d(s.head<3>()), Vector3d(s.tail<3>())};
  const std::array inverse{inverse_spin_transposed(turn[0]), inverse_spin_transposed(turn[1])};

  // Spin of the axes due to the motion of the ends: e stays on the chord, and mean_y in the x-y plane.
  const double q1 = 0.5 * (y[0][0] + y[1][0]), q2 = 0.5 * (y[0][1] + y[1][1]), slant = q1 / q2;
  Matrix3x12 axes_spin = Matrix3x12::Zero();
  for (int i : {0, 1}) {
    const double sign = i == 0 ? 1 : -1;
    axes_spin(0, 6 * i + 2) = sign * slant / l;
    axes_spin(1, 6 * i + 2) = sign / l;
    axes_spin(2, 6 * i + 1) = -sign / l;
    axes_spin(0, 6 * i + 3) = 0.5 * y[i][1] / q2;
    axes_spin(0, 6 * i + 4) = -0.5 * y[i][0] / q2;
  }
  Row12 lengthening = Row12::Zero();
  lengthening[0] = -1;
  lengthening[6] = 1;
  std::array<Matrix3x12, 2> spin;  // of the ends relative to the axes
  std::array<Vector3d, 2> moment;
  Eigen::Matrix<double, 7, 12> b;
  b.row(3) = lengthening;
  for (int i : {0, 1}) {
    spin[i] = -axes_spin;
    spin[i].block<3, 3>(0, 6 * i + 3) += Matrix3d::Identity();
    const Matrix3d to_moment = inverse[i].matrix(turn[i]);
    moment[i] = to_moment * bend[i];
    b.middleRows<3>(4 * i) = to_moment.transpose() * spin[i];
  }

  Response out;
  out.energy = 0.5 * d.dot(s);
  out.force = b.transpose() * s;
  if (tangent) {
    const double normal_force = s[3];
    const Vector3d sum = moment[0] + moment[1];
    Matrix12& k = *tangent;
    k = b.transpose() * stiffness_ * b;
    for (int i : {0, 1}) k += spin[i].transpose() * inverse[i].derivative(turn[i], bend[i]) * b.middleRows<3>(4 * i);
    for (int direction : {1, 2})
      for (int i : {0, 6})
        for (int j : {0, 6}) k(i + direction, j + direction) += (i == j ? 1 : -1) * normal_force / l;
    const Vector12 by_moments = out.force - lengthening.transpose() * normal_force;
    for (int i : {0, 3, 6, 9}) k.middleRows<3>(i) -= cross(by_moments.segment<3>(i)) * axes_spin;

    // Derivative of axes_spin^T sum at constant sum.
    std::array<Matrix3x12, 2> of_y;
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
  }
  for (int i : {0, 3, 6, 9}) out.force.segment<3>(i) = (e * out.force.segment<3>(i)).eval();
  return out;
}

CorotationalBeam::Response CorotationalBeam::respond(const Vector12& u, Matrix12* tangent) const {
  if (is_plane_) return plane_response(plane(u), tangent);
  const Chord c = chord(u);
  Response out = space_ends(u, c, tangent);

  // Transforms from the ends to the nodes, and from spins to rotation vectors.
  Matrix12 to_ends = Matrix12::Identity();
  std::array<Matrix3d, 2> curved;
  for (int i : {0, 1}) {
    const Vector3d& arm = i == 0 ? c.arm_start : c.arm_end;
    const Vector3d turn = u.segment<3>(6 * i + 3), force = out.force.segment<3>(6 * i);
    const Vector3d moment = out.force.segment<3>(6 * i + 3) + arm.cross(force);
    const RotationMap map = spin_transposed(turn);
    const Matrix3d to_moment = map.matrix(turn);
    out.force.segment<3>(6 * i + 3) = to_moment * moment;
    if (!tangent) continue;
    curved[i] = to_moment * cross(force) * cross(arm) * to_moment.transpose() + map.derivative(turn, moment);
    to_ends.block<3, 3>(6 * i, 6 * i + 3) = -cross(arm) * to_moment.transpose();
    to_ends.block<3, 3>(6 * i + 3, 6 * i + 3) = to_moment.transpose();
  }
  if (!tangent) return out;
  // For such small matrices, a lazy product is faster than a blocked one.
  const Matrix12 by_ends = tangent->lazyProduct(to_ends);
  (*tangent) = to_ends.transpose().lazyProduct(by_ends);
  for (int i : {0, 1}) tangent->block<3, 3>(6 * i + 3, 6 * i + 3) += curved[i];
  // A Hessian: any asymmetry is round-off.
  (*tangent) = (0.5 * ((*tangent) + tangent->transpose())).eval();
  return out;
}

Vector12 CorotationalBeam::end_forces(const Vector12& u) const {
  Vector12 ends;
  if (is_plane_) {
    const Plane p = plane(u);
    ends << p.force_x, 0, p.force_z, 0, p.start_moment, 0, -p.force_x, 0, -p.force_z, 0, p.end_moment, 0;
  } else {
    ends = space_ends(u, chord(u), nullptr).force;
  }
  const Matrix3d to_local = axes(u);
  Vector12 local;
  for (int i : {0, 3, 6, 9}) local.segment<3>(i) = to_local * ends.segment<3>(i);
  return local;
}

Matrix3d CorotationalBeam::axes(const Vector12& u) const {
  Matrix3d e;
  e.row(0) = chord(u).direction;
  const Vector3d mean_y = is_plane_ ? Vector3d(axes_.col(1))
                                    : Vector3d((rotation(u.segment<3>(3)) + rotation(u.segment<3>(9))) * axes_.col(1));
  e.row(2) = e.row(0).cross(mean_y).normalized();
  e.row(1) = e.row(2).cross(e.row(0));
  return e;
}

}  // namespace pounding
