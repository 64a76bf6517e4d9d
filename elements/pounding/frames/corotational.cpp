// A frame of corotational members: its forces, energy and tangent.

#include <pounding/frames/corotational.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <pounding/core/refuse.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {

using Eigen::Matrix3d;
using Eigen::Vector3d;

CorotationalBeam CorotationalBeam::of(const CorotationalMember& member, const AssembledFrame& assembled) {
  const Vector3d &from = assembled.positions[member.start], &to = assembled.positions[member.end];
  if (member.is_truss) return truss(from, to, member.section.area, member.material, assembled.dimension);
  return {from, to, member.section, member.material, member.options, assembled.dimension};
}

std::vector<CorotationalMember> corotational_members(const Frame& frame) {
  std::vector<CorotationalMember> members;
  for (int member = 0; member < frame.members(); ++member) {
    const auto [start, end] = frame.ends(member);
    const Beam& beam = frame.beam(member);
    members.push_back({start, end, beam.section(), beam.material(), beam.options(), beam.is_truss()});
  }
  return members;
}

CorotationalFrame::CorotationalFrame(const AssembledFrame& assembled, const std::vector<CorotationalMember>& members)
    : linear_(assembled.stiffness), rest_(assembled.stiffness) {
  const int nodes = static_cast<int>(assembled.positions.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (const CorotationalMember& m : members) {
    const std::string where = "member " + std::to_string(members_.size()) + " (nodes " + std::to_string(m.start) +
                              " and " + std::to_string(m.end) + "): ";
    for (const int node : {m.start, m.end})
      if (node < 0 || node >= nodes)
        refuse(where + "unknown node " + std::to_string(node) + "; number of nodes: " + std::to_string(nodes));
    try {
      members_.push_back(
          {CorotationalBeam::of(m, assembled), MemberUnknowns(assembled, m.start, m.end), Matrix12::Zero()});
    } catch (const std::invalid_argument& error) {
      refuse(where + error.what());
    }
    Member& member = members_.back();
    member.beam.evaluate(Vector12::Zero(), member.linear);
    member.unknowns.add_entries(member.linear, entries);
  }
  const SparseMatrix turning = sparse_matrix(size(), size(), entries);
  rest_ -= turning;
  linear_ = (linear_ + 0 * turning).eval();  // keeps entries that are zero at rest in the sparsity pattern
  for (Member& member : members_) member.unknowns.find_places(linear_);
  // The stiffness other than that of the members, without its round-off.
  rest_.prune([&](int i, int j, double value) {
    return std::abs(value) > 1e-12 * std::sqrt(linear_.coeff(i, i) * linear_.coeff(j, j));
  });
  for (int j = 0; j < size(); ++j)
    if (rest_.coeff(j, j) < -1e-9 * turning.coeff(j, j))
      refuse("node " + std::to_string(assembled.unknowns[j].first) +
             ": the corotational members are stiffer than the assembled frame; pass each of its members once");
}

void CorotationalFrame::require_size(const Eigen::VectorXd& q, const char* what) const {
  if (q.size() != size())
    refuse(std::string(what) + " has " + std::to_string(q.size()) + " entries, but must have " +
           std::to_string(size()) + ", one per unknown of the frame");
}

double CorotationalFrame::energy(const Eigen::VectorXd& q) const {
  require_size(q, "q");
  double sum = 0.5 * q.dot(rest_ * q);
  for (const Member& member : members_) sum += member.beam.evaluate(member.unknowns.displacements(q)).energy;
  return sum;
}

Eigen::VectorXd CorotationalFrame::force(const Eigen::VectorXd& q) const {
  require_size(q, "q");
  Eigen::VectorXd sum = rest_ * q;
  for (const Member& member : members_) {
    const Vector12 f = member.beam.evaluate(member.unknowns.displacements(q)).force;
    member.unknowns.add_force(f, sum);
  }
  return sum;
}

Eigen::SparseMatrix<double> CorotationalFrame::tangent(const Eigen::VectorXd& q) const {
  Eigen::SparseMatrix<double> sum = linear_;
  add_excess_tangent(q, sum);
  return sum;
}

void CorotationalFrame::add_excess_tangent(const Eigen::VectorXd& q, Eigen::SparseMatrix<double>& sum) const {
  require_size(q, "q");
  for (const Member& member : members_) {
    Matrix12 k;
    member.beam.evaluate(member.unknowns.displacements(q), k);
    k -= member.linear;
    member.unknowns.add_to(sum.valuePtr(), k);
  }
}

const CorotationalFrame::Member& CorotationalFrame::of(int member, const Eigen::VectorXd& q) const {
  if (member < 0 || member >= members())
    refuse("unknown member " + std::to_string(member) + "; number of members: " + std::to_string(members()));
  require_size(q, "q");
  return members_[member];
}

Vector12 CorotationalFrame::end_forces(int member, const Eigen::VectorXd& q) const {
  const Member& m = of(member, q);
  return m.beam.end_forces(m.unknowns.displacements(q));
}

Matrix3d CorotationalFrame::axes(int member, const Eigen::VectorXd& q) const {
  const Member& m = of(member, q);
  return m.beam.axes(m.unknowns.displacements(q));
}

Vector12 CorotationalFrame::nodal_forces(int member, const Eigen::VectorXd& q) const {
  const Member& m = of(member, q);
  return m.beam.evaluate(m.unknowns.displacements(q)).force;
}

}  // namespace pounding
