#include <pounding/frames/fibre_member.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

#include <pounding/core/refuse.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

using Vector6 = FibreMember::Iterate::Vector6;

/// Sizes of a plane member (two section deformations) and of a member in space (three).
template <int section_size>
constexpr int basic_size = section_size == 2 ? 3 : 6;

template <int size>
Eigen::Matrix<double, size, size> stiffness_of(const sections::SectionResponse& response) {
  const auto& k = response.stiffness;
  Eigen::Matrix3d all;
  all << k[0], k[1], k[2], k[1], k[3], k[4], k[2], k[4], k[5];
  return all.topLeftCorner<size, size>();
}

template <int size, class Values>
auto head(Values& values) {
  using Vector = Eigen::Matrix<double, size, 1>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Values>, const Vector, Vector>>(values.data());
}

/// Positive definite matrix close to a stiffness without inverse: residuals remain exact, only the rate of convergence
/// suffers.
template <class Matrix>
Matrix bounded(Matrix k, const Eigen::Matrix3d& initial) {
  constexpr int size = Matrix::RowsAtCompileTime;
  constexpr double coupling = size == 2 ? 0.995 : 0.49;
  for (int i = 0; i < size; ++i) k(i, i) = std::max(k(i, i), 1e-6 * initial(i, i));
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < i; ++j) {
      const double limit = coupling * std::sqrt(k(i, i) * k(j, j));
      k(i, j) = k(j, i) = std::clamp(k(i, j), -limit, limit);
    }
  return k;
}

/// Basic deformations for displacements of the ends, in local axes.
Eigen::Matrix<double, 6, 12> basic_of_ends(double length) {
  Eigen::Matrix<double, 6, 12> b = Eigen::Matrix<double, 6, 12>::Zero();
  b(0, 0) = -1, b(0, 6) = 1;
  b(5, 3) = -1, b(5, 9) = 1;
  for (const int i : {1, 2}) {
    // Rotation relative to the chord, which turns by -t/L about y and by t/L about z.
    b(i, 2) = -1 / length, b(i, 8) = 1 / length, b(i, i == 1 ? 4 : 10) = 1;
    b(i + 2, 1) = 1 / length, b(i + 2, 7) = -1 / length, b(i + 2, i == 1 ? 5 : 11) = 1;
  }
  return b;
}

/// Transverse displacement of the end relative to the start along local z, and in space along y.
Matrix12 chord_stiffness(double axial_force, double length, bool is_plane) {
  Matrix12 k = Matrix12::Zero();
  for (const int i : {1, 2})
    if (!is_plane || i == 2) {
      k(i, i) = k(i + 6, i + 6) = axial_force / length;
      k(i, i + 6) = k(i + 6, i) = -axial_force / length;
    }
  return k;
}

/// Basic deformations for the deformations of Corotation in space.
Eigen::Matrix<double, 6, 7> basic_of_corotation() {
  Eigen::Matrix<double, 6, 7> b = Eigen::Matrix<double, 6, 7>::Zero();
  b(0, 3) = b(1, 1) = b(2, 5) = b(3, 2) = b(4, 6) = b(5, 4) = 1;
  b(5, 0) = -1;
  return b;
}

constexpr std::array plane_dofs{0, 2, 4, 6, 8, 10};

/// Slow iterations after which softening sections have a bounded flexibility, and every such number of iterations
/// takes half of its step, which ends cycles between two sides of a corner.
constexpr int max_slow = 4;
/// Largest change of section strains in an iteration: larger ones overshoot the corners of the materials.
constexpr double max_change = 0.003;

}  // namespace

FibreMember::FibreMember(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const BeamOptions& options,
                         std::shared_ptr<const sections::FibreSection> section, FibreMemberOptions fibres,
                         int dimension)
    : section_(std::move(section)), options_(std::move(fibres)), is_plane_(dimension == 2) {
  if (!options.start_releases.empty() || !options.end_releases.empty())
    refuse("a fibre member has no releases; add a hinge between its end and the node");
  if (options.axial_force != 0) refuse("a fibre member has its axial force at rest in the options of its fibres");
  if (options_.axial_force != 0 && options_.geometry != FrameGeometry::p_delta)
    refuse("an axial force at rest needs the geometry p_delta");
  const Beam line(start_node, end_node, {.area = 1, .inertia_y = 1}, {.young = 1}, options);
  length_ = line.length();
  to_local_ = line.to_local();
  if (options_.geometry == FrameGeometry::corotational) corotation_.emplace(line, start_node, end_node);

  const bool by_forces = options_.formulation == MemberFormulation::force;
  options_.rule.check();
  if (!by_forces && !options_.rule.elastic.empty())
    refuse("a rule with elastic points needs the formulation by forces");
  for (const double shear : {options_.shear_stiffness_y, options_.shear_stiffness_z}) {
    if (!(shear > 0)) laws::refuse("shear stiffness", shear, "positive");
    if (!by_forces && std::isfinite(shear)) refuse("shear deformation needs the formulation by forces");
  }
  if (!is_plane_) laws::require_positive("torsion stiffness of a member in space", options_.torsion_stiffness);

  const auto& [low, high] = section_->extent();
  scale_ = {1, 0.5 * (high.z - low.z), 0.5 * (high.y - low.y)};
  initial_section_ = stiffness_of<3>(section_->evaluate(section_->states(), {}));
  Eigen::Matrix3d flexibility = Eigen::Matrix3d::Zero();
  const int size = is_plane_ ? 2 : 3;
  const Eigen::MatrixXd initial = initial_section_.topLeftCorner(size, size);
  initial_determinant_ = initial.determinant();
  if (!(initial_determinant_ > 1e-12 * initial.diagonal().prod()))
    refuse(is_plane_ ? "the fibres of a section have no initial stiffness for bending about y"
                     : "the fibres of a section have no initial stiffness for bending about y and z");
  flexibility.topLeftCorner(size, size) = initial.inverse();

  for (const auto& [at, weight] : options_.rule.points) {
    shapes_.push_back(interpolation(at));
    weights_.push_back(weight * length_);
  }
  elastic_flexibility_.setZero();
  for (const auto& [at, weight] : options_.rule.elastic) {
    const Interpolation b = interpolation(at);
    elastic_flexibility_ += weight * length_ * b.transpose() * flexibility * b;
  }
  elastic_flexibility_.block<2, 2>(1, 1).array() += 1 / (options_.shear_stiffness_z * length_);
  elastic_flexibility_.block<2, 2>(3, 3).array() += 1 / (options_.shear_stiffness_y * length_);
  if (!is_plane_) elastic_flexibility_(5, 5) = length_ / options_.torsion_stiffness;

  const Eigen::Matrix<double, 6, 12> to_basic = basic_of_ends(length_) * to_local_;
  const Matrix12 geometric =
      to_local_.transpose() * chord_stiffness(options_.axial_force, length_, is_plane_) * to_local_;
  to_basic_ = to_basic, geometric_ = geometric;
  if (!is_plane_) return;
  to_basic_.topLeftCorner<3, 6>() = to_basic(std::array{0, 1, 2}, plane_dofs);
  geometric_.topLeftCorner<6, 6>() = geometric(plane_dofs, plane_dofs);
}

FibreMember::Interpolation FibreMember::interpolation(double at) const {
  double first = at - 1, second = at, axial = 1;
  if (options_.formulation == MemberFormulation::displacement)
    first = (6 * at - 4) / length_, second = (6 * at - 2) / length_, axial = 1 / length_;
  Interpolation b = Interpolation::Zero();
  b(0, 0) = axial;
  b(1, 1) = first, b(1, 2) = second;
  if (!is_plane_) b(2, 3) = first, b(2, 4) = second;
  return b;
}

void FibreMember::begin(const State& state, Iterate& iterate) const {
  iterate.forces = head<6>(state.forces);
  iterate.deformations = head<6>(state.basic_deformations);
  iterate.sections.resize(shapes_.size());
  for (std::size_t k = 0; k < shapes_.size(); ++k) iterate.sections[k].deformation = state.deformations[k];
  iterate.change = 0, iterate.slow = 0;
  iterate.times.clear();
  iterate.stages.clear();
  is_plane_ ? evaluate<2>(state, iterate) : evaluate<3>(state, iterate);
}

template <int section_size>
double FibreMember::correct(Iterate& iterate, const Vector6& deformations) const {
  constexpr int size = basic_size<section_size>;
  using Basic = Eigen::Matrix<double, size, 1>;
  using Section = Eigen::Matrix<double, section_size, 1>;
  const Basic v = deformations.head<size>();
  const Basic missing = iterate.residual.head<size>() + v - iterate.deformations.head<size>();
  const Basic change = iterate.stiffness.topLeftCorner<size, size>() * missing;
  const bool by_forces = options_.formulation == MemberFormulation::force;
  iterate.deformations.head<size>() = v;
  double largest = 0;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    auto& section = iterate.sections[k];
    const auto shape = shapes_[k].topLeftCorner<section_size, size>();
    auto step = head<section_size>(section.change);
    if (by_forces)
      step = section.flexibility.topLeftCorner<section_size, section_size>() *
             Section(shape * change + head<section_size>(section.residual));
    else
      step = shape * v - head<section_size>(section.deformation);
    double strain = 0;
    for (int i = 0; i < section_size; ++i) strain += scale_[i] * std::abs(step[i]);
    largest = std::max(largest, strain);
  }
  double fraction = 1;
  if (by_forces && largest > max_change) fraction = max_change / largest;
  if (by_forces && iterate.slow >= max_slow && iterate.slow % max_slow == 0) fraction *= 0.5;
  if (by_forces) iterate.forces.head<size>() += fraction * change;
  iterate.residual.head<size>() = (1 - fraction) * missing;
  for (auto& section : iterate.sections) {
    head<section_size>(section.deformation) += fraction * head<section_size>(section.change);
    head<section_size>(section.residual) *= 1 - fraction;
  }
  return largest;
}

template <int section_size>
void FibreMember::evaluate(const State& state, Iterate& iterate) const {
  constexpr int size = basic_size<section_size>;
  using Basic = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  using SectionMatrix = Eigen::Matrix<double, section_size, section_size>;
  const bool by_forces = options_.formulation == MemberFormulation::force;
  const Basic q = iterate.forces.head<size>();
  Matrix sum = Matrix::Zero();
  Basic basic = Basic::Zero();
  if (by_forces) {
    sum = elastic_flexibility_.topLeftCorner<size, size>();
    basic = iterate.deformations.head<size>() - sum * q;
  }
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    auto& section = iterate.sections[k];
    const sections::SectionResponse response = section_->evaluate(state.fibres[k], section.deformation);
    const SectionMatrix stiffness = stiffness_of<section_size>(response);
    const auto s = head<section_size>(response.force);
    const auto shape = shapes_[k].topLeftCorner<section_size, size>();
    if (by_forces) {
      auto r = head<section_size>(section.residual);
      r = shape * q - s;
      const double determinant = stiffness.determinant();
      const double size_of_it = iterate.slow < max_slow ? std::abs(determinant) : determinant;
      const bool is_singular = !(size_of_it > 1e-9 * initial_determinant_);
      const SectionMatrix flexibility =
          is_singular ? bounded(stiffness, initial_section_).inverse().eval() : stiffness.inverse().eval();
      section.flexibility.topLeftCorner<section_size, section_size>() = flexibility;
      basic -= weights_[k] * (shape.transpose() * (head<section_size>(section.deformation) + flexibility * r));
      sum += weights_[k] * (shape.transpose() * flexibility * shape);
    } else {
      basic += weights_[k] * (shape.transpose() * s);
      sum += weights_[k] * (shape.transpose() * stiffness * shape);
    }
  }
  if (by_forces) {
    iterate.residual.head<size>() = basic;
    iterate.stiffness.topLeftCorner<size, size>() = sum.inverse();
  } else {
    if constexpr (section_size == 3) {
      sum(5, 5) = 1 / elastic_flexibility_(5, 5);
      basic[5] = sum(5, 5) * iterate.deformations[5];
    }
    iterate.forces.head<size>() = basic;
    iterate.stiffness.topLeftCorner<size, size>() = sum;
  }
}

template <int section_size>
double FibreMember::linearize_in(const State& state, Iterate& iterate, const Vector12& u, Vector12& force,
                                 Matrix12& tangent) const {
  constexpr int size = basic_size<section_size>, columns = 2 * size, stride = 12 / columns;
  double change = 0;
  const auto step = [&](const Vector6& deformations) {
    change = correct<section_size>(iterate, deformations);
    const bool is_slow = change > 1e-10 && change > 0.5 * iterate.change;
    iterate.slow = is_slow || iterate.slow >= max_slow ? iterate.slow + 1 : 0;
    iterate.change = change;
    evaluate<section_size>(state, iterate);
    return iterate.linearized_forces();
  };
  if (!corotation_) {
    using Nodes = Eigen::Matrix<double, columns, 1>;
    const auto to_basic = to_basic_.topLeftCorner<size, columns>();
    const auto geometric = geometric_.topLeftCorner<columns, columns>();
    const Nodes at = Eigen::Map<const Nodes, 0, Eigen::InnerStride<stride>>(u.data());
    Vector6 v = Vector6::Zero();
    v.head<size>() = to_basic * at;
    const Vector6 q = step(v);
    const Nodes f = to_basic.transpose() * q.head<size>() + geometric * at;
    const Eigen::Matrix<double, columns, columns> k =
        to_basic.transpose() * (iterate.stiffness.topLeftCorner<size, size>() * to_basic) + geometric;
    if constexpr (stride > 1) force.setZero(), tangent.setZero();
    for (int j = 0; j < columns; ++j) {
      force[stride * j] = f[j];
      for (int i = 0; i < columns; ++i) tangent(stride * i, stride * j) = 0.5 * (k(i, j) + k(j, i));
    }
  } else if constexpr (section_size == 2) {
    const Corotation::Plane motion = corotation_->plane(u);
    Vector6 v = Vector6::Zero();
    v.head<3>() = motion.deformations;
    const Eigen::Vector3d q = step(v).template head<3>();
    force = corotation_->nodal_forces(motion, q);
    tangent = corotation_->tangent(motion, q, iterate.stiffness.topLeftCorner<3, 3>());
  } else {
    const Corotation::Space motion = corotation_->space(u);
    const auto to_basic = basic_of_corotation();
    const Corotation::Vector7 q = to_basic.transpose() * step(to_basic * motion.deformations);
    force = corotation_->nodal_forces(motion, u, q);
    tangent = corotation_->tangent(motion, u, q, to_basic.transpose() * iterate.stiffness * to_basic);
  }
  return change;
}

double FibreMember::linearize(const State& state, Iterate& iterate, const Vector12& displacements, Vector12& force,
                              Matrix12& tangent) const {
  return is_plane_ ? linearize_in<2>(state, iterate, displacements, force, tangent)
                   : linearize_in<3>(state, iterate, displacements, force, tangent);
}

Vector6 FibreMember::basic_deformations(const Vector12& u) const {
  Vector6 v = Vector6::Zero();
  if (corotation_ && is_plane_)
    v.head<3>() = corotation_->plane(u).deformations;
  else if (corotation_)
    v = basic_of_corotation() * corotation_->space(u).deformations;
  else if (is_plane_)
    v.head<3>() = to_basic_.topLeftCorner<3, 6>() * u(plane_dofs);
  else
    v = to_basic_ * u;
  return v;
}

double FibreMember::update(Iterate& iterate, const Vector12& displacements) const {
  const Vector6 v = basic_deformations(displacements);
  return is_plane_ ? correct<2>(iterate, v) : correct<3>(iterate, v);
}

double FibreMember::potential(const Vector12& u) const {
  const Vector12 ends = to_local_ * u;
  return 0.5 * ends.dot(chord_stiffness(options_.axial_force, length_, is_plane_) * ends);
}

Vector12 FibreMember::nodal_forces(const Vector6& q, const Vector12& u) const {
  if (corotation_ && is_plane_) return corotation_->nodal_forces(corotation_->plane(u), q.head<3>());
  if (corotation_) return corotation_->nodal_forces(corotation_->space(u), u, basic_of_corotation().transpose() * q);
  return to_local_.transpose() * end_forces(q, u);
}

Vector12 FibreMember::end_forces(const Vector6& q, const Vector12& u) const {
  if (corotation_ && is_plane_) return corotation_->end_forces(corotation_->plane(u), q.head<3>());
  if (corotation_) return corotation_->end_forces(corotation_->space(u), basic_of_corotation().transpose() * q);
  return basic_of_ends(length_).transpose() * q +
         chord_stiffness(options_.axial_force, length_, is_plane_) * (to_local_ * u);
}

Matrix12 FibreMember::initial_stiffness() const {
  Iterate iterate;
  begin(undeformed(), iterate);
  const Eigen::Matrix<double, 6, 12> to_basic = basic_of_ends(length_) * to_local_;
  return to_basic.transpose() * iterate.stiffness * to_basic;
}

}  // namespace pounding
