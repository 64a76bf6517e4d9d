#include <pounding/stepping/ts_pounding.hpp>

#include <petsc/private/tsimpl.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding::petsc {
namespace {

// Phases that end one after the other without time passing: more than this is a fault, not a contact.
constexpr int max_crossings_at_one_time = 10000;
// Time passes when a step is longer than this part of the time.
constexpr double no_time = 1e-13;
// A first contact is met with this part of the step that was right before it.
constexpr double first_contact_part = 0.1;
// A step may be stretched by this part to reach a corner, rather than leave a sliver for the next one.
constexpr double longest_stretch = 1e-3;

struct Data {
  Stepper* stepper = nullptr;
  SolverOptions choice;
  double step_apart = 0;    // last good step while no contact presses [s]
  double step_pressed = 0;  // and while one does
  int crossings = 0;        // without time passing
  Archive snapshot;         // of the beginning of the step, while somebody may roll it back
  bool keeps_step = false;  // though there is no event
  bool lazy = false;        // vectors are written where PETSc looks at them
};

void archive(Data& data, Archive& archive) {
  archive(data.step_apart);
  archive(data.step_pressed);
  archive(data.crossings);
  data.stepper->archive(archive);
}

Data& data_of(TS ts) { return *static_cast<Data*>(ts->data); }

// A trial that ends at the next corner of the ground motion or at the end of the run knows its time exactly.
struct Aim {
  double step;
  std::optional<double> end;
};

Aim aim(TS ts, const Stepper& stepper, double wanted, bool ladder) {
  const double now = stepper.time();
  const double target = std::min<double>(stepper.next_break(), ts->max_time);
  const double left = target - now;
  const double step = ladder ? stepper.step_towards(wanted, left) : wanted;
  if (left > wanted * (1 + longest_stretch) && left > step * (1 + 1e-9)) return {step, std::nullopt};
  return {std::abs(left - step) <= 1e-9 * step ? step : left, target};
}

[[noreturn]] void give_up(const Stepper& stepper, double step, const std::string& reason) {
  const int link = stepper.troublesome_link();
  const std::vector<std::string>& names = stepper.system().names;
  std::string place;
  if (link >= 0) place = link < static_cast<int>(names.size()) ? " at link " + names[link] : fmt::format(" at link {}", link + 1);
  throw SolverError(fmt::format("the solve stopped at t = {:.9g} s{} with a step of {:.3g} s: {}", stepper.time(), place, step,
                                reason));
}

void check_step(const Stepper& stepper, double step) {
  const double least = 1e-14 * std::max(1.0, std::abs(stepper.time())) * 1e-2;
  if (!(step > least))
    give_up(stepper, step,
            fmt::format("no step is short enough for the tolerance {:g}. Check the unit of the stiffness of the link, or type a "
                        "larger analysis.tolerance",
                        stepper.options().tolerance));
}

// All entries, on every process.
PetscErrorCode copy(Vec from, Eigen::VectorXd& to) {
  const PetscScalar* values = nullptr;
  const PetscInt* ranges = nullptr;
  PetscMPIInt processes = 0;
  PetscFunctionBegin;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(from));
  PetscCallMPI(MPI_Comm_size(comm, &processes));
  PetscCall(VecGetOwnershipRanges(from, &ranges));
  std::vector<PetscMPIInt> counts(processes), first(processes);
  for (int p = 0; p < processes; ++p) {
    first[p] = static_cast<PetscMPIInt>(ranges[p]);
    counts[p] = static_cast<PetscMPIInt>(ranges[p + 1] - ranges[p]);
  }
  PetscInt own = 0;
  PetscCall(VecGetLocalSize(from, &own));
  PetscCall(VecGetArrayRead(from, &values));
  PetscCallMPI(MPI_Allgatherv(values, static_cast<PetscMPIInt>(own), MPIU_SCALAR, to.data(), counts.data(), first.data(), MPIU_SCALAR,
                              comm));
  PetscCall(VecRestoreArrayRead(from, &values));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode copy(const Eigen::VectorXd& from, Vec to) {
  PetscScalar* values = nullptr;
  PetscFunctionBegin;
  PetscInt first = 0, end = 0;
  PetscCall(VecGetOwnershipRange(to, &first, &end));
  PetscCall(VecGetArrayWrite(to, &values));
  std::copy_n(from.data() + first, end - first, values);
  PetscCall(VecRestoreArrayWrite(to, &values));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode write_vectors(TS ts) {
  PetscFunctionBegin;
  const State& state = data_of(ts).stepper->state();
  PetscCall(copy(state.u, ts->vec_sol));
  PetscCall(copy(state.v, ts->vec_dot));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// One kept step. `stepper` throws; the caller keeps exceptions out of PETSc.
PetscErrorCode advance(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  Stepper& stepper = *data.stepper;
  PetscBool fixed = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ts->adapt), TSADAPTNONE, &fixed));
  double wanted = ts->time_step;
  const auto cross = [&](double step) {
    if (++data.crossings > max_crossings_at_one_time)
      give_up(stepper, step, "a contact opens and closes without end. Type another analysis.tolerance, or a gap that is not "
                             "closed at rest");
  };
  PetscInt rejected = 0;
  const auto reject = [&](double step) {
    ts->reject++;
    if (++rejected > ts->max_reject && ts->max_reject >= 0)
      give_up(stepper, step, fmt::format("{} trial steps were rejected. Type a larger -pounding_ts_max_reject", rejected));
  };
  for (;;) {
    const Aim goal = aim(ts, stepper, wanted, !fixed);
    check_step(stepper, goal.step);
    if (!stepper.try_step(goal.step, goal.end)) {
      reject(goal.step);
      wanted = goal.step / 4;
      continue;
    }
    PetscBool accepted = PETSC_FALSE;
    PetscReal next = goal.step;
    ts->time_step = goal.step;
    PetscCall(TSAdaptChoose(ts->adapt, ts, goal.step, nullptr, &next, &accepted));
    if (!accepted) {
      reject(goal.step);
      wanted = std::min<double>(next, goal.step / 2);
      continue;
    }
    // A short step to a corner says nothing against the longer one that was wanted.
    const double good = goal.end ? std::max<double>(next, wanted) : next;
    const bool was_pressed = stepper.in_contact();
    const std::optional<double> landed = stepper.locate_event();
    if (landed && *landed == 0) {
      cross(goal.step);
      stepper.apply_event();
      continue;
    }
    // A long trial may step over a whole press and see nothing of it, and end inside it when it is shortened.
    if (landed && !fixed && !(stepper.error_ratio() <= 1)) {
      reject(*landed);
      wanted = *landed / 2;
      continue;
    }
    if (landed && *landed < no_time * std::max(1.0, stepper.time()))
      cross(*landed);
    else
      data.crossings = 0;
    stepper.accept();
    (was_pressed ? data.step_pressed : data.step_apart) = good;
    const bool pressed = stepper.in_contact();
    double following = pressed ? data.step_pressed : data.step_apart;
    if (following == 0) following = pressed ? good * first_contact_part : good;
    ts->time_step = fixed ? wanted : following;
    break;
  }
  ts->ptime = stepper.time();
  const bool last = ts->ptime >= ts->max_time || ts->steps + 1 >= ts->max_steps;
  const bool looked_at = last || ts->numbermonitors > 0 || ts->event || ts->trajectory;
  if (!data.lazy || looked_at) PetscCall(write_vectors(ts));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode step(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscCheck(data.stepper, PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ORDER,
             "Call set_stepper() before TSSolve()");
  std::string failure;
  try {
    if (ts->steprestart) {
      Eigen::VectorXd u(data.stepper->system().size()), v(data.stepper->system().size());
      PetscCall(copy(ts->vec_sol, u));
      PetscCall(copy(ts->vec_dot, v));
      data.stepper->start(ts->ptime, u, v);
    }
    if (ts->event || data.keeps_step) {
      data.snapshot.rewind_for_writing();
      archive(data, data.snapshot);
    }
    PetscCall(advance(ts));
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (!failure.empty()) PetscFunctionReturn(fail(failure));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// Back to the beginning of the last step, contacts included.
PetscErrorCode roll_back(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscCheck(!data.snapshot.bytes().empty(), PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ORDER,
             "Call set_rollback() before TSSolve() to keep the beginning of every step");
  std::string failure;
  try {
    data.snapshot.rewind_for_reading();
    archive(data, data.snapshot);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (!failure.empty()) PetscFunctionReturn(fail(failure));
  PetscCall(write_vectors(ts));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode evaluate_error(TS ts, NormType, PetscInt* order, PetscReal* ratio) {
  PetscFunctionBegin;
  if (order) *order = data_of(ts).stepper->error_order();
  *ratio = data_of(ts).stepper->error_ratio();
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode interpolate(TS ts, PetscReal time, Vec to) {
  PetscFunctionBegin;
  Eigen::VectorXd u, v;
  data_of(ts).stepper->interpolate(time, u, v);
  PetscCall(copy(u, to));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_up(TS ts) {
  PetscFunctionBegin;
  PetscCheck(ts->vec_sol && ts->vec_dot, PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ORDER,
             "Call TS2SetSolution() first");
  PetscInt size = 0;
  PetscCall(VecGetSize(ts->vec_sol, &size));
  const Stepper* stepper = data_of(ts).stepper;
  PetscCheck(!stepper || size == stepper->system().size(), PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ARG_SIZ,
             "The solution has %d entries, the system of the stepper %d", static_cast<int>(size), stepper->system().size());
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_from_options(TS ts, OptionItems PetscOptionsObject) {
  static const char* const schemes[] = {Scheme::names[0].data(), Scheme::names[1].data()};
  static const char* const bases[] = {"automatic", "modal", "sparse"};
  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "Steps with condensed links");
  SolverOptions choice = data_of(ts).choice;
  PetscInt scheme = static_cast<PetscInt>(choice.scheme.kind), base = static_cast<PetscInt>(choice.solver);
  PetscReal radius = choice.scheme.spectral_radius;
  PetscBool radius_given = PETSC_FALSE;
  PetscCall(PetscOptionsEList("-ts_pounding_scheme", "Time-stepping scheme", "set_solver_options", schemes, 2, schemes[scheme],
                              &scheme, nullptr));
  PetscCall(PetscOptionsReal("-ts_pounding_radius", "Spectral radius at infinite frequency", "set_solver_options", radius, &radius,
                             &radius_given));
  PetscCall(PetscOptionsEList("-ts_pounding_base", "How structures are solved", "set_solver_options", bases, 3, bases[base], &base,
                              nullptr));
  choice.scheme.kind = static_cast<Scheme::Kind>(scheme);
  choice.scheme.spectral_radius = radius;
  choice.solver = static_cast<SolverKind>(base);
  PetscCheck(!radius_given || choice.scheme.kind == Scheme::Kind::generalized_alpha,
             PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ARG_INCOMP,
             "-ts_pounding_radius belongs to -ts_pounding_scheme generalized_alpha");
  PetscCall(set_solver_options(ts, choice));
  PetscOptionsHeadEnd();
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode view(TS ts, PetscViewer viewer) {
  PetscFunctionBegin;
  const Data& data = data_of(ts);
  PetscBool ascii = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(viewer), PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  scheme %s", std::string(data.choice.scheme.name()).c_str()));
  if (data.choice.scheme.kind == Scheme::Kind::generalized_alpha)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", spectral radius %g", data.choice.scheme.spectral_radius));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  if (data.stepper)
    PetscCall(PetscViewerASCIIPrintf(
        viewer, "  %s\n  %d links, longest step %g s, tolerance %g, %ld events\n",
        data.stepper->base().description().c_str(), data.stepper->system().links(), data.stepper->options().max_step,
        data.stepper->options().tolerance, data.stepper->events()));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode destroy(TS ts) {
  PetscFunctionBegin;
  delete static_cast<Data*>(ts->data);
  ts->data = nullptr;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode create(TS ts) {
  PetscFunctionBegin;
  ts->ops->setup = set_up;
  ts->ops->step = step;
  ts->ops->evaluatewlte = evaluate_error;
  ts->ops->interpolate = interpolate;
  ts->ops->rollback = roll_back;
  ts->ops->setfromoptions = set_from_options;
  ts->ops->view = view;
  ts->ops->destroy = destroy;
  ts->default_adapt_type = TSADAPTBASIC;
  ts->usessnes = PETSC_FALSE;
  ts->max_reject = -1;
  ts->data = new Data;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

}  // namespace

PetscErrorCode register_ts_pounding() {
  PetscFunctionBegin;
  PetscCall(TSRegister(ts_type, create));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_solver_options(TS ts, const SolverOptions& choice) {
  PetscFunctionBegin;
  PetscCheck(choice.scheme.spectral_radius >= 0 && choice.scheme.spectral_radius <= 1,
             PetscObjectComm(reinterpret_cast<PetscObject>(ts)), PETSC_ERR_ARG_OUTOFRANGE,
             "The spectral radius must lie in [0, 1], not %g", choice.scheme.spectral_radius);
  data_of(ts).choice = choice;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode get_solver_options(TS ts, SolverOptions* choice) {
  PetscFunctionBegin;
  *choice = data_of(ts).choice;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_stepper(TS ts, Stepper* stepper) {
  PetscFunctionBegin;
  data_of(ts).stepper = stepper;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_rollback(TS ts, PetscBool keep) {
  PetscFunctionBegin;
  data_of(ts).keeps_step = keep == PETSC_TRUE;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy) {
  PetscFunctionBegin;
  data_of(ts).lazy = lazy == PETSC_TRUE;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode archive(TS ts, Archive& state) {
  PetscFunctionBegin;
  PetscBool plain = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(ts->adapt), &plain, TSADAPTBASIC, TSADAPTNONE, ""));
  if (!plain) PetscFunctionReturn(fail("only the adapt types basic and none can go on from a saved state"));
  std::string failure;
  try {
    state(ts->ptime);
    state(ts->time_step);
    state(ts->steps);
    state(ts->reject);
    state(ts->adapt->timestepjustdecreased);
    archive(data_of(ts), state);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (!failure.empty()) PetscFunctionReturn(fail(failure));
  if (!state.reading()) PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  PetscCall(write_vectors(ts));
  ts->steprestart = PETSC_FALSE;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

}  // namespace pounding::petsc
