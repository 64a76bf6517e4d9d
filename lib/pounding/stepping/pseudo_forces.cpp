#include <pounding/stepping/pseudo_forces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using Eigen::VectorXd;
using Factor = Eigen::SimplicialLDLT<SparseMatrix>;

// Newton steps below this fraction of the displacements imposed by the neighbours are round-off.
constexpr double balanced = 3e-14;
// With larger round-off, as with stiff members, the steps stop decreasing; below this fraction they are accepted.
constexpr double nearly_balanced = 1e-10;
// With the factorization at rest, each step must decrease to this fraction of the previous one; otherwise the tangent
// is factorized.
constexpr double slow = 0.2;
constexpr int max_iterations = 60;
// Finite-difference step for the tangent's time derivative, as a fraction of 1/omega (Rayleigh quotient of v).
constexpr double short_time = 1e-4;

/// Submatrix of matrices that all have the same sparsity pattern.
class Extract {
 public:
  Extract() = default;
  Extract(SparseMatrix whole, const std::vector<int>& rows, const std::vector<int>& columns) {
    std::iota(whole.valuePtr(), whole.valuePtr() + whole.nonZeros(), 0.0);
    part_ = submatrix(whole, rows, columns);
    from_.assign(part_.valuePtr(), part_.valuePtr() + part_.nonZeros());
  }
  const SparseMatrix& operator()(const SparseMatrix& whole) {
    for (std::size_t k = 0; k < from_.size(); ++k) part_.valuePtr()[k] = whole.valuePtr()[from_[k]];
    return part_;
  }

 private:
  SparseMatrix part_;
  std::vector<int> from_;  // indices of its values among those of the full matrix
};

}  // namespace

// One group; vectors start at its first degree of freedom.
struct PseudoForces::Part {
  int group, first, size;
  const ElasticForces& forces;
  SparseMatrix mass, stiffness;
  std::vector<int> all, dynamic, massless;  // degrees of freedom: all, with mass, without
  SparseMatrix couplings;                   // absolute stiffness between massless and all degrees of freedom
  VectorXd diagonal;                        // of the stiffness at massless degrees of freedom
  Factor at_rest;                           // factorization of that block of the stiffness
  mutable Extract massless_of_tangent, coupling_of_tangent;  // massless to massless, massless to dynamic
  mutable Factor massless_factor;                            // factorization of the same block of a tangent

  Part(const System& system, int number)
      : group(number),
        first(system.groups[number].first),
        size(system.groups[number].count),
        forces(*system.groups[number].elastic),
        all(size),
        dynamic(split_by_mass(system.mass, first, size).dynamic),
        massless(split_by_mass(system.mass, first, size).massless) {
    std::iota(all.begin(), all.end(), 0);
    mass = submatrix(system.mass, all, all, first);
    stiffness = submatrix(system.stiffness, all, all, first);
    if (massless.empty()) return;
    couplings = submatrix(system.stiffness, massless, all, first).cwiseAbs();
    const SparseMatrix own = submatrix(system.stiffness, massless, massless, first);
    diagonal = own.diagonal();
    at_rest.compute(own);
    if (at_rest.info() != Eigen::Success || !(at_rest.vectorD().minCoeff() > 0))
      throw std::invalid_argument("a massless degree of freedom has no stiffness");
    const SparseMatrix tangent = forces.tangent(VectorXd::Zero(size));
    massless_of_tangent = Extract(tangent, massless, massless);
    coupling_of_tangent = Extract(tangent, massless, dynamic);
    massless_factor.analyzePattern(massless_of_tangent(tangent));
  }

  VectorXd of(const VectorXd& whole) const { return whole.segment(first, size); }

  // Moves the massless degrees of freedom to static equilibrium and sets f to the forces there.
  bool settle(VectorXd& u, VectorXd& f) const {
    f = forces.force(u);
    if (massless.empty()) return true;
    const double scale =
        std::sqrt((couplings * (u.cwiseAbs() + forces.at_rest().cwiseAbs())).cwiseAbs2().cwiseQuotient(diagonal).sum());
    double last = std::numeric_limits<double>::infinity();
    bool turned = false;  // too far for the factorization at rest
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      if (turned) massless_factor.factorize(massless_of_tangent(forces.tangent(u)));
      const VectorXd step = (turned ? massless_factor : at_rest).solve(-f(massless));
      const double length = std::sqrt(step.cwiseAbs2().dot(diagonal));
      if (!std::isfinite(length)) return false;
      if (length <= balanced * scale || (length > 0.5 * last && length <= nearly_balanced * scale)) return true;
      turned = turned || (length > slow * last && length > nearly_balanced * scale);
      last = length;
      u(massless) += step;
      f = forces.force(u);
    }
    return false;
  }

  void complete(VectorXd& u, VectorXd* v, VectorXd* a) const {
    VectorXd f;
    if (massless.empty()) return;
    if (!settle(u, f)) u(massless).setConstant(std::nan(""));
    if (!v) return;
    const SparseMatrix tangent = forces.tangent(u);
    massless_factor.factorize(massless_of_tangent(tangent));
    const SparseMatrix& coupling = coupling_of_tangent(tangent);
    (*v)(massless) = massless_factor.solve(-(coupling * (*v)(dynamic)));
    if (!a) return;
    VectorXd pull = coupling * (*a)(dynamic);
    const double stiff = v->dot(stiffness * *v), kinetic = v->dot(mass * *v);
    if (stiff > 0 && kinetic > 0) {
      const double by = short_time * std::sqrt(kinetic / stiff);
      const VectorXd change = (forces.tangent(u + by * *v) * *v - forces.tangent(u - by * *v) * *v) / (2 * by);
      pull += change(massless);
    }
    (*a)(massless) = massless_factor.solve(-pull);
  }
};

PseudoForces::~PseudoForces() = default;

PseudoForces::PseudoForces(const System& system) {
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (system.groups[k].elastic) parts_.push_back(std::make_unique<Part>(system, static_cast<int>(k)));
}

void PseudoForces::evaluate(std::span<const int> groups, const VectorXd& u, VectorXd& e) const {
  e.setZero(u.size());
  for (const auto& part : parts_) {
    if (std::find(groups.begin(), groups.end(), part->group) == groups.end()) continue;
    const VectorXd linear = part->of(u);
    VectorXd there = linear, f;
    const bool settled = part->settle(there, f);
    f -= part->stiffness * linear;
    f(part->massless).setZero();
    if (!settled) f.setConstant(std::nan(""));
    e.segment(part->first, part->size) = f;
  }
}

double PseudoForces::energy(const VectorXd& u) const {
  double sum = 0;
  for (const auto& part : parts_) {
    const VectorXd linear = part->of(u);
    VectorXd there = linear, f;
    part->settle(there, f);
    sum += part->forces.energy(there) - 0.5 * linear.dot(part->stiffness * linear);
  }
  return sum;
}

bool PseudoForces::corrects(const SparseMatrix& of_unknowns) const {
  for (int j = 0; j < of_unknowns.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(of_unknowns, j); it; ++it)
      for (const auto& part : parts_)
        if (it.value() != 0 && std::binary_search(part->massless.begin(), part->massless.end(), it.row() - part->first))
          return true;
  return false;
}

void PseudoForces::complete(VectorXd& u) const {
  for (const auto& part : parts_) {
    VectorXd own = part->of(u);
    part->complete(own, nullptr, nullptr);
    u.segment(part->first, part->size) = own;
  }
}

void PseudoForces::complete(VectorXd& u, VectorXd& v) const {
  for (const auto& part : parts_) {
    VectorXd own = part->of(u), rate = part->of(v);
    part->complete(own, &rate, nullptr);
    u.segment(part->first, part->size) = own;
    v.segment(part->first, part->size) = rate;
  }
}

void PseudoForces::complete(VectorXd& u, VectorXd& v, VectorXd& a) const {
  for (const auto& part : parts_) {
    VectorXd own = part->of(u), rate = part->of(v), change = part->of(a);
    part->complete(own, &rate, &change);
    u.segment(part->first, part->size) = own;
    v.segment(part->first, part->size) = rate;
    a.segment(part->first, part->size) = change;
  }
}

}  // namespace pounding
