#include <pounding/frames/corotational_forces.hpp>

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/frames/static_solver.hpp>

namespace pounding {
namespace {

using Eigen::VectorXd;

constexpr int load_steps = 4;

// State under this fraction of the load, if it and all earlier points of the path are stable.
std::optional<VectorXd> stable_rest(const CorotationalFrame& frame, const VectorXd& load, double part) {
  try {
    const auto path = frame.solve(part * load, load_steps);
    for (const auto& point : path)
      if (!StaticSolver(frame.tangent(point.q)).holds()) return {};
    return path.back().q;
  } catch (const SolverError&) {
    return {};
  }
}

VectorXd rest_of(const CorotationalFrame& frame, const VectorXd& load) {
  if (load.isZero(0)) return VectorXd::Zero(frame.size());
  if (const auto q = stable_rest(frame, load, 1)) return *q;
  double carried = 0, too_much = 1;
  while (too_much - carried > 1e-3) {
    const double middle = 0.5 * (carried + too_much);
    (stable_rest(frame, load, middle) ? carried : too_much) = middle;
  }
  throw std::invalid_argument(
      fmt::format("the frame buckles under its own loads, at {:.3f} times their value", carried));
}

}  // namespace

CorotationalForces::CorotationalForces(std::shared_ptr<const CorotationalFrame> frame, const VectorXd& load)
    : frame_(std::move(frame)),
      rest_(rest_of(*frame_, load)),
      force_(frame_->force(rest_)),
      energy_(frame_->energy(rest_)) {}

double CorotationalForces::energy(const VectorXd& u) const {
  return frame_->energy(rest_ + u) - energy_ - force_.dot(u);
}

}  // namespace pounding
