#include <pounding/beam.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <string>

namespace pounding {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr std::array axial{0, 6}, twist{3, 9};
// Deflection and rotation of the start, then of the end.
constexpr std::array bending_y{2, 4, 8, 10}, bending_z{1, 5, 7, 11};

void require(bool holds, const char* text) {
  if (!holds) throw std::invalid_argument(text);
}

double shear_factor(double young, double inertia, double shear, double shear_area, double length) {
  return std::isinf(shear_area) ? 0 : 12 * young * inertia / (shear * shear_area * length * length);
}

double phi_y(const Section& s, const Material& m, double l) {
  return shear_factor(m.young, s.inertia_y, m.shear, s.shear_area_z, l);
}

double phi_z(const Section& s, const Material& m, double l) {
  return shear_factor(m.young, s.inertia_z, m.shear, s.shear_area_y, l);
}

// The three matrices of bending for (w, t, w, t), where t = dw/dx when there is no shear.

Matrix4d bending_stiffness(double rigidity, double phi, double l) {
  const double near = (4 + phi) * l * l, far = (2 - phi) * l * l;
  Matrix4d k;
  k << 12, 6 * l, -12, 6 * l,
      6 * l, near, -6 * l, far,
      -12, -6 * l, 12, -6 * l,
      6 * l, far, -6 * l, near;
  return rigidity / ((1 + phi) * l * l * l) * k;
}

Matrix4d bending_mass(double mass, double phi, double l) {
  const double p = phi, p2 = phi * phi;
  const double a = 13.0 / 35 + 7 * p / 10 + p2 / 3, b = 9.0 / 70 + 3 * p / 10 + p2 / 6;
  const double c = (11.0 / 210 + 11 * p / 120 + p2 / 24) * l, d = (13.0 / 420 + 3 * p / 40 + p2 / 24) * l;
  const double e = (1.0 / 105 + p / 60 + p2 / 120) * l * l, f = (1.0 / 140 + p / 60 + p2 / 120) * l * l;
  Matrix4d m;
  m << a, c, b, -d,
      c, e, d, -f,
      b, d, a, -c,
      -d, -f, -c, e;
  return mass / ((1 + p) * (1 + p)) * m;
}

Matrix4d bending_geometric(double phi, double l) {
  const double a = 1.2 + 2 * phi + phi * phi, c = l / 10, curved = phi / 6 + phi * phi / 12;
  const double near = (2.0 / 15 + curved) * l * l, far = -(1.0 / 30 + curved) * l * l;
  Matrix4d g;
  g << a, c, -a, c,
      c, near, -c, far,
      -a, -c, a, -c,
      c, far, -c, near;
  return g / ((1 + phi) * (1 + phi) * l);
}

// A bar's two by two, and both bendings, at their places. About y a positive rotation lowers the far end: t = -ry.
Matrix12 placed(const Matrix2d& along, const Matrix2d& around, Matrix4d about_y, const Matrix4d& about_z) {
  const Eigen::Vector4d sign(1, -1, 1, -1);
  about_y = sign.asDiagonal() * about_y * sign.asDiagonal();
  Matrix12 all = Matrix12::Zero();
  all(axial, axial) = along;
  all(twist, twist) = around;
  all(bending_y, bending_y) = about_y;
  all(bending_z, bending_z) = about_z;
  return all;
}

Matrix12 symmetric(const Matrix12& m) { return 0.5 * (m + m.transpose()); }

Matrix3d cross(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// All displacements of the ends from those that are not released: no force acts along the released ones.
Matrix12 release(const Matrix12& stiffness, const BeamOptions& options) {
  std::array<bool, 12> is_released{};
  for (const Dof d : options.start_releases) is_released[static_cast<int>(d)] = true;
  for (const Dof d : options.end_releases) is_released[6 + static_cast<int>(d)] = true;
  std::vector<int> released, kept;
  for (int i = 0; i < 12; ++i) (is_released[i] ? released : kept).push_back(i);
  Matrix12 follow = Matrix12::Identity();
  if (released.empty()) return follow;

  const char* mechanism = "the releases leave a mechanism";
  const Eigen::VectorXd diagonal = stiffness.diagonal()(released);
  require((diagonal.array() != 0).all(), mechanism);
  // Scaled, since rotations and translations have different units.
  const Eigen::VectorXd scale = diagonal.cwiseAbs().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd block = scale.asDiagonal() * stiffness(released, released) * scale.asDiagonal();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(block);
  lu.setThreshold(1e-12);
  require(lu.isInvertible(), mechanism);
  follow(released, released).setZero();
  follow(released, kept) = -(scale.asDiagonal() * lu.solve(scale.asDiagonal() * stiffness(released, kept)));
  return follow;
}

void check(const Section& s, const Material& m) {
  for (const double value : {s.area, s.inertia_y, m.young})
    require(value > 0 && std::isfinite(value), "area, inertia_y and young must be positive and finite");
  for (const double value : {s.inertia_z, s.torsion, m.shear, m.density})
    require(value >= 0 && std::isfinite(value), "inertia_z, torsion, shear and density must be finite and not negative");
  require(s.shear_area_y > 0 && s.shear_area_z > 0, "shear areas must be positive, infinite without shear deformation");
  const bool shears = std::isfinite(s.shear_area_y) || std::isfinite(s.shear_area_z);
  require(m.shear > 0 || !shears, "a finite shear area needs a shear modulus");
}

}  // namespace

Matrix12 beam_stiffness(const Section& s, const Material& m, double l) {
  Matrix2d bar;
  bar << 1, -1, -1, 1;
  return placed(m.young * s.area / l * bar, m.shear * s.torsion / l * bar,
                bending_stiffness(m.young * s.inertia_y, phi_y(s, m, l), l),
                bending_stiffness(m.young * s.inertia_z, phi_z(s, m, l), l));
}

Matrix12 beam_mass(const Section& s, const Material& m, double l) {
  const double mass = m.density * s.area * l;
  Matrix2d bar;
  bar << 2, 1, 1, 2;
  return placed(mass / 6 * bar, m.density * (s.inertia_y + s.inertia_z) * l / 6 * bar,
                bending_mass(mass, phi_y(s, m, l), l), bending_mass(mass, phi_z(s, m, l), l));
}

Matrix12 beam_geometric_stiffness(const Section& s, const Material& m, double l) {
  return placed(Matrix2d::Zero(), Matrix2d::Zero(),
                bending_geometric(phi_y(s, m, l), l), bending_geometric(phi_z(s, m, l), l));
}

Matrix6 in_plane(const Matrix12& matrix) {
  constexpr std::array rows{0, 2, 4, 6, 8, 10};
  return matrix(rows, rows);
}

Matrix3d beam_axes(const Vector3d& direction, const std::optional<Vector3d>& reference) {
  const Vector3d x = direction.normalized();
  const bool vertical = std::hypot(x.x(), x.y()) < 1e-6;
  const Vector3d leaning = reference.value_or(vertical ? Vector3d(-1, 0, 0) : Vector3d(0, 0, 1));
  const Vector3d across = leaning.cross(x);
  require(across.norm() > 1e-6 * leaning.norm(), "the reference vector lies along the member");
  const Vector3d y = across.normalized();
  Matrix3d axes;
  axes << x.transpose(), y.transpose(), x.cross(y).transpose();
  return axes;
}

Beam::Beam(const Vector3d& start_node, const Vector3d& end_node, const Section& section, const Material& material,
           const BeamOptions& options)
    : mass_per_length_(material.density * section.area), mass_kind_(options.mass) {
  check(section, material);
  const Vector3d along = end_node + options.end_offset - start_node - options.start_offset;
  length_ = along.norm();
  require(std::isfinite(length_), "its ends must have finite coordinates");
  // Below this the ends differ by the rounding of their coordinates.
  require(length_ > 1e-9 * (1 + start_node.norm() + end_node.norm()), "its two ends are at one point");
  require(std::isfinite(options.axial_force), "the axial force must be finite");
  axes_ = beam_axes(along, options.reference);

  Matrix12 stiffness = beam_stiffness(section, material, length_);
  if (options.axial_force != 0) stiffness += options.axial_force * beam_geometric_stiffness(section, material, length_);
  const Matrix12 follow = release(stiffness, options);
  local_stiffness_ = symmetric(follow.transpose() * stiffness * follow);
  local_mass_ = symmetric(follow.transpose() * beam_mass(section, material, length_) * follow);

  to_local_.setZero();
  for (const int node : {0, 6}) {
    to_local_.block<3, 3>(node, node) = to_local_.block<3, 3>(node + 3, node + 3) = axes_;
    to_local_.block<3, 3>(node, node + 3) = -axes_ * cross(node == 0 ? options.start_offset : options.end_offset);
  }
}

Matrix12 Beam::stiffness() const { return symmetric(to_local_.transpose() * local_stiffness_ * to_local_); }

Matrix12 Beam::mass() const {
  if (mass_kind_ == BeamMass::consistent) return symmetric(to_local_.transpose() * local_mass_ * to_local_);
  Vector12 diagonal = Vector12::Zero();
  diagonal.segment<3>(0).setConstant(total_mass() / 2);
  diagonal.segment<3>(6).setConstant(total_mass() / 2);
  return diagonal.asDiagonal();
}

Vector12 Beam::end_forces(const Vector12& displacements) const { return local_stiffness_ * (to_local_ * displacements); }

}  // namespace pounding
