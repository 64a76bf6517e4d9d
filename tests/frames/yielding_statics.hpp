#pragma once
/// Statics of a structure with bilinear parts by dense algebra on its matrices: K u + B F = p and d = B^T u - R F + d0.
/// Independent of the engine.

#include <Eigen/Core>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/structures/structure.hpp>
#include "support/dense.hpp"

namespace pounding::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct YieldingStatics {
  MatrixXd stiffness, b, relief;
  VectorXd k, at_rest;

  explicit YieldingStatics(const Structure& s)
      : stiffness(s.stiffness), b(MatrixXd::Zero(s.size(), s.yielding.size())) {
    relief = s.yielding_flexibility.size() > 0 ? MatrixXd(s.yielding_flexibility) : MatrixXd::Zero(b.cols(), b.cols());
    k = at_rest = VectorXd::Zero(b.cols());
    for (int i = 0; i < b.cols(); ++i) {
      b.col(i) = VectorXd(s.yielding[i].deformation);
      k[i] = s.yielding[i].stiffness();
      at_rest[i] = s.yielding[i].at_rest;
    }
  }

  VectorXd unknowns(const VectorXd& load, const VectorXd& forces) const {
    return dense::solve(stiffness, load - b * forces);
  }
  VectorXd deformations(const VectorXd& u, const VectorXd& forces) const {
    return b.transpose() * u - relief * forces + at_rest;
  }
  /// k d + F.
  VectorXd moments(const VectorXd& u, const VectorXd& forces) const {
    return k.cwiseProduct(deformations(u, forces)) + forces;
  }
  /// Deformations per unit force at constant load.
  MatrixXd flexibility() const { return b.transpose() * dense::solve_columns(stiffness, b) + relief; }
};

/// The path of a load that grows from zero: the factors at which parts first yield, in order.
struct Pushed {
  struct Event {
    double factor;
    int part;
  };
  std::vector<Event> events;
  VectorXd u, forces;         ///< at the end
  bool is_mechanism = false;  ///< no stiffness is left after the last event: its factor is the limit load
};

/// Event-to-event path up to this factor, for parts that yield at a moment of +- `yield` and keep `ratio` of their k.
/// Parts do not unload.
inline Pushed push(const Structure& s, const VectorXd& load, const VectorXd& yield, const VectorXd& ratio,
                   double last) {
  const YieldingStatics statics(s);
  const MatrixXd h = statics.flexibility();
  const int count = static_cast<int>(statics.k.size());
  const VectorXd by_load = statics.b.transpose() * dense::solve(statics.stiffness, load);
  Pushed pushed;
  pushed.forces = VectorXd::Zero(count);
  VectorXd moment = VectorXd::Zero(count);
  std::vector<int> yielded;
  double factor = 0;
  while (true) {
    VectorXd by_factor = VectorXd::Zero(count);  // of the forces
    if (!yielded.empty()) {
      MatrixXd matrix = h(yielded, yielded);
      VectorXd scale(yielded.size());
      for (std::size_t i = 0; i < yielded.size(); ++i) {
        scale[i] = std::sqrt(statics.k[yielded[i]]);
        matrix(i, i) -= 1 / ((1 - ratio[yielded[i]]) * statics.k[yielded[i]]);
      }
      matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
      if (-dense::eigenvalues(matrix).maxCoeff() < 1e-12) {
        pushed.is_mechanism = true;
        break;
      }
      by_factor(yielded) = scale.cwiseProduct(dense::solve(matrix, scale.cwiseProduct(by_load(yielded))));
    }
    const VectorXd rate = statics.k.cwiseProduct(by_load - h * by_factor) + by_factor;
    double next = last - factor;
    int who = -1;
    for (int i = 0; i < count; ++i) {
      bool is_yielded = false;
      for (const int j : yielded) is_yielded = is_yielded || i == j;
      if (is_yielded || std::abs(rate[i]) < 1e-14 * rate.cwiseAbs().maxCoeff()) continue;
      const double way = (std::copysign(yield[i], rate[i]) - moment[i]) / rate[i];
      if (way < next) next = way, who = i;
    }
    factor += next;
    moment += next * rate;
    pushed.forces += next * by_factor;
    if (who < 0) break;
    pushed.events.push_back({factor, who});
    yielded.push_back(who);
  }
  pushed.u = statics.unknowns(factor * load, pushed.forces);
  return pushed;
}

}  // namespace pounding::test
