#pragma once
/// Cached calibrations of a law, instead of one at every touch: some integrate impacts for milliseconds.

#include <array>
#include <type_traits>

#include <pounding/laws/all.hpp>
#include <pounding/study/adams_calibration.hpp>

namespace pounding::study {

/// Last calibration of one formula on this thread. The formula is pure, so cached results are bitwise identical.
struct LastCalibration {
  laws::DampingFormula formula = nullptr;
  laws::CalibrationTarget target{};
  double number = 0;
  bool known = false;

  double number_for(const laws::CalibrationTarget& requested) {
    if (!known || !same(requested, target)) number = formula(requested), target = requested, known = true;
    return number;
  }

 private:
  static bool same(const laws::CalibrationTarget& a, const laws::CalibrationTarget& b) {
    const auto numbers = [](const laws::CalibrationTarget& target) {
      const auto& [e, v, k, n, m, depth, yield] = target;
      return std::array{e, v, k, n, m, depth, yield};
    };
    return numbers(a) == numbers(b);
  }
};

/// One per law.
template <class Law>
LastCalibration& last_calibration() {
  thread_local LastCalibration last;
  return last;
}

/// True if the laws have the same formula or none has any.
template <class Law>
bool same_formula(const Law& a, const Law& b) {
  if constexpr (requires { a.formula == b.formula; }) return a.formula == b.formula;
  return true;
}

/// The law with a formula that caches its last result on this thread. A number that depends on the closing speed is
/// still computed at every touch, except for adams_impact, which uses a table.
template <class Law>
Law remembering(Law law) {
  if constexpr (std::is_same_v<Law, laws::AdamsImpact>) {
    if (law.formula == &laws::exact_adams_impact) law.formula = &tabled_adams_impact;
    return law;
  } else if constexpr (requires { law.formula = laws::DampingFormula{}; }) {
    LastCalibration& last = last_calibration<Law>();
    if (law.formula != last.formula) last = {.formula = law.formula, .target = {}, .number = 0, .known = false};
    law.formula = [](const laws::CalibrationTarget& requested) {
      return last_calibration<Law>().number_for(requested);
    };
  }
  return law;
}

/// True for a law whose curve follows from powers of the closing speed and that accepts the curve instead.
template <class Law>
inline constexpr bool has_curve =
    requires(Law law, const laws::Impact& impact) { law.initial_stiffness = law.curve(impact).k1; };

/// The law with the curve of one impact, computed once.
template <class Law>
Law with_curve(const Law& law, const laws::Impact& impact) {
  const auto [k1, k2, yield] = law.curve(impact);
  Law given;
  given.initial_stiffness = k1, given.secondary_stiffness = k2, given.yield_penetration = yield;
  return given;
}

}  // namespace pounding::study
