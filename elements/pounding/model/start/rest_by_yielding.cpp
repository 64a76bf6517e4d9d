#include <pounding/model/start/start.hpp>

#include <Eigen/LU>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <pounding/frames/static_solver.hpp>

namespace pounding {
namespace {

constexpr int max_newton_iterations = 100;
constexpr double at_rest_solved = 1e-14, min_step_part = 1e-4;

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Parts deformed by gravity, on the straight path from their initial state.
class StrainedParts {
 public:
  explicit StrainedParts(const Structure& s) {
    for (std::size_t i = 0; i < s.yielding.size(); ++i) {
      const YieldingPart& part = s.yielding[i];
      Archive fresh(part.fresh);
      part.spring->archive(fresh);
      if (!part.is_device()) parts_.push_back(static_cast<int>(i));
    }
    at_rest_.resize(size());
    stiffness_.resize(size());
    for (Eigen::Index j = 0; j < size(); ++j) {
      const YieldingPart& part = s.yielding[static_cast<std::size_t>(parts_[j])];
      springs_.push_back(part.spring.get());
      at_rest_[j] = part.at_rest;
      stiffness_[j] = part.spring->stiffness();
    }
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(parts_.size()); }
  bool straight() const { return size() == 0 || law(at_rest_).first.isZero(0); }

  // `s` is the structure with which they were created.
  VectorXd displacement(const Structure& s) const {
    StaticSolver solver(s.stiffness);
    if (!solver.holds()) throw std::invalid_argument("it has no stiffness against gravity");
    MatrixXd columns = MatrixXd::Zero(s.size(), size());
    for (Eigen::Index j = 0; j < size(); ++j)
      for (Row::InnerIterator it(s.yielding[static_cast<std::size_t>(parts_[j])].deformation); it; ++it)
        columns(it.index(), j) = it.value();
    const MatrixXd by_parts = solver.solve(columns);
    MatrixXd flexibility = columns.transpose() * by_parts;
    if (s.yielding_flexibility.size() > 0) flexibility += MatrixXd(s.yielding_flexibility)(parts_, parts_);
    VectorXd forces = VectorXd::Zero(size());
    auto [answer, slopes] = law(at_rest_);
    // The forces are differences between those of the laws and k d.
    const double rounding = at_rest_solved * stiffness_.cwiseProduct(at_rest_).norm();
    for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
      const VectorXd left = answer - forces;
      if (left.norm() <= rounding) return -by_parts * forces;
      const MatrixXd tangent = MatrixXd::Identity(size(), size()) + slopes.asDiagonal() * flexibility;
      const VectorXd step = tangent.partialPivLu().solve(left);
      double part = 1;
      VectorXd next = forces + step;
      for (;; next = forces + (part /= 2) * step) {
        std::tie(answer, slopes) = law(at_rest_ - flexibility * next);
        if ((answer - next).norm() < left.norm() || part < min_step_part) break;
      }
      if (part < min_step_part && left.norm() <= 1e3 * rounding) return -by_parts * forces;  // only round-off is left
      forces = next;
    }
    throw std::invalid_argument("no equilibrium of its parts under gravity was found; make them stronger");
  }

 private:
  std::pair<VectorXd, VectorXd> law(const VectorXd& deformations) const {
    std::pair<VectorXd, VectorXd> all{deformations, deformations};
    for (Eigen::Index j = 0; j < size(); ++j) {
      const laws::Response r = springs_[static_cast<std::size_t>(j)]->evaluate({deformations[j], 0});
      all.first[j] = r.force, all.second[j] = r.by_penetration;
    }
    return all;
  }

  std::vector<int> parts_;
  std::vector<const Spring*> springs_;
  VectorXd at_rest_, stiffness_;
};

}  // namespace

VectorXd rest_by_yielding(const Structure& s) {
  const StrainedParts parts(s);
  if (parts.straight()) return {};
  return parts.displacement(s);
}

}  // namespace pounding
