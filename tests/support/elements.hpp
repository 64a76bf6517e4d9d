#pragma once
/// Contract of elements with two deformations, and a mass on such an element in an earthquake.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <pounding/base/gauss.hpp>
#include <pounding/structures/element.hpp>
#include "support/bearing_references.hpp"
#include "support/records.hpp"

namespace pounding::test {

using Vector2 = std::array<double, 2>;

/// An element with two deformations and its memory, which starts undeformed.
class ElementRun {
 public:
  explicit ElementRun(const Element& element)
      : element_(&element), bytes_((element.memory_size() + sizeof(double) - 1) / sizeof(double)) {
    element.reset(memory());
  }

  ElementResponse at(const Vector2& d, const Vector2& rate = {}) const {
    ElementResponse response;
    const std::array motion{LinkMotion{d[0], rate[0]}, LinkMotion{d[1], rate[1]}};
    element_->evaluate(std::as_bytes(std::span(bytes_)), motion, response);
    return response;
  }
  /// Force including k_i d_i.
  Vector2 force(const Vector2& d, const Vector2& rate = {}) const {
    const ElementResponse response = at(d, rate);
    return {element_->stiffness(0) * d[0] + response.force[0], element_->stiffness(1) * d[1] + response.force[1]};
  }
  /// Accepts a step of one second on a straight path at a constant rate.
  void go(const Vector2& d) { step(d, {d[0] - d_[0], d[1] - d_[1]}, {d[0] - d_[0], d[1] - d_[1]}, 1); }
  /// Accepts a step of duration h that begins and ends with these rates.
  void step(const Vector2& d, const Vector2& rate_begin, const Vector2& rate_end, double h) {
    std::array<LinkStep, 2> steps;
    for (int i = 0; i < 2; ++i) {
      steps[i].end = h;
      steps[i].motion_begin = {d_[i], rate_begin[i]};
      steps[i].motion_end = {d[i], rate_end[i]};
    }
    element_->accept(memory(), steps);
    d_ = d;
  }
  const Vector2& d() const { return d_; }
  double lost() const { return energy().lost; }
  double stored() const {
    double sum = energy().stored_correction;
    for (int i = 0; i < 2; ++i) sum += 0.5 * element_->stiffness(i) * d_[i] * d_[i];
    return sum;
  }
  const std::vector<double>& bytes() const { return bytes_; }
  const Element& element() const { return *element_; }

 private:
  ElementMemory memory() { return std::as_writable_bytes(std::span(bytes_)); }
  ElementEnergy energy() const { return element_->energy(std::as_bytes(std::span(bytes_))); }

  const Element* element_;
  std::vector<double> bytes_;
  Vector2 d_{};
};

/// Random deformations: near zero, within a few yield deformations, or far.
class RandomPath {
 public:
  explicit RandomPath(const Element& element, unsigned seed = 1) : element_(&element), random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  Vector2 next() {
    const double size = std::pow(10.0, uniform(-1, 1));
    return {size * uniform(-1, 1) * element_->yield_deformation(0),
            size * uniform(-1, 1) * element_->yield_deformation(1)};
  }
  /// With up to six random straight steps.
  ElementRun state() {
    ElementRun run(*element_);
    for (int i = static_cast<int>(uniform(0, 7)); i > 0; --i) run.go(next());
    return run;
  }

 private:
  const Element* element_;
  std::mt19937 random_;
};

inline double yield_force(const Element& element, int i) { return element.stiffness(i) * element.yield_deformation(i); }

/// Slopes are the derivatives of the forces in random states; at a kink, that of either side. `rate` [m/s] is the size
/// of the rates. Errors are relative to yield force and yield deformation, or rate.
inline void expect_slopes_are_derivatives(const Element& element, double rate, double allowed, int states = 10000) {
  RandomPath path(element);
  double worst = 0, largest_by_rate = 0;
  for (int n = 0; n < states; ++n) {
    const ElementRun run = path.state();
    const std::vector<double> before = run.bytes();
    const Vector2 d = path.next(), v{rate * path.uniform(-1, 1), rate * path.uniform(-1, 1)};
    const ElementResponse here = run.at(d, v);
    for (int kind = 0; kind < 2; ++kind)
      for (int j = 0; j < 2; ++j) {
        const double scale = kind == 0 ? element.yield_deformation(j) : rate;
        const auto moved = [&](double by) {
          Vector2 to = d, speed = v;
          (kind == 0 ? to : speed)[j] += by * scale;
          return run.at(to, speed).force;
        };
        const double h = 1e-5;
        const auto two = moved(2 * h), up = moved(h), down = moved(-h), minus_two = moved(-2 * h);
        for (int i = 0; i < 2; ++i) {
          const double slope = (kind == 0 ? here.by_deformation : here.by_rate)[i][j] * scale / yield_force(element, i);
          // One-sided differences of second order.
          const double size = 2 * h * yield_force(element, i);
          const double right = (4 * up[i] - 3 * here.force[i] - two[i]) / size;
          const double left = -(4 * down[i] - 3 * here.force[i] - minus_two[i]) / size;
          const double error = std::min(std::abs(slope - right), std::abs(slope - left));
          worst = std::max(worst, error);
          if (kind == 1) largest_by_rate = std::max(largest_by_rate, std::abs(slope));
        }
      }
    ASSERT_EQ(run.bytes(), before);
  }
  EXPECT_LT(worst, allowed);
  EXPECT_TRUE(rate == 0 || largest_by_rate > 0.01);
}

/// A straight path in one step or in several gives the same forces and losses, relative to yield.
inline void expect_straight_paths_can_be_divided(const Element& element, double allowed) {
  RandomPath path(element);
  double worst_force = 0, worst_loss = 0;
  for (int n = 0; n < 2000; ++n) {
    ElementRun whole = path.state(), divided = whole;
    const Vector2 from = whole.d(), to = path.next();
    whole.go(to);
    double s = 0;
    for (int i = 0; i < 5; ++i) {
      s += (1 - s) * path.uniform(0, 0.6);
      divided.go({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
    }
    divided.go(to);
    const Vector2 a = whole.force(to), b = divided.force(to);
    for (int i = 0; i < 2; ++i) worst_force = std::max(worst_force, std::abs(a[i] - b[i]) / yield_force(element, i));
    const double energy =
        yield_force(element, 0) * element.yield_deformation(0) + yield_force(element, 1) * element.yield_deformation(1);
    worst_loss = std::max(worst_loss, std::abs(whole.lost() - divided.lost()) / energy);
  }
  EXPECT_LT(worst_force, allowed);
  EXPECT_LT(worst_loss, allowed);
}

/// On random closed paths the work of the forces is the stored energy plus the loss, which never decreases.
inline void expect_energies_balance(const Element& element, double allowed) {
  RandomPath path(element);
  const double scale = yield_force(element, 0) * element.yield_deformation(0);
  for (int n = 0; n < 100; ++n) {
    ElementRun run(element);
    double work = 0, lost = 0;
    for (int leg = 0; leg < 6; ++leg) {
      const Vector2 from = run.d(), to = leg < 5 ? path.next() : Vector2{};
      const int steps = 400;
      for (int i = 1; i <= steps; ++i) {
        const Vector2 begin = run.d();
        const double s = static_cast<double>(i) / steps;
        const Vector2 end{from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])};
        work += gauss_integral(
            [&](double part) {
              const Vector2 x{end[0] - begin[0], end[1] - begin[1]};
              const Vector2 f = run.force({begin[0] + part * x[0], begin[1] + part * x[1]}, x);
              return f[0] * x[0] + f[1] * x[1];
            },
            0, 1);
        run.go(end);
        ASSERT_GE(run.lost() - lost, -1e-13 * scale);
        lost = run.lost();
      }
    }
    ASSERT_NEAR(work, run.stored() + run.lost(), allowed * (scale + run.lost()));
    ASSERT_GE(work, -allowed * scale);
  }
}

/// One horizontal component of El Centro 1940 [m/s^2], at 0.01 s; empty if the record is missing.
inline std::vector<double> el_centro(const std::string& component) {
  std::ifstream file(folder_of_records() + "/imperialValley_elCentro_1940/RSN6_IMPVALL.I_I-" + component + ".AT2");
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(file, line);
  std::vector<double> values;
  for (double value; file >> value;) values.push_back(9.80665 * value);
  return values;
}

/// Peaks and instants of a mass [kg] on the element, both components of El Centro, by the classical Runge-Kutta scheme.
/// Also checks the balance of energies, relative to the input.
inline BearingReference ride(const Element& element, double mass, double h, double allowed_imbalance) {
  const std::array record{el_centro("ELC180-hor1"), el_centro("ELC270-hor2")};
  BearingReference found{};
  if (record[0].empty()) {
    ADD_FAILURE() << "missing record; run `make python` to install it";
    return found;
  }
  const auto ground = [&](int i, double t) {
    const double place = t / 0.01;
    const auto n = std::min(static_cast<std::size_t>(place), record[i].size() - 2);
    return record[i][n] + (place - static_cast<double>(n)) * (record[i][n + 1] - record[i][n]);
  };
  ElementRun run(element);
  Vector2 u{}, v{};
  double work = 0;
  std::size_t next = 0;
  const int steps = static_cast<int>(std::lround(bearing_instants.back() / h));
  for (int step = 0; step < steps; ++step) {
    const double t = step * h;
    const auto acceleration = [&](const Vector2& d, const Vector2& rate, double time) {
      const Vector2 f = run.force(d, rate);
      return Vector2{-f[0] / mass - ground(0, time), -f[1] / mass - ground(1, time)};
    };
    const auto plus = [](const Vector2& a, double by, const Vector2& b) {
      return Vector2{a[0] + by * b[0], a[1] + by * b[1]};
    };
    const Vector2 a1 = acceleration(u, v, t), v2 = plus(v, h / 2, a1);
    const Vector2 a2 = acceleration(plus(u, h / 2, v), v2, t + h / 2), v3 = plus(v, h / 2, a2);
    const Vector2 a3 = acceleration(plus(u, h / 2, v2), v3, t + h / 2), v4 = plus(v, h, a3);
    const Vector2 a4 = acceleration(plus(u, h, v3), v4, t + h);
    Vector2 u1, v1;
    for (int i = 0; i < 2; ++i) {
      u1[i] = u[i] + h / 6 * (v[i] + 2 * v2[i] + 2 * v3[i] + v4[i]);
      v1[i] = v[i] + h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
      work -=
          mass * h / 6 * (ground(i, t) * v[i] + 2 * ground(i, t + h / 2) * (v2[i] + v3[i]) + ground(i, t + h) * v1[i]);
      found.values[0][i] = std::max(found.values[0][i], std::abs(u1[i]));
    }
    run.step(u1, v, v1, h);
    u = u1, v = v1;
    if (next < bearing_instants.size() && t + h > bearing_instants[next] - 0.5 * h) found.values[++next] = u;
  }
  const double kinetic = 0.5 * mass * (v[0] * v[0] + v[1] * v[1]);
  EXPECT_NEAR(kinetic + run.stored() + run.lost(), work, allowed_imbalance * work);
  return found;
}

/// Largest difference from a reference, relative to the larger peak.
inline double difference(const BearingReference& found, const BearingReference& expected) {
  double worst = 0;
  for (std::size_t n = 0; n < found.values.size(); ++n)
    for (int i = 0; i < 2; ++i) worst = std::max(worst, std::abs(found.values[n][i] - expected.values[n][i]));
  return worst / std::max(expected.values[0][0], expected.values[0][1]);
}

}  // namespace pounding::test
