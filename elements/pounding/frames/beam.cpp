#include <pounding/frames/beam.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <pounding/frames/finite_rotation.hpp>
#include <pounding/frames/section_fibres.hpp>

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

// The three bending matrices for (w, t, w, t), where t = dw/dx without shear deformation.

Matrix4d bending_stiffness(double rigidity, double phi, double l) {
  const double near = (4 + phi) * l * l, far = (2 - phi) * l * l;
  Matrix4d k;
  k << 12, 6 * l, -12, 6 * l, 6 * l, near, -6 * l, far, -12, -6 * l, 12, -6 * l, 6 * l, far, -6 * l, near;
  return rigidity / ((1 + phi) * l * l * l) * k;
}

Matrix4d bending_mass(double mass, double phi, double l) {
  const double p = phi, p2 = phi * phi;
  const double a = 13.0 / 35 + 7 * p / 10 + p2 / 3, b = 9.0 / 70 + 3 * p / 10 + p2 / 6;
  const double c = (11.0 / 210 + 11 * p / 120 + p2 / 24) * l, d = (13.0 / 420 + 3 * p / 40 + p2 / 24) * l;
  const double e = (1.0 / 105 + p / 60 + p2 / 120) * l * l, f = (1.0 / 140 + p / 60 + p2 / 120) * l * l;
  Matrix4d m;
  m << a, c, b, -d, c, e, d, -f, b, d, a, -c, -d, -f, -c, e;
  return mass / ((1 + p) * (1 + p)) * m;
}

Matrix4d bending_geometric(double phi, double l) {
  const double a = 1.2 + 2 * phi + phi * phi, c = l / 10, curved = phi / 6 + phi * phi / 12;
  const double near = (2.0 / 15 + curved) * l * l, far = -(1.0 / 30 + curved) * l * l;
  Matrix4d g;
  g << a, c, -a, c, c, near, -c, far, -a, -c, a, -c, c, far, -c, near;
  return g / ((1 + phi) * (1 + phi) * l);
}

// Deflection at x = along l of a beam without load between its ends.
Eigen::RowVector4d bending_shape(double along, double phi, double l) {
  const double s = along, s2 = s * s, s3 = s2 * s;
  return Eigen::RowVector4d(1 - 3 * s2 + 2 * s3 + phi * (1 - s), l * (s - 2 * s2 + s3 + phi / 2 * (s - s2)),
                            3 * s2 - 2 * s3 + phi * s, l * (s3 - s2 + phi / 2 * (s2 - s))) /
         (1 + phi);
}

// About y, a positive rotation lowers the far end: t = -ry.
Eigen::RowVector4d turned() { return {1, -1, 1, -1}; }

// Assembles the 2 x 2 bar matrices and the bending matrices of both planes.
Matrix12 placed(const Matrix2d& along, const Matrix2d& around, Matrix4d about_y, const Matrix4d& about_z) {
  about_y = turned().asDiagonal() * about_y * turned().asDiagonal();
  Matrix12 all = Matrix12::Zero();
  all(axial, axial) = along;
  all(twist, twist) = around;
  all(bending_y, bending_y) = about_y;
  all(bending_z, bending_z) = about_z;
  return all;
}

// Along the axis, and transverse stiffness due to the axial force.
Matrix12 truss_stiffness(double along, double across) {
  Matrix12 all = Matrix12::Zero();
  for (const auto& [at, stiffness] : {std::pair(0, along), {1, across}, {2, across}}) {
    all(at, at) = all(at + 6, at + 6) = stiffness;
    all(at, at + 6) = all(at + 6, at) = -stiffness;
  }
  return all;
}

Matrix12 symmetric(const Matrix12& m) { return 0.5 * (m + m.transpose()); }

// Maps the displacements of unreleased ends to all end displacements: no force acts along the released ones.
Matrix12 release(const Matrix12& stiffness, const BeamOptions& options) {
  std::array<bool, 12> is_released{};
  for (const Dof d : options.start_releases) is_released[static_cast<int>(d)] = true;
  for (const Dof d : options.end_releases) is_released[6 + static_cast<int>(d)] = true;
  std::vector<int> released, kept;
  for (int i = 0; i < 12; ++i) (is_released[i] ? released : kept).push_back(i);
  Matrix12 follow = Matrix12::Identity();
  if (released.empty()) return follow;

  const char* mechanism = "the releases create a mechanism";
  const Eigen::VectorXd diagonal = stiffness.diagonal()(released);
  require((diagonal.array() != 0).all(), mechanism);
  // Scaled, because rotations and translations have different units.
  const Eigen::VectorXd scale = diagonal.cwiseAbs().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd block = scale.asDiagonal() * stiffness(released, released) * scale.asDiagonal();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(block);
  lu.setThreshold(1e-12);
  require(lu.isInvertible(), mechanism);
  // Only an axial force can cause this.
  require(block.llt().info() == Eigen::Success, "the member buckles between its released ends under its axial force");
  follow(released, released).setZero();
  follow(released, kept) = -(scale.asDiagonal() * lu.solve(scale.asDiagonal() * stiffness(released, kept)));
  return follow;
}

// Maps the displacements at the far side of the end springs to those of the member ends, which rotate in proportion to
// their moments.
Matrix12 through_springs(const Matrix12& stiffness, const std::vector<std::pair<int, double>>& springs) {
  Matrix12 follow = Matrix12::Identity();
  if (springs.empty()) return follow;
  std::vector<int> sprung;
  for (const auto& [place, k] : springs) sprung.push_back(place);
  Eigen::MatrixXd block = stiffness(sprung, sprung);
  for (std::size_t i = 0; i < springs.size(); ++i) block(i, i) += springs[i].second;
  const Eigen::LLT<Eigen::MatrixXd> factor(block);
  require(factor.info() == Eigen::Success, "the member buckles between its end springs under its axial force");
  follow(sprung, Eigen::all) -= factor.solve(stiffness(sprung, Eigen::all));
  return follow;
}

void check(const Section& s, const Material& m) {
  for (const double value : {s.area, s.inertia_y, m.young})
    require(value > 0 && std::isfinite(value), "area, inertia_y and young must be positive and finite");
  for (const double value : {s.inertia_z, s.torsion, m.shear, m.density})
    require(value >= 0 && std::isfinite(value),
            "inertia_z, torsion, shear and density must be finite and not negative");
  require(s.shear_area_y > 0 && s.shear_area_z > 0,
          "shear areas must be positive; infinite means no shear deformation");
  const bool shears = std::isfinite(s.shear_area_y) || std::isfinite(s.shear_area_z);
  require(m.shear > 0 || !shears, "a finite shear area needs a shear modulus");
}

void check_truss(double area, const Material& m) {
  for (const double value : {area, m.young})
    require(value > 0 && std::isfinite(value), "area and young must be positive and finite");
  require(m.density >= 0 && std::isfinite(m.density), "density must be finite and not negative");
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
  return placed(Matrix2d::Zero(), Matrix2d::Zero(), bending_geometric(phi_y(s, m, l), l),
                bending_geometric(phi_z(s, m, l), l));
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
  require(across.norm() > 1e-6 * leaning.norm(), "the reference vector is parallel to the member");
  const Vector3d y = across.normalized();
  Matrix3d axes;
  axes << x.transpose(), y.transpose(), x.cross(y).transpose();
  return axes;
}

Beam::Beam(const Vector3d& start_node, const Vector3d& end_node, const Section& section, const Material& material,
           const BeamOptions& options)
    : Beam(start_node, end_node, section, material, options, false) {}

Beam Beam::truss(const Vector3d& start_node, const Vector3d& end_node, double area, const Material& material) {
  return Beam(start_node, end_node, {.area = area}, material, {}, true);
}

Beam::Beam(const Vector3d& start_node, const Vector3d& end_node, const Section& section, const Material& material,
           const BeamOptions& options, bool is_truss)
    : section_(section),
      material_(section.fibres ? section.fibres->material : material),
      options_(options),
      is_truss_(is_truss) {
  is_truss ? check_truss(section.area, material_) : check(section, material_);
  const Vector3d along = end_node + options.end_offset - start_node - options.start_offset;
  length_ = along.norm();
  require(std::isfinite(length_), "the ends must have finite coordinates");
  // For smaller lengths, the ends differ only by the round-off of their coordinates.
  require(length_ > 1e-9 * (1 + start_node.norm() + end_node.norm()), "both ends are at the same point");
  axes_ = beam_axes(along, options.reference);
  to_local_.setZero();
  for (const int node : {0, 6}) {
    to_local_.block<3, 3>(node, node) = to_local_.block<3, 3>(node + 3, node + 3) = axes_;
    to_local_.block<3, 3>(node, node + 3) =
        -axes_ * finite_rotation::cross(node == 0 ? options.start_offset : options.end_offset);
  }
  set_axial_force(options.axial_force);
}

void Beam::set_axial_force(double force) {
  require(std::isfinite(force), "the axial force must be finite");
  condense(force);
  options_.axial_force = force;
}

void Beam::set_end_spring(int place, double stiffness) {
  require(!is_truss_, "a truss carries no moment");
  require(place == 4 || place == 5 || place == 10 || place == 11, "an end spring must act on a bending rotation");
  require(stiffness > 0 && std::isfinite(stiffness), "the stiffness of an end spring must be positive and finite");
  require(!is_released(place), "the end is released, so it transmits no moment to a spring");
  std::erase_if(end_springs_, [&](const auto& spring) { return spring.first == place; });
  end_springs_.emplace_back(place, stiffness);
  condense(options_.axial_force);
}

bool Beam::is_released(int place) const {
  const std::vector<Dof>& released = place < 6 ? options_.start_releases : options_.end_releases;
  return std::find(released.begin(), released.end(), static_cast<Dof>(place % 6)) != released.end();
}

void Beam::condense(double force) {
  Matrix12 stiffness = is_truss_ ? truss_stiffness(material_.young * section_.area / length_, force / length_)
                                 : beam_stiffness(section_, material_, length_);
  if (force != 0 && !is_truss_) stiffness += force * beam_geometric_stiffness(section_, material_, length_);
  const Matrix12 released = release(stiffness, options_);
  local_stiffness_ = symmetric(released.transpose() * stiffness * released);
  follow_ = released;
  if (end_springs_.empty()) return;
  const Matrix12 through = through_springs(local_stiffness_, end_springs_);
  // The springs transmit the same forces, K times the rotated ends.
  local_stiffness_ = symmetric(local_stiffness_ * through);
  follow_ = released * through;
}

Matrix12 Beam::stiffness() const { return symmetric(to_local_.transpose() * local_stiffness_ * to_local_); }

Matrix12 Beam::mass() const {
  if (options_.mass == BeamMass::consistent) {
    const Matrix12 to_ends = follow_ * to_local_;
    return symmetric(to_ends.transpose() * beam_mass(section_, material_, length_) * to_ends);
  }
  Vector12 diagonal = Vector12::Zero();
  diagonal.segment<3>(0).setConstant(total_mass() / 2);
  diagonal.segment<3>(6).setConstant(total_mass() / 2);
  return diagonal.asDiagonal();
}

Vector12 Beam::end_forces(const Vector12& displacements) const { return end_force_matrix() * displacements; }

Matrix12 Beam::end_force_matrix() const { return local_stiffness_ * to_local_; }

Vector12 Beam::fixed_end_forces(const Vector3d& per_length) const {
  const Vector3d local = axes_ * per_length;
  Vector12 held = Vector12::Zero();
  held.segment<3>(0) = held.segment<3>(6) = -0.5 * length_ * local;
  if (is_truss_) return held;
  // A uniform load shears both halves of the beam equally, so shear deformation does not affect its end moments.
  const double arm = length_ * length_ / 12;
  held[4] = arm * local.z();
  held[5] = -arm * local.y();
  held[10] = -held[4];
  held[11] = -held[5];
  return follow_.transpose() * held;
}

Vector12 Beam::fixed_end_forces_of_weight() const {
  if (options_.mass == BeamMass::lumped) return Vector12::Zero();
  return fixed_end_forces({0, 0, -material_.density * section_.area});
}

Eigen::Matrix<double, 3, 12> Beam::shape_at(double along) const {
  require(along >= 0 && along <= 1, "the position of a point on a member must be in [0, 1]");
  Eigen::Matrix<double, 3, 12> shape = Eigen::Matrix<double, 3, 12>::Zero();
  shape(0, 0) = 1 - along;
  shape(0, 6) = along;
  if (is_truss_) {
    shape(1, 1) = shape(2, 2) = 1 - along;
    shape(1, 7) = shape(2, 8) = along;
    return shape;
  }
  shape(1, bending_z) = bending_shape(along, phi_z(section_, material_, length_), length_);
  shape(2, bending_y) = bending_shape(along, phi_y(section_, material_, length_), length_).cwiseProduct(turned());
  return shape * follow_;
}

Eigen::Matrix<double, 3, 12> Beam::motion_at(double along) const {
  return axes_.transpose() * shape_at(along) * to_local_;
}

// Betti's theorem: the forces on the fixed ends follow from the displacement of the point due to those of the ends.
Eigen::Matrix<double, 12, 3> Beam::fixed_end_forces_at(double along) const {
  return -shape_at(along).transpose() * axes_;
}

Vector12 Beam::at_nodes(const Vector12& on_ends) const { return to_local_.transpose() * on_ends; }

}  // namespace pounding
