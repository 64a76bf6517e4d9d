// A frame of corotational members: its forces, energy and tangent.

#include <pounding/frames/corotational.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>

#include <pounding/core/refuse.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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
  constexpr std::array plane{0, 2, 4};
  constexpr std::array space{0, 1, 2, 3, 4, 5};
  const std::span<const int> dofs =
      assembled.dimension == 2 ? std::span<const int>(plane) : std::span<const int>(space);
  std::vector<Eigen::Triplet<double>> entries;
  for (const CorotationalMember& m : members) {
    const std::string where = "member " + std::to_string(members_.size()) + " (nodes " + std::to_string(m.start) +
                              " and " + std::to_string(m.end) + "): ";
    for (const int node : {m.start, m.end})
      if (node < 0 || node >= nodes)
        refuse(where + "unknown node " + std::to_string(node) + "; number of nodes: " + std::to_string(nodes));
    try {
      const Vector3d &from = assembled.positions[m.start], &to = assembled.positions[m.end];
      members_.push_back({m.is_truss
                              ? CorotationalBeam::truss(from, to, m.section.area, m.material, assembled.dimension)
                              : CorotationalBeam(from, to, m.section, m.material, m.options, assembled.dimension),
                          {},
                          {},
                          Matrix12::Zero()});
    } catch (const std::invalid_argument& error) {
      refuse(where + error.what());
    }
    Member& member = members_.back();
    for (const int end : {0, 1})
      for (std::size_t at = 0; at < dofs.size(); ++at) {
        const int row = (end == 0 ? m.start : m.end) * static_cast<int>(dofs.size()) + static_cast<int>(at);
        using Transform = Eigen::SparseMatrix<double, Eigen::RowMajor>;
        for (Transform::InnerIterator it(assembled.transform, row); it; ++it)
          member.rows.emplace_back(6 * end + dofs[at], static_cast<int>(it.col()), it.value());
      }
    member.beam.evaluate(Vector12::Zero(), member.linear);
    for (const auto& a : member.rows)
      for (const auto& b : member.rows)
        entries.emplace_back(a.col(), b.col(), a.value() * member.linear(a.row(), b.row()) * b.value());
  }
  const SparseMatrix turning = sparse_matrix(size(), size(), entries);
  rest_ -= turning;
  linear_ = (linear_ + 0 * turning).eval();  // keeps entries that are zero at rest in the sparsity pattern
  for (Member& member : members_)
    for (const auto& b : member.rows)
      for (const auto& a : member.rows) {
        const int* const column = linear_.innerIndexPtr() + linear_.outerIndexPtr()[b.col()];
        const int* const end = linear_.innerIndexPtr() + linear_.outerIndexPtr()[b.col() + 1];
        member.places.push_back(static_cast<int>(std::lower_bound(column, end, a.col()) - linear_.innerIndexPtr()));
      }
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

Vector12 CorotationalFrame::displacements(const Member& member, const Eigen::VectorXd& q) {
  Vector12 u = Vector12::Zero();
  for (const auto& row : member.rows) u[row.row()] += row.value() * q[row.col()];
  return u;
}

double CorotationalFrame::energy(const Eigen::VectorXd& q) const {
  require_size(q, "q");
  double sum = 0.5 * q.dot(rest_ * q);
  for (const Member& member : members_) sum += member.beam.evaluate(displacements(member, q)).energy;
  return sum;
}

Eigen::VectorXd CorotationalFrame::force(const Eigen::VectorXd& q) const {
  require_size(q, "q");
  Eigen::VectorXd sum = rest_ * q;
  for (const Member& member : members_) {
    const Vector12 f = member.beam.evaluate(displacements(member, q)).force;
    for (const auto& row : member.rows) sum[row.col()] += row.value() * f[row.row()];
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
    member.beam.evaluate(displacements(member, q), k);
    k -= member.linear;
    const int* place = member.places.data();
    for (const auto& b : member.rows)
      for (const auto& a : member.rows) sum.valuePtr()[*place++] += a.value() * k(a.row(), b.row()) * b.value();
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
  return m.beam.end_forces(displacements(m, q));
}

Matrix3d CorotationalFrame::axes(int member, const Eigen::VectorXd& q) const {
  const Member& m = of(member, q);
  return m.beam.axes(displacements(m, q));
}

Vector12 CorotationalFrame::nodal_forces(int member, const Eigen::VectorXd& q) const {
  const Member& m = of(member, q);
  return m.beam.evaluate(displacements(m, q)).force;
}

}  // namespace pounding
