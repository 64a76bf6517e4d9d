// Guarantees of the kernel for every law: exact free flight, a sufficient gap, bitwise identical results, error
// messages.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/ground/spectrum.hpp>
#include <pounding/study/kernel.hpp>
#include <pounding/study/kernels.hpp>
#include "support/messages.hpp"

namespace pounding::study {
namespace kernel_test {

/// Twenty seconds of ground motion with several frequencies, at 0.02 s.
std::vector<double> shaking() {
  std::vector<double> a;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.02 * i;
    a.push_back(2 * std::sin(5.3 * t) + 1.5 * std::sin(9.1 * t + 1) + std::sin(21 * t + 2) * std::exp(-0.1 * t));
  }
  return a;
}

const std::vector<double> ground = shaking();
const EvenRecord record{.accelerations = ground, .step = 0.02};

laws::AnyLaw hertz() { return laws::HertzDamped{.stiffness = 2.75e9, .damping_factor = 0.8}; }

/// Random pairs, the same on every machine.
class Pairs {
 public:
  LinearModel next(double gap_to, const laws::AnyLaw& law) {
    const auto u = [&] { return static_cast<double>(engine_()) / 4294967296.0; };
    const double t1 = 0.2 * std::pow(10, u()), t2 = 0.2 * std::pow(10, u()), m2 = 1e5 * std::pow(4, u() - 0.5);
    return pair_of({1e5, t1, 0.05}, {m2, t2, 0.05}, gap_to * u(), law, true);
  }

 private:
  std::mt19937 engine_{20};
};

/// Peak absolute accelerations of a pair with a linear spring, by the classical Runge-Kutta method at 0.05 ms.
std::array<double, 2> fine_accelerations(const LinearModel& model, double stiffness, double duration) {
  using State = std::array<double, 4>;
  const auto& b = model.links[0].closing;
  const auto ag = [](double t) {
    const auto i = std::min(static_cast<std::size_t>(t / 0.02), ground.size() - 2);
    return ground[i] + (ground[i + 1] - ground[i]) * (t / 0.02 - static_cast<double>(i));
  };
  const auto rate = [&](double t, const State& x) {
    const double force = stiffness * std::max(0.0, b[0] * x[0] + b[1] * x[1] - model.links[0].gap);
    State r{x[2], x[3], 0, 0};
    for (std::size_t j = 0; j < 2; ++j)
      r[2 + j] = -model.damping[j] * x[2 + j] - model.stiffness[j] * x[j] - model.load[j] * ag(t) - b[j] * force;
    return r;
  };
  const auto moved = [](const State& x, double h, const State& r) {
    State y = x;
    for (std::size_t i = 0; i < 4; ++i) y[i] += h * r[i];
    return y;
  };
  State x{};
  std::array<double, 2> peaks{};
  const double h = 5e-5;
  for (int n = 0; n < duration / h; ++n) {
    const double t = n * h;
    const State r1 = rate(t, x), r2 = rate(t + h / 2, moved(x, h / 2, r1)), r3 = rate(t + h / 2, moved(x, h / 2, r2)),
                r4 = rate(t + h, moved(x, h, r3));
    for (std::size_t j = 0; j < 2; ++j)
      peaks[j] = std::max(peaks[j], std::abs(r1[2 + j] * model.outputs[2 + j].factors[j] + ag(t)));
    for (std::size_t i = 0; i < 4; ++i) x[i] += h / 6 * (r1[i] + 2 * r2[i] + 2 * r3[i] + r4[i]);
  }
  return peaks;
}

TEST(AFlight, HasThePeakOfTheElasticSpectrum) {
  const std::vector<double> periods{0.01, 0.05, 0.2, 0.7, 2.0};
  std::vector<double> times;
  for (std::size_t i = 0; i < ground.size(); ++i) times.push_back(0.02 * static_cast<double>(i));
  const auto spectrum = response_spectrum(GroundMotion(Samples{times, ground, true}), periods, 0.02);
  for (std::size_t i = 0; i < periods.size(); ++i) {
    LinearModel model;
    const double w = 2 * M_PI / periods[i];
    model.stiffness = {w * w}, model.damping = {0.04 * w}, model.load = {1};
    model.outputs = {{.kind = Output::Kind::displacement, .factors = {1}}};
    // The spectrum continues after the record.
    const Peaks found = run(model, record, {.duration = 20 + 3 * periods[i]});
    // The spectrum finds its peaks on cubics.
    EXPECT_NEAR(found.outputs[0], spectrum[i].sd, 1e-6 * spectrum[i].sd) << periods[i];
  }
}

TEST(TheGapThatIsEnough, IsMetFromBothSides) {
  Pairs pairs;
  for (int i = 0; i < 100; ++i) {
    LinearModel model = pairs.next(0, hertz());
    const double enough = run(without_links(model), record).outputs[0];
    ASSERT_GT(enough, 1e-4);
    model.links[0].gap = enough * (1 + 1e-6);
    EXPECT_EQ(run(model, record).links[0].impacts, 0) << i;
    model.links[0].gap = enough * (1 - 1e-6);
    EXPECT_GE(run(model, record).links[0].impacts, 1) << i;
  }
}

TEST(OscillatorsOfOnePeriodAndDamping, NeverTouch) {
  const LinearModel model = pair_of({1e5, 0.5, 0.05}, {3e5, 0.5, 0.05}, 1e-6, hertz());
  const Peaks found = run(model, record);
  EXPECT_EQ(found.links[0].impacts, 0);
  EXPECT_EQ(found.links[0].peak_force, 0);
}

TEST(AWall, IsThePlaneOfSymmetryOfTwoMirroredOscillators) {
  // Two oscillators moved apart and together by the ground, and one of them in front of a wall at half the gap with
  // twice the stiffness.
  LinearModel both = pair_of({1e5, 0.6, 0.05}, {1e5, 0.6, 0.05}, 0.04, laws::Hertz{.stiffness = 1e9});
  both.load[1] *= -1;
  LinearModel one;
  one.stiffness = {both.stiffness[0]}, one.damping = {both.damping[0]}, one.load = {both.load[0]};
  one.links.push_back(
      {.gap = 0.02, .closing = {both.links[0].closing[0]}, .law = laws::Hertz{.stiffness = 1e9 * std::pow(2, 1.5)}});
  one.outputs = {{.kind = Output::Kind::displacement, .factors = {both.links[0].closing[0]}}};
  const Peaks pair = run(both, record, {.tolerance = 1e-8}), wall = run(one, record, {.tolerance = 1e-8});
  EXPECT_GT(wall.links[0].impacts, 3);
  EXPECT_EQ(wall.links[0].impacts, pair.links[0].impacts);
  EXPECT_NEAR(wall.outputs[0], pair.outputs[0], 1e-5 * pair.outputs[0]);
  EXPECT_NEAR(wall.links[0].peak_force, pair.links[0].peak_force, 1e-5 * pair.links[0].peak_force);
  EXPECT_NEAR(2 * wall.links[0].peak_penetration, pair.links[0].peak_penetration,
              1e-5 * pair.links[0].peak_penetration);
}

TEST(ThePeakOfAForce, IsFoundJustBeforeTheBodiesTurn) {
  // A dashpot that acts during approach only: the force has its maximum there, and its slope jumps at the reversal.
  for (const double c : {0.05, 0.3, 0.8}) {
    LinearModel model;
    model.stiffness = model.damping = model.load = {0};
    model.velocity = {1};
    model.links.push_back({.gap = 0.5,
                           .closing = {1},
                           .law = laws::ModifiedLinearViscoelastic{.stiffness = 1, .damping_coefficient = c}});
    const double w = std::sqrt(1 - c * c / 4);
    double peak = 0;
    for (double t = 0; t < 0.5 * M_PI / w; t += 1e-5) {
      const double d = std::exp(-c / 2 * t) * std::sin(w * t) / w,
                   rate = std::exp(-c / 2 * t) * std::cos(w * t) - c / 2 * d;
      peak = std::max(peak, d + c * std::max(rate, 0.0));
    }
    const std::vector<double> still(2, 0.0);
    const Peaks found = run(model, {.accelerations = still, .step = 1}, {.duration = 5});
    EXPECT_NEAR(found.links[0].peak_force, peak, 1e-7) << c;
  }
}

void expect_same_bits(const Peaks& a, const Peaks& b) {
  EXPECT_EQ(a.outputs, b.outputs);
  EXPECT_EQ(a.steps, b.steps);
  for (std::size_t l = 0; l < a.links.size(); ++l) {
    EXPECT_EQ(a.links[l].impacts, b.links[l].impacts);
    EXPECT_EQ(a.links[l].peak_force, b.links[l].peak_force);
    EXPECT_EQ(a.links[l].impulse, b.links[l].impulse);
    EXPECT_EQ(a.links[l].energy_lost, b.links[l].energy_lost);
  }
}

TEST(TheBitsOfARow, DependOnNothingButTheRow) {
  Pairs pairs;
  std::vector<LinearModel> models;
  for (int i = 0; i < 40; ++i) models.push_back(pairs.next(0.04, hertz()));
  std::vector<Peaks> forth, back;
  for (const LinearModel& model : models) forth.push_back(run(model, record));
  for (std::size_t i = models.size(); i-- > 0;) back.push_back(run(models[i], record));
  for (std::size_t i = 0; i < models.size(); ++i) expect_same_bits(forth[i], back[models.size() - 1 - i]);
}

TEST(ThePeakOfAnAcceleration, IsThatOfAFineIntegrationWithContactsThatLast) {
  // Soft contacts that last for many samples.
  Pairs pairs;
  for (int i = 0; i < 6; ++i) {
    const double k = 4e6;
    const LinearModel model = pairs.next(0.03, laws::LinearSpring{.stiffness = k});
    const Peaks found = run(model, record, {.duration = 10, .tolerance = 1e-8});
    EXPECT_GT(found.links[0].impacts, 1);
    const std::array<double, 2> expected = fine_accelerations(model, k, 10);
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(found.outputs[2 + j], expected[j], 1e-4 * expected[j]) << i;
  }
}

TEST(AThirdStructureFarAway, ChangesNothingBesideIt) {
  // A pair, by the code path for any number of modes and links.
  Pairs pairs;
  for (int i = 0; i < 20; ++i) {
    const LinearModel pair = pairs.next(0.04, hertz());
    LinearModel row = pair;
    row.stiffness.push_back(100), row.damping.push_back(1), row.load.push_back(300);
    for (Output& output : row.outputs) output.factors.push_back(0);
    row.links[0].closing.push_back(0);
    row.links.push_back({.gap = 5, .closing = {0, row.links[0].closing[1], -1.0 / 300}, .law = hertz()});
    const Peaks a = run(pair, record, {.tolerance = 1e-7}), b = run(row, record, {.tolerance = 1e-7});
    EXPECT_EQ(b.links[1].impacts, 0);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(b.outputs[k], a.outputs[k], 2e-5 * a.outputs[k]) << i;
    EXPECT_NEAR(b.links[0].peak_force, a.links[0].peak_force, 2e-5 * a.links[0].peak_force) << i;
  }
}

TEST(TheShapesOfTheKernel, GiveTheSameBits) {
  Pairs pairs;
  for (int i = 0; i < 20; ++i) {
    const LinearModel pair = pairs.next(0.04, hertz());
    LinearModel row = pair;
    row.stiffness.push_back(100), row.damping.push_back(1), row.load.push_back(300);
    for (Output& output : row.outputs) output.factors.push_back(1e-3);
    row.links[0].closing.push_back(0);
    row.links.push_back({.gap = 0.01, .closing = {0, row.links[0].closing[1], -1.0 / 300}, .law = hertz()});
    expect_same_bits(run_few(pair, record, {}), run_pair(pair, record, {}));
    LinearModel apart = pair;
    apart.outputs.resize(2);
    for (const laws::AnyLaw& law :
         {laws::AnyLaw(hertz()), laws::AnyLaw(laws::KelvinVoigt{.stiffness = 9e7, .damping_coefficient = 5e5})}) {
      apart.links[0].law = law;
      expect_same_bits(run_few(apart, record, {}), run_pair(apart, record, {}));
    }
    expect_same_bits(run_few(row, record, {}), run_any(row, record, {}));
  }
}

TEST(ATouchAtRest, WithoutAGapIsTakenByEveryLaw) {
  for (const laws::Entry& entry : laws::catalogue()) {
    if (entry.instantaneous) continue;
    laws::AnyLaw law = laws::make_law(laws::typical_settings(entry));
    if (auto* const bilinear = std::get_if<laws::BilinearHertz>(&law); bilinear && !bilinear->is_given())
      bilinear->impact_velocity = 0.5;
    const Peaks found = run(pair_of({1e5, 0.5, 0.05}, {1.5e5, 0.3, 0.05}, 0, law), record);
    EXPECT_GT(found.links[0].impacts, 5) << entry.name;
    EXPECT_TRUE(std::isfinite(found.links[0].peak_force)) << entry.name;
    // A spring loses no energy; the error of the steps is their tolerance times the energy transferred.
    EXPECT_GT(found.links[0].energy_lost, -1e-5 * found.links[0].peak_force * found.links[0].peak_penetration)
        << entry.name;
  }
}

TEST(ATouchAtRest, IsRefusedByALawThatNeedsAClosingSpeed) {
  laws::BilinearHertz law{.stiffness = 2.75e9, .restitution = 0.65, .reduced_mass = 6e4};
  const std::vector<double> push(200, -1.0);  // presses the flexible left one to the right permanently
  const EvenRecord pressed{.accelerations = push, .step = 0.02};
  const auto model = [&] { return pair_of({1e5, 2, 0.05}, {1.5e5, 0.3, 0.05}, 1e-9, law); };
  try {
    run(model(), pressed);
    ADD_FAILURE() << "not rejected";
  } catch (const SolverError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"bilinear_hertz"}));
    EXPECT_NE(std::string(error.what()).find("impact_velocity: 0.5 m/s"), std::string::npos) << error.what();
  }
  law.impact_velocity = 0.5;
  EXPECT_GE(run(model(), pressed).links[0].impacts, 1);
}

/// A mass of 1 kg, pressed by 1 m/s^2, that falls with speed v onto a spring and a dashpot that may pull. Closed form:
/// d'' + c d' + w^2 d = 1.
struct Fall {
  double w, c, v;
  double fast = std::sqrt(w * w - 0.25 * c * c);
  double penetration(double t) const {
    return 1 / (w * w) + std::exp(-0.5 * c * t) *
                             ((v - 0.5 * c / (w * w)) / fast * std::sin(fast * t) - std::cos(fast * t) / (w * w));
  }
  double rate(double t) const {
    return std::exp(-0.5 * c * t) * (v * std::cos(fast * t) + (1 - 0.5 * c * v) / fast * std::sin(fast * t));
  }
  /// Minimum of `of(*this, t)` in the first period.
  template <class Of>
  double minimum(const Of& of) const {
    const double period = 2 * M_PI / fast;
    double at = 0.5 * period, low = 0, high = period;
    for (double t = at; t < high; t += 0.01 * period)
      if (of(*this, t) < of(*this, at)) at = t;
    low = at - 0.01 * period, high = at + 0.01 * period;
    for (int i = 0; i < 100; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (of(*this, a) < of(*this, b) ? high : low) = of(*this, a) < of(*this, b) ? b : a;
    }
    return of(*this, low);
  }
};

/// Impacts in 0.3 s of falls whose speed is 1e-6 below and above the threshold of a second impact, for any frequency.
template <class Of, class Law>
void expect_a_second_touch(double damping, const Of& of, const Law& law) {
  const std::vector<double> pressing(7, -1.0);
  for (int i = 0; i < 40; ++i) {
    const double w = 100 + 0.37 * i, c = 10;
    double low = 0, high = 10 / w;
    for (int k = 0; k < 60; ++k) (Fall{w, c, 0.5 * (low + high)}.minimum(of) > 0 ? low : high) = 0.5 * (low + high);
    LinearModel model;
    model.stiffness = {0}, model.damping = {damping * c}, model.load = {1};
    model.links.push_back({.gap = 0, .closing = {1}, .law = law(w, c)});
    model.velocity = {low * (1 - 1e-6)};
    EXPECT_EQ(
        run(model, {.accelerations = pressing, .step = 0.1}, {.duration = 0.2, .tolerance = 1e-9}).links[0].impacts, 1)
        << w;
    model.velocity = {low * (1 + 1e-6)};
    EXPECT_GE(
        run(model, {.accelerations = pressing, .step = 0.1}, {.duration = 0.2, .tolerance = 1e-9}).links[0].impacts, 2)
        << w;
  }
}

TEST(BodiesThatPartForAnInstant, TouchAgainHoweverStepsFall) {
  expect_a_second_touch(
      1, [](const Fall& fall, double t) { return fall.penetration(t); },
      [](double w, double) { return laws::LinearSpring{.stiffness = w * w}; });
}

TEST(AForceThatEndsForAnInstant, EndsTheContactOfALawThatLeavesAnIndentation) {
  expect_a_second_touch(
      0, [](const Fall& fall, double t) { return fall.w * fall.w * fall.penetration(t) + fall.c * fall.rate(t); },
      [](double w, double c) {
        laws::Komodromos law;
        law.stiffness = w * w, law.damping_coefficient = c;
        return law;
      });
}

TEST(TheKernel, RefusesWhatItCannotRun) {
  const LinearModel good = pair_of({1e5, 0.5, 0.05}, {1e5, 0.3, 0.05}, 0.01, hertz());
  const auto text = [&](const LinearModel& model, const EvenRecord& r, const Settings& s) -> std::string {
    try {
      run(model, r, s);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(text(good, record, {}), "");
  LinearModel bad = good;
  bad.links[0].gap = -0.01;
  EXPECT_TRUE(test::mentions(text(bad, record, {}), {"gap"}));
  bad = good;
  bad.links[0].law = laws::Stereomechanical{.restitution = 0.6};
  EXPECT_TRUE(test::mentions(text(bad, record, {}), {"stereomechanical"}));
  bad = good;
  bad.load.pop_back();
  EXPECT_TRUE(test::mentions(text(bad, record, {}), {"2"}));
  bad = good;
  bad.links.push_back({.gap = 1, .closing = {0, 0}, .law = laws::Hertz{.stiffness = 1e9}});
  EXPECT_NE(text(bad, record, {}), "");
  bad = good;
  bad.displacement = {20, 0};
  EXPECT_NE(text(bad, record, {}), "");
  EXPECT_TRUE(test::mentions(text(good, {.accelerations = ground, .step = 0}, {}), {"record"}));
  EXPECT_TRUE(test::mentions(text(good, record, {.tolerance = 1}), {"[1e-13, 1e-2]", "tolerance"}));
  const std::vector<double> broken{0, std::nan("")};
  EXPECT_TRUE(test::mentions(text(good, {.accelerations = broken, .step = 0.01}, {}), {"record"}));
}

}  // namespace kernel_test
}  // namespace pounding::study
