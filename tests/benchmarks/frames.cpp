// Run times of linear frames with pounding: one JSON object per run.
//
//   frames plane --law NAME --tolerance T --motion FILE [--integrator esdirk4] [--base modal|sparse]
//   frames space --storeys N --bays N [--bays-y M] [--steps K] [--base modal|sparse]
//
// plane: the pair of plane_frames.py, six links, 20 s. space: two frames in space, a link at every facing column line
// and floor, pushed together by constant forces; K steps of 5 ms. Other arguments are PETSc options.

#include <petscts.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/frames/frame.hpp>
#include <pounding/linear/make_solver.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace {

using namespace pounding;
using petsc::check;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The constants of plane_frames.py and problem.py. SI units.
constexpr double height = 3.2, bay = 6.0, elasticity = 25e9, floor_mass = 36e3;
constexpr double gap = 0.02, restitution = 0.65, linear_stiffness = 93.5e6, hertz_stiffness = 2.75e9;
constexpr double reduced_mass = (3 * floor_mass) * (2 * floor_mass) / (5 * floor_mass);
// 5 % at the first and sixth frequency of the plane pair; reference/plane_frames.json.
constexpr double by_mass = 0.31244343565330945, by_stiffness = 0.002905632243854408;

// Time step of the space frames [s].
constexpr double space_step = 5e-3;
constexpr int settling_steps = 40;  // before timing starts

using Words = std::map<std::string, std::string>;

double number(const Words& arguments, const std::string& name, double otherwise) {
  const auto found = arguments.find(name);
  if (found == arguments.end()) return otherwise;
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(found->second, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != found->second.size())
    throw std::invalid_argument(name + ": \"" + found->second + "\" is no number");
  return value;
}

int count(const Words& arguments, const std::string& name, int otherwise) {
  const double value = number(arguments, name, otherwise);
  if (!(value >= 1 && value <= 1e6 && value == std::floor(value)))
    throw std::invalid_argument(name + ": a whole number from 1 on");
  return static_cast<int>(value);
}

GridFrame grid(int storeys, int bays_x, int bays_y, double stiffer) {
  GridFrame g;
  g.storeys = storeys;
  g.bays_x = bays_x;
  g.bays_y = bays_y;
  g.storey_height = {height};
  g.bay_width_x = {bay};
  g.bay_width_y = {bay};
  const double column = 0.55, depth = 0.6, width = 0.3;
  const double inertia = stiffer * 0.7 * std::pow(column, 4) / 12;
  g.column = Section{
      .area = column * column, .inertia_y = inertia, .inertia_z = inertia, .torsion = 0.141 * std::pow(column, 4)};
  g.beam = Section{.area = width * depth,
                   .inertia_y = stiffer * 0.5 * width * std::pow(depth, 3) / 12,
                   .inertia_z = 0.5 * depth * std::pow(width, 3) / 12,
                   .torsion = 0.2 * std::pow(width, 3) * depth};
  g.material = {.young = elasticity, .shear = elasticity / 2.4};
  // 36 t where two bays meet, half of it at an edge: a floor counts its bays.
  g.floor_mass = {floor_mass * bays_x * std::max(1, bays_y)};
  return g;
}

struct Pair {
  System system;
  std::vector<std::unique_ptr<const Contact>> contacts;
  std::vector<GridFrame> grids;
  std::vector<AssembledFrame> frames;

  // Links from the right face of the first to the left face of the second, at every common floor and row of columns.
  template <class MakeContact>
  Pair(std::vector<GridFrame> both, const MakeContact& make_contact) : grids(std::move(both)) {
    std::vector<Eigen::Triplet<double>> mass, stiffness, closing;
    int n = 0;
    for (const GridFrame& g : grids) {
      frames.push_back(make_frame(g).assemble());
      const AssembledFrame& f = frames.back();
      for (int j = 0; j < f.size(); ++j) {
        for (SparseMatrix::InnerIterator it(f.mass, j); it; ++it) mass.emplace_back(n + it.row(), n + j, it.value());
        for (SparseMatrix::InnerIterator it(f.stiffness, j); it; ++it)
          stiffness.emplace_back(n + it.row(), n + j, it.value());
      }
      system.groups.push_back({n, f.size(), 1e-4, 1e-3, by_mass, by_stiffness});
      n += f.size();
    }
    system.mass.resize(n, n);
    system.mass.setFromTriplets(mass.begin(), mass.end());
    system.stiffness.resize(n, n);
    system.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
    system.damping.resize(n, n);
    system.load.resize(n, 1);
    for (std::size_t k = 0; k < grids.size(); ++k)
      system.load.col(0).segment(system.groups[k].first, frames[k].size()) = frames[k].load.col(0);
    for (int floor = 1; floor <= std::min(grids[0].storeys, grids[1].storeys); ++floor)
      for (int row = 0; row <= grids[0].bays_y; ++row) {
        const int link = static_cast<int>(contacts.size());
        closing.emplace_back(unknown(0, floor, grids[0].bays_x, row), link, 1.0);
        closing.emplace_back(unknown(1, floor, 0, row), link, -1.0);
        contacts.push_back(make_contact(link));
        system.contacts.push_back(contacts.back().get());
      }
    system.gap_jacobian.resize(n, static_cast<int>(contacts.size()));
    system.gap_jacobian.setFromTriplets(closing.begin(), closing.end());
  }

  // Index of the displacement along x at a node.
  int unknown(int frame, int storey, int line, int row = 0) const {
    const auto motion = frames[frame].motion(grids[frame].node(storey, line, row), Dof::ux);
    return system.groups[frame].first + static_cast<int>(Eigen::SparseVector<double>::InnerIterator(motion).index());
  }
};

// As problem.py states them.
laws::AnyLaw law_named(const std::string& name) {
  laws::Settings s{.law = name, .formula = {}};
  if (name == "linear_spring" || name == "kelvin_voigt")
    s.values["stiffness"] = linear_stiffness;
  else
    s.values["stiffness"] = hertz_stiffness;
  const std::map<std::string, std::string> formulas{{"kelvin_voigt", "anagnostopoulos"},
                                                    {"hertz_damped", "ye_2009"},
                                                    {"jankowski", "jankowski_2006"},
                                                    {"bilinear_hertz", "muthukumar_desroches"}};
  if (const auto formula = formulas.find(name); formula != formulas.end()) {
    s.formula = formula->second;
    s.restitution = restitution;
    s.reduced_mass = reduced_mass;
  }
  if (name == "bilinear_hertz") {
    s.impact_velocity = 0.5;
    s.values["yield_ratio"] = 0.1;
  }
  return laws::make_law(s);
}

GroundMotion motion_of(const std::string& path) {
  std::ifstream file(path);
  Samples samples;
  for (double t = 0, a = 0; file >> t >> a;) {
    samples.times.push_back(t);
    samples.accelerations.push_back(a);
  }
  if (!file.eof() || samples.times.size() < 2)
    throw std::invalid_argument(path + ": two columns of numbers are needed, time [s] and acceleration [m/s^2]");
  samples.uniform = evenly_spaced(samples.times);
  return GroundMotion(std::move(samples), path);
}

petsc::SolverKind base_kind(const Words& arguments) {
  const auto found = arguments.find("--base");
  if (found == arguments.end()) return petsc::SolverKind::automatic;
  if (found->second == "modal") return petsc::SolverKind::modal;
  if (found->second == "sparse") return petsc::SolverKind::sparse;
  throw std::invalid_argument("--base: modal or sparse");
}

Scheme scheme(const Words& arguments) {
  const auto found = arguments.find("--integrator");
  if (found == arguments.end()) return {.kind = Scheme::Kind::generalized_alpha};
  if (std::find(Scheme::names.begin(), Scheme::names.end(), found->second) == Scheme::names.end())
    throw std::invalid_argument("--integrator: generalized_alpha or esdirk4");
  return {.kind = Scheme::kind_of(found->second)};
}

struct Solve {
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;

  Solve(Stepper& stepper, double end, double step) {
    const State& now = stepper.view().state();
    check(petsc::register_ts_pounding());
    check(TSCreate(PETSC_COMM_SELF, ts.out()));
    check(TSSetOptionsPrefix(ts, "pounding_"));
    check(TSSetType(ts, petsc::ts_type));
    for (const auto& [vec, values] : {std::pair{&u, &now.u}, std::pair{&v, &now.v}}) {
      check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(values->size()), vec->out()));
      PetscScalar* to = nullptr;
      check(VecGetArray(*vec, &to));
      std::copy_n(values->data(), values->size(), to);
      check(VecRestoreArray(*vec, &to));
    }
    check(TS2SetSolution(ts, u, v));
    check(TSSetTime(ts, now.time));
    check(TSSetMaxTime(ts, end));
    check(TSSetMaxSteps(ts, PETSC_MAX_INT));
    check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
    check(TSSetTolerances(ts, 0, nullptr, stepper.view().options().tolerance, nullptr));
    check(TSSetTimeStep(ts, step));
    check(petsc::set_stepper(ts, &stepper));
    check(petsc::set_lazy_vectors(ts, PETSC_TRUE));
  }
  TSAdapt adapt() {
    TSAdapt adapt = nullptr;
    check(TSGetAdapt(ts, &adapt));
    return adapt;
  }
};

// Displacements of the tops and the energy balance during the run.
struct Watch {
  Stepper& stepper;
  std::array<int, 2> tops;
  double sample = 0.1;
  std::array<std::vector<double>, 2> displacement;
  std::array<double, 2> largest{0, 0};
  double input = 0, imbalance = 0;
  Eigen::VectorXd u, v;

  void look() {
    const State& now = stepper.view().state();
    for (int k = 0; k < 2; ++k) largest[k] = std::max(largest[k], std::abs(now.u[tops[k]]));
    while (sample * static_cast<double>(displacement[0].size()) <= now.time + 1e-9) {
      stepper.view().interpolate(sample * static_cast<double>(displacement[0].size()), u, v);
      for (int k = 0; k < 2; ++k) displacement[k].push_back(u[tops[k]]);
      const Energies e = stepper.view().energies();
      input = std::max(input, e.input);
      imbalance = std::max(imbalance, std::abs(e.input - e.kinetic - e.strain - e.damping - e.hysteretic - e.impact));
    }
  }
  static PetscErrorCode after_step(TS ts) {
    Watch* watch = nullptr;
    PetscFunctionBegin;
    PetscCall(TSGetApplicationContext(ts, &watch));
    watch->look();
    PetscFunctionReturn(0);
  }
};

nlohmann::json plane(const Words& arguments) {
  constexpr double duration = 20.0, longest = 0.005;
  const laws::AnyLaw law = law_named(arguments.contains("--law") ? arguments.at("--law") : "hertz_damped");
  const double tolerance = number(arguments, "--tolerance", 1e-4);
  if (!arguments.contains("--motion")) throw std::invalid_argument("--motion FILE is needed");
  Pair pair({grid(8, 3, 0, 1.0), grid(6, 2, 0, 1.7)}, [&](int link) { return pounding::make_contact(law, gap, link); });
  pair.system.grounds = {motion_of(arguments.at("--motion"))};
  // Errors are relative to a hundredth of the peak displacement of an oscillator of one second.
  const double w = 2 * M_PI;
  for (Group& group : pair.system.groups) {
    group.displacement_floor = 1e-2 * pair.system.grounds[0].peak() / (w * w);
    group.velocity_floor = 1e-2 * pair.system.grounds[0].peak() / w;
  }
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<StructureSolver> base = petsc::make_solver(pair.system, base_kind(arguments), PETSC_COMM_WORLD);
  Stepper stepper(pair.system, *base, {.tolerance = tolerance, .scheme = scheme(arguments), .max_step = longest});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(pair.system.size());
  stepper.start(0, zero, zero);
  Watch watch{stepper, {pair.unknown(0, 8, 3), pair.unknown(1, 6, 0)}, 0.1, {}, {0, 0}, 0, 0, {}, {}};
  watch.look();
  Solve solve(stepper, duration, longest / 64);
  check(TSSetApplicationContext(solve.ts, &watch));
  check(TSSetPostStep(solve.ts, Watch::after_step));
  check(TSSetFromOptions(solve.ts));
  const double setup = seconds_since(start);
  check(TSSolve(solve.ts, nullptr));
  const double wall = seconds_since(start);
  PetscInt steps = 0, rejected = 0;
  check(TSGetStepNumber(solve.ts, &steps));
  check(TSGetStepRejections(solve.ts, &rejected));
  std::vector<double> peaks;
  std::vector<int> impacts;
  for (const ContactMemory& contact : stepper.view().memory().contacts) {
    double peak = 0;
    for (const ImpactRow& row : contact.impacts()) peak = std::max(peak, row.peak_force);
    peaks.push_back(peak);
    impacts.push_back(static_cast<int>(contact.impacts().size()));
  }
  return {{"unknowns", pair.system.size()},
          {"base", base->description()},
          {"wall_seconds", wall},
          {"seconds_setup", setup},
          {"steps", steps},
          {"rejected", rejected},
          {"events", stepper.view().events()},
          {"peaks", peaks},
          {"impacts", impacts},
          {"peak_displacement", {{"left", watch.largest[0]}, {"right", watch.largest[1]}}},
          {"displacement", watch.displacement},
          {"energy_error", watch.imbalance / watch.input}};
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Both frames are pushed towards each other with a force that grows with time. Without a gap and with elastic links the
// motion is the static answer to a push of 1 m/s^2 times the time, apart from damping, so that the links stay in
// contact.
Eigen::VectorXd static_answer(const Pair& pair, StructureSolver& base) {
  base.set_matrix({0, 0, 1}, std::nullopt);
  Eigen::VectorXd x = base.layout().load.col(0);
  if (!base.solve(x)) throw SolverError("the static answer failed");
  Eigen::MatrixXd relative, g;
  base.gather(x, relative);
  std::vector<int> links(pair.contacts.size());
  for (std::size_t i = 0; i < links.size(); ++i) links[i] = static_cast<int>(i);
  Eigen::VectorXd force;
  for (;;) {
    const int count = static_cast<int>(links.size());
    if (!base.flexibility(links, g)) throw SolverError("the static answer failed");
    g.diagonal().array() += 1 / linear_stiffness;
    Eigen::VectorXd closing(count);
    for (int i = 0; i < count; ++i) closing[i] = relative(links[i], 0);
    force = g.ldlt().solve(closing);
    std::vector<int> pressed;
    for (int i = 0; i < count; ++i)
      if (force[i] > 0) pressed.push_back(links[i]);
    if (pressed.size() == links.size()) break;
    links = pressed;
  }
  base.add_response(-1, links, force, x);
  Eigen::VectorXd u;
  base.recover(x);
  u = base.physical(x);
  return u;
}

struct StepClock {
  std::vector<double> seconds;
  Clock::time_point last = Clock::now();

  static PetscErrorCode after_step(TS ts) {
    StepClock* clock = nullptr;
    PetscFunctionBegin;
    PetscCall(TSGetApplicationContext(ts, &clock));
    clock->seconds.push_back(seconds_since(clock->last));
    clock->last = Clock::now();
    PetscFunctionReturn(0);
  }
};

nlohmann::json space(const Words& arguments) {
  const int storeys = count(arguments, "--storeys", 12), bays = count(arguments, "--bays", 5);
  const int bays_y = count(arguments, "--bays-y", bays), steps = count(arguments, "--steps", 100);
  const int lower = std::max(1, 4 * storeys / 5);
  Pair pair({grid(storeys, bays, bays_y, 1.0), grid(lower, bays, bays_y, 1.7)}, [](int link) {
    return std::make_unique<GapContact<laws::LinearSpring>>(laws::LinearSpring{.stiffness = linear_stiffness}, 0.0,
                                                            link);
  });
  const Group& right = pair.system.groups[1];
  pair.system.load.middleRows(right.first, right.count) *= -1;
  constexpr double begin = 1, far = 1e4;
  pair.system.grounds = {GroundMotion(Samples{{0, far}, {0, -far}, true})};

  const Clock::time_point start = Clock::now();
  const std::unique_ptr<StructureSolver> base = petsc::make_solver(pair.system, base_kind(arguments), PETSC_COMM_WORLD);
  const Eigen::VectorXd pushed = static_answer(pair, *base);
  // They press from the start instead of touching simultaneously.
  const Eigen::VectorXd closing = pair.system.gap_jacobian.transpose() * pushed;
  for (std::size_t i = 0; i < pair.contacts.size(); ++i) {
    ContactMemory& memory = pair.system.initial_contacts.emplace_back(pair.contacts[i]->initial());
    if (closing[static_cast<Eigen::Index>(i)] > 0)
      pair.contacts[i]->on_event(
          memory, 0, begin, {begin * closing[static_cast<Eigen::Index>(i)], closing[static_cast<Eigen::Index>(i)]});
  }
  Stepper stepper(pair.system, *base, {.tolerance = 1e-4, .scheme = scheme(arguments), .max_step = space_step});
  stepper.start(begin, begin * pushed, pushed);
  Solve solve(stepper, far, space_step);
  StepClock clock;
  check(TSAdaptSetType(solve.adapt(), TSADAPTNONE));
  check(TSSetMaxSteps(solve.ts, steps + settling_steps));
  check(TSSetApplicationContext(solve.ts, &clock));
  check(TSSetPostStep(solve.ts, StepClock::after_step));
  check(TSSetFromOptions(solve.ts));
  const double setup = seconds_since(start);
  clock.last = Clock::now();
  check(TSSolve(solve.ts, nullptr));

  std::vector<double> solves;
  Eigen::VectorXd x = base->layout().load.col(0);
  for (int i = 0; i < 21; ++i) {
    const Clock::time_point before = Clock::now();
    base->solve(x);
    solves.push_back(seconds_since(before));
    x = base->layout().load.col(0);
  }
  const std::vector<double> timed(clock.seconds.begin() + settling_steps, clock.seconds.end());
  double total = 0;
  for (const double s : timed) total += s;
  const auto pressed =
      std::count_if(pair.contacts.begin(), pair.contacts.end(), [](const auto& c) { return presses(c->phase()); });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::array<double, 1> memory{static_cast<double>(usage.ru_maxrss) / 1024};
  MPI_Allreduce(MPI_IN_PLACE, memory.data(), 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  int ranks = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  return {{"unknowns", pair.system.size()},
          {"ranks", ranks},
          {"base", base->description()},
          {"links", pair.contacts.size()},
          {"links_in_contact", pressed},
          {"steps", timed.size()},
          {"events", stepper.view().events()},
          {"seconds_per_step", median(timed)},
          {"seconds_per_step_mean", total / static_cast<double>(timed.size())},
          {"seconds_per_solve", median(solves)},
          {"seconds_setup", setup},
          {"seconds_first_step", clock.seconds.front()},
          {"memory_mb", memory[0]}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> own{"--law",     "--tolerance", "--motion", "--integrator", "--base",
                                     "--storeys", "--bays",      "--bays-y", "--steps"};
  Words arguments;
  std::vector<std::string> options;
  for (int i = 2; i < argc; ++i) {
    if (std::find(own.begin(), own.end(), argv[i]) == own.end())
      options.emplace_back(argv[i]);
    else if (i + 1 < argc)
      arguments[argv[i]] = argv[i + 1], ++i;
  }
  const std::string kind = argc > 1 ? argv[1] : "";
  const petsc::Environment environment(options);
  try {
    if (kind != "plane" && kind != "space") throw std::invalid_argument("frames plane ..., or frames space ...");
    const nlohmann::json result = kind == "plane" ? plane(arguments) : space(arguments);
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0) std::cout << result.dump() << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "frames: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
