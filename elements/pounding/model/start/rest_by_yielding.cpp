#include <pounding/model/start/start.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/frames/static_solver.hpp>

namespace pounding {
namespace {

constexpr int max_newton_iterations = 100;
constexpr double at_rest_solved = 1e-14, min_step_part = 1e-4;

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Parts of K on the straight path from their initial state; devices are installed afterwards.
class StrainedParts {
 public:
  explicit StrainedParts(const Structure& s) : structure_(s) {
    for (std::size_t i = 0; i < s.yielding.size(); ++i)
      if (!s.yielding[i].is_device()) parts_.push_back(static_cast<int>(i));
    at_rest_.resize(size());
    stiffness_.resize(size());
    for (Eigen::Index j = 0; j < size(); ++j) {
      const YieldingPart& part = s.yielding[static_cast<std::size_t>(parts_[j])];
      if (part.direction == 0) {
        elements_.push_back({part.element.get(), j});
        memories_.add(*part.element);
      }
      at_rest_[j] = part.at_rest;
      stiffness_[j] = part.stiffness();
    }
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(parts_.size()); }
  const std::vector<int>& indices() const { return parts_; }
  const VectorXd& elastic_at_rest() const { return at_rest_; }
  // True if no part leaves its initial stiffness on the way to these deformations.
  bool straight(const VectorXd& deformations) const { return size() == 0 || law(deformations).first.isZero(0); }

  // B, one column per part.
  MatrixXd columns() const {
    MatrixXd columns = MatrixXd::Zero(structure_.size(), size());
    for (Eigen::Index j = 0; j < size(); ++j)
      for (Row::InnerIterator it(structure_.yielding[static_cast<std::size_t>(parts_[j])].deformation); it; ++it)
        columns(it.index(), j) = it.value();
    return columns;
  }
  // R of the parts.
  MatrixXd flexibility() const {
    if (structure_.yielding_flexibility.size() == 0) return MatrixXd::Zero(size(), size());
    return MatrixXd(structure_.yielding_flexibility)(parts_, parts_);
  }
  // Advances the springs to these deformations.
  void start(const VectorXd& deformations) {
    for (std::size_t i = 0; i < elements_.size(); ++i)
      elements_[i].element->start(memories_[static_cast<int>(i)], motions(elements_[i], deformations));
  }

  // Forces F of the parts and their deformations d = elastic - flexibility F. `load` is its name in the message.
  struct Equilibrium {
    VectorXd forces, deformations;
  };
  Equilibrium solve(const VectorXd& elastic, const MatrixXd& flexibility, const char* load) const {
    Equilibrium found{VectorXd::Zero(size()), elastic};
    auto [answer, slopes] = law(elastic);
    // The forces are differences between those of the laws and k d.
    const double rounding = at_rest_solved * stiffness_.cwiseProduct(elastic).norm();
    for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
      const VectorXd left = answer - found.forces;
      if (left.norm() <= rounding) return found;
      const MatrixXd tangent = MatrixXd::Identity(size(), size()) + slopes * flexibility;
      const VectorXd step = tangent.partialPivLu().solve(left);
      double part = 1;
      Equilibrium next{found.forces + step, {}};
      for (;; next.forces = found.forces + (part /= 2) * step) {
        next.deformations = elastic - flexibility * next.forces;
        std::tie(answer, slopes) = law(next.deformations);
        if ((answer - next.forces).norm() < left.norm() || part < min_step_part) break;
      }
      if (part < min_step_part && left.norm() <= 1e3 * rounding) return found;  // only round-off is left
      found = std::move(next);
    }
    throw std::invalid_argument(
        fmt::format("no equilibrium of its parts under {} was found; make them stronger", load));
  }

 private:
  struct PartsOfElement {
    const Element* element;
    Eigen::Index first;  // part
  };

  static std::vector<LinkMotion> motions(const PartsOfElement& parts, const VectorXd& deformations) {
    std::vector<LinkMotion> all;
    for (int i = 0; i < parts.element->deformations(); ++i) all.push_back({deformations[parts.first + i], 0});
    return all;
  }
  std::pair<VectorXd, SparseMatrix> law(const VectorXd& deformations) const {
    VectorXd forces(size());
    std::vector<Eigen::Triplet<double>> slopes;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const auto& [element, first] = elements_[k];
      ElementResponse r;
      element->evaluate(memories_[static_cast<int>(k)], motions(elements_[k], deformations), r);
      for (int i = 0; i < element->deformations(); ++i) {
        forces[first + i] = r.force[i];
        for (int j = 0; j < element->deformations(); ++j)
          slopes.emplace_back(static_cast<int>(first) + i, static_cast<int>(first) + j, r.by_deformation[i][j]);
      }
    }
    return {std::move(forces), sparse_matrix(static_cast<int>(size()), static_cast<int>(size()), slopes)};
  }

  const Structure& structure_;
  std::vector<int> parts_;
  std::vector<PartsOfElement> elements_;
  ElementMemories memories_;
  VectorXd at_rest_, stiffness_;
};

// Gravity state: displacements q, empty without yielding, and deformations of the parts.
struct Rest {
  VectorXd displacement, deformations;
};

Rest rest_of(const StrainedParts& parts, const Structure& s) {
  const VectorXd& elastic = parts.elastic_at_rest();
  if (parts.straight(elastic)) return {{}, elastic};
  StaticSolver solver(s.stiffness);
  if (!solver.holds()) throw std::invalid_argument("it has no stiffness against gravity");
  const MatrixXd columns = parts.columns(), by_parts = solver.solve(columns);
  MatrixXd flexibility = columns.transpose() * by_parts;
  if (s.yielding_flexibility.size() > 0) flexibility += parts.flexibility();
  StrainedParts::Equilibrium found = parts.solve(elastic, flexibility, "gravity");
  return {-by_parts * found.forces, std::move(found.deformations)};
}

}  // namespace

VectorXd rest_by_yielding(const Structure& s) { return rest_of(StrainedParts(s), s).displacement; }

VectorXd deformations_at_rest(const Structure& s) {
  const StrainedParts parts(s);
  VectorXd all = VectorXd::Zero(static_cast<Eigen::Index>(s.yielding.size()));
  all(parts.indices()) = rest_of(parts, s).deformations;
  return all;
}

VectorXd yielding_while_held(const Structure& s, const VectorXd& elastic_shape, const std::vector<Row>& held) {
  const VectorXd none = VectorXd::Zero(s.size());
  StrainedParts parts(s);
  if (parts.size() == 0) return none;
  const Rest rest = rest_of(parts, s);
  const VectorXd gravity = rest.displacement.size() > 0 ? rest.displacement : none;
  const MatrixXd columns = parts.columns();
  parts.start(rest.deformations);
  VectorXd yielded = none;
  if (!parts.straight(rest.deformations + columns.transpose() * elastic_shape)) {
    StaticSolver solver(s.stiffness);
    MatrixXd directions(s.size(), static_cast<Eigen::Index>(held.size()));
    for (std::size_t i = 0; i < held.size(); ++i) directions.col(static_cast<Eigen::Index>(i)) = held[i];
    const MatrixXd by_held = solver.solve(directions), by_parts = solver.solve(columns);
    // Each column moves one of the held displacements by one, without forces elsewhere.
    const MatrixXd unit = (directions.transpose() * by_held).ldlt().solve(by_held.transpose()).transpose();
    const MatrixXd by_parts_held = by_parts - unit * (directions.transpose() * by_parts);
    // The displacements that gravity causes by yielding remain where the structure is held.
    const VectorXd carried = unit * (directions.transpose() * gravity);
    const VectorXd elastic = parts.elastic_at_rest() + columns.transpose() * (elastic_shape + carried);
    const StrainedParts::Equilibrium found =
        parts.solve(elastic, columns.transpose() * by_parts_held + parts.flexibility(), "the initial displacement");
    yielded = carried - by_parts_held * found.forces - gravity;
  }
  return yielded;
}

}  // namespace pounding
