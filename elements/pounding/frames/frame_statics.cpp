#include <pounding/frames/frame.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/frame_dofs.hpp>
#include <pounding/frames/static_solver.hpp>

namespace pounding {

using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace frame_dofs;

namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// factors * rows, for few columns with entries: a general product would visit all columns.
SparseRows combined(const Eigen::MatrixXd& factors, const SparseRows& rows) {
  SparseRows sums(factors.rows(), rows.cols());
  sums.reserve(factors.rows() * rows.nonZeros());
  std::map<Eigen::Index, double> sum;
  for (Eigen::Index i = 0; i < factors.rows(); ++i) {
    sum.clear();
    for (Eigen::Index k = 0; k < factors.cols(); ++k)
      for (SparseRows::InnerIterator it(rows, k); factors(i, k) != 0 && it; ++it)
        sum[it.col()] += factors(i, k) * it.value();
    sums.startVec(i);
    for (const auto& [column, value] : sum) sums.insertBack(i, column) = value;
  }
  sums.finalize();
  return sums;
}

}  // namespace

// Stiffness of the stiffest spring to the ground that these displacements of all nodes stretch, as text; empty if there
// is none.
std::string Frame::spring_against(const VectorXd& displacements) const {
  const auto turns = [&](int at) { return is_rotation(dofs_of(dimension_)[at % dofs()]); };
  double largest[] = {0, 0}, stiffest[] = {0, 0};
  for (int at = 0; at < displacements.size(); ++at)
    largest[turns(at)] = std::max(largest[turns(at)], std::abs(displacements[at]));
  for (const auto& [at, stiffness] : ground_springs_)
    if (std::abs(displacements[at]) > 1e-3 * largest[turns(at)])
      stiffest[turns(at)] = std::max(stiffest[turns(at)], stiffness);
  if (stiffest[0] > 0) return format_quantity(stiffest[0], dimension::stiffness);
  return stiffest[1] > 0 ? fmt::format("{:.4g} N m", stiffest[1]) : "";
}

// Names the node with the largest displacement in a mode; a rotation only if no node moves.
void Frame::refuse_to_hold(const VectorXd& mode, bool buckles, const AssembledFrame& frame) const {
  int at[2] = {-1, -1};  // largest translation, largest rotation
  for (int j = 0; j < frame.size(); ++j) {
    int& largest = at[is_rotation(frame.unknowns[j].second)];
    // With a margin, so that the first of equal values is named.
    if (largest < 0 || std::abs(mode[j]) > 1.000001 * std::abs(mode[largest])) largest = j;
  }
  double size = 0;
  for (const Vector3d& position : positions_) size = std::max(size, (position - positions_.front()).norm());
  const bool turns = at[0] < 0 || (at[1] >= 0 && std::abs(mode[at[0]]) < 1e-6 * size * std::abs(mode[at[1]]));
  const auto [node, dof] = frame.unknowns[at[turns]];
  const std::string where = node_text(node) + name(dof) + ": ";

  const auto pressed = std::min_element(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return a.beam.axial_force() < b.beam.axial_force();
  });
  if (!buckles || pressed == members_.end() || !(pressed->beam.axial_force() < 0)) {
    if (const std::string spring = spring_against(frame.transform * mode); !spring.empty())
      refuse(fmt::format(
          "{}only a spring of {} resists this displacement, and it is below the round-off of the member stiffness; "
          "check its unit, as in springs: {{ux: 20 MN/m, ry: 100 MN m}}, or fix the displacement",
          where, spring));
    refuse(where + "the frame has no stiffness against this displacement; fix, brace or connect it");
  }
  const int member = static_cast<int>(pressed - members_.begin());
  refuse(fmt::format("{}the frame buckles here under its axial forces; maximum compression: {:.4g} N in member {}",
                     where, -pressed->beam.axial_force(), member_name(member)));
}

VectorXd Frame::rest(const AssembledFrame& assembled) const {
  StaticSolver solver(assembled.stiffness);
  if (!solver.holds()) refuse_to_hold(solver.mode(), solver.buckles(), assembled);
  if (assembled.load_at_rest.isZero(0)) return VectorXd::Zero(assembled.size());
  return solver.solve(assembled.load_at_rest);
}

void Frame::add_p_delta(bool gravity) {
  Frame trial = *this;
  VectorXd force = VectorXd::Zero(members());
  for (int round = 0; round < 100; ++round) {
    for (int member = 0; member < members(); ++member) trial.set_axial_force(member, force[member]);
    const AssembledFrame assembled = trial.assemble(gravity);
    const VectorXd q = trial.rest(assembled);
    const VectorXd before = force;
    for (int member = 0; member < members(); ++member) {
      const Vector12 ends = trial.end_forces(member, assembled, q) + trial.fixed_end_forces(member, gravity);
      force[member] = (ends[6] - ends[0]) / 2;  // mean value along the member
    }
    if (members() == 0 || (force - before).cwiseAbs().maxCoeff() <= 1e-10 * force.cwiseAbs().maxCoeff()) {
      *this = std::move(trial);
      return;
    }
  }
  refuse("the axial forces of P-Delta do not converge: the frame is close to buckling under its own loads");
}

// Rows of a matrix with one row per displacement that belong to the nodes of a member, in the order of Vector12.
SparseRows Frame::member_motion(int member, const SparseRows& of_all) const {
  const Member& m = of(member);
  SparseRows rows(12, of_all.cols());
  rows.reserve(12);
  for (int i = 0; i < 12; ++i) {
    rows.startVec(i);
    const Dof dof = static_cast<Dof>(i % 6);
    if (place(dimension_, dof) < 0) continue;
    for (SparseRows::InnerIterator it(of_all, index(i < 6 ? m.start : m.end, dof)); it; ++it)
      rows.insertBack(i, it.col()) = it.value();
  }
  rows.finalize();
  return rows;
}

Vector12 Frame::end_forces(int member, const AssembledFrame& assembled, const VectorXd& q) const {
  return of(member).beam.end_forces(member_motion(member, assembled.transform) * q);
}

SparseRows Frame::end_force_rows(int member, const AssembledFrame& assembled) const {
  return combined(of(member).beam.end_force_matrix(), member_motion(member, assembled.transform));
}

Eigen::Matrix<double, 12, 3> Frame::enforced_end_forces(int member, const Eigen::MatrixX3d& enforced) const {
  const Member& m = of(member);
  Eigen::Matrix<double, 12, 3> motion = Eigen::Matrix<double, 12, 3>::Zero();
  for (const auto& [node, first] : {std::pair(m.start, 0), {m.end, 6}})
    for (const Dof dof : dofs_of(dimension_))
      motion.row(first + static_cast<int>(dof)) = enforced.row(index(node, dof));
  return m.beam.end_force_matrix() * motion;
}

Vector12 Frame::fixed_end_forces(int member, bool gravity) const {
  const Member& m = of(member);
  Vector12 held = m.beam.fixed_end_forces(m.load);
  if (gravity) held += standard_gravity * m.beam.fixed_end_forces_of_weight();
  return held;
}

Frame::PointOnMember Frame::point_on_member(int member, double along, const AssembledFrame& assembled) const {
  const Beam& beam = of(member).beam;
  if (!(along >= 0 && along <= 1))
    refuse(fmt::format("member {}: the position of a point must be in [0, 1], but is {}", member_name(member), along));
  const auto at_point = [&](const SparseRows& of_all) {
    const SparseRows rows = combined(beam.motion_at(along), member_motion(member, of_all));
    std::array<Eigen::SparseVector<double>, 3> by_axis;
    for (int axis = 0; axis < 3; ++axis) by_axis[axis] = rows.row(axis).transpose();
    return by_axis;
  };
  PointOnMember point;
  point.motion = at_point(assembled.transform);
  SparseRows every(assembled.transform.rows(), assembled.transform.rows());
  every.setIdentity();
  point.supported = at_point(every);
  point.fixed_ends = beam.fixed_end_forces_at(along);
  return point;
}

Frame::SupportMotion Frame::support_motion(const std::vector<int>& nodes, const AssembledFrame& assembled) const {
  const int all = static_cast<int>(positions_.size()) * dofs();
  Eigen::MatrixX3d supports = Eigen::MatrixX3d::Zero(all, 3);  // displacements enforced by these supports
  Eigen::MatrixX3d pulls = Eigen::MatrixX3d::Zero(all, 3);     // forces of their springs on fixed nodes
  for (const int node : std::set<int>(nodes.begin(), nodes.end())) {
    bool supports_something = false;
    for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz}) {
      if (place(dimension_, dof) < 0) continue;
      const int at = index(node, dof), axis = static_cast<int>(dof);
      if (fixed_.contains(at)) supports(at, axis) = 1, supports_something = true;
      for (const auto& [of, stiffness] : ground_springs_)
        if (of == at) pulls(at, axis) += stiffness, supports_something = true;
    }
    if (!supports_something)
      refuse(node_text(node) + "not a support: neither fixed nor connected to a spring to the ground");
  }
  const Eigen::SparseMatrix<double> t = assembled.transform;
  SupportMotion motion;
  motion.enforced = assembled.supported * supports;
  StaticSolver solver(assembled.stiffness);
  if (!solver.holds()) refuse_to_hold(solver.mode(), solver.buckles(), assembled);
  motion.influence = solver.solve(t.transpose() * (pulls - gathered(springs_, &Beam::stiffness) * motion.enforced));
  motion.load = t.transpose() * (gathered(masses_, &Beam::mass) * (t * motion.influence + motion.enforced));
  return motion;
}

}  // namespace pounding
