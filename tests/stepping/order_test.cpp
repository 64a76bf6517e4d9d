// The observed orders of generalized-alpha and ESDIRK4. For generalized-alpha, halving the step divides the error by
// four, from rest or not, with contacts whose force is smooth (Hertz) or jumps at the touch (Kelvin-Voigt), because
// steps end at the located instants.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <pounding/laws/free_impact.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/stepper.hpp>
#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace order_test {

SparseMatrix one(double value) { return Eigen::MatrixXd::Constant(1, 1, value).sparseView(); }

struct Problem {
  System system;
  std::unique_ptr<const Contact> contact;
  Eigen::VectorXd u, v;
  double end = 0;
};

// u'' + 2 z w u' + w^2 u = 0 from u = 1, v = 0: the initial acceleration is nonzero.
Problem damped_oscillator(double w, double z) {
  Problem p;
  p.system.mass = one(2.0);
  p.system.damping = one(2.0 * 2 * z * w);
  p.system.stiffness = one(2.0 * w * w);
  p.system.gap_jacobian = SparseMatrix(1, 0);
  p.system.groups = {{0, 1, 1.0, 1.0}};
  p.u = Eigen::VectorXd::Constant(1, 1.0);
  p.v = Eigen::VectorXd::Zero(1);
  p.end = 1.0;
  return p;
}

double exact_oscillation(double w, double z, double t) {
  const double wd = w * std::sqrt(1 - z * z);
  return std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
}

// A mass of 60 t at 1 m/s, 10 mm from a wall.
template <class Law>
Problem ball_on_wall(const Law& law, double end) {
  Problem p;
  p.system.mass = one(6e4);
  p.system.damping = p.system.stiffness = SparseMatrix(1, 1);
  p.system.gap_jacobian = one(1);
  p.system.groups = {{0, 1, 1e-3, 1.0}};
  p.contact = std::make_unique<GapContact<Law>>(law, 0.01);
  p.system.contacts = {p.contact.get()};
  p.u = Eigen::VectorXd::Zero(1);
  p.v = Eigen::VectorXd::Ones(1);
  p.end = end;
  return p;
}

double observed_order(const std::vector<double>& errors) {
  return std::log2(errors[errors.size() - 2] / errors.back());
}

constexpr Scheme alpha(double radius) { return {.kind = Scheme::Kind::generalized_alpha, .spectral_radius = radius}; }

class SpectralRadius : public testing::TestWithParam<double> {};

TEST_P(SpectralRadius, FreeVibrationFromRestIsSecondOrder) {
  test::Book book("Orders of the time schemes", "free vibration of a damped oscillator in closed form",
                  "the next order of the error");
  const double w = 7.0, z = 0.05;
  std::vector<double> errors;
  for (const double h : {1.0 / 64, 1.0 / 128, 1.0 / 256, 1.0 / 512}) {
    Problem p = damped_oscillator(w, z);
    ModalSolver base(p.system);
    Stepper stepper(p.system, base, {.tolerance = 1e-3, .scheme = alpha(GetParam()), .max_step = h});
    stepper.start(0, p.u, p.v);
    EXPECT_DOUBLE_EQ(stepper.view().state().a[0], -w * w) << "the initial acceleration balances the equations";
    test::march_evenly(stepper, p.end, h);
    errors.push_back(std::abs(stepper.view().state().u[0] - exact_oscillation(w, z, p.end)));
  }
  book.near("generalized-alpha: order in free vibration [-]", observed_order(errors), 2.0, 0.06);
}

// Error of position and speed after an impact that ends at `parting` with the speed `speed`; only one of the two may
// pass through zero between two steps.
template <class Law>
double error_after_impact(const Law& law, double parting, double speed, double h, const Scheme& scheme) {
  const double end = 0.15;
  Problem p = ball_on_wall(law, end);
  ModalSolver base(p.system);
  Stepper stepper(p.system, base, {.tolerance = 1e-3, .scheme = scheme, .max_step = h});
  stepper.start(0, p.u, p.v);
  test::march_evenly(stepper, end, h);
  const double position = 0.01 - speed * (end - 0.01 - parting);
  return std::hypot(stepper.view().state().v[0] + speed, (stepper.view().state().u[0] - position) / parting);
}

// Slope of a linear fit of log error against log step.
double order_of(const std::vector<double>& errors) {
  const double n = static_cast<double>(errors.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double step = -static_cast<double>(i), error = std::log2(errors[i]);
    x += step, y += error, xx += step * step, xy += step * error;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

TEST_P(SpectralRadius, AHertzImpactIsSecondOrder) {
  test::Book book("Orders of the time schemes", "free impact of a Hertz spring in closed form",
                  "the next order of the error");
  const laws::Hertz law{.stiffness = 2.75e9};
  const double duration = laws::free_impact(law, 6e4, 1.0).duration;
  std::vector<double> errors;
  for (double h = 2e-4; h > 5e-6; h /= 2)
    errors.push_back(error_after_impact(law, duration, 1.0, h, alpha(GetParam())));
  book.near("generalized-alpha: order through a Hertz impact, linear fit [-]", order_of(errors), 2.0, 0.15);
  book.near("generalized-alpha: order through a Hertz impact, last two steps [-]", observed_order(errors), 2.0, 0.2);
}

TEST_P(SpectralRadius, AKelvinVoigtImpactIsSecondOrderAlthoughItsForceJumps) {
  test::Book book("Orders of the time schemes",
                  "free impact of a Kelvin-Voigt contact in closed form, whose force jumps at the touch",
                  "the next order of the error");
  const double requested = 0.65;
  const laws::KelvinVoigt law{.stiffness = 9.35e7, .restitution = requested, .reduced_mass = 6e4};
  const double duration = laws::free_impact(law, 6e4, 1.0).duration;
  std::vector<double> errors;
  for (double h = 2e-4; h > 5e-6; h /= 2)
    errors.push_back(error_after_impact(law, duration, requested, h, alpha(GetParam())));
  book.near("generalized-alpha: order through a Kelvin-Voigt impact, linear fit [-]", order_of(errors), 2.0, 0.15);
  book.near("generalized-alpha: order through a Kelvin-Voigt impact, last two steps [-]", observed_order(errors), 2.0,
            0.2);
}

INSTANTIATE_TEST_SUITE_P(GeneralizedAlpha, SpectralRadius, testing::Values(1.0, 0.8, 0.0));

// The acceleration of the scheme belongs to a time that moves with the step. Without that shift at a change of the
// step, the error estimate would require six times as many steps.
TEST(SpectralRadiusBelowOne, CostsNoMoreStepsThanOne) {
  const auto steps = [](const char* radius) {
    std::string yaml = test::two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65", 1e-5);
    yaml.insert(yaml.rfind('}'), std::string(", integrator: generalized_alpha, spectral_radius: ") + radius);
    const Outcome run = test::run_text(yaml);
    EXPECT_LT(run.summary.energy.error, 1e-5);
    return run.summary.solver.steps + run.summary.solver.rejected;
  };
  EXPECT_LT(steps("0.8"), 1.1 * steps("1"));
}

// The fourth-order scheme.

TEST(Esdirk4, MeetsTheConditionsOfItsOrder) {
  test::Book book("Orders of the time schemes",
                  "conditions of order four of Runge-Kutta methods, of order three for the embedded one", "rounding");
  using namespace esdirk4;
  double rows = 0, b1 = 0, b2 = 0, b3 = 0, b4 = 0, b31 = 0, b41 = 0, b42 = 0, b43 = 0, e1 = 0, e2 = 0, e3 = 0, e31 = 0;
  const double* b = a[stages - 1];
  double ac[stages] = {}, acc[stages] = {}, aac[stages] = {};
  for (int i = 0; i < stages; ++i) {
    double sum = 0;
    for (int j = 0; j < stages; ++j) {
      sum += a[i][j];
      ac[i] += a[i][j] * c[j];
      acc[i] += a[i][j] * c[j] * c[j];
    }
    rows = std::max(rows, std::abs(sum - c[i]));
  }
  for (int i = 0; i < stages; ++i)
    for (int j = 0; j < stages; ++j) aac[i] += a[i][j] * ac[j];
  for (int i = 0; i < stages; ++i) {
    b1 += b[i], b2 += b[i] * c[i], b3 += b[i] * c[i] * c[i], b4 += b[i] * c[i] * c[i] * c[i];
    b31 += b[i] * ac[i], b41 += b[i] * c[i] * ac[i], b42 += b[i] * acc[i], b43 += b[i] * aac[i];
    e1 += embedded[i], e2 += embedded[i] * c[i], e3 += embedded[i] * c[i] * c[i], e31 += embedded[i] * ac[i];
  }
  book.below("ESDIRK4(3): row sums less c [-]", rows, 1e-15);
  book.near("ESDIRK4(3): sum b [-]", b1, 1, 1e-14);
  book.near("ESDIRK4(3): b c [-]", b2, 1.0 / 2, 1e-14);
  book.near("ESDIRK4(3): b c^2 [-]", b3, 1.0 / 3, 1e-14);
  book.near("ESDIRK4(3): b A c [-]", b31, 1.0 / 6, 1e-14);
  book.near("ESDIRK4(3): b c^3 [-]", b4, 1.0 / 4, 1e-14);
  book.near("ESDIRK4(3): b c A c [-]", b41, 1.0 / 8, 1e-14);
  book.near("ESDIRK4(3): b A c^2 [-]", b42, 1.0 / 12, 1e-14);
  book.near("ESDIRK4(3): b A A c [-]", b43, 1.0 / 24, 1e-14);
  book.near("ESDIRK4(3): embedded: sum b [-]", e1, 1, 1e-14);
  book.near("ESDIRK4(3): embedded: b c [-]", e2, 1.0 / 2, 1e-14);
  book.near("ESDIRK4(3): embedded: b c^2 [-]", e3, 1.0 / 3, 1e-14);
  book.near("ESDIRK4(3): embedded: b A c [-]", e31, 1.0 / 6, 1e-14);
  for (int i = 1; i < stages; ++i) EXPECT_EQ(a[i][i], shift) << "one matrix for all stages";
}

constexpr Scheme fourth{.kind = Scheme::Kind::esdirk4};

TEST(Esdirk4, FreeVibrationFromRestIsOfOrderFour) {
  test::Book book("Orders of the time schemes", "free vibration of a damped oscillator in closed form",
                  "the next order of the error");
  const double w = 7.0, z = 0.05;
  std::vector<double> errors;
  for (const double h : {1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128}) {
    Problem p = damped_oscillator(w, z);
    ModalSolver base(p.system);
    Stepper stepper(p.system, base, {.tolerance = 1e-3, .scheme = fourth, .max_step = h});
    stepper.start(0, p.u, p.v);
    test::march_evenly(stepper, p.end, h);
    errors.push_back(std::abs(stepper.view().state().u[0] - exact_oscillation(w, z, p.end)));
  }
  book.near("ESDIRK4: order in free vibration [-]", observed_order(errors), 4.0, 0.1);
}

TEST(Esdirk4, AKelvinVoigtImpactIsOfOrderFour) {
  test::Book book("Orders of the time schemes",
                  "free impact of a Kelvin-Voigt contact in closed form, whose force jumps at the touch",
                  "the next order of the error");
  const double requested = 0.65;
  const laws::KelvinVoigt law{.stiffness = 9.35e7, .restitution = requested, .reduced_mass = 6e4};
  const double duration = laws::free_impact(law, 6e4, 1.0).duration;
  std::vector<double> errors;
  for (double h = 1.6e-2; h > 1e-3; h /= 2) errors.push_back(error_after_impact(law, duration, requested, h, fourth));
  book.near("ESDIRK4: order through a Kelvin-Voigt impact, linear fit [-]", order_of(errors), 4.0, 0.3);
  book.below("ESDIRK4: error after a Kelvin-Voigt impact, shortest step [-]", errors.back(), 1e-6);
}

// d^(3/2) has no second derivative at the touch: at least order 5/2, but not the order of the scheme.
TEST(Esdirk4, AHertzImpactIsOfTheOrderOfItsForce) {
  const laws::Hertz law{.stiffness = 2.75e9};
  const double duration = laws::free_impact(law, 6e4, 1.0).duration;
  std::vector<double> errors;
  for (double h = 8e-3; h > 2e-4; h /= 2) errors.push_back(error_after_impact(law, duration, 1.0, h, fourth));
  EXPECT_GT(order_of(errors), 2.4);
}

TEST(Esdirk4, EstimatesAnErrorOfOrderFour) {
  test::Book book("Orders of the time schemes", "order of the embedded error estimate", "the next order of the error");
  Problem p = damped_oscillator(7.0, 0.05);
  ModalSolver base(p.system);
  Stepper stepper(p.system, base, {.tolerance = 1e-3, .scheme = fourth, .max_step = 0.1});
  stepper.start(0, p.u, p.v);
  ASSERT_TRUE(stepper.try_step(4e-3));
  const double coarse = stepper.view().error_ratio();
  ASSERT_TRUE(stepper.try_step(2e-3));
  book.near("ESDIRK4: order of the error estimate [-]", std::log2(coarse / stepper.view().error_ratio()), 4.0, 0.2);
}

TEST(ErrorEstimate, FallsWithTheCubeOfTheStep) {
  test::Book book("Orders of the time schemes", "order of the local error", "the next order of the error");
  Problem p = damped_oscillator(7.0, 0.05);
  ModalSolver base(p.system);
  Stepper stepper(p.system, base, {.tolerance = 1e-3, .scheme = alpha(1), .max_step = 0.1});
  stepper.start(0, p.u, p.v);
  ASSERT_TRUE(stepper.try_step(1e-2));
  const double coarse = stepper.view().error_ratio();
  ASSERT_TRUE(stepper.try_step(5e-3));
  book.near("generalized-alpha: order of the error estimate [-]", std::log2(coarse / stepper.view().error_ratio()), 3.0,
            0.15);
}

// The estimate agrees with the actual error of the step within a small factor.
TEST(ErrorEstimate, IsTheErrorOfTheStep) {
  const double w = 7.0, z = 0.05, tolerance = 1e-3, h = 2e-3;
  Problem p = damped_oscillator(w, z);
  ModalSolver base(p.system);
  Stepper stepper(p.system, base, {.tolerance = tolerance, .scheme = alpha(1), .max_step = h});
  stepper.start(0, p.u, p.v);
  ASSERT_TRUE(stepper.try_step(h));
  const double estimated = stepper.view().error_ratio() * 0.25 * std::pow(tolerance, 1.5);
  stepper.accept();
  const double slope = (exact_oscillation(w, z, h + 1e-6) - exact_oscillation(w, z, h - 1e-6)) / 2e-6;
  const double made = std::max(std::abs(stepper.view().state().u[0] - exact_oscillation(w, z, h)),
                               std::abs(stepper.view().state().v[0] - slope));
  EXPECT_GT(estimated, 0.3 * made);
  EXPECT_LT(estimated, 5 * made);
}

}  // namespace order_test
}  // namespace pounding
