// The engine against independent integrators: PETSc's own TSALPHA2 with fixed steps, and TSRK (5dp) with PETSc's events
// at touch, release and separation.
//
// Shared with the engine: the reader, the matrices, the ground motion, the laws and their damping. Not shared: time
// stepping, error control, event location, phases, condensation of the link forces, peaks.

#include <gtest/gtest.h>
#include <petscts.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <pounding/laws/all.hpp>
#include <pounding/model/system.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/petsc/version.hpp>
#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace stock_integrators_test {

using Eigen::MatrixXd, Eigen::VectorXd, petsc::check, petsc::Handle;

constexpr const char* subject = "The engine compared with PETSc's integrators";

laws::AnyLaw law_of(const Link& link) {
  laws::Settings settings{.law = link.law, .formula = link.formula, .reduced_mass = link.reduced_mass};
  for (const laws::ResolvedValue& p : link.parameters) {
    if (p.name == "restitution") settings.restitution = p.value;
    if (p.name == "stiffness") settings.values.emplace(p.name, p.value);
  }
  return laws::make_law(settings);
}

struct Hit {
  double time = 0, approach = 0, peak_force = 0;  // [s], [m/s], [N]
};

// No force while separated. In contact, the law at max(penetration, 0), so that a late separation cannot glue the
// bodies.
struct PlainLink {
  laws::AnyLaw law;
  VectorXd closing;  // column of B
  double gap = 0;
  bool pressed = false;
  laws::Impact impact{};
  std::vector<Hit> hits{};

  double penetration(const VectorXd& u) const { return closing.dot(u) - gap; }
  laws::Response uncut(double d, double rate) const {
    return std::visit([&](const auto& chosen) { return chosen.contact(std::max(d, 0.0), rate, impact); }, law);
  }
  bool may_pull() const { return laws::entry_of(law).may_pull; }
  laws::Response force(const VectorXd& u, const VectorXd& v) const {
    if (!pressed) return {};
    const laws::Response r = uncut(penetration(u), closing.dot(v));
    return may_pull() ? r : laws::no_tension(r);
  }
  // A dashpot releases before the separation if it would pull: its force is cut off at zero.
  bool lets_go_early() const { return pressed && !may_pull() && uncut(0, -1).force < 0; }

  void touch_or_part(double time, double rate) {
    pressed = rate > 0;
    if (!pressed) return;
    impact = std::visit([&](const auto& chosen) { return laws::touch(chosen, rate); }, law);
    hits.push_back({.time = time, .approach = rate});
  }
};

struct Signal {
  double value = 0, slope = 0;  // slope in time
};

// Maximum absolute value of the cubic with these end values, h apart.
double highest(double h, Signal begin, Signal end) {
  const double top = std::max(std::abs(begin.value), std::abs(end.value));
  if (!(begin.slope * end.slope < 0)) return top;
  const double mean = (end.value - begin.value) / h;
  const double a = 3 * (begin.slope + end.slope - 2 * mean), b = 2 * (3 * mean - 2 * begin.slope - end.slope);
  const double root = std::copysign(std::sqrt(b * b - 4 * a * begin.slope), begin.slope);
  const double s = 2 * begin.slope / (root - b);
  return std::max(top, std::abs(begin.value + h * s * (begin.slope + s * (b / 2 + s * a / 3))));
}

// The full equations, and the peaks of a run.
struct PlainModel {
  MatrixXd mass, damping, stiffness, mass_inverse;
  VectorXd load, u, v;
  GroundMotion ground;
  double time = 0, duration = 0;
  std::vector<PlainLink> links;
  std::vector<Signal> signals;  // displacements, then link forces
  std::vector<double> peaks;    // of the signals

  explicit PlainModel(const Model& model) : duration(model.analysis.duration) {
    const System system = assemble(model);
    mass = MatrixXd(system.mass);
    damping = MatrixXd(system.damping);
    stiffness = MatrixXd(system.stiffness);
    for (const Group& g : system.groups) {
      const auto block = [&](MatrixXd& matrix) { return matrix.block(g.first, g.first, g.count, g.count); };
      block(damping) += g.by_mass * block(mass) + g.by_stiffness * block(stiffness);
    }
    mass_inverse = mass.inverse();
    load = system.load.col(0);
    ground = system.grounds[0];
    const MatrixXd closing(system.gap_jacobian);
    for (const Link& link : model.links)
      links.push_back({.law = law_of(link), .closing = closing.col(links.size()), .gap = link.gap});
    std::tie(u, v) = initial_state(model);
    depart(0, u, v);
    peaks.assign(signals.size(), 0);
  }

  // C v + K u + B F + p ag
  VectorXd resistance(double t, const VectorXd& at_u, const VectorXd& at_v) const {
    VectorXd r = damping * at_v + stiffness * at_u + ground.acceleration(t) * load;
    for (const PlainLink& link : links) r += link.force(at_u, at_v).force * link.closing;
    return r;
  }
  VectorXd acceleration(double t, const VectorXd& at_u, const VectorXd& at_v) const {
    return -(mass_inverse * resistance(t, at_u, at_v));
  }

  // The next step starts here, in the present phases.
  void depart(double t, const VectorXd& at_u, const VectorXd& at_v) {
    time = t, u = at_u, v = at_v;
    const VectorXd a = acceleration(t, u, v);
    signals.clear();
    for (Eigen::Index i = 0; i < u.size(); ++i) signals.push_back({u[i], v[i]});
    for (const PlainLink& link : links) {
      const laws::Response r = link.force(u, v);
      signals.push_back({r.force, r.by_penetration * link.closing.dot(v) + r.by_rate * link.closing.dot(a)});
    }
  }
  // The end of a step, in the phases in which it was computed. (A pull is smaller than the push before it.)
  void arrive(double t, const VectorXd& at_u, const VectorXd& at_v) {
    const std::vector<Signal> before = signals;
    const double h = t - time;
    depart(t, at_u, at_v);
    if (!(h > 0)) return;
    for (std::size_t k = 0; k < signals.size(); ++k) {
      const double top = highest(h, before[k], signals[k]);
      peaks[k] = std::max(peaks[k], top);
      if (k < static_cast<std::size_t>(u.size()) || top == 0) continue;
      double& of_hit = links[k - u.size()].hits.back().peak_force;
      of_hit = std::max(of_hit, top);
    }
  }
};

// In a callback a failed access ends the program: no exception may cross the C code of PETSc.
VectorXd values(Vec x) noexcept {
  const PetscScalar* data = nullptr;
  PetscInt size = 0;
  check(VecGetLocalSize(x, &size));
  check(VecGetArrayRead(x, &data));
  const VectorXd copy = Eigen::Map<const VectorXd>(data, size);
  check(VecRestoreArrayRead(x, &data));
  return copy;
}

PetscErrorCode write(const VectorXd& from, Vec to) noexcept {
  PetscScalar* data = nullptr;
  check(VecGetArrayWrite(to, &data));
  std::copy_n(from.data(), from.size(), data);
  check(VecRestoreArrayWrite(to, &data));
  return POUNDING_PETSC_SUCCESS;
}

void create(Handle<Vec>& x, const VectorXd& from) {
  check(VecCreateSeq(PETSC_COMM_SELF, from.size(), x.out()));
  write(from, x);
}

PlainModel& plain(void* context) { return *static_cast<PlainModel*>(context); }

PlainModel& plain(TS ts) noexcept {
  PlainModel* model = nullptr;
  check(TSGetApplicationContext(ts, &model));
  return *model;
}

double time_of(TS ts) noexcept {
  PetscReal t = 0;
  check(TSGetTime(ts, &t));
  return t;
}

// A TS with these options, which include the prefix.
void create(Handle<TS>& ts, PlainModel& model, const char* prefix, const char* options,
            PetscErrorCode (*after_step)(TS)) {
  check(PetscOptionsInsertString(nullptr, options));
  check(TSCreate(PETSC_COMM_SELF, ts.out()));
  check(TSSetOptionsPrefix(ts, prefix));
  check(TSSetFromOptions(ts));
  check(TSSetApplicationContext(ts, &model));
  check(TSSetPostStep(ts, after_step));
  check(TSSetMaxTime(ts, model.duration));
  check(TSSetMaxSteps(ts, PETSC_MAX_INT));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
}

// TSALPHA2: M a + C v + K u + B F + p ag = 0. Phases change at the ends of steps, so that no step contains a jump of
// the force.
namespace alpha2 {

PetscErrorCode residual(TS, PetscReal t, Vec u, Vec v, Vec a, Vec r, void* context) {
  const PlainModel& model = plain(context);
  return write(model.mass * values(a) + model.resistance(t, values(u), values(v)), r);
}

PetscErrorCode jacobian(TS, PetscReal, Vec u, Vec v, Vec, PetscReal shift_v, PetscReal shift_a, Mat, Mat j,
                        void* context) {
  const PlainModel& model = plain(context);
  MatrixXd matrix = shift_a * model.mass + shift_v * model.damping + model.stiffness;
  for (const PlainLink& link : model.links) {
    const laws::Response r = link.force(values(u), values(v));
    matrix += (r.by_penetration + shift_v * r.by_rate) * link.closing * link.closing.transpose();
  }
  PetscScalar* data = nullptr;
  PetscFunctionBegin;
  PetscCall(MatDenseGetArrayWrite(j, &data));
  std::copy_n(matrix.data(), matrix.size(), data);
  PetscCall(MatDenseRestoreArrayWrite(j, &data));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode after_step(TS ts) {
  PlainModel& model = plain(ts);
  const double t = time_of(ts);
  Vec u = nullptr, v = nullptr;
  PetscFunctionBegin;
  PetscCall(TS2GetSolution(ts, &u, &v));
  model.arrive(t, values(u), values(v));
  for (PlainLink& link : model.links)
    if (link.pressed != (link.penetration(model.u) > 0)) link.touch_or_part(t, link.closing.dot(model.v));
  model.depart(t, values(u), values(v));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// The spectral radius is one: below 3.22 TSALPHA2 starts with twice the acceleration, which is harmless only at one.
// Newton's method and never KSPONLY: TSALPHA2 updates its velocity in the residual after the last correction.
PlainModel march(const Model& input, int steps) {
  PlainModel model(input);
  Handle<TS> ts;
  Handle<Vec> u, v, r;
  Mat j = nullptr;
  create(ts, model, "alpha2_",
         "-alpha2_ts_type alpha2 -alpha2_ts_alpha_radius 1 -alpha2_ts_adapt_type none -alpha2_snes_type newtonls "
         "-alpha2_snes_rtol 1e-11 -alpha2_snes_stol 1e-14 -alpha2_ksp_type preonly -alpha2_pc_type lu",
         after_step);
  create(u, model.u);
  create(v, model.v);
  create(r, model.v);
  check(MatCreateSeqDense(PETSC_COMM_SELF, model.u.size(), model.u.size(), nullptr, &j));
  check(TS2SetSolution(ts, u, v));
  check(TSSetI2Function(ts, r, residual, &model));
  check(TSSetI2Jacobian(ts, j, j, jacobian, &model));
  check(MatDestroy(&j));  // the TS holds its own reference
  check(TSSetTimeStep(ts, model.duration / steps));
  check(TSSolve(ts, nullptr));
  return model;
}

}  // namespace alpha2

// TSRK on [u; v], with events at every touch and separation, and at the zero of a dashpot force that would pull.
namespace runge_kutta {

constexpr int events_of_a_link = 2;

VectorXd u_of(const VectorXd& y) { return y.head(y.size() / 2); }
VectorXd v_of(const VectorXd& y) { return y.tail(y.size() / 2); }
VectorXd joined(const VectorXd& u, const VectorXd& v) {
  VectorXd y(u.size() + v.size());
  y << u, v;
  return y;
}

PetscErrorCode right_hand_side(TS, PetscReal t, Vec y, Vec rates, void* context) {
  const VectorXd now = values(y);
  return write(joined(v_of(now), plain(context).acceleration(t, u_of(now), v_of(now))), rates);
}

// Both in metres: the penetration, and the force over its stiffness, or 1 without an early release.
PetscErrorCode indicators(TS, PetscReal, Vec y, PetscScalar found[], void* context) {
  const VectorXd now = values(y);
  for (const PlainLink& link : plain(context).links) {
    const double d = link.penetration(u_of(now));
    const laws::Response r = link.uncut(d, link.closing.dot(v_of(now)));
    *found++ = d;
    *found++ = link.lets_go_early() ? r.force / r.by_penetration : 1;
  }
  return POUNDING_PETSC_SUCCESS;
}

// Phases are set from the sign of the rate. 5dp reuses its last stage as the next first one, unless it is restarted.
PetscErrorCode located(TS ts, PetscInt count, PetscInt which[], PetscReal t, Vec y, PetscBool, void* context) {
  PlainModel& model = plain(context);
  const VectorXd now = values(y);
  model.arrive(t, u_of(now), v_of(now));
  for (PetscInt i = 0; i < count; ++i) {
    PlainLink& link = model.links[which[i] / events_of_a_link];
    if (which[i] % events_of_a_link == 0) link.touch_or_part(t, link.closing.dot(model.v));
  }
  model.depart(t, u_of(now), v_of(now));
  return TSRestartStep(ts);
}

PetscErrorCode after_step(TS ts) {
  Vec y = nullptr;
  PetscFunctionBegin;
  PetscCall(TSGetSolution(ts, &y));
  plain(ts).arrive(time_of(ts), u_of(values(y)), v_of(values(y)));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// The step after an event has no error control: over 1e-7 s this is harmless even for Jankowski's d^(1/4). The maximum
// step is for the cubic that finds the peaks.
PlainModel march(const Model& input) {
  PlainModel model(input);
  Handle<TS> ts;
  Handle<Vec> y;
  create(ts, model, "rk_",
         "-rk_ts_type rk -rk_ts_rk_type 5dp -rk_ts_rtol 1e-11 -rk_ts_atol 1e-12 -rk_ts_adapt_dt_max 1e-4 "
         "-rk_ts_event_post_event_step 1e-7",
         after_step);
  create(y, joined(model.u, model.v));
  check(TSSetSolution(ts, y));
  check(TSSetRHSFunction(ts, nullptr, right_hand_side, &model));
  // Before the events are set: PETSc below 3.21 uses the present step as the second one after every event.
  check(TSSetTimeStep(ts, 1e-7));
  const int events = events_of_a_link * static_cast<int>(model.links.size());
  std::vector<PetscInt> either_way(events, 0);
  const auto never_stop = std::make_unique<PetscBool[]>(events);
  check(TSSetEventHandler(ts, events, either_way.data(), never_stop.get(), indicators, located, &model));
  check(TSSetEventTolerances(ts, 1e-12, nullptr));  // [m]
  check(TSSolve(ts, nullptr));
  return model;
}

}  // namespace runge_kutta

// Differences of the peak displacements and of the peak force of each link, relative to the engine.
VectorXd differences(const PlainModel& stock, const Outcome& engine) {
  std::vector<double> peaks;
  for (const StructureSummary& structure : engine.summary.structures)
    peaks.insert(peaks.end(), structure.peak_displacement.begin(), structure.peak_displacement.end());
  for (const LinkSummary& link : engine.summary.links) peaks.push_back(link.peak_force);
  VectorXd parts(peaks.size());
  for (std::size_t k = 0; k < peaks.size(); ++k) parts[k] = stock.peaks[k] / peaks[k] - 1;
  return parts;
}

// Observed order of the difference between TSALPHA2 and the engine, over five step lengths and five a quarter as long.
double observed_order(const char* law) {
  const std::string yaml = test::two_oscillators(law, 1e-8);
  const Outcome engine = test::run_text(yaml);
  double coarse = 0, fine = 0;
  for (const int steps : {5000, 5700, 6500, 7300, 8300}) {
    const PlainModel few = alpha2::march(test::model_of(yaml), steps),
                     many = alpha2::march(test::model_of(yaml), 4 * steps);
    EXPECT_EQ(many.links[0].hits.size(), engine.results.impacts.size());
    coarse += differences(few, engine).squaredNorm();
    fine += differences(many, engine).squaredNorm();
  }
  return std::log2(coarse / fine) / 4;
}

constexpr const char* fixed_steps = "PETSc's TSALPHA2 with fixed steps on the same equations";
constexpr const char* chance =
    "the location of a touch within a step is random, as is a fraction of the error: root mean squares over five "
    "lengths";

TEST(StockAlpha2, ComesNearTheEngineWithTheSquareOfItsStepForHertz) {
  test::Book book(subject, fixed_steps, chance);
  book.near("order of the difference from TSALPHA2, Hertz [-]", observed_order("hertz, stiffness: 2.75e9"), 2, 0.3);
}

TEST(StockAlpha2, ComesNearTheEngineWithTheSquareOfItsStepForASpring) {
  test::Book book(subject, fixed_steps, chance);
  book.near("order of the difference from TSALPHA2, linear spring [-]",
            observed_order("linear_spring, stiffness: 9.35e7"), 2, 0.3);
}

TEST(StockAlpha2, ComesNearTheEngineWithItsStepWhereTheForceJumps) {
  test::Book book(subject, fixed_steps, chance);
  book.near(
      "order of the difference from TSALPHA2, Kelvin-Voigt, where a touch detected one step late loses c v h of "
      "momentum [-]",
      observed_order("kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65"), 1, 0.3);
}

// ESDIRK4 may exceed its tolerance by a tenth with Jankowski's dashpot, which grows as d^(1/4) from the touch.
constexpr double tolerance = 5e-9, allowed = 1e-7;

void expect_the_same_impacts(const std::string& problem, const std::string& law, const std::string& yaml) {
  test::Book book(subject, "PETSc's TSRK (5dp, 1e-11) with PETSc's events, " + problem,
                  "twice the engine's tolerance 5e-9 as amplified by impacts: "
                  "an initial displacement of 1e-8 of the peak changes no speed or force of these impacts "
                  "by more than 1e-7");
  const Outcome engine = test::run_text(yaml);
  const PlainModel stock = runge_kutta::march(test::model_of(yaml));
  const double widest = *std::max_element(stock.peaks.begin(), stock.peaks.begin() + stock.u.size());
  EXPECT_DOUBLE_EQ(stock.time, stock.duration);
  book.below(law + ": differences of peak displacements and forces, relative [-]",
             differences(stock, engine).cwiseAbs().maxCoeff(), allowed);
  for (std::size_t i = 0; i < stock.links.size(); ++i) {
    std::vector<ImpactRow> rows;
    for (const ImpactRow& row : engine.results.impacts)
      if (row.link == static_cast<int>(i)) rows.push_back(row);
    const std::vector<Hit>& hits = stock.links[i].hits;
    ASSERT_EQ(rows.size(), hits.size()) << "link " << i;
    book.equal(law + ": impacts of a link", static_cast<double>(rows.size()), static_cast<double>(hits.size()));
    for (std::size_t k = 0; k < hits.size(); ++k) {
      SCOPED_TRACE(fmt::format("link {}, impact {}", i, k));
      book.near(law + ": touch [s]", rows[k].t_start, hits[k].time, allowed * widest / hits[k].approach);
      book.near(law + ": approach [m/s]", rows[k].v_approach, hits[k].approach, allowed * hits[k].approach);
      book.near(law + ": peak force [N]", rows[k].peak_force, hits[k].peak_force, allowed * hits[k].peak_force);
    }
  }
}

class StockRungeKutta : public testing::TestWithParam<const char*> {};

TEST_P(StockRungeKutta, FindsTheSameImpactsOfTwoOscillators) {
  expect_the_same_impacts("two oscillators", test::law_of(GetParam()), test::two_oscillators(GetParam(), tolerance));
}

// Thirteen or fourteen impacts on three floors that touch in close succession.
TEST_P(StockRungeKutta, FindsTheSameImpactsOnThreeFloors) {
  expect_the_same_impacts(
      "three floors, thirteen or fourteen impacts", test::law_of(GetParam()),
      fmt::format("ground_motion: {{harmonic: {{amplitude: 3.0, period: 0.6, duration: 3.0}}}}\n"
                  "structures:\n"
                  "  left:  {{shear_building: {{storeys: 3, mass: 250 t, stiffness: 220 MN/m}}, damping: 5 %}}\n"
                  "  right: {{shear_building: {{storeys: 3, mass: 250 t, stiffness: 450 MN/m}}, damping: 5 %}}\n"
                  "links: [{{between: [left, right], floors: all, gap: 15 mm, law: {}}}]\n"
                  "analysis: {{duration: 3, tolerance: {}}}\n",
                  GetParam(), tolerance));
}

INSTANTIATE_TEST_SUITE_P(SixLaws, StockRungeKutta,
                         testing::Values("hertz, stiffness: 2.75e9",
                                         "hertz_damped, stiffness: 2.75e9, restitution: 0.65",
                                         "jankowski, stiffness: 2.75e9, restitution: 0.65",
                                         "kelvin_voigt, stiffness: 9.35e7, restitution: 0.65",
                                         "kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65",
                                         "modified_linear_viscoelastic, stiffness: 9.35e7, restitution: 0.65"),
                         test::law_name);

}  // namespace stock_integrators_test
}  // namespace pounding
