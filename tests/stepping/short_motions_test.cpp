// Short ground motions: closed forms of undamped structures, the energy balance, and steps that grow again after the
// motion.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/model/model.hpp>
#include <pounding/model/system.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace short_motions_test {

constexpr double pi = std::numbers::pi;
constexpr double amplitude = 3, period = 0.43, durations[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1};

// A ground motion by its duration.
struct Kind {
  const char* name;
  double cycles;  // number of sine cycles; 0: constant acceleration
};

constexpr double harmonic_cycles = 2.6;

constexpr Kind kinds[] = {{"rectangle", 0}, {"half_sine", 0.5}, {"sine", 1}, {"harmonic", harmonic_cycles}};

struct Motion {
  double u = 0, v = 0;
};

// u'' + w^2 u = -ag from rest, at the end of the motion and `later` after it. sin(p d) and cos(p d) - cos(w d) are
// written without cancellation.
Motion exact(const Kind& kind, double duration, double w, double later) {
  Motion end;
  const double p = 2 * pi * kind.cycles / duration;
  if (kind.cycles == 0) {
    end = {-2 * amplitude / (w * w) * std::pow(std::sin(w * duration / 2), 2), -amplitude / w * std::sin(w * duration)};
  } else {
    const double sine = std::fmod(2 * kind.cycles, 1) == 0 ? 0 : std::sin(p * duration),
                 factor = -amplitude / (w * w - p * p);
    end = {factor * (sine - p / w * std::sin(w * duration)),
           -2 * factor * p * std::sin((p + w) * duration / 2) * std::sin((p - w) * duration / 2)};
  }
  const double c = std::cos(w * later), s = std::sin(w * later);
  return {end.u * c + end.v / w * s, end.v * c - w * end.u * s};
}

double size(const Motion& motion, double w) { return std::hypot(motion.u, motion.v / w); }

std::string pulse_text(const std::string& shape, double duration, double start = 0) {
  if (shape == "harmonic")
    return fmt::format("harmonic: {{amplitude: {}, period: {}, duration: {}}}", amplitude, duration / harmonic_cycles,
                       duration);
  return fmt::format("pulse: {{shape: {}, amplitude: {}, duration: {}, start: {}}}", shape, amplitude, duration, start);
}

std::string text(const std::string& ground, const std::string& structures, double tolerance, const std::string& scheme,
                 double length) {
  return fmt::format(
      "ground_motion: {{{}}}\nstructures:\n{}analysis: {{duration: {}, tolerance: {}, integrator: {}}}\n", ground,
      structures, length, tolerance, scheme);
}

const std::string one_oscillator = fmt::format("  a: {{oscillator: {{mass: 1 t, period: {}, damping: 0}}}}\n", period);

struct Case {
  const char* scheme;
  double tolerance;
};

class ShortMotions : public testing::TestWithParam<Case> {};

// Without damping the phase error grows in every period by a fraction of the tolerance, at most 0.6 of it, for any
// motion. Errors are therefore per period.
double periods(double length, double w) { return std::max(1.0, length * w / (2 * pi)); }

TEST_P(ShortMotions, KeepTheToleranceAndTheEnergies) {
  test::Book book("Short motions of the ground",
                  "an undamped oscillator under a rectangle, a half sine, a sine and a harmonic in closed form",
                  "the tolerance of the run, for each period of the motion; durations from 1e-5 s to 1 s");
  const auto [scheme, tolerance] = GetParam();
  const double w = 2 * pi / period;
  for (const Kind& kind : kinds)
    for (const double duration : durations) {
      SCOPED_TRACE(fmt::format("{} of {:g} s", kind.name, duration));
      const double length = duration + period;
      const Outcome found =
          test::run_text(text(pulse_text(kind.name, duration), one_oscillator, tolerance, scheme, length));
      const Motion expected = exact(kind, duration, w, period);
      const StructureHistory& a = found.results.structures[0];
      double largest = size(expected, w);
      for (const double u : a.displacement) largest = std::max(largest, std::abs(u));
      const double error = size({a.displacement.back() - expected.u, a.velocity.back() - expected.v}, w) / largest;
      book.below(fmt::format("{}, {:g}: error of the motion, over the tolerance [-]", scheme, tolerance),
                 error / periods(length, w) / tolerance, 1);
      book.below(fmt::format("{}, {:g}: imbalance of the energies, over the tolerance [-]", scheme, tolerance),
                 found.summary.energy.error / tolerance, 1);
      const double energy = 0.5 * 1e3 * std::pow(w * size(expected, w), 2),
                   maximum = 0.5 * 1e3 * std::pow(w * largest, 2);
      book.below(fmt::format("{}, {:g}: error of the input, over the tolerance [-]", scheme, tolerance),
                 std::abs(found.summary.energy.input - energy) / maximum / tolerance, 1);
    }
}

// The free vibration, which is the same after every motion, takes the majority of the steps.
TEST_P(ShortMotions, TakeAtMostTwiceTheStepsOfARectangle) {
  const auto [scheme, tolerance] = GetParam();
  const double length = std::string(scheme) == "generalized_alpha" && tolerance < 1e-5 ? 4 : 20;  // it needs many steps
  for (const double duration : durations) {
    long of_rectangle = 0;
    for (const Kind& kind : kinds) {
      const Outcome found =
          test::run_text(text(pulse_text(kind.name, duration), one_oscillator, tolerance, scheme, length));
      if (kind.cycles == 0) of_rectangle = found.results.solver.steps;
      EXPECT_LE(found.results.solver.steps, 2 * of_rectangle) << kind.name << " of " << duration << " s";
      EXPECT_LT(found.summary.energy.error, tolerance) << kind.name << " of " << duration << " s";
    }
  }
}

// The motion is zero before a late pulse, and a structure with a delay receives the same pulse.
TEST_P(ShortMotions, MayComeLateAndWithADelay) {
  const auto [scheme, tolerance] = GetParam();
  const double w = 2 * pi / period, start = 5, delay = 0.3, duration = 1e-3;
  const std::string two =
      one_oscillator +
      fmt::format("  b: {{oscillator: {{mass: 1 t, period: {}, damping: 0}}, delay: {}}}\n", period, delay);
  for (const Kind& kind : kinds) {
    if (std::string(kind.name) == "harmonic") continue;
    SCOPED_TRACE(kind.name);
    const double length = start + duration + delay + period;
    const Outcome found = test::run_text(text(pulse_text(kind.name, duration, start), two, tolerance, scheme, length));
    EXPECT_LT(found.summary.energy.error, tolerance);
    for (int i = 0; i < 2; ++i) {
      const Motion expected = exact(kind, duration, w, i == 0 ? period + delay : period);
      const StructureHistory& h = found.results.structures[i];
      const double error =
          size({h.displacement.back() - expected.u, h.velocity.back() - expected.v}, w) / size(expected, w);
      EXPECT_LT(error, tolerance * periods(length - start, w)) << i;
    }
  }
}

// Masses on storeys and members: the sum of the modes, each an oscillator. Returns the error per period of the first
// mode.
double error_of_modes(const Kind& kind, double duration, const std::string& structure, double tolerance,
                      const std::string& scheme, double later, double* imbalance) {
  const std::string yaml = text(pulse_text(kind.name, duration), structure, tolerance, scheme, duration + later);
  const Outcome found = test::run_text(yaml);
  *imbalance = found.summary.energy.error;
  const Model model = test::model_of(yaml);
  const System system = assemble(model);
  const test::dense::Condensed condensed = test::dense::condense(system.stiffness, system.mass);
  const test::dense::Modes modes = test::dense::modes(condensed.stiffness, condensed.mass);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(system.size()), largest = u;
  for (int k = 0; k < modes.squares.size(); ++k) {
    const Eigen::VectorXd shape = modes.shapes.col(k);
    const double part = shape.dot(Eigen::VectorXd(system.load.col(0)(condensed.dynamic))),
                 w = std::sqrt(modes.squares[k]);
    const Motion motion = exact(kind, duration, w, later);
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(system.size());
    whole(condensed.dynamic) = shape;
    whole(condensed.massless) = condensed.following * shape;
    u += part * motion.u * whole;
    largest += (part * size(motion, w) * whole).cwiseAbs();
  }
  const Eigen::VectorXd expected = system.outputs.transpose() * u, sizes = system.outputs.transpose() * largest;
  const std::vector<double>& obtained = found.results.structures[0].displacement;
  EXPECT_GE(obtained.size(), static_cast<std::size_t>(expected.size()));
  const Eigen::VectorXd last =
      Eigen::Map<const Eigen::VectorXd>(obtained.data() + obtained.size() - expected.size(), expected.size());
  const double first = std::sqrt(modes.squares[0]);
  return (last - expected).cwiseAbs().maxCoeff() / sizes.maxCoeff() / periods(duration + later, first);
}

const std::string building = "  a: {shear_building: {storeys: 5, mass: 20 t, stiffness: 4e4 kN/m, damping: 0}}\n";
// A portal whose beam may rotate at its ends: two unknowns with mass along x, the others massless.
const std::string portal =
    "  a: {frame: {material: {E: 30 GPa}, sections: {s: {area: 0.2, inertia_y: 4e-3}},\n"
    "    nodes: {a: [0, 0], b: [0, 3], c: [5, 3], d: [5, 0]},\n"
    "    members: {left: {between: [a, b], section: s}, beam: {between: [b, c], section: s}, right: {between: [d, c], "
    "section: s}},\n"
    "    supports: {a: fixed, d: fixed}, masses: {b: 20 t, c: 30 t}, floors: [{nodes: [b, c], rigid: true}]}, damping: "
    "0}\n";

TEST_P(ShortMotions, MoveBuildingsAndFramesByTheirModes) {
  test::Book book("Short motions of the ground",
                  "the sum over the modes of a shear building and of a portal, each in closed form",
                  "the tolerance of the run, for each period of the first mode; durations from 1e-5 s to 0.1 s");
  const auto [scheme, tolerance] = GetParam();
  for (const std::string& structure : {building, portal})
    for (const Kind& kind : kinds)
      for (const double duration : {1e-5, 1e-3, 1e-2, 0.1}) {
        SCOPED_TRACE(fmt::format("{} of {:g} s on {}", kind.name, duration, structure.substr(0, 22)));
        double imbalance = 0;
        const double error = error_of_modes(kind, duration, structure, tolerance, scheme, 0.3, &imbalance);
        book.below(fmt::format("{}, {:g}: error of the floors, over the tolerance [-]", scheme, tolerance),
                   error / tolerance, 1);
        EXPECT_LT(imbalance, tolerance);
      }
}

// The motion is short only for the body on the soft spring, and the quadrature rule would press it into the other body
// or separate them. Together they are one oscillator in closed form.
TEST_P(ShortMotions, HoldRigidBodiesTogetherThatFeelThemDifferently) {
  const auto [scheme, tolerance] = GetParam();
  const double ground_period = 0.11, stiff = 0.063, soft = 0.47, length = 0.06;
  const std::string bodies = fmt::format(
      "  a: {{oscillator: {{mass: 1 t, period: {}, damping: 0}}}}\n  b: {{oscillator: {{mass: 1 t, period: {}, "
      "damping: 0}}}}\n"
      "links:\n  - {{between: [a, b], gap: 0, law: stereomechanical, restitution: 0}}\n",
      stiff, soft);
  const std::string ground =
      fmt::format("harmonic: {{amplitude: {}, period: {}, duration: 1}}", amplitude, ground_period);
  const Outcome found = test::run_text(text(ground, bodies, tolerance, scheme, length));
  const double w = std::sqrt(0.5 * (std::pow(2 * pi / stiff, 2) + std::pow(2 * pi / soft, 2))),
               p = 2 * pi / ground_period;
  const double expected = -amplitude / (w * w - p * p) * (std::sin(p * length) - p / w * std::sin(w * length));
  const std::vector<double>& way = found.results.structures[0].displacement;
  EXPECT_NEAR(way.back(), expected, tolerance * amplitude / (w * w));
  ASSERT_EQ(found.results.impacts.size(), 1u);
  const ImpactRow& rest = found.results.impacts[0];
  EXPECT_TRUE(std::isnan(rest.t_end)) << "until the end";
  const LinkHistory& link = found.results.links[0];
  for (std::size_t k = 0; k < link.time.size(); ++k) {
    if (link.time[k] < rest.t_start) continue;
    EXPECT_LT(std::abs(link.penetration[k]), 1e-12 * std::abs(expected)) << "at " << link.time[k];
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ShortMotions,
                         testing::Values(Case{"esdirk4", 1e-4}, Case{"esdirk4", 1e-6}, Case{"generalized_alpha", 1e-4},
                                         Case{"generalized_alpha", 1e-6}),
                         [](const auto& test) {
                           return fmt::format("{}_1em{:.0f}", test.param.scheme, -std::log10(test.param.tolerance));
                         });

}  // namespace short_motions_test
}  // namespace pounding
