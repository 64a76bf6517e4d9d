// A run that was stopped and resumed is bitwise identical to an uninterrupted run.

#include <gtest/gtest.h>

#include <unistd.h>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/recording/recorder.hpp>
#include <pounding/results/results.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace restart_test {

// A results file of this process, removed at the end.
class File {
 public:
  explicit File(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_" + name + ".h5")) {}
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

using Bits = std::vector<std::uint64_t>;

Bits bits_of(const std::vector<double>& values) {
  Bits bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

// All results that do not depend on the clock, by name.
std::map<std::string, Bits> bits_of(Outcome outcome) {
  std::map<std::string, Bits> all;
  visit_histories(outcome.results,
                  [&](const std::string& place, std::vector<double>& values) { all[place] = bits_of(values); });
  for (const ImpactRow& row : outcome.results.impacts) {
    const Bits values = bits_of({static_cast<double>(row.link), row.t_start, row.t_end, row.t_release, row.v_approach,
                                 row.v_separation, row.restitution, row.peak_force, row.t_peak, row.peak_penetration,
                                 row.impulse, row.energy_lost, row.energy_stored});
    Bits& impacts = all["impacts"];
    impacts.insert(impacts.end(), values.begin(), values.end());
  }
  for (const StructureHistory& s : outcome.results.structures)
    for (const Extremes* extremes : {&s.envelope.displacement, &s.envelope.acceleration, &s.envelope.drift,
                                     &s.envelope.storey_shear, &s.envelope.member_force, &s.envelope.reaction})
      for (const std::vector<double>* values : {&extremes->min, &extremes->max, &extremes->t_min, &extremes->t_max}) {
        const Bits bits = bits_of(*values);
        all["envelope " + s.name].insert(all["envelope " + s.name].end(), bits.begin(), bits.end());
      }
  const SolverStatistics& solver = outcome.results.solver;
  for (const long count : {solver.steps, solver.rejected, solver.events, solver.iterations})
    all["solver"].push_back(static_cast<std::uint64_t>(count));
  Summary& summary = outcome.summary;
  summary.solver.wall_seconds = summary.solver.wall_setup = summary.solver.wall_solve = summary.solver.wall_output = 0;
  for (const char letter : to_json(summary)) all["summary"].push_back(static_cast<unsigned char>(letter));
  return all;
}

void expect_same(const Outcome& whole, const Outcome& continued) {
  const auto expected = bits_of(whole), found = bits_of(continued);
  ASSERT_EQ(expected.size(), found.size());
  for (const auto& [place, bits] : expected) {
    ASSERT_TRUE(found.contains(place)) << place;
    EXPECT_EQ(bits.size(), found.at(place).size()) << place;
    EXPECT_TRUE(bits == found.at(place)) << place;
  }
}

using StopWhen = bool (*)(const ContactMemory& contact);

bool pressed(const ContactMemory& contact) { return presses(contact.phase()); }
// Monitor calls depend on the clock: on a busy machine an impact may begin and end between two calls.
bool touched(const ContactMemory& contact) { return presses(contact.phase()) || !contact.impacts().empty(); }
bool apart(const ContactMemory& contact) { return !contact.impacts().empty() && contact.phase() == ContactPhase::open; }

void stop(const Model& model, const RunOptions& base, StopWhen when) {
  RunOptions options = base;
  bool stopped = false;
  options.stop = [&](std::span<const ContactMemory> contacts) {
    return stopped = !contacts.empty() && when(contacts[0]);
  };
  EXPECT_THROW(run(model, options), FailedRun);
  ASSERT_TRUE(stopped) << "the run ended before it was stopped";
}

void expect_to_go_on(const std::string& yaml, StopWhen when) {
  const File file("resume");
  stop(test::model_of(yaml), {.output = file.path()}, when);
  if (testing::Test::HasFatalFailure()) return;
  const Model model = test::model_of(yaml);
  const Outcome continued = run(model, {.output = file.path(), .resume = file.path()});
  expect_same(test::run_text(yaml), continued);
  EXPECT_THROW(read_interrupted_run(file.path()), InputError) << "a completed run cannot be resumed";
}

constexpr const char* schemes[] = {"integrator: generalized_alpha, spectral_radius: 1",
                                   "integrator: generalized_alpha, spectral_radius: 0.8", "integrator: esdirk4"};

// The benchmark with this line added to its analysis.
std::string two_oscillators(const std::string& law, const std::string& scheme) {
  std::string yaml = test::two_oscillators(law, scheme.find("esdirk4") == std::string::npos ? 1e-5 : 1e-10, 1.5);
  return yaml.insert(yaml.rfind('}'), ", " + scheme);
}

class Resume : public testing::TestWithParam<const char*> {};

TEST_P(Resume, OutsideAContactGivesTheSameBits) {
  for (const char* scheme : schemes) {
    SCOPED_TRACE(scheme);
    expect_to_go_on(two_oscillators(GetParam(), scheme), apart);
  }
}

TEST_P(Resume, InsideAContactGivesTheSameBits) {
  if (std::string(GetParam()).find("stereomechanical") == 0) GTEST_SKIP() << "its contacts are instantaneous";
  for (const char* scheme : schemes) {
    SCOPED_TRACE(scheme);
    expect_to_go_on(two_oscillators(GetParam(), scheme), pressed);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Resume, testing::ValuesIn(test::every_law), test::law_name);

// A body pushed by the ground motion against a rigid wall, where it comes to rest.
constexpr const char* resting =
    "ground_motion: {pulse: {shape: half_sine, amplitude: -3, duration: 2.9}}\n"
    "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}, w: {wall: {}}}\n"
    "links: [{between: [a, w], gap: 5 mm, law: stereomechanical, restitution: 0.3}]\n"
    "analysis: {duration: 3, max_step: 1 ms}\n";

TEST(ResumeAtRest, GivesTheSameBits) {
  expect_to_go_on(resting, [](const ContactMemory& contact) { return contact.phase() == ContactPhase::resting; });
}

// The maxima of the run occur before the stop: motion that decays after one impact.
constexpr const char* dying =
    "ground_motion: {pulse: {shape: half_sine, amplitude: -3, duration: 0.3}}\n"
    "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 30 %}}, w: {wall: {}}}\n"
    "links: [{between: [a, w], gap: 5 mm, law: hertz, stiffness: 2.75e9}]\n"
    "analysis: {duration: 3, max_step: 1 ms}\n";

TEST(ResumeOfDyingMotion, KeepsTheLargestValues) { expect_to_go_on(dying, apart); }

// The body is in contact during the ground pulse, whose steps are shorter than those after it.
TEST(ResumeInAShortPulse, GivesTheSameBits) {
  for (const std::string scheme : schemes) {
    SCOPED_TRACE(scheme);
    const std::string tolerance = scheme == "integrator: esdirk4" ? "1e-10" : "1e-5";
    expect_to_go_on(
        "ground_motion: {pulse: {shape: sine, amplitude: -300, start: 0.2, duration: 0.02}}\n"
        "structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}, w: {wall: {}}}\n"
        "links: [{between: [a, w], gap: 5 mm, law: hertz, stiffness: 2.75e9}]\n"
        "analysis: {duration: 2, tolerance: " +
            tolerance + ", " + scheme + "}\n",
        pressed);
  }
}

// A model with its recorder, driven step by step.
struct Recorded {
  Model model;
  System system;
  ModalSolver solver;
  Stepper stepper;
  StepController controller;
  Results results;
  Recorder recorder;
  ErrorControl policy{0.02};
  double wanted = 1e-3;

  explicit Recorded(const std::string& yaml)
      : model(test::model_of(yaml)),
        system(assemble(model)),
        solver(system),
        stepper(system, solver,
                {.tolerance = model.analysis.tolerance, .scheme = model.analysis.scheme, .max_step = 0.02}),
        controller(stepper),
        recorder(model, stepper.view(), results) {
    stepper.start(0, Eigen::VectorXd::Zero(system.size()), Eigen::VectorXd::Zero(system.size()));
    recorder.begin();
  }
  void step() {
    wanted = controller.advance(wanted, 1.5, policy);
    recorder.step();
  }
  void archive(Archive& archive) {
    controller.archive(archive);
    recorder.archive(archive);
    archive(wanted);
  }
};

// Accelerations have their peaks inside steps, on paths that also depend on the previous step.
TEST(ResumeInEveryStepOfAContact, FindsTheSamePeakAccelerations) {
  const std::string yaml = test::two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65", 1e-4, 1.5);
  Recorded whole(yaml);
  int compared = 0;
  while (whole.stepper.view().time() < 0.62) {
    Archive state;
    whole.archive(state);
    Archive saved(state.bytes());
    Recorded continued(yaml);
    continued.results = whole.results;  // histories over time, which a file contains
    continued.archive(saved);
    const bool presses = whole.stepper.view().in_contact();
    whole.step();
    if (!presses) continue;
    continued.step();
    ++compared;
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(whole.results.structures[k].envelope.acceleration.min,
                continued.results.structures[k].envelope.acceleration.min);
      EXPECT_EQ(whole.results.structures[k].envelope.acceleration.max,
                continued.results.structures[k].envelope.acceleration.max);
    }
  }
  EXPECT_GT(compared, 20);
}

// Bounces whose errors accumulate until the energy balance requires shorter steps.
TEST(ResumeWithASpentBudgetOfEnergy, GivesTheSameBits) {
  for (const std::string scheme : schemes) {
    SCOPED_TRACE(scheme);
    const StopWhen late = [](const ContactMemory& contact) {
      return contact.impacts().size() > 60 && presses(contact.phase());
    };
    expect_to_go_on(
        "ground_motion: {pulse: {shape: rectangle, amplitude: -3.7245309099735495, duration: 2.5}}\n"
        "structures: {a: {body: {mass: 17133.6901071129}}, w: {wall: {}}}\n"
        "links: [{between: [a, w], gap: 1e-9, law: linear_spring, stiffness: 6185090576.35574}]\n"
        "analysis: {duration: 1, tolerance: 1e-4, " +
            scheme + "}\n",
        late);
  }
}

// Only forces: a short one, one with corners, and a permanent one.
TEST(ResumeUnderForces, GivesTheSameBits) {
  for (const std::string scheme : schemes)
    for (const StopWhen when : {pressed, apart}) {
      SCOPED_TRACE(scheme);
      expect_to_go_on(
          "structures:\n"
          "  a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}, forces: [{harmonic: {amplitude: 300 kN, period: "
          "0.6, duration: 3}},\n"
          "      {pulse: {shape: sine, amplitude: 9 MN, start: 0.2, duration: 5 ms}}, {step_force: {amplitude: 50 kN, "
          "start: 0.1, rise: 0.3}}]}\n"
          "  b: {body: {mass: 50 t, gravity: -0.1 m/s^2}}\n"
          "links: [{between: [a, b], gap: 5 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.6}]\n"
          "analysis: {duration: 2, tolerance: " +
              std::string(scheme == "integrator: esdirk4" ? "1e-10" : "1e-5") + ", " + scheme + "}\n",
          when);
    }
}

// A record with corners, several simultaneous links, yielding storeys.
constexpr const char* buildings =
    "ground_motion: {synthetic: {seed: 7, duration: 4 s, step: 0.02, pga: 0.4 g}}\n"
    "structures:\n"
    "  left: {shear_building: {storeys: 3, mass: 250 t, stiffness: 5e5 kN/m, yield_force: 1500 kN, hardening: 0.05, "
    "damping: {rayleigh: {ratio: 5 %, modes: [1, 3]}}}}\n"
    "  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 9e5 kN/m, damping: {modal: {ratio: 3 %}}}}\n"
    "links: [{between: [left, right], floors: all, gap: 5 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}]\n"
    "compare: no_pounding\n"
    "analysis: {duration: 4}\n";

TEST(ResumeOfBuildings, GivesTheSameBits) { expect_to_go_on(buildings, touched); }

// Dashpots inside dampers have their own lengths, braces have slips.
constexpr const char* with_devices =
    "ground_motion: {synthetic: {seed: 7, duration: 4 s, step: 0.02, pga: 0.4 g}}\n"
    "structures:\n"
    "  left: {shear_building: {storeys: 3, mass: 250 t, stiffness: 5e5 kN/m, yield_force: 1500 kN, hardening: 0.05, "
    "damping: 5 %, devices: "
    "{fluid: {storey: 1, damper: {coefficient: 200 kN (s/m)^0.35, exponent: 0.35, stiffness: 40 MN/m}}, "
    "brace: {between: [1, 3], bouc_wen: {stiffness: 80 MN/m, yield_force: 300 kN}}}}}\n"
    "  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 9e5 kN/m, damping: 3 %}}\n"
    "links: [{between: [left, right], floors: all, gap: 5 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}]\n"
    "devices: {tie: {between: [left.1, right.1], bilinear: {stiffness: 60 MN/m, yield_force: 200 kN}, damper: "
    "{coefficient: 100 kN (s/m)^0.5, "
    "exponent: 0.5, stiffness: 30 MN/m}}}\n"
    "analysis: {duration: 4}\n";

TEST(ResumeWithDevices, GivesTheSameBits) {
  for (const char* scheme :
       {"duration: 4, integrator: generalized_alpha, spectral_radius: 0.8", "duration: 4, integrator: esdirk4"}) {
    std::string yaml = with_devices;
    expect_to_go_on(yaml.replace(yaml.find("duration: 4}"), 11, scheme), touched);
  }
}

// Isolators with two laws, velocity-dependent friction, and walls with permanently deformed backfill.
constexpr const char* isolated =
    "ground_motion: {harmonic: {amplitude: 4 m/s^2, period: 1.2, duration: 4}}\n"
    "structures:\n"
    "  west: {wall: {}}\n"
    "  a: {shear_building: {storeys: 3, mass: 250 t, stiffness: 3e5 kN/m, isolator: {friction_pendulum: {radius: 2 m, "
    "friction: [4 %, 8 %], rate: 60 s/m}}}, damping: 2 %}\n"
    "  b: {shear_building: {storeys: 3, mass: 250 t, stiffness: 3e5 kN/m, isolator: {lead_rubber: {strength: 300 kN, "
    "yield_displacement: 10 mm, post_yield_stiffness: 3 MN/m}}}, damping: 2 %}\n"
    "links:\n"
    "  - {between: [west, a.1], gap: 40 mm, law: backfill, stiffness: 100 MN/m, unloading: 300 MN/m, failure_ratio: "
    "0.75, strength: 3 MN}\n"
    "  - {between: [a.1, b.1], gap: 30 mm, law: backfill, stiffness: 100 MN/m, unloading: 300 MN/m, failure_ratio: "
    "0.75, strength: 3 MN}\n"
    "analysis: {duration: 4, tolerance: 1e-4, output_step: 1e-2}\n";

TEST(ResumeOfIsolatedBuildings, GivesTheSameBits) {
  expect_to_go_on(isolated, apart);
  expect_to_go_on(isolated, touched);
}

// Isolators in space, with constant and velocity-dependent friction, and a wall.
constexpr const char* isolated_in_space =
    "ground_motion: {components: {x: {harmonic: {amplitude: 3, period: 0.7, duration: 1.5}}, y: {harmonic: {amplitude: "
    "2, period: 0.45, duration: 1.5}}}}\n"
    "structures:\n"
    "  w: {wall: {}}\n"
    "  a: {damping: 2 %, frame: {origin: [1 m, 0 m, 0 m], material: {E: 30 GPa, G: 12 GPa}, gravity: true, grid: "
    "{storeys: 1, bays: [1, 1], storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: "
    "{rectangle: [0.3, 0.5]}, floor_mass: 60 t}, masses: {0.0.0: 20 t, 0.1.0: 20 t, 0.0.1: 20 t, 0.1.1: 20 t}, "
    "supports: {feet: {isolator: {friction_pendulum: {radius: 2 m, friction: LAW}}}}, ties: [{master: 0.0.0, nodes: "
    "[0.1.0, 0.0.1, 0.1.1], dofs: [ux, uy]}]}}\n"
    "links: [{between: [w, a.1], gap: 80 mm, law: kelvin_voigt_no_tension, stiffness: 100 MN/m, restitution: 0.6}]\n"
    "analysis: {duration: 2, tolerance: 1e-4, output_step: 1e-2}\n";

TEST(ResumeOfIsolatorsInSpace, GivesTheSameBits) {
  for (const char* law : {"6 %", "[4 %, 8 %], rate: 60 s/m"}) {
    std::string yaml = isolated_in_space;
    yaml.replace(yaml.find("LAW"), 3, law);
    expect_to_go_on(yaml, apart);
    expect_to_go_on(yaml, touched);
  }
}

// Extremes of members are tracked over several steps; the column of the left frame is hit between its ends.
constexpr const char* frames =
    "ground_motion: {synthetic: {seed: 7, duration: 2 s, pga: 0.6 g}}\n"
    "structures:\n"
    "  left: {frame: {material: {E: 30 GPa, density: 2500}, mass: consistent, grid: {storeys: 2, bays: 1, "
    "storey_height: 3 m, bay_width: 5 m, columns: {circle: 0.4}, beams: {circle: 0.5}, floor_mass: 60 t}, report: "
    "{members: all}}, damping: 5 %}\n"
    "  right: {frame: {origin: [5.001 m, 0 m], material: {E: 30 GPa, density: 2500}, mass: consistent, grid: {storeys: "
    "1, bays: 1, storey_height: 2 m, bay_width: 5 m, columns: {circle: 0.6}, beams: {circle: 0.5}, floor_mass: 60 t}}, "
    "damping: 5 %}\n"
    "links: [{between: [left, right], floors: any, gap: 1 mm, law: hertz_damped, stiffness: 1e8, restitution: 0.6}]\n"
    "analysis: {duration: 2}\n";

TEST(ResumeOfFrames, GivesTheSameBits) {
  static int looks = 0;
  for (const int first : {0, 1}) {
    looks = first;
    expect_to_go_on(frames, [](const ContactMemory&) { return ++looks == 3; });
  }
}

TEST(ResumeTwice, GivesTheSameBits) {
  const std::string yaml = two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65",
                                           "integrator: generalized_alpha, spectral_radius: 0.8");
  const File first("first"), second("second");
  stop(test::model_of(yaml), {.output = first.path()}, pressed);
  stop(test::model_of(yaml), {.output = second.path(), .resume = first.path()}, apart);
  const Model model = test::model_of(yaml);
  expect_same(test::run_text(yaml), run(model, {.resume = second.path()}));
  EXPECT_EQ(read_interrupted_run(first.path()).model_yaml, yaml) << "the first file is unchanged";
}

}  // namespace restart_test
}  // namespace pounding
