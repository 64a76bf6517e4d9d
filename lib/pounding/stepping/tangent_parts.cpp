#include <pounding/stepping/tangent_parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/core/error.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using Eigen::VectorXd;

constexpr int settling_iterations = 100;
// Relative change of strain, and change of displacement relative to the largest one, at which the state is settled.
constexpr double settled = 1e-12;
// With larger round-off, as with stiff members, changes stop decreasing; below this fraction they are accepted.
constexpr double nearly_settled = 1e-9;
constexpr double smallest_displacement = 1e-9;  // [m]

}  // namespace

TangentParts::TangentParts(const System& system, StructureSolver& solver) : solver_(solver) {
  for (const StructureSolver::Segment& s : solver.layout().segments) {
    const Group& group = system.groups[static_cast<std::size_t>(s.group)];
    if (!group.tangent) continue;
    const SparseMatrix stiffness = system.stiffness.block(group.first, group.first, group.count, group.count);
    parts_.push_back({s.group,
                      group.first,
                      s.first,
                      s.count,
                      *group.tangent,
                      stiffness,
                      split_by_mass(system.mass, group.first, group.count).massless,
                      group.tangent->start(),
                      {},
                      {},
                      {},
                      {}});
  }
}

double TangentParts::linearize(Part& part, const VectorXd& u) {
  part.last.u = u;
  return part.forces.linearize(*part.motion, u, part.last.force, part.last.tangent);
}

void TangentParts::settle(Eigen::Ref<VectorXd> u) {
  for (Part& part : parts_) {
    VectorXd own = u.segment(part.first, part.size);
    part.forces.begin_step(*part.motion);
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0;; ++iteration) {
      const double strain = linearize(part, own);
      double change = 0;
      if (!part.massless.empty()) {
        const VectorXd step = part.factor_of_massless(part.last.tangent).solve(-part.last.force(part.massless));
        own(part.massless) += step;
        change = step.cwiseAbs().maxCoeff();
      }
      if (!std::isfinite(strain + change) || iteration == settling_iterations)
        throw SolverError("a structure of fibre members has no equilibrium with its initial displacement");
      const double size = (own + part.forces.at_rest()).cwiseAbs().maxCoeff();
      const double error = std::max(strain, change / std::max(size, smallest_displacement));
      if (error < settled || (error > 0.5 * last && error < nearly_settled)) break;
      last = error;
    }
    u.segment(part.first, part.size) = own;
    part.forces.accept(*part.motion, 0);
    part.forces.begin_step(*part.motion);
    linearize(part, own);
    part.accepted = part.last;
  }
}

void TangentParts::begin_step() {
  for (Part& part : parts_) {
    part.forces.begin_step(*part.motion);
    part.last = part.accepted;
  }
  set_tangents();
}

double TangentParts::linearize(Eigen::Ref<const VectorXd> u) {
  double strain = 0;
  for (Part& part : parts_) {
    const double own = linearize(part, u.segment(part.first, part.size));
    if (!(own <= strain)) strain = own;
  }
  return strain;
}

void TangentParts::set_tangents() {
  for (const Part& part : parts_) solver_.set_tangent(part.group, part.last.tangent);
}

void TangentParts::add_pseudo_force(Eigen::Ref<const VectorXd> u, VectorXd& e) const {
  for (const Part& part : parts_) {
    const VectorXd own = u.segment(part.first, part.size);
    e.segment(part.first, part.size) += part.last.at(own) - part.stiffness * own;
  }
}

// Interpolated displacements of massless degrees of freedom are not in equilibrium; the forces at the others are those
// of the equilibrium.
void TangentParts::add_middle(Eigen::Ref<const VectorXd> u, VectorXd& e) const {
  for (const Part& part : parts_) {
    const VectorXd own = u.segment(part.first, part.size);
    VectorXd balanced = own;
    if (!part.massless.empty()) {
      const VectorXd residual = part.middle.at(own);
      balanced(part.massless) -= part.factor_of_massless(part.middle.tangent).solve(residual(part.massless));
    }
    e.segment(part.first, part.size) += part.middle.at(balanced) - part.stiffness * own;
  }
}

const Eigen::SimplicialLDLT<SparseMatrix>& TangentParts::Part::factor_of_massless(const SparseMatrix& tangent) const {
  if (!massless_factor) massless_factor = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>();
  massless_factor->compute(submatrix(tangent, massless, massless));
  return *massless_factor;
}

void TangentParts::recover(Eigen::Ref<VectorXd> rate) const {
  for (const Part& part : parts_) {
    if (part.massless.empty()) continue;
    auto own = rate.segment(part.first, part.size);
    own(part.massless).setZero();
    const VectorXd force = part.last.tangent * own;
    own(part.massless) = part.factor_of_massless(part.last.tangent).solve(-force(part.massless));
  }
}

void TangentParts::record_stage(Eigen::Ref<const VectorXd> u, double time, bool is_middle) {
  for (Part& part : parts_) {
    part.forces.record_stage(*part.motion, u.segment(part.first, part.size), time);
    if (is_middle) part.middle = part.last;
  }
}

bool TangentParts::accept(Eigen::Ref<const VectorXd> u, double min_reversal) {
  bool reversed = false;
  for (Part& part : parts_) {
    if (part.forces.accept(*part.motion, min_reversal)) {
      reversed = true;
      part.forces.begin_step(*part.motion);
      linearize(part, u.segment(part.first, part.size));
    }
    part.accepted = part.last;
  }
  return reversed;
}

VectorXd TangentParts::member_forces(int first_dof, double s) const {
  for (const Part& part : parts_)
    if (part.first_dof == first_dof) return part.forces.member_forces(*part.motion, s);
  return {};
}

TangentForces::Energy TangentParts::energy(Eigen::Ref<const VectorXd> u) const {
  TangentForces::Energy sum;
  for (const Part& part : parts_) {
    const VectorXd own = u.segment(part.first, part.size);
    const TangentForces::Energy energy = part.forces.energy(*part.motion, own);
    sum.stored += energy.stored - 0.5 * own.dot(part.stiffness * own);
    sum.dissipated += energy.dissipated;
  }
  return sum;
}

void TangentParts::archive(Archive& archive) {
  for (Part& part : parts_) {
    part.motion->archive(archive);
    archive(part.accepted.u, part.accepted.force);
    std::vector<double> values(part.accepted.tangent.valuePtr(),
                               part.accepted.tangent.valuePtr() + part.accepted.tangent.nonZeros());
    archive(values);
    part.accepted.tangent = part.last.tangent;
    std::ranges::copy(values, part.accepted.tangent.valuePtr());
    part.last = part.accepted;
  }
}

}  // namespace pounding
