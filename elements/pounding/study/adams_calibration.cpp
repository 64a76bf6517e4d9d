#include <pounding/study/adams_calibration.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <pounding/base/extrapolation.hpp>
#include <pounding/base/root.hpp>
#include <pounding/laws/adams_impact.hpp>

namespace pounding::study {
namespace {

/// A free impact of unit mass, speed and stiffness.
class UnitImpact {
 public:
  explicit UnitImpact(const laws::AdamsImpact& law) : law_(law), impact_(laws::touch(law, 1)) {}

  /// Restitution to 1e-11.
  double restitution() {
    // At such a penetration the energy of the spring is negligible.
    for (int i = 0; i < 5000 && (y_[1] > 0 || y_[0] > 1e-6); ++i) {
      // The force is not smooth at its end, so steps do not pass it.
      if (y_[1] < 0) h_ = std::min(h_, std::sqrt(std::sqrt(x_ * x_ * x_ * x_ - 0.9 * y_[0] / y_[1])) - x_);
      auto end = moved(h_);
      land(end);
      if ((end.error > 1 || end.state[0] < 0) && h_ > shortest) {
        h_ *= end.error > 1 ? std::clamp(0.8 * std::pow(end.error, -1.0 / 11), 0.1, 0.7) : 0.5;
        continue;
      }
      x_ += h_, y_ = end.state;
      h_ *= std::clamp(0.8 * std::pow(std::max(end.error, 1e-12), -1.0 / 11), 0.5, 3.0);
    }
    return -y_[1];
  }

 private:
  using State = std::array<double, 2>;
  static constexpr double tolerance = 1e-12, shortest = 1e-9;

  // In the fourth root of time, in which the first touch is smooth.
  ExtrapolatedStep<2> moved(double h) const {
    const auto slope = [&](double x, const State& y) {
      const double speed = 4 * x * x * x;
      return State{speed * y[1], -speed * law_.respond(y[0], y[1], impact_).force};
    };
    return extrapolated_step<2>(slope, x_, y_, h, tolerance);
  }
  // Ends the step where the damping becomes full or the force is cut off: the error estimate can overlook such points.
  // It also ends at the reversal, since bodies that just reach the depth of full damping would pass it twice in one
  // step.
  void land(ExtrapolatedStep<2>& end) {
    const auto place = [&](int which, const State& y) {
      return which == 0   ? y[1]
             : which == 1 ? law_.corner(y[0], y[1], impact_)
                          : law_.contact(y[0], y[1], impact_).force;
    };
    for (const int which : {0, 1, 2}) {
      const double before = place(which, y_), after = place(which, end.state);
      if (!(before * after < 0)) continue;
      const double h = find_root([&](double part) { return place(which, moved(part).state); }, 0, before, h_, after);
      if (h > shortest) h_ = h, end = moved(h);
    }
  }

  const laws::AdamsImpact& law_;
  laws::Impact impact_;
  State y_{0, 1};
  double x_ = 0, h_ = 0.3;
};

/// Damping numbers of one restitution and one exponent over the depth of full damping, in impact lengths.
class Table {
 public:
  Table(double restitution, double exponent) : restitution_(restitution), exponent_(exponent) {}

  double number(double depth) {
    const double octave = std::log2(depth);
    for (int level = 0; level <= deepest; ++level) {
      const double place = std::ldexp(octave, level), index = std::floor(place);
      const auto [piece, is_new] = pieces_.try_emplace({level, static_cast<long>(index)});
      if (is_new) piece->second = polynomial(level, index);
      if (piece->second) return std::exp(value(*piece->second, 2 * (place - index) - 1));
    }
    return solved(depth);
  }

 private:
  static constexpr int deepest = 16;  // level of pieces with a width of 2^-16 octaves
  static constexpr std::size_t terms = 12;
  using Series = std::array<double, terms>;  // Chebyshev coefficients

  double solved(double depth) const {
    const double scale = std::max(1.0, depth * depth / 3);
    const auto miss = [&](double number) {
      const laws::AdamsImpact law{.stiffness = 1,
                                  .exponent = exponent_,
                                  .depth = depth,
                                  .damping_coefficient = scale * number,
                                  .reduced_mass = 1};
      return UnitImpact(law).restitution() - restitution_;
    };
    double low = 0, at_low = 1 - restitution_, high = 1, at_high = miss(high);
    while (at_high > 0) {
      // A law that cannot reach its restitution has been rejected by check().
      if (high > 1e9) return scale * high;
      low = std::exchange(high, 4 * high), at_low = at_high;
      at_high = miss(high);
    }
    return scale * find_root(miss, low, at_low, high, at_high);
  }

  // Logarithms of the numbers over one piece; nullopt if they are not smooth: at bodies that just reach the depth or
  // are just released.
  std::optional<Series> polynomial(int level, double index) const {
    Series logarithms, series{};
    const auto angle = [](std::size_t i) { return std::numbers::pi * (static_cast<double>(i) + 0.5) / terms; };
    for (std::size_t i = 0; i < terms; ++i)
      logarithms[i] = std::log(solved(std::exp2(std::ldexp(index + 0.5 * (1 + std::cos(angle(i))), -level))));
    for (std::size_t k = 0; k < terms; ++k)
      for (std::size_t i = 0; i < terms; ++i)
        series[k] += (k == 0 ? 1.0 : 2.0) / terms * logarithms[i] * std::cos(static_cast<double>(k) * angle(i));
    for (std::size_t k = terms - 3; k < terms; ++k)
      if (std::abs(series[k]) > 1e-9) return std::nullopt;
    return series;
  }

  static double value(const Series& series, double x) noexcept {
    double next = 0, after = 0;
    for (std::size_t k = terms - 1; k > 0; --k) after = std::exchange(next, 2 * x * next - after + series[k]);
    return x * next - after + series[0];
  }

  double restitution_, exponent_;
  std::map<std::pair<int, long>, std::optional<Series>> pieces_;
};

}  // namespace

double tabled_adams_impact(const laws::CalibrationTarget& requested) {
  if (requested.restitution >= 1) return 0;
  thread_local std::map<std::pair<double, double>, Table> tables;
  if (tables.size() > 1000) tables.clear();
  Table& table =
      tables.try_emplace({requested.restitution, requested.exponent}, requested.restitution, requested.exponent)
          .first->second;
  return table.number(requested.depth / impact_length(requested.reduced_mass, requested.closing_speed,
                                                      requested.stiffness, requested.exponent));
}

}  // namespace pounding::study
