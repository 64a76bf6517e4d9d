// Yielding storeys in complete runs: closed forms, an independent integrator, the energy balance, and contacts.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace yielding_test {

// One storey under a harmonic ground motion, independent of the library: fourth-order Runge-Kutta on the linear
// branches of the force, which are joined at located instants.
struct Reference {
  double mass, stiffness, damping, yield_force, hardening;
  double amplitude, period, duration;  // of the ground motion

  struct Point {
    double time, u, force, lost;
  };

  // Output every `every` seconds until `end`.
  std::vector<Point> run(double end, double every) const {
    const double yield = yield_force / stiffness, longest = 2e-5;
    double t = 0, u = 0, v = 0, slip = 0, lost = 0;
    int branch = 0;  // -1, 1: yielding in this direction
    const auto force = [&](double x) {
      const double stretch = branch == 0 ? x - slip : branch * yield;
      return hardening * stiffness * x + (1 - hardening) * stiffness * stretch;
    };
    const auto acceleration = [&](double time, double x, double rate) {
      const double ground = time < duration ? amplitude * std::sin(2 * M_PI * time / period) : 0;
      return -ground - (damping * rate + force(x)) / mass;
    };
    const auto after = [&](double h) {
      const double v1 = v, a1 = acceleration(t, u, v);
      const double v2 = v + h / 2 * a1, a2 = acceleration(t + h / 2, u + h / 2 * v1, v2);
      const double v3 = v + h / 2 * a2, a3 = acceleration(t + h / 2, u + h / 2 * v2, v3);
      const double v4 = v + h * a3, a4 = acceleration(t + h * (1 - 1e-15), u + h * v3, v4);
      return std::array{u + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
    };
    // Positive while the branch applies.
    const auto margin = [&](const std::array<double, 2>& x) {
      return branch == 0 ? yield - std::abs(x[0] - slip) : branch * x[1];
    };
    std::vector<Point> points{{0, 0, 0, 0}};
    for (int output = 1; output * every <= end * (1 + 1e-12); ++output) {
      const double goal = output * every;
      while (goal - t > 1e-14) {
        double h = std::min(longest, goal - t);
        if (t < duration && t + h > duration) h = duration - t;
        auto next = after(h);
        const bool ends = margin(next) < 0;
        if (ends) {
          double low = 0, high = h;
          while (high - low > 1e-17) {
            const double middle = 0.5 * (low + high);
            if (middle == low || middle == high) break;
            (margin(after(middle)) < 0 ? high : low) = middle;
          }
          next = after(h = high);
        }
        t = std::abs(goal - t - h) < 1e-14 ? goal : t + h;
        if (std::abs(t - duration) < 1e-14) t = duration;
        u = next[0], v = next[1];
        if (!ends) continue;
        if (branch == 0) {
          branch = u > slip ? 1 : -1;
        } else {
          const double moved = u - branch * yield - slip;
          lost += (1 - hardening) * yield_force * std::abs(moved);
          slip += moved;
          branch = 0;
        }
      }
      points.push_back({goal, u, force(u), lost});
    }
    return points;
  }
};

// Yields in eleven half-cycles and comes to rest 8 mm out of plumb.
constexpr double w = 2 * M_PI / 0.5;
constexpr Reference yielding_tower{.mass = 1e5,
                                   .stiffness = 1e5 * w * w,
                                   .damping = 2 * 0.03 * w * 1e5,
                                   .yield_force = 3e5,
                                   .hardening = 0.05,
                                   .amplitude = 4,
                                   .period = 0.6,
                                   .duration = 3.3};
constexpr double tower_end = 8, tower_output = 0.005;

Reference elastic_tower() {
  Reference tower = yielding_tower;
  tower.yield_force = 1e9;
  return tower;
}

std::string yaml_of(const Reference& tower, const std::string& analysis) {
  return fmt::format(
      "ground_motion: {{harmonic: {{amplitude: {}, period: {}, duration: {}}}}}\n"
      "structures: {{tower: {{oscillator: {{mass: {}, stiffness: {}, damping: {}, yield_force: {}, hardening: "
      "{}}}}}}}\n"
      "analysis: {{duration: {}, output_step: {}, {}}}\n",
      tower.amplitude, tower.period, tower.duration, tower.mass, tower.stiffness, tower.damping / (2 * w * tower.mass),
      tower.yield_force, tower.hardening, tower_end, tower_output, analysis);
}

double largest(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// Maximum errors of a run: displacements relative to the peak, forces relative to the initial stiffness times the peak,
// the lost energy relative to itself.
struct Errors {
  double displacement = 0, force = 0, peak = 0, residual = 0, lost = 0, energy = 0;
};

Errors errors_of(const Reference& tower, const std::vector<Reference::Point>& exact, const std::string& analysis) {
  const Outcome run = test::run_text(yaml_of(tower, analysis));
  const StructureHistory& history = run.results.structures[0];
  Errors e;
  if (history.displacement.size() != exact.size()) {
    ADD_FAILURE() << history.displacement.size() << " outputs instead of " << exact.size();
    return e;
  }
  double peak = 0, off_centre = 0;
  for (const Reference::Point& point : exact) peak = std::max(peak, std::abs(point.u));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = history.displacement[i] - exact[i].u;
    e.displacement = std::max(e.displacement, std::abs(error) / peak);
    e.force = std::max(e.force, std::abs(history.storey_shear[i] - exact[i].force) / (tower.stiffness * peak));
    // Averaged over the last period the oscillation vanishes and leaves the residual displacement.
    if (exact[i].time > tower_end - 0.5 + tower_output / 2) off_centre += error * tower_output / 0.5;
  }
  e.peak = std::abs(largest(history.displacement) - peak) / peak;
  e.residual = std::abs(off_centre) / peak;
  e.lost = std::abs(run.summary.energy.hysteretic - exact.back().lost) / std::max(exact.back().lost, 1.0);
  e.energy = run.summary.energy.error;
  return e;
}

const std::vector<Reference::Point>& yielding_reference() {
  static const std::vector<Reference::Point> points = yielding_tower.run(tower_end, tower_output);
  return points;
}

const std::vector<Reference::Point>& elastic_reference() {
  static const std::vector<Reference::Point> points = elastic_tower().run(tower_end, tower_output);
  return points;
}

class YieldingTower : public testing::TestWithParam<const char*> {};

// The phase drifts by slightly more than the tolerance, as in an elastic tower; the corners of the force add no error.
TEST_P(YieldingTower, IsAsAccurateAsAnElasticOne) {
  test::Book book(
      "Yielding storeys",
      "independent integration: Runge-Kutta of order four on the linear branches, which are joined at located "
      "instants",
      "the tolerance of the run, 1e-3 to 1e-6");
  const double tolerance = std::stod(GetParam());
  const std::string analysis = std::string("tolerance: ") + GetParam();
  const Errors e = errors_of(yielding_tower, yielding_reference(), analysis);
  const Errors elastic = errors_of(elastic_tower(), elastic_reference(), analysis);
  book.below("peak displacement, error over peak [-]", e.peak, tolerance);
  book.below("residual displacement, error over peak [-]", e.residual, tolerance);
  book.below("hysteretic energy, error [-]", e.lost, tolerance);
  book.below("imbalance of the energies [-]", e.energy, tolerance);
  EXPECT_LT(e.displacement, elastic.displacement);
  EXPECT_LT(e.force, elastic.force);
}

INSTANTIATE_TEST_SUITE_P(Tolerance, YieldingTower, testing::Values("1e-3", "1e-4", "1e-5", "1e-6"),
                         [](const auto& test) { return "1em" + std::string(test.param).substr(3); });

TEST(YieldingTower, ComesToRestOffThePlumbLine) {
  const std::vector<Reference::Point>& exact = yielding_reference();
  double mean = 0;
  for (const Reference::Point& point : exact)
    if (point.time > tower_end - 0.5 + tower_output / 2) mean += point.u * tower_output / 0.5;
  EXPECT_GT(std::abs(mean), 5e-3) << "otherwise the residual displacement would not be tested";
  EXPECT_GT(exact.back().lost, 20 * yielding_tower.yield_force * yielding_tower.yield_force / yielding_tower.stiffness);
}

TEST(PerfectlyPlasticOscillator, FollowsItsClosedForm) {
  test::Book book(
      "Yielding storeys",
      "elastic-perfectly-plastic oscillator from a velocity v: elastic to uy = Fy/k at v1^2 = v^2 - (w "
      "uy)^2, decelerated by Fy to uy + m v1^2/(2 Fy), then oscillating by uy about the residual displacement",
      "the tolerance 1e-6 of the run, by which half a cycle of phase drifts");
  const double m = 1e5, k = m * w * w, fy = 4e5, uy = fy / k, v = 1.2, end = 3, tolerance = 1e-6;
  const Outcome run =
      test::run_text(fmt::format("structures: {{a: {{oscillator: {{mass: {}, stiffness: {}, damping: 0, yield_force: "
                                 "{}}}, initial_velocity: {}}}}}\n"
                                 "analysis: {{duration: {}, output_step: 0.01, tolerance: {}}}\n",
                                 m, k, fy, v, end, tolerance));
  const double v1 = std::sqrt(v * v - w * w * uy * uy), residual = m * v1 * v1 / (2 * fy), top = uy + residual;
  const double t1 = std::asin(w * uy / v) / w, t2 = t1 + m * v1 / fy;
  EXPECT_GT(residual, 2 * uy);
  book.near("closed form: peak displacement [m]", run.summary.structures[0].peak_displacement[0], top, tolerance * top);
  book.near("closed form: hysteretic energy [J]", run.summary.energy.hysteretic, fy * residual,
            tolerance * fy * residual);
  book.below("closed form: imbalance of the energies [-]", run.summary.energy.error, tolerance);
  const StructureHistory& history = run.results.structures[0];
  for (std::size_t i = 0; i < run.results.time.size(); ++i) {
    const double t = run.results.time[i];
    const double u = t < t1   ? v / w * std::sin(w * t)
                     : t < t2 ? uy + v1 * (t - t1) - fy / (2 * m) * (t - t1) * (t - t1)
                              : residual + uy * std::cos(w * (t - t2));
    const double force = t < t1 ? k * u : t < t2 ? fy : k * (u - residual);
    book.near("closed form: displacement at each instant [m]", history.displacement[i], u, 2 * tolerance * top);
    book.near("closed form: force at each instant [N]", history.storey_shear[i], force, 2 * tolerance * k * top);
    EXPECT_LE(std::abs(history.storey_shear[i]), fy * (1 + 1e-12)) << "at " << t;
  }
}

// Three storeys each, 5 mm apart.
std::string two_buildings(bool yield, bool linked, const std::string& more) {
  const std::string left = yield ? ", yield_force: [2500 kN, 2000 kN, 1200 kN], hardening: 10 %" : "";
  const std::string right = yield ? ", yield_force: 3 MN" : "";
  std::string yaml =
      "ground_motion: {harmonic: {amplitude: 3, period: 0.7, duration: 4}}\n"
      "structures:\n"
      "  left: {shear_building: {storeys: 3, mass: 150 t, stiffness: 100 MN/m" +
      left +
      "}, damping: 4 %}\n"
      "  right: {shear_building: {storeys: 3, mass: 200 t, stiffness: [300 MN/m, 250 MN/m, 200 MN/m]" +
      right + "}, damping: 4 %}\n";
  if (linked)
    yaml +=
        "links: [{between: [left, right], floors: all, gap: 5 mm, law: hertz_damped, stiffness: 2.75e9, restitution: "
        "0.65}]\n";
  return yaml + "analysis: {duration: 6, output_step: 0.01, tolerance: 1e-5}\n" + more;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

bool same_histories(const Outcome& a, const Outcome& b) {
  for (std::size_t k = 0; k < a.results.structures.size(); ++k) {
    const StructureHistory &x = a.results.structures[k], &y = b.results.structures[k];
    if (!same_bits(x.displacement, y.displacement) || !same_bits(x.acceleration, y.acceleration) ||
        !same_bits(x.storey_shear, y.storey_shear))
      return false;
  }
  return same_bits(a.results.energy.hysteretic, b.results.energy.hysteretic);
}

TEST(YieldingBuildings, KeepTheirEnergiesWhileTheyPound) {
  const Outcome run = test::run_text(two_buildings(true, true, ""));
  EXPECT_LT(run.summary.energy.error, 1e-5);
  EXPECT_GT(run.results.impacts.size(), 10u);
  EXPECT_GT(run.summary.energy.hysteretic, 0.1 * run.summary.energy.input);
  EXPECT_GT(run.summary.energy.impact, 0.01 * run.summary.energy.input);
  const std::vector<double>& lost = run.results.energy.hysteretic;
  EXPECT_TRUE(std::is_sorted(lost.begin(), lost.end())) << "lost energy does not return";
}

TEST(YieldingBuildings, DoNotMoveAsElasticOnesDo) {
  const double yielding = test::run_text(two_buildings(true, true, "")).summary.structures[0].peak_drift[0];
  const Outcome elastic = test::run_text(two_buildings(false, true, ""));
  EXPECT_GT(std::abs(yielding / elastic.summary.structures[0].peak_drift[0] - 1), 0.1);
  EXPECT_EQ(elastic.summary.energy.hysteretic, 0);
}

TEST(YieldingBuildings, GiveTheSameBitsTwice) {
  const std::string yaml = two_buildings(true, true, "");
  EXPECT_TRUE(same_histories(test::run_text(yaml), test::run_text(yaml)));
}

// The run without links must leave no state in the springs of the run with links.
TEST(YieldingBuildings, StartUndeformedInBothRunsOfAComparison) {
  const Outcome compared = test::run_text(two_buildings(true, true, "compare: no_pounding\n"));
  EXPECT_TRUE(same_histories(compared, test::run_text(two_buildings(true, true, ""))));
  const Outcome alone = test::run_text(two_buildings(true, false, ""));
  ASSERT_EQ(compared.summary.without_pounding.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_bits(compared.summary.without_pounding[i].peak_drift, alone.summary.structures[i].peak_drift));
    EXPECT_FALSE(same_bits(compared.summary.structures[i].peak_drift, alone.summary.structures[i].peak_drift));
  }
}

TEST(YieldingBuildings, StartUndeformedWhenTheyAreRunAgain) {
  const Model model = test::model_of(two_buildings(true, false, ""));
  const Outcome first = run(model);
  EXPECT_GT(first.summary.energy.hysteretic, 0);
  EXPECT_TRUE(same_histories(first, run(model)));
}

// Storeys that never reach their yield force match the elastic building, up to the round-off of one more product.
TEST(YieldingBuildings, AreElasticBelowTheirYieldForce) {
  std::string elastic = two_buildings(false, true, "");
  elastic.insert(elastic.rfind("}"), ", integrator: generalized_alpha");
  std::string strong = elastic;
  strong.insert(strong.find("}, damping: 4 %}\n  right"), ", yield_force: 1 GN");
  const Outcome a = test::run_text(strong), b = test::run_text(elastic);
  EXPECT_EQ(a.summary.energy.hysteretic, 0);
  for (int i = 0; i < 2; ++i)
    for (int floor = 0; floor < 3; ++floor)
      EXPECT_NEAR(a.summary.structures[i].peak_displacement[floor], b.summary.structures[i].peak_displacement[floor],
                  1e-9 * b.summary.structures[i].peak_displacement[floor]);
}

// Fourth-order steps are long; they end at yields and reversals of a storey.
TEST(YieldingTower, IsTheSameByEsdirk4) {
  test::Book book(
      "Yielding storeys",
      "independent integration: Runge-Kutta of order four on the linear branches, which are joined at located "
      "instants",
      "the tolerance of the run");
  const Errors e = errors_of(yielding_tower, yielding_reference(), "tolerance: 1e-4, integrator: esdirk4");
  book.below("ESDIRK4: peak displacement, error over peak [-]", e.peak, 1e-4);
  book.below("ESDIRK4: residual displacement, error over peak [-]", e.residual, 1e-4);
  book.below("ESDIRK4: hysteretic energy, error [-]", e.lost, 1e-4);
  book.below("ESDIRK4: imbalance of the energies [-]", e.energy, 1e-4);
}

}  // namespace yielding_test
}  // namespace pounding
