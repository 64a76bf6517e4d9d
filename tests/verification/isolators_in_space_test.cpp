// Isolators of frames in space, from the input file: a mass on one isolator under both components of a record.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/run/implausible.hpp>
#include "support/bearing_references.hpp"
#include "support/book.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace isolators_in_space_test {

constexpr double output_step = 0.5, weight = 1e5 * 9.80665;

// 100 t on an isolator with these keys.
std::string mass_on(const std::string& isolator, const std::string& motion, const std::string& more = "",
                    const std::string& analysis = "duration: 15 s") {
  return fmt::format(
      "{}structures:\n  a:\n    damping: 0\n    frame: {{dimension: 3, material: {{E: 30 GPa}}, nodes: {{a: [0, 0, "
      "0]}}, masses: {{a: 100 t}}, supports: {{a: {{isolator: {{{}}}}}}}{}}}\nanalysis: {{{}, tolerance: 1e-6, "
      "output_step: {}}}\n",
      motion, isolator, more, analysis, output_step);
}

std::string record(const std::string& component, double scale = 1) {
  return fmt::format("{{record: {}/imperialValley_elCentro_1940/RSN6_IMPVALL.I_I-{}.AT2, scale: {}}}",
                     test::folder_of_records(), component, scale);
}

std::string motion(const std::string& x, const std::string& y = "") {
  return "ground_motion: {components: {x: " + x + (y.empty() ? "" : ", y: " + y) + "}}\n";
}

std::string both_components() { return motion(record("ELC180-hor1"), record("ELC270-hor2")); }

const SpringHistory& springs(const Outcome& run) { return run.results.structures[0].springs; }
double deformation(const Outcome& run, std::size_t sample, std::size_t part) {
  return springs(run).deformation[sample * springs(run).size() + part];
}

// Largest difference of both deformations at the instants of the reference, over the peak.
double difference(const Outcome& run, const test::BearingReference& expected) {
  double worst = 0;
  for (std::size_t n = 0; n < test::bearing_instants.size(); ++n)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto sample = static_cast<std::size_t>(std::lround(test::bearing_instants[n] / output_step));
      worst = std::max(worst, std::abs(deformation(run, sample, i) - expected.values[n + 1][i]));
    }
  return worst / std::max(expected.values[0][0], expected.values[0][1]);
}

// Largest difference between one part in each of two runs, over the peak.
double difference(const Outcome& run, std::size_t part, double factor, const Outcome& other, std::size_t of_other) {
  double worst = 0;
  const std::size_t samples = springs(run).deformation.size() / springs(run).size();
  EXPECT_EQ(samples, springs(other).deformation.size() / springs(other).size());
  for (std::size_t n = 0; n < samples; ++n)
    worst = std::max(worst, std::abs(factor * deformation(run, n, part) - deformation(other, n, of_other)));
  return worst / springs(other).deformations.peak(of_other);
}

void expect_balance(const Outcome& run) {
  EXPECT_LT(run.summary.energy.error, 1e-5);
  const std::vector<SpringSummary>& parts = run.summary.structures[0].springs;
  double lost = 0;
  for (const SpringSummary& part : parts) {
    lost += part.energy_lost;
    EXPECT_GT(part.energy_lost, 0.1 * run.summary.energy.hysteretic);
  }
  EXPECT_NEAR(lost, run.summary.energy.hysteretic, 1e-9 * lost);
}

struct Reference {
  const char* name;
  std::string isolator;
  const test::BearingReference& expected;
};

// The laws bilinear, lead_rubber and friction_pendulum with equal numbers are equal, as are bouc_wen and elastomeric.
const std::vector<Reference> references{
    {"bouc_wen",
     fmt::format("bouc_wen: {{stiffness: {}, yield_force: {}, hardening: {}}}", 0.05 * weight / 8e-3 + 0.6e6,
                 0.05 * weight + 0.6e6 * 8e-3, 0.6e6 / (0.05 * weight / 8e-3 + 0.6e6)),
     test::bouc_wen},
    {"elastomeric",
     fmt::format("elastomeric: {{strength: {}, yield_displacement: 8 mm, post_yield_stiffness: 0.6 MN/m}}",
                 0.05 * weight),
     test::bouc_wen},
    {"friction_pendulum",
     fmt::format("friction_pendulum: {{radius: 2 m, friction: 6 %, yield_displacement: 1 mm, weight: {}}}", weight),
     test::pendulum},
    {"friction_pendulum, mu(v)",
     fmt::format("friction_pendulum: {{radius: 2 m, friction: [3 %, 8 %], rate: 20 s/m, yield_displacement: 1 mm, "
                 "weight: {}}}",
                 weight),
     test::pendulum_rate},
    {"lead_rubber",
     fmt::format("lead_rubber: {{strength: {}, yield_displacement: 1 mm, post_yield_stiffness: {}}}", 0.06 * weight,
                 weight / 2),
     test::pendulum},
    {"bilinear",
     fmt::format("bilinear: {{stiffness: {}, yield_force: {}, hardening: {}}}", (60 + 0.5) * weight,
                 (60 + 0.5) * weight * 1e-3, 0.5 / 60.5),
     test::pendulum}};

TEST(IsolatorsInSpace, AgreeWithOpenSees) {
  ASSERT_FALSE(test::folder_of_records().empty()) << "missing record; run `make python` to install it";
  test::Book book("Isolators of a frame in space, both components of El Centro 1940",
                  "OpenSees, refined steps (tests/verification/opensees/bearings.py)",
                  "1e-3 of the peak; the reference is converged to 1e-4");
  for (const Reference& each : references) {
    const Outcome run = test::run_text(mass_on(each.isolator, both_components()));
    book.below(fmt::format("{}: displacements / peak [-]", each.name), difference(run, each.expected), 1e-3);
    expect_balance(run);
  }
}

constexpr const char* slider =
    "friction_pendulum: {radius: 2 m, friction: 6 %, yield_displacement: 1 mm, weight: 980.665 kN}";
constexpr const char* rubber =
    "elastomeric: {strength: 50 kN, yield_displacement: 8 mm, post_yield_stiffness: 0.6 MN/m}";
const std::string apart = "coupled: false, ";

TEST(IsolatorsInSpace, AreThatOfThePlaneInOneDirection) {
  for (const std::string law : {slider, rubber}) {
    const std::string x = record("ELC180-hor1");
    const Outcome coupled = test::run_text(mass_on(law, motion(x))),
                  single = test::run_text(mass_on(apart + law, motion(x))),
                  diagonal = test::run_text(mass_on(
                      law, motion(record("ELC180-hor1", std::sqrt(0.5)), record("ELC180-hor1", std::sqrt(0.5)))));
    EXPECT_LT(difference(coupled, 0, 1, single, 0), 1e-4) << law;
    EXPECT_EQ(springs(coupled).deformations.peak(1), 0) << law;
    EXPECT_LT(springs(coupled).lost[1], 1e-6 * springs(coupled).lost[0]) << law;
    EXPECT_NEAR(springs(coupled).lost[0], springs(single).lost[0], 1e-4 * springs(single).lost[0]) << law;
    for (const std::size_t part : {0, 1})
      EXPECT_LT(difference(diagonal, part, std::sqrt(2), single, 0), 1e-4) << law << ", part " << part;
    const SpringSummary &expected = single.summary.structures[0].springs[0],
                        &found = diagonal.summary.structures[0].springs[1];
    EXPECT_NEAR(found.ductility, expected.ductility, 1e-4 * expected.ductility);
    EXPECT_NEAR(found.first_yield, expected.first_yield, 1e-4) << "by the resultant";
    EXPECT_NEAR(2 * found.energy_lost, expected.energy_lost, 1e-4 * expected.energy_lost);
  }
}

// Each axis alone.
TEST(IsolatorsInSpace, AreIndependentUnlessCoupled) {
  const Outcome both = test::run_text(mass_on(apart + slider, both_components()));
  const std::array<std::string, 2> components{"ELC180-hor1", "ELC270-hor2"};
  for (std::size_t i = 0; i < 2; ++i) {
    std::string plane = mass_on(slider, motion(record(components[i])));
    plane.replace(plane.find("dimension: 3"), 12, "dimension: 2");
    plane.replace(plane.find("[0, 0, 0]"), 9, "[0, 0]");
    EXPECT_LT(difference(both, i, 1, test::run_text(plane), 0), 1e-4);
  }
}

// A pull-back test beyond yield, along the diagonal.
TEST(IsolatorsInSpace, StartFromADisplacement) {
  const std::string quiet, short_run = "duration: 3 s";
  for (const std::string law : {slider, rubber}) {
    const double u = 0.2;  // the restoring force exceeds the friction
    const auto moved = [](double x, double y) {
      return fmt::format(", initial_node_displacements: {{a: {{ux: {}, uy: {}}}}}", x, y);
    };
    const Outcome single = test::run_text(mass_on(apart + law, quiet, moved(u, 0), short_run)),
                  diagonal =
                      test::run_text(mass_on(law, quiet, moved(u * std::sqrt(0.5), u * std::sqrt(0.5)), short_run));
    EXPECT_GT(springs(single).deformations.max[0] - springs(single).deformations.min[0], 0.02);
    for (const std::size_t part : {0, 1})
      EXPECT_LT(difference(diagonal, part, std::sqrt(2), single, 0), 1e-4) << law << ", part " << part;
    EXPECT_LT(diagonal.summary.energy.error, 1e-5);
  }
}

// Neither component reaches the capacity, but their resultant does.
TEST(IsolatorsInSpace, WarnBeyondTheCapacityInEveryDirection) {
  const std::string ground = motion("{harmonic: {amplitude: 2, period: 1, duration: 2}}",
                                    "{harmonic: {amplitude: 2, period: 1, duration: 2}}");
  const auto warnings = [&](double capacity) {
    const Model model =
        test::model_of(mass_on(fmt::format("capacity: {}, {}", capacity, slider), ground, "", "duration: 3 s"));
    return beyond_capacity(model, run(model).summary);
  };
  const Outcome free = test::run_text(mass_on(slider, ground, "", "duration: 3 s"));
  const double largest = springs(free).deformations.peak(0);
  ASSERT_EQ(warnings(1.41 * largest).size(), 1u) << "once, not per direction";
  EXPECT_TRUE(test::mentions(warnings(1.41 * largest)[0], {"isolator a: "}));
  EXPECT_TRUE(warnings(1.42 * largest).empty());
}

}  // namespace isolators_in_space_test
}  // namespace pounding
