#include <pounding/structures/coupled_yielding.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

using Pair = CoupledYielding::Pair;

double speed_of(double x, double y) noexcept { return std::hypot(x, y); }

/// An accepted step of both deformations: a cubic for each.
class CubicStep {
 public:
  explicit CubicStep(std::span<const LinkStep> step)
      : step_{step[0], step[1]}, h_(step[0].end - step[0].begin), x_(cubic(0)), y_(cubic(1)) {}

  Pair at(double s) const noexcept { return {x_.at(s), y_.at(s)}; }
  double speed(double s) const noexcept { return speed_of(rate(0, s), rate(1, s)); }
  /// Fraction of the step at which the path reverses; 1 if it does not. The reversal is that in the direction of the
  /// change of velocity, with deformations divided by `scale`.
  double reversal(const Pair& scale) const noexcept {
    double product = 0;
    LinkMotion begin, end;
    for (int i = 0; i < 2; ++i) {
      const LinkMotion a = step_[i].motion_begin, b = step_[i].motion_end;
      const double weight = 1 / (scale[i] * scale[i]), change = weight * (a.rate - b.rate);
      product += weight * a.rate * b.rate;
      begin.penetration += change * a.penetration, begin.rate += change * a.rate;
      end.penetration += change * b.penetration, end.rate += change * b.rate;
    }
    if (!(product < 0)) return 1;
    const double s = CubicPenetration(begin, end, h_).turn();
    return s > 0 && s < 1 ? s : 1;
  }

 private:
  CubicPenetration cubic(int i) const noexcept { return {step_[i].motion_begin, step_[i].motion_end, h_}; }
  double rate(int i, double s) const noexcept {
    const double a = step_[i].motion_begin.rate, b = step_[i].motion_end.rate;
    const double mean = (step_[i].motion_end.penetration - step_[i].motion_begin.penetration) / h_;
    return a + s * (2 * (3 * mean - 2 * a - b) + s * 3 * (a + b - 2 * mean));
  }

  std::array<LinkStep, 2> step_;
  double h_;
  CubicPenetration x_, y_;
};

/// Number of chords of equal duration that deviate from the path by at most 1e-7 of the scale, or the maximum.
int chords(const CubicStep& path, const Pair& scale, double from, double to) noexcept {
  constexpr double allowed = 1e-7;
  constexpr int maximum = 16;
  const auto scaled = [&](double s) {
    const Pair d = path.at(s);
    return Pair{d[0] / scale[0], d[1] / scale[1]};
  };
  const Pair a = scaled(from), b = scaled(to);
  const double x = b[0] - a[0], y = b[1] - a[1], length = std::hypot(x, y);
  if (!(length > 0)) return 1;
  double deviation = 0;
  for (const double s : {0.25, 0.5, 0.75}) {
    const Pair c = scaled(from + s * (to - from));
    deviation = std::max(deviation, std::abs(x * (c[1] - a[1]) - y * (c[0] - a[0])) / length);
  }
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(deviation / allowed)), 1.0, double{maximum}));
}

}  // namespace

void CoupledYielding::evaluate(ConstElementMemory memory, std::span<const LinkMotion> motion,
                               ElementResponse& response) const noexcept {
  const double speed = speed_of(motion[0].rate, motion[1].rate);
  const Flow end = flow(memory_as<State>(memory), {motion[0].penetration, motion[1].penetration}, speed);
  for (int i = 0; i < 2; ++i) {
    const double h = lost_stiffness(i);
    response.force[i] = -h * end.plastic[i];
    for (int j = 0; j < 2; ++j) {
      response.by_deformation[i][j] = -h * end.by_deformation[i][j];
      response.by_rate[i][j] = speed > 0 ? -h * end.by_speed[i] * motion[j].rate / speed : 0;
    }
  }
}

void CoupledYielding::start(ElementMemory memory, std::span<const LinkMotion> motion) const {
  State& state = memory_as<State>(memory);
  if (state.deformation != Pair{}) return;
  const Pair d{motion[0].penetration, motion[1].penetration};
  const double speed = speed_of(motion[0].rate, motion[1].rate);
  state = {.deformation = d, .plastic = flow(state, d, speed).plastic, .speed = speed, .lost = state.lost};
}

// Follows a straight path.
void CoupledYielding::follow(State& state, const Pair& deformation, double speed) const noexcept {
  const Flow end = flow(state, deformation, speed);
  Pair work{};
  for (int i = 0; i < 2; ++i) {
    const double elastic = state.deformation[i] - state.plastic[i] + deformation[i] - end.plastic[i];
    work[i] = std::max(0.0, lost_stiffness(i) * elastic * (end.plastic[i] - state.plastic[i]));
  }
  const double both = work[0] + work[1], fraction = both > 0 ? work[0] / both : 0.5;
  state = {.deformation = deformation,
           .plastic = end.plastic,
           .speed = speed,
           .lost = {state.lost[0] + fraction * end.lost, state.lost[1] + (1 - fraction) * end.lost}};
}

void CoupledYielding::accept(ElementMemory memory, std::span<const LinkStep> step) const {
  State& state = memory_as<State>(memory);
  const CubicStep path(step);
  const Pair scale{yield_deformation(0), yield_deformation(1)};
  const double reversal = path.reversal(scale);
  for (const auto& [from, to] : {Pair{0, reversal}, Pair{reversal, 1}}) {
    if (!(to > from)) continue;
    const int count = std::max(min_pieces(), chords(path, scale, from, to));
    for (int i = 1; i <= count; ++i) {
      const double s = from + (to - from) * i / count;
      if (i < count || to < 1) follow(state, path.at(s), path.speed(s));
    }
  }
  follow(state, {step[0].motion_end.penetration, step[1].motion_end.penetration},
         speed_of(step[0].motion_end.rate, step[1].motion_end.rate));
}

ElementEnergy CoupledYielding::energy(ConstElementMemory memory) const noexcept {
  const State& state = memory_as<State>(memory);
  ElementEnergy energy{.lost = state.lost[0] + state.lost[1]};
  // h (d - p)^2/2 - h d^2/2
  for (int i = 0; i < 2; ++i)
    energy.stored_correction -=
        0.5 * lost_stiffness(i) * state.plastic[i] * (2 * state.deformation[i] - state.plastic[i]);
  return energy;
}

}  // namespace pounding
