#include <pounding/frames/frame.hpp>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <tuple>

#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/frame_dofs.hpp>
#include <pounding/frames/static_solver.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {

using Eigen::Triplet;
using Eigen::Vector3d;
using namespace frame_dofs;

namespace {

SparseMatrix symmetric_part(const SparseMatrix& m) { return 0.5 * (m + SparseMatrix(m.transpose())); }

// A motion without inertia that involves several unknowns, such as the rotation of a rigid floor with its mass at one
// node other than the master, would leave the accelerations undetermined.
void require_regular(const SparseMatrix& mass, const AssembledFrame& frame) {
  std::vector<Triplet<double>> entries;
  for (int j = 0; j < mass.outerSize(); ++j) {
    if (frame.massless[j]) entries.emplace_back(j, j, 1.0);
    for (SparseMatrix::InnerIterator it(mass, j); it; ++it) entries.emplace_back(it.row(), j, it.value());
  }
  const SparseMatrix padded = sparse_matrix(mass.rows(), mass.cols(), entries);
  const Eigen::SimplicialLDLT<SparseMatrix> factor(padded);
  const Eigen::VectorXd pivots = factor.permutationPinv() * factor.vectorD();
  for (int j = 0; j < mass.rows(); ++j)
    if (!(pivots[j] > 1e-12 * padded.coeff(j, j)))
      refuse("node " + frame.node_names[frame.unknowns[j].first] + ": a motion that involves " +
             name(frame.unknowns[j].second) +
             " has no inertia; put the mass of a rigid part at its master, distribute it, " +
             "or give the master a rotational mass");
}

}  // namespace

Eigen::SparseVector<double> AssembledFrame::motion(int node, Dof dof, const Vector3d& arm) const {
  require_node(node, static_cast<int>(positions.size()));
  Eigen::SparseVector<double> sum(size());
  for (const auto& [of_node, factor] : on_rigid_body(dof, arm)) {
    if (factor == 0) continue;
    const int at = place(dimension, of_node);
    if (at < 0) refuse_out_of_plane(node_names[node], of_node);
    const int row = node * static_cast<int>(dofs_of(dimension).size()) + at;
    sum += factor * Eigen::SparseVector<double>(transform.row(row).transpose());
  }
  return sum;
}

// True for a rotation at a node connected only to trusses.
bool Frame::is_loose(int at) const {
  return is_rotation(dofs_of(dimension_)[at % dofs()]) && trussed_.contains(at / dofs()) && !engaged_.contains(at);
}

// Determines the unknowns, and all displacements as functions of the unknowns and of the supports.
void Frame::trace(AssembledFrame& frame) const {
  const int all = nodes() * dofs();
  std::vector<int> column(all, -1);
  for (int at = 0; at < all; ++at) {
    const bool is_fixed = fixed_.contains(at), follows = follows_.contains(at);
    if (is_fixed && follows) refuse(label(at) + " is both fixed and tied to another node; remove one of them");
    if (is_fixed || follows || is_loose(at)) continue;
    column[at] = static_cast<int>(frame.unknowns.size());
    frame.unknowns.emplace_back(at / dofs(), dofs_of(dimension_)[at % dofs()]);
  }

  Entries by_unknowns, by_supports;
  for (int row = 0; row < all; ++row) {
    // Terms still to be traced back to unknowns; a chain longer than the number of displacements is a cycle.
    Entries open{{row, 0, 1.0}};
    while (!open.empty()) {
      const auto [at, depth, factor] = std::tuple(open.back().row(), open.back().col(), open.back().value());
      open.pop_back();
      if (column[at] >= 0) by_unknowns.emplace_back(row, column[at], factor);
      if (fixed_.contains(at)) by_supports.emplace_back(row, at, factor);
      const auto master = follows_.find(at);
      if (master == follows_.end()) continue;
      if (depth > static_cast<int>(follows_.size())) refuse(label(row) + " is tied to itself through other nodes");
      for (const auto& [next, share] : master->second) open.emplace_back(next, depth + 1, factor * share);
    }
  }
  frame.transform.resize(all, frame.unknowns.size());
  frame.transform.setFromTriplets(by_unknowns.begin(), by_unknowns.end());
  frame.supported.resize(all, all);
  frame.supported.setFromTriplets(by_supports.begin(), by_supports.end());
}

// Assembles a matrix over all displacements from nodal entries and member matrices.
SparseMatrix Frame::gathered(const Entries& nodal, Matrix12 (Beam::*of_member)() const) const {
  Entries entries = nodal;
  for (const Member& member : members_) {
    const Matrix12 matrix = (member.beam.*of_member)();
    std::vector<std::pair<int, int>> rows;  // of the frame, of the member
    for (const Dof dof : dofs_of(dimension_)) {
      rows.emplace_back(index(member.start, dof), static_cast<int>(dof));
      rows.emplace_back(index(member.end, dof), 6 + static_cast<int>(dof));
    }
    for (const auto& [row, i] : rows)
      for (const auto& [column, j] : rows)
        if (matrix(i, j) != 0) entries.emplace_back(row, column, matrix(i, j));
  }
  return sparse_matrix(nodes() * dofs(), nodes() * dofs(), entries);
}

// Loads at nodes and on members, for all displacements.
Eigen::VectorXd Frame::loads() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes() * dofs());
  for (const auto& [at, force] : loads_) {
    if (is_loose(at)) refuse(label(at) + ": trusses carry no moment; remove the load");
    sum[at] += force;
  }
  for (const Member& member : members_) {
    if (member.load.isZero(0)) continue;
    const Vector12 held = member.beam.at_nodes(member.beam.fixed_end_forces(member.load));
    for (const Dof dof : dofs_of(dimension_)) {
      sum[index(member.start, dof)] -= held[static_cast<int>(dof)];
      sum[index(member.end, dof)] -= held[6 + static_cast<int>(dof)];
    }
  }
  return sum;
}

AssembledFrame Frame::assemble(bool gravity) const {
  for (int node = 0; node < nodes(); ++node)
    if (!connected_.contains(node)) refuse(node_text(node) + "not connected to any member, spring or constraint");

  AssembledFrame out;
  out.dimension = dimension_;
  out.positions = positions_;
  for (int node = 0; node < nodes(); ++node) out.node_names.push_back(node_name(node));
  trace(out);
  const SparseMatrix t = out.transform;
  const SparseMatrix mass = gathered(masses_, &Beam::mass);
  const int n = static_cast<int>(t.cols()), all = static_cast<int>(t.rows());
  const SparseMatrix dashpots = sparse_matrix(all, all, dashpots_);
  out.stiffness = symmetric_part(t.transpose() * gathered(springs_, &Beam::stiffness) * t);
  out.damping = symmetric_part(t.transpose() * dashpots * t);
  out.mass = symmetric_part(t.transpose() * mass * t);
  // At the centre of mass of a floor, the sum of m x arm is zero up to round-off.
  const Eigen::VectorXd diagonal = out.mass.diagonal();
  out.mass.prune(
      [&](int i, int j, double value) { return std::abs(value) > 1e-14 * std::sqrt(diagonal[i] * diagonal[j]); });

  out.influence = Eigen::MatrixX3d::Zero(n, 3);
  for (int j = 0; j < n; ++j) {
    const int direction = static_cast<int>(out.unknowns[j].second);
    if (direction < 3) out.influence(j, direction) = 1;
    out.massless.push_back(diagonal[j] == 0);
  }
  Eigen::MatrixX3d moving = Eigen::MatrixX3d::Zero(all, 3);
  for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz})
    if (place(dimension_, dof) >= 0)
      for (int node = 0; node < nodes(); ++node) moving(index(node, dof), static_cast<int>(dof)) = 1;
  out.load = t.transpose() * (mass * moving);
  out.load_at_rest = t.transpose() * loads();
  if (gravity) out.load_at_rest -= standard_gravity * out.load.col(2);
  check(out);
  return out;
}

void Frame::check(const AssembledFrame& frame) const {
  const auto text = [&](int j) { return node_text(frame.unknowns[j].first) + name(frame.unknowns[j].second); };
  const Eigen::VectorXd dashpots = frame.damping.diagonal();
  for (int j = 0; j < frame.size(); ++j) {
    if (!frame.massless[j]) continue;
    if (frame.stiffness.coeff(j, j) == 0) refuse(text(j) + " has neither stiffness nor mass; fix it or connect it");
    if (dashpots[j] != 0) refuse(text(j) + ": a dashpot acts on a massless degree of freedom; add mass with add_mass");
  }
  require_regular(frame.mass, frame);
}

void Frame::require_motion(const AssembledFrame& frame) const {
  std::vector<int> massless;
  for (int j = 0; j < frame.size(); ++j)
    if (frame.massless[j]) massless.push_back(j);
  const StaticSolver light(submatrix(frame.stiffness, massless, massless));
  if (light.holds()) return;
  Eigen::VectorXd mode = Eigen::VectorXd::Zero(frame.size());
  mode(massless) = light.mode();
  refuse_to_hold(mode, light.buckles(), frame);
}

}  // namespace pounding
