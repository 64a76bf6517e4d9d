// Runs of frames in reduced coordinates against runs in all natural modes, and their own error estimates.

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include "support/messages.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace reduced_test {

struct Pair {
  int storeys = 20, bays = 3;
  std::string damping = "5 %";
  std::string law = "hertz_damped, stiffness: 2.75e9, restitution: 0.65";
  double tolerance = 1e-5, duration = 4, gap = 20;  // [s], [mm]
  std::string own = "";                             // frame keys of the left frame
  double amplitude = 3, period = 1.5;               // of the ground [m/s^2], [s]
  std::string inside = "", devices = "",
              wave = "";  // keys inside the left frame; after the links; in the ground motion

  // Two plane frames with contacts at three floors: 160 unknowns with mass each, and as many massless rotations.
  std::string text(const std::string& reduction) const {
    const auto frame = [&](const std::string& name, double origin, double mass, const std::string& beside) {
      return fmt::format(
          "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: {}, bays: {}, storey_height: 3.2, "
          "bay_width: 6, columns: "
          "{{rectangle: [0.6, 0.6]}}, beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}{}}}, damping: {}{}}}\n",
          name, origin, storeys, bays, mass, name == "left" ? inside : "", damping, beside);
    };
    std::string links;
    for (const int floor : {storeys, 3 * storeys / 4, storeys / 2})
      links += fmt::format("  - {{between: [left.{0}, right.{0}], gap: {1} mm, law: {2}}}\n", floor, gap, law);
    return fmt::format("ground_motion: {{harmonic: {{amplitude: {}, period: {}, duration: 4}}{}}}\nstructures:\n",
                       amplitude, period, wave) +
           frame("left", 0, 40.0 * bays, own) + frame("right", 6 * bays + 1e-3 * gap, 20.0 * bays, "") + "links:\n" +
           links + devices +
           fmt::format("analysis: {{duration: {}, tolerance: {}{}}}\n", duration, tolerance, reduction);
  }
  Outcome run(const std::string& reduction) const { return test::run_text(text(reduction)); }
};

double peak_force(const Outcome& outcome) {
  double peak = 0;
  for (const LinkSummary& link : outcome.summary.links) peak = std::max(peak, link.peak_force);
  return peak;
}

// Maximum difference of the peak forces of links, relative to the overall maximum.
double force_error(const Outcome& found, const Outcome& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.summary.links.size(); ++i)
    worst = std::max(worst, std::abs(found.summary.links[i].peak_force - exact.summary.links[i].peak_force));
  return worst / peak_force(exact);
}

double history_error(const std::vector<double>& found, const std::vector<double>& exact) {
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    worst = std::max(worst, std::abs(found[i] - exact[i]));
    largest = std::max(largest, std::abs(exact[i]));
  }
  return worst / largest;
}

bool says(const Outcome& outcome, const std::string& text) {
  return std::ranges::any_of(outcome.summary.warnings,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

class ReducedRun : public testing::Test {
 protected:
  static const Outcome& all_modes() {
    static const Outcome exact = Pair{}.run("");
    return exact;
  }
};

// The time errors of both runs are about 5e-5; smaller differences are not resolved.
constexpr double floor = 5e-5;

TEST_F(ReducedRun, TellsMoreThanItsErrors) {
  ASSERT_GT(all_modes().results.impacts.size(), 4u);
  for (const int links : {2, 3, 4, 5}) {
    const Outcome reduced = Pair{}.run(fmt::format(", reduction: {{links: {}, ground: {}}}", links, 4 * links));
    ASSERT_EQ(reduced.summary.reduced.size(), 2u);
    double reported = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const ReducedStructure& s = reduced.summary.reduced[k];
      reported = std::max(reported, s.error_force);
      const double displacement =
          history_error(reduced.results.structures[k].displacement, all_modes().results.structures[k].displacement);
      const double shear =
          history_error(reduced.results.structures[k].storey_shear, all_modes().results.structures[k].storey_shear);
      EXPECT_LT(displacement, s.error_displacement + floor) << links << s.name;
      EXPECT_LT(s.error_displacement, 500 * (displacement + floor)) << links << s.name;
      EXPECT_LT(shear, s.error_members + 10 * floor) << links << s.name;
      EXPECT_LT(history_error(reduced.results.structures[k].reaction, all_modes().results.structures[k].reaction),
                s.error_members + 10 * floor)
          << links << s.name;
      EXPECT_GT(s.error_acceleration, 0) << links << s.name;
      RecordProperty(fmt::format("{}_{}", s.name, links),
                     fmt::format("{} | {:.1e} {:.1e}", s.error_text(), displacement, shear));
    }
    const double force = force_error(reduced, all_modes());
    EXPECT_LT(force, reported + floor) << links;
    EXPECT_LT(reported, 500 * (force + floor)) << links;
    RecordProperty(fmt::format("force_{}", links), fmt::format("{:.1e} told {:.1e}", force, reported));
  }
}

TEST_F(ReducedRun, WarnsWhereItsErrorsExceedTheirShareOfTheTolerance) {
  const Outcome shallow = Pair{}.run(", reduction: {links: 2, ground: 6}");
  EXPECT_TRUE(says(shallow, "1e-05"));
  EXPECT_TRUE(says(shallow, "reduction: auto"));
  EXPECT_FALSE(says(Pair{.tolerance = 0.02}.run(", reduction: {links: 5, ground: 20}"), "reduc"));
  EXPECT_FALSE(says(all_modes(), "reduc"));
}

TEST_F(ReducedRun, SaysWhereNothingEstimatesItsErrors) {
  for (const std::string how : {"{links: 1}", "{modes: 30}"}) {
    const Outcome reduced = Pair{}.run(", reduction: " + how);
    EXPECT_TRUE(std::isnan(reduced.summary.reduced[0].error_force));
    EXPECT_TRUE(says(reduced, "reduc")) << how;
  }
}

// Plain modes have no shadow, and their error is still detected; so is that of blocks with a small estimate.
TEST_F(ReducedRun, TellsWhatAllUnknownsDoInItsHardestImpacts) {
  for (const std::string how : {"{modes: 30", "{links: 1, ground: 4", "{links: 3, ground: 12"}) {
    const Outcome checked = Pair{}.run(", reduction: " + how + ", check: true}"),
                  usual = Pair{}.run(", reduction: " + how + "}");
    EXPECT_EQ(checked.results.links[0].force, usual.results.links[0].force) << how;
    double reported = 0;
    for (const ReducedStructure& s : checked.summary.reduced) {
      EXPECT_EQ(s.checked_windows, 3) << how;
      EXPECT_TRUE(test::mentions(s.check_text(), {"3"}));
      reported = std::max(reported, s.check_force);
      EXPECT_GT(s.check_displacement, 0) << how;
    }
    EXPECT_EQ(usual.summary.reduced[0].checked_windows, 0);
    EXPECT_EQ(usual.summary.reduced[0].check_text(), "");
    EXPECT_TRUE(says(checked, "1e-05")) << how;
    RecordProperty(how, fmt::format("told {:.1e}, truth {:.1e}", reported, force_error(checked, all_modes())));
    EXPECT_GT(reported, force_error(checked, all_modes()) / 10) << how;
    EXPECT_LT(reported, 10 * (force_error(checked, all_modes()) + floor)) << how;
  }
}

// The closing between two structures lacks what the basis of one of them lacks: both are reported.
TEST_F(ReducedRun, IsCheckedByTheClosingsOfAllItsStructures) {
  const Outcome checked = Pair{.own = ", reduction: {links: 1, ground: 4, check: true}"}.run(
      ", reduction: {links: 5, ground: 20, check: true}");
  const double truth = force_error(checked, all_modes());
  RecordProperty("told", fmt::format("{:.2e}, truth {:.2e}", checked.summary.reduced[0].check_force, truth));
  EXPECT_GT(checked.summary.reduced[0].check_force, truth / 10);
  EXPECT_EQ(checked.summary.reduced[0].check_force, checked.summary.reduced[1].check_force);
}

TEST_F(ReducedRun, KeepsTheBitsWhereNothingIsReduced) {
  for (const std::string how : {", reduction: none", ", reduction: auto", ", reduction: all modes"}) {
    const Outcome same = Pair{}.run(how);
    EXPECT_EQ(same.results.structures[0].displacement, all_modes().results.structures[0].displacement) << how;
    EXPECT_EQ(same.results.links[0].force, all_modes().results.links[0].force) << how;
    EXPECT_EQ(says(same, "reduc"), how == ", reduction: auto");
  }
}

TEST_F(ReducedRun, MayLeaveOneStructureWhole) {
  const Outcome mixed = Pair{.own = ", reduction: none"}.run(", reduction: {links: 5, ground: 20}");
  EXPECT_LT(force_error(mixed, all_modes()), 1e-3);
  ASSERT_EQ(mixed.summary.reduced.size(), 1u);
  EXPECT_EQ(mixed.summary.reduced[0].name, "right");
}

TEST_F(ReducedRun, GoesOnWithTheSameBits) {
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("{}_reduced.h5", getpid())).string();
  const std::string yaml = Pair{.tolerance = 1e-4}.text(", reduction: {links: 4, ground: 10, check: true}");
  {
    const Model model = test::model_of(yaml);
    RunOptions options{.output = file};
    options.stop = [](std::span<const ContactMemory> contacts) { return !contacts[0].impacts().empty(); };
    EXPECT_THROW(run(model, options), FailedRun);
  }
  const Outcome continued = run(test::model_of(yaml), {.output = file, .resume = file}), whole = test::run_text(yaml);
  std::filesystem::remove(file);
  EXPECT_EQ(continued.results.structures[1].displacement, whole.results.structures[1].displacement);
  EXPECT_EQ(continued.results.links[2].force, whole.results.links[2].force);
  EXPECT_EQ(continued.results.solver.steps, whole.results.solver.steps);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(continued.summary.reduced[k].error_force, whole.summary.reduced[k].error_force);
    EXPECT_EQ(continued.summary.reduced[k].error_displacement, whole.summary.reduced[k].error_displacement);
    EXPECT_EQ(continued.summary.reduced[k].error_members, whole.summary.reduced[k].error_members);
    EXPECT_EQ(whole.summary.reduced[k].checked_windows, 3);
    EXPECT_EQ(continued.summary.reduced[k].check_force, whole.summary.reduced[k].check_force);
    EXPECT_EQ(continued.summary.reduced[k].check_displacement, whole.summary.reduced[k].check_displacement);
  }
}

// The file is written at the beginning and again before the check.
TEST_F(ReducedRun, IsCheckedAfterAStopInItsCheck) {
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("{}_checked.h5", getpid())).string();
  const std::string yaml = Pair{.tolerance = 1e-4}.text(", reduction: {links: 4, ground: 10, check: true}");
  const Model model = test::model_of(yaml);
  RunOptions options{.output = file};
  std::optional<std::filesystem::file_time_type> first;
  options.stop = [&](std::span<const ContactMemory>) {
    const auto written = std::filesystem::last_write_time(file);
    if (!first) first = written;
    return written != *first;
  };
  try {
    run(model, options);
    ADD_FAILURE() << "the check does not stop";
  } catch (const FailedRun& stopped) {
    EXPECT_NE(std::string(stopped.what()), "");
    EXPECT_TRUE(stopped.outcome().resumable);
  }
  const Outcome continued = run(test::model_of(yaml), {.output = file, .resume = file}), whole = test::run_text(yaml);
  std::filesystem::remove(file);
  EXPECT_EQ(continued.results.structures[1].displacement, whole.results.structures[1].displacement);
  EXPECT_EQ(continued.results.impacts.size(), whole.results.impacts.size());
  EXPECT_EQ(continued.results.solver.steps, whole.results.solver.steps);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(continued.summary.reduced[k].checked_windows, 3);
    EXPECT_EQ(continued.summary.reduced[k].check_force, whole.summary.reduced[k].check_force);
    EXPECT_EQ(continued.summary.reduced[k].check_displacement, whole.summary.reduced[k].check_displacement);
  }
}

// Frames of 600 unknowns with mass, which `auto` reduces. The left one starts towards the right one.
const Pair large{
    .storeys = 30, .bays = 9, .tolerance = 1e-3, .duration = 1, .gap = 2, .own = ", initial_velocity: 0.3"};

int blocks(const Outcome& outcome) {
  return outcome.summary.reduced.empty() ? 0 : outcome.summary.reduced[0].link_blocks;
}

TEST(AutomaticReduction, GoesDeeperUntilItsErrorsAreSmallEnough) {
  const Outcome wide = large.run(", reduction: {error: 0.05}"), narrow = large.run(", reduction: {error: 1e-6}");
  ASSERT_GT(wide.results.impacts.size(), 1u);
  EXPECT_EQ(wide.results.deeper, 0);
  EXPECT_EQ(blocks(wide), 4);
  EXPECT_GT(narrow.results.deeper, 0);
  EXPECT_EQ(blocks(narrow), 6 + narrow.results.deeper);
  EXPECT_LE(narrow.summary.reduced[0].error_force, 1e-6);
  EXPECT_LE(narrow.summary.reduced[1].error_displacement, 1e-6);
  EXPECT_FALSE(says(narrow, "reduc"));
  EXPECT_NEAR(peak_force(narrow), peak_force(wide), 0.05 * peak_force(narrow));
  // Each run starts with new contacts.
  EXPECT_EQ(narrow.results.impacts.size(), wide.results.impacts.size());
}

TEST(AutomaticReduction, GoesOnAtTheDepthThatItHadReached) {
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("{}_deeper.h5", getpid())).string();
  const std::string yaml = large.text(", reduction: {error: 1e-6}") + "checkpoint: {every: 1000 s}\n";
  int begun = 0;
  {
    const Model model = test::model_of(yaml);
    RunOptions options{.output = file};
    std::filesystem::file_time_type last{};
    // In the second run, after an impact. The file is written at the start of a run; a fast run is sampled too rarely
    // to detect its new contacts.
    options.stop = [&](std::span<const ContactMemory> contacts) {
      const auto written = std::filesystem::last_write_time(file);
      if (last != std::filesystem::file_time_type{} && written != last) ++begun;
      last = written;
      return begun > 0 && !contacts[0].impacts().empty();
    };
    EXPECT_THROW(run(model, options), FailedRun);
  }
  ASSERT_GT(begun, 0);
  const Outcome continued = run(test::model_of(yaml), {.output = file, .resume = file}), whole = test::run_text(yaml);
  std::filesystem::remove(file);
  EXPECT_EQ(continued.results.deeper, whole.results.deeper);
  EXPECT_EQ(continued.results.links[0].force, whole.results.links[0].force);
  EXPECT_EQ(continued.summary.reduced[0].error_force, whole.summary.reduced[0].error_force);
}

// High modes with 3 % of critical damping resonate up to the frequency of the contact.
TEST(AutomaticReduction, GoesDeeperForLightDamping) {
  Pair light = large;
  light.damping = "{rayleigh: {ratio: 3 %, periods: [1.5, 0.02]}}";
  const Outcome usual = large.run(", reduction: auto"), deep = light.run(", reduction: auto"),
                fixed = light.run(", reduction: {links: 5, ground: 20}");
  ASSERT_GT(deep.results.impacts.size(), 1u);
  EXPECT_TRUE(says(fixed, "0.001"));
  EXPECT_TRUE(deep.summary.reduced.empty() || blocks(deep) > blocks(usual))
      << blocks(deep) << " after " << blocks(usual);
  EXPECT_TRUE(!deep.summary.reduced.empty() || says(deep, "blocks"));
  RecordProperty("blocks", fmt::format("usual {}, light {}, fixed {}", blocks(usual), blocks(deep),
                                       fixed.summary.reduced[0].error_text()));
}

double peak_displacement_error(const Outcome& found, const Outcome& exact) {
  double worst = 0;
  for (std::size_t k = 0; k < exact.results.structures.size(); ++k)
    worst = std::max(worst,
                     history_error(found.results.structures[k].displacement, exact.results.structures[k].displacement));
  return worst;
}

struct Reported {
  double force = 0, displacement = 0;

  explicit Reported(const Outcome& outcome) {
    for (const ReducedStructure& s : outcome.summary.reduced) {
      force = std::max(force, s.error_force);
      displacement = std::max(displacement, s.error_displacement);
    }
  }
};

void record(const Outcome& found, const Outcome& exact, const std::string& name) {
  const Reported reported(found);
  testing::Test::RecordProperty(
      name,
      fmt::format("forces {:.1e} reported {:.1e}, displacements {:.1e} reported {:.1e}, coordinates {}",
                  force_error(found, exact), reported.force, peak_displacement_error(found, exact),
                  reported.displacement, found.summary.reduced.empty() ? 0 : found.summary.reduced[0].coordinates));
}

void expect_right(const Outcome& found, const Outcome& exact, double tolerance, const std::string& name) {
  record(found, exact, name);
  EXPECT_LT(force_error(found, exact), tolerance) << name;
  EXPECT_LT(peak_displacement_error(found, exact), tolerance) << name;
}

// Both runs are accurate enough in time that only the error of the reduction remains.
void expect_reported(const Outcome& found, const Outcome& exact, const std::string& name) {
  record(found, exact, name);
  ASSERT_FALSE(found.summary.reduced.empty()) << name;
  EXPECT_LT(force_error(found, exact), Reported(found).force + floor) << name;
  EXPECT_LT(peak_displacement_error(found, exact), Reported(found).displacement + floor) << name;
}

class ModalDampingReduced : public testing::Test {
 protected:
  static Pair pair(const std::string& ratio, double tolerance) {
    Pair own = large;
    own.damping = "{modal: {ratio: " + ratio + "}}";
    own.tolerance = tolerance;
    return own;
  }
};

TEST_F(ModalDampingReduced, HitsAsHardAsAllModes) {
  const Outcome exact = pair("20 %", 1e-5).run(", reduction: all modes");
  ASSERT_GT(exact.results.impacts.size(), 2u);
  for (const double tolerance : {1e-3, 1e-4}) {
    const Outcome found = pair("20 %", tolerance).run(", reduction: auto");
    ASSERT_EQ(found.summary.reduced.size(), 2u);
    EXPECT_FALSE(says(found, "reduc"));
    expect_right(found, exact, tolerance, fmt::format("modal_{:g}", tolerance));
  }
  for (const int links : {2, 4, 8}) {
    const Outcome fixed = pair("20 %", 1e-5).run(fmt::format(", reduction: {{links: {}, ground: 20}}", links));
    expect_reported(fixed, exact, fmt::format("modal_{}_blocks", links));
  }
}

TEST_F(ModalDampingReduced, SaysThatAllModesAreNeededWhereTheyRing) {
  const Outcome exact = pair("5 %", 1e-5).run(", reduction: all modes");
  const Outcome fixed = pair("5 %", 1e-3).run(", reduction: {links: 5, ground: 20}"),
                found = pair("5 %", 1e-3).run(", reduction: auto");
  EXPECT_TRUE(says(fixed, "0.001"));
  EXPECT_TRUE(found.summary.reduced.empty());
  EXPECT_TRUE(says(found, "blocks"));
  expect_right(found, exact, 1e-3, "ringing");
  expect_reported(fixed, exact, "fixed");
}

// Multiple-support excitation: each support loads the frames separately.
TEST(SeveralSupports, AreGroundsOfTheChains) {
  const auto run = [](double tolerance, const std::string& reduction) {
    Pair pair = large;
    pair.wave = ", wave: {velocity: 500}";
    pair.amplitude = 6, pair.period = 1, pair.gap = 10, pair.duration = 3, pair.own = "", pair.tolerance = tolerance;
    return pair.run(", reduction: " + reduction);
  };
  const Outcome exact = run(1e-6, "all modes");
  ASSERT_GT(exact.results.impacts.size(), 0u);
  for (const double tolerance : {1e-3, 1e-4}) {
    const Outcome found = run(tolerance, "auto");
    ASSERT_EQ(found.summary.reduced.size(), 2u);
    EXPECT_EQ(found.summary.reduced[0].grounds, 10);
    EXPECT_FALSE(says(found, "reduc"));
    expect_right(found, exact, tolerance, fmt::format("supports_{:g}", tolerance));
  }
  for (const int links : {2, 4})
    expect_reported(run(1e-6, fmt::format("{{links: {}, ground: 3}}", links)), exact,
                    fmt::format("supports_{}_blocks", links));
}

// Maximum difference of the friction peaks, relative to the maximum force of all links.
double friction_error(const Outcome& found, const Outcome& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.results.links.size(); ++i) {
    const auto peak = [i](const Outcome& of) {
      double largest = 0;
      for (const double force : of.results.links[i].friction) largest = std::max(largest, std::abs(force));
      return largest;
    };
    worst = std::max(worst, std::abs(peak(found) - peak(exact)));
  }
  return worst / peak_force(exact);
}

// Minimum and maximum of the friction over Coulomb's limit in contact: 0 is rest, 1 sliding.
std::pair<double, double> use_of_friction(const Outcome& outcome, double coefficient) {
  double minimum = 1, largest = 0;
  for (const LinkHistory& link : outcome.results.links)
    for (std::size_t i = 0; i < link.force.size(); ++i) {
      if (link.force[i] < 0.05 * peak_force(outcome)) continue;
      const double part = std::abs(link.friction[i]) / (coefficient * link.force[i]);
      minimum = std::min(minimum, part), largest = std::max(largest, part);
    }
  return {minimum, largest};
}

struct Rubbing {
  Pair pair = large;
  double coefficient = 0.2;

  Rubbing(double of, double period, double amplitude) : coefficient(of) {
    pair.law += fmt::format(", friction: {}", coefficient);
    pair.period = period, pair.amplitude = amplitude;
    pair.gap = 10, pair.duration = 4, pair.own = "";
  }
  Outcome run(double tolerance, const std::string& reduction) const {
    Pair of = pair;
    of.tolerance = tolerance;
    return of.run(", reduction: " + reduction);
  }
};

class FrictionReduced : public testing::TestWithParam<Rubbing> {};

TEST_P(FrictionReduced, SticksAndSlipsAsInAllModes) {
  const Outcome exact = GetParam().run(1e-6, "all modes");
  ASSERT_GT(exact.results.impacts.size(), 2u);
  const auto [sticking, sliding] = use_of_friction(exact, GetParam().coefficient);
  EXPECT_LT(sticking, 0.5);
  EXPECT_GT(sliding, 0.99);
  for (const double tolerance : {1e-3, 1e-4}) {
    const Outcome found = GetParam().run(tolerance, "auto");
    ASSERT_EQ(found.summary.reduced.size(), 2u);
    EXPECT_FALSE(says(found, "reduc"));
    expect_right(found, exact, tolerance, fmt::format("friction_{:g}", tolerance));
    EXPECT_LT(friction_error(found, exact), tolerance);
    EXPECT_TRUE(test::mentions(found.summary.reduced[0].size_text(), {"6", "3"}));
  }
  for (const int links : {2, 3, 4, 5}) {
    const Outcome fixed = GetParam().run(1e-6, fmt::format("{{links: {}, ground: 20}}", links));
    expect_reported(fixed, exact, fmt::format("friction_{}_blocks", links));
    EXPECT_LT(friction_error(fixed, exact), Reported(fixed).force + floor) << links;
    RecordProperty(fmt::format("rubs_{}_blocks", links), fmt::format("{:.1e}", friction_error(fixed, exact)));
  }
}

INSTANTIATE_TEST_SUITE_P(Links, FrictionReduced, testing::Values(Rubbing(0.2, 1.0, 6), Rubbing(0.6, 1.5, 5)),
                         [](const testing::TestParamInfo<Rubbing>& test) {
                           return test.param.coefficient < 0.5 ? "ThatSlide" : "ThatStick";
                         });

// Maximum difference of the peak forces of devices, relative to the maximum force of all links.
double device_error(const Outcome& found, const Outcome& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.summary.devices.size(); ++i)
    worst = std::max(worst,
                     std::abs(found.summary.devices[i].extremes.peak(1) - exact.summary.devices[i].extremes.peak(1)));
  for (std::size_t k = 0; k < exact.summary.structures.size(); ++k)
    for (std::size_t i = 0; i < exact.summary.structures[k].springs.size(); ++i)
      worst = std::max(worst, std::abs(found.summary.structures[k].springs[i].peak_force -
                                       exact.summary.structures[k].springs[i].peak_force));
  return worst / peak_force(exact);
}

struct Coupled {
  std::string name, inside, devices;
  int inputs;  // of the left frame

  Outcome run(double tolerance, const std::string& reduction) const {
    Pair pair = large;
    pair.inside = inside, pair.devices = devices;
    pair.amplitude = 6, pair.period = 1, pair.gap = 10, pair.duration = 3, pair.own = "", pair.tolerance = tolerance;
    return pair.run(", reduction: " + reduction);
  }
};

class DevicesReduced : public testing::TestWithParam<Coupled> {};

TEST_P(DevicesReduced, ActAsInAllModes) {
  const Coupled& coupled = GetParam();
  const Outcome exact = coupled.run(1e-6, "all modes");
  ASSERT_GT(exact.results.impacts.size(), 0u);
  for (const double tolerance : {1e-3, 1e-4}) {
    const Outcome found = coupled.run(tolerance, "auto");
    ASSERT_EQ(found.summary.reduced.size(), 2u);
    EXPECT_FALSE(says(found, "reduc"));
    expect_right(found, exact, tolerance, fmt::format("devices_{:g}", tolerance));
    EXPECT_LT(device_error(found, exact), tolerance);
    EXPECT_NE(found.summary.reduced[0].size_text().find(
                  fmt::format(" x {}, {} of them devices, ground ", 3 + coupled.inputs, coupled.inputs)),
              std::string::npos)
        << found.summary.reduced[0].size_text();
  }
  for (const int links : {2, 4}) {
    const Outcome fixed = coupled.run(1e-6, fmt::format("{{links: {}, ground: 20}}", links));
    expect_reported(fixed, exact, fmt::format("devices_{}_blocks", links));
    EXPECT_LT(device_error(fixed, exact), Reported(fixed).force + floor) << links;
    RecordProperty(fmt::format("forces_of_devices_{}_blocks", links),
                   fmt::format("{:.1e}", device_error(fixed, exact)));
  }
}

// Modes replace all unknowns, except for the contributions of yielding parts to displacements and forces.
TEST_P(DevicesReduced, MoveAndLoadTheFrameAsWithAllUnknowns) {
  const Outcome modes = GetParam().run(1e-6, "all modes"), unknowns = GetParam().run(1e-6, "none");
  ASSERT_EQ(modes.summary.devices.size(), unknowns.summary.devices.size());
  EXPECT_LT(device_error(modes, unknowns), floor);
  const StructureHistory &found = modes.results.structures[0], &exact = unknowns.results.structures[0];
  // Inside steps the motion of a massless point is a cubic, although its velocity jumps when the device yields.
  const double between = 1e-3;
  EXPECT_LT(history_error(found.storey_shear, exact.storey_shear), between);
  EXPECT_LT(history_error(found.reaction, exact.reaction), between);
  if (!exact.node_displacement.empty()) {
    EXPECT_LT(history_error(found.node_displacement, exact.node_displacement), between);
  }
}

// Nonlinear dampers, a bar with a damper, and yielding devices; at points with mass and at a massless one.
INSTANTIATE_TEST_SUITE_P(
    Pairs, DevicesReduced,
    testing::Values(Coupled{"DamperBetween", "",
                            "devices: {top: {between: [left.30, right.30], damper: {coefficient: 400 kN (s/m)^0.35, "
                            "exponent: 0.35, stiffness: 60 MN/m}}}\n",
                            1},
                    Coupled{"BarBetween", "",
                            "devices: {tie: {between: [left.20, right.20], bar: {stiffness: 20 MN/m}, damper: "
                            "{coefficient: 20 MN s/m}}}\n",
                            1},
                    Coupled{"BraceAndDamperInside",
                            ", devices: {brace: {between: [\"0.0\", \"1.1\"], bilinear: {stiffness: 200 MN/m, "
                            "yield_force: 300 kN, hardening: 0.02}}, dash: {between: "
                            "[\"15.9\", ground], axis: x, damper: {coefficient: 2 MN s/m}}}",
                            "", 2},
                    Coupled{"OnAPointWithoutMass",
                            ", members: {column 16.0: {parts: 2}}, report: {nodes: [column 16.0/1]}, devices: {stop: "
                            "{between: [column 16.0/1, ground], axis: x, "
                            "bilinear: {stiffness: 100 MN/m, yield_force: 300 kN, hardening: 0.02}}}",
                            "", 1}),
    [](const testing::TestParamInfo<Coupled>& test) { return test.param.name; });

// Frames of 280 unknowns with mass. The left one has hinges at its feet and at all beam ends of its lowest two floors:
// 31 in total.
struct Hinged {
  std::string name, law;

  Pair pair(double tolerance) const {
    Pair made{.bays = 6,
              .tolerance = tolerance,
              .duration = 1.5,
              .gap = 3,
              .own = ", initial_velocity: 0.3",
              .amplitude = 6,
              .period = 1};
    made.inside = hinges(6, 2);
    return made;
  }
  std::string hinges(int bays, int storeys) const {
    std::string all = fmt::format(", hinges: {{columns: {{at: feet, {}}}", law);
    for (int storey = 1; storey <= storeys; ++storey)
      for (int bay = 0; bay < bays; ++bay) all += fmt::format(", \"beam x {}.{}\": {{at: both, {}}}", storey, bay, law);
    return all + "}";
  }
};

double rotation_error(const Outcome& found, const Outcome& exact) {
  double worst = 0, largest = 0;
  const auto &a = found.summary.structures[0].springs, &b = exact.summary.structures[0].springs;
  for (std::size_t i = 0; i < b.size(); ++i) {
    worst = std::max(worst, std::abs(std::abs(a[i].peak) - std::abs(b[i].peak)));
    largest = std::max(largest, std::abs(b[i].peak));
  }
  return worst / largest;
}

class HingesReduced : public testing::TestWithParam<Hinged> {};

TEST_P(HingesReduced, YieldAsInAllModes) {
  const Outcome exact = GetParam().pair(1e-5).run("");
  ASSERT_GT(exact.results.impacts.size(), 2u);
  ASSERT_EQ(exact.summary.structures[0].springs.size(), 31u);
  EXPECT_GT(std::ranges::count_if(exact.summary.structures[0].springs,
                                  [](const SpringSummary& s) { return s.ductility > 1; }),
            10);
  for (const int links : {2, 5}) {
    const Outcome found = GetParam().pair(1e-5).run(fmt::format(", reduction: {{links: {}, ground: 20}}", links));
    expect_reported(found, exact, fmt::format("hinges_{}_blocks", links));
    const ReducedStructure& left = found.summary.reduced[0];
    EXPECT_EQ(left.parts, 31);
    EXPECT_TRUE(test::mentions(left.size_text(), {"2", "31"}));
    EXPECT_LT(rotation_error(found, exact), left.error_displacement + 10 * floor);
    EXPECT_LT(history_error(found.results.structures[0].storey_shear, exact.results.structures[0].storey_shear),
              left.error_members + 10 * floor);
    EXPECT_LT(history_error(found.results.structures[0].reaction, exact.results.structures[0].reaction),
              left.error_members + 10 * floor);
    RecordProperty(fmt::format("rotations_{}_blocks", links),
                   fmt::format("{:.1e}, members told {:.1e}", rotation_error(found, exact), left.error_members));
  }
  const Outcome coarse = GetParam().pair(1e-3).run(", reduction: {links: 5, ground: 20}");
  expect_right(coarse, exact, 1e-3, "hinges_at_1e-3");
  EXPECT_LT(rotation_error(coarse, exact), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, HingesReduced,
    testing::Values(Hinged{"RigidPlastic", "yield_moment: 150 kN m, hardening: 3 %"},
                    Hinged{"Smooth",
                           "menegotto_pinto: {yield_moment: 150 kN m, spring_hardening: 0.01, stiffness_factor: 10}"}),
    [](const testing::TestParamInfo<Hinged>& test) { return test.param.name; });

// The left frame is on isolators under its four feet.
Pair isolated(double tolerance) {
  Pair pair{.tolerance = tolerance, .duration = 3, .gap = 10, .amplitude = 6, .period = 1};
  pair.inside =
      ", masses: {0.0: 60 t, 0.1: 60 t, 0.2: 60 t, 0.3: 60 t}, supports: {feet: {isolator: {lead_rubber: {strength: 60 "
      "kN, yield_displacement: 10 mm, "
      "post_yield_stiffness: 1.5 MN/m}}}}";
  return pair;
}

TEST(IsolatedReduced, SlideAndHitAsInAllModes) {
  const Outcome exact = isolated(1e-5).run("");
  ASSERT_GT(exact.results.impacts.size(), 2u);
  ASSERT_EQ(exact.summary.structures[0].springs.size(), 4u);
  for (const SpringSummary& isolator : exact.summary.structures[0].springs) EXPECT_GT(isolator.ductility, 3);
  for (const int links : {2, 5}) {
    const Outcome found = isolated(1e-5).run(fmt::format(", reduction: {{links: {}, ground: 20}}", links));
    expect_reported(found, exact, fmt::format("isolators_{}_blocks", links));
    EXPECT_EQ(found.summary.reduced[0].parts, 4);
  }
  const Outcome coarse = isolated(1e-3).run(", reduction: {links: 5, ground: 20}");
  expect_right(coarse, exact, 1e-3, "isolators_at_1e-3");
}

struct Stopped {
  std::string name;
  Pair pair;
};

// Stopped in its first impact, after yielding.
class ReducedWithParts : public testing::TestWithParam<Stopped> {};

TEST_P(ReducedWithParts, GoOnWithTheSameBits) {
  const std::string file =
      (std::filesystem::temp_directory_path() / fmt::format("{}_{}.h5", getpid(), GetParam().name)).string();
  const std::string yaml = GetParam().pair.text(", reduction: {links: 3, ground: 10}");
  {
    const Model model = test::model_of(yaml);
    RunOptions options{.output = file};
    options.stop = [](std::span<const ContactMemory> contacts) {
      return std::ranges::any_of(contacts, [](const ContactMemory& contact) { return !contact.impacts().empty(); });
    };
    EXPECT_THROW(run(model, options), FailedRun);
  }
  const Outcome continued = run(test::model_of(yaml), {.output = file, .resume = file}), whole = test::run_text(yaml);
  std::filesystem::remove(file);
  ASSERT_EQ(whole.summary.reduced.size(), 2u);
  EXPECT_EQ(continued.results.solver.steps, whole.results.solver.steps);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(continued.results.structures[k].displacement, whole.results.structures[k].displacement);
    EXPECT_EQ(continued.results.structures[k].storey_shear, whole.results.structures[k].storey_shear);
    EXPECT_EQ(continued.summary.reduced[k].error_text(), whole.summary.reduced[k].error_text());
    EXPECT_EQ(continued.summary.reduced[k].error_members, whole.summary.reduced[k].error_members);
  }
  for (std::size_t i = 0; i < whole.results.links.size(); ++i)
    EXPECT_EQ(continued.results.links[i].force, whole.results.links[i].force);
  const std::vector<SpringSummary>&springs = continued.summary.structures[0].springs,
        &of_whole = whole.summary.structures[0].springs;
  ASSERT_EQ(springs.size(), of_whole.size());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    EXPECT_EQ(springs[i].peak, of_whole[i].peak);
    EXPECT_EQ(springs[i].energy_lost, of_whole[i].energy_lost);
  }
  EXPECT_TRUE(std::ranges::any_of(of_whole, [](const SpringSummary& s) { return s.ductility > 1; }) ||
              !whole.summary.devices.empty());
  for (std::size_t i = 0; i < whole.summary.devices.size(); ++i)
    EXPECT_EQ(continued.summary.devices[i].energy_lost, whole.summary.devices[i].energy_lost);
}

Pair braced(const std::string& inside, const std::string& devices) {
  Pair pair{.tolerance = 1e-4, .duration = 2, .gap = 5, .amplitude = 6, .period = 1};
  pair.inside = inside, pair.devices = devices;
  return pair;
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, ReducedWithParts,
    testing::Values(Stopped{"Hinges", Hinged{"", "yield_moment: 150 kN m, hardening: 3 %"}.pair(1e-4)},
                    Stopped{"Isolators", isolated(1e-4)},
                    Stopped{"Damper", braced("",
                                             "devices: {top: {between: [left.15, right.15], damper: {coefficient: 400 "
                                             "kN (s/m)^0.35, exponent: 0.35, stiffness: 60 MN/m}}}\n")},
                    Stopped{"Braces", braced(", devices: {brace: {between: [\"0.0\", \"1.1\"], bilinear: {stiffness: "
                                             "200 MN/m, yield_force: 300 kN, hardening: 0.02}}, dash: {between: "
                                             "[\"15.3\", ground], axis: x, damper: {coefficient: 2 MN s/m}}}",
                                             "")}),
    [](const testing::TestParamInfo<Stopped>& test) { return test.param.name; });

// 600 unknowns with mass: 82 hinges are reduced; 172 are too many, and their frame uses all its modes.
TEST(AutomaticReduction, TakesAQuarterOfAsManyHingesAsUnknownsWithMass) {
  const Hinged few{"", "yield_moment: 150 kN m, hardening: 3 %"};
  Pair pair = large;
  pair.duration = 0.05;
  pair.inside = few.hinges(9, 4);
  const Outcome reduced = pair.run(", reduction: {error: 0.1}");
  ASSERT_EQ(reduced.summary.reduced.size(), 2u);
  EXPECT_EQ(reduced.summary.reduced[0].parts, 82);
  pair.inside = few.hinges(9, 9);
  const Outcome whole = pair.run(", reduction: {error: 0.1}");
  ASSERT_EQ(whole.summary.reduced.size(), 1u);
  EXPECT_EQ(whole.summary.reduced[0].name, "right");
}

}  // namespace reduced_test
}  // namespace pounding
