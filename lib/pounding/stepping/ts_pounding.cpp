#include <pounding/stepping/ts_pounding.hpp>

#include <petsc/private/tsimpl.h>

#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/vectors.hpp>
#include <pounding/petsc/version.hpp>
#include <pounding/stepping/step_controller.hpp>

namespace pounding::petsc {
namespace {

struct Data {
  std::optional<StepController> controller;
  Archive snapshot;         // of the beginning of the step, for a rollback
  bool keeps_step = false;  // take the snapshot even if the TS has no events
  bool lazy = false;        // write vectors only when PETSc reads them

  Stepper* stepper() { return controller ? &controller->stepper() : nullptr; }
};

Data& data_of(TS ts) { return *static_cast<Data*>(ts->data); }
MPI_Comm comm_of(TS ts) { return PetscObjectComm(reinterpret_cast<PetscObject>(ts)); }

// Keeps exceptions out of PETSc; check() rethrows what `body` throws.
template <class Body>
PetscErrorCode guarded(const Body& body) {
  try {
    return body();
  } catch (...) {
    return fail();
  }
}

// Type name that selects ErrorControl; PETSc never calls it.
PetscErrorCode create_adapt(TSAdapt) { return POUNDING_PETSC_SUCCESS; }

// ErrorControl, or the TSAdapt of the TS if another type is selected.
class TsPolicy final : public StepSizePolicy {
 public:
  TsPolicy(TS ts, const StepView& stepper)
      : ts_(ts),
        control_(stepper.options().max_step, ts->exact_final_time == TS_EXACTFINALTIME_MATCHSTEP
                                                 ? ts->max_time
                                                 : std::numeric_limits<double>::infinity()) {}
  bool fixed() const override { return adapts_by(TSADAPTNONE); }
  Verdict judge(const StepView& stepper, double step) override {
    if (adapts_by(ts_type)) return control_.judge(stepper, step);
    const LibraryLock lock;
    PetscBool accepted = PETSC_FALSE;
    PetscReal next = step;
    ts_->time_step = step;
    check(TSAdaptChoose(ts_->adapt, ts_, step, nullptr, &next, &accepted));
    return {accepted == PETSC_TRUE, next};
  }
  std::string on_reject() override {
    ts_->reject++;
    if (++rejected_ > ts_->max_reject && ts_->max_reject >= 0)
      return fmt::format("{} trial steps were rejected. Type a larger -pounding_ts_max_reject", rejected_);
    return {};
  }

 private:
  bool adapts_by(const char* type) const {
    return std::strcmp(reinterpret_cast<PetscObject>(ts_->adapt)->type_name, type) == 0;
  }

  TS ts_;
  ErrorControl control_;
  PetscInt rejected_ = 0;  // since the last accepted step
};

PetscErrorCode write_vectors(TS ts) {
  PetscFunctionBegin;
  const State& state = data_of(ts).stepper()->view().state();
  PetscCall(scatter(state.u, ts->vec_sol));
  PetscCall(scatter(state.v, ts->vec_dot));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// Makes one accepted step. May throw; the caller keeps exceptions out of PETSc.
PetscErrorCode advance(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  TsPolicy policy(ts, data.stepper()->view());
  {
    const LibraryLock::Released released;
    ts->time_step = data.controller->advance(ts->time_step, ts->max_time, policy);
  }
  ts->ptime = data.stepper()->view().time();
  const bool last = ts->ptime >= ts->max_time || ts->steps + 1 >= ts->max_steps;
  const bool looked_at = last || ts->numbermonitors > 0 || ts->event || ts->trajectory;
  if (!data.lazy || looked_at) PetscCall(write_vectors(ts));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode step(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscCheck(data.controller, comm_of(ts), PETSC_ERR_ORDER, "Call set_stepper() before TSSolve()");
  PetscFunctionReturn(guarded([&]() -> PetscErrorCode {
    if (ts->steprestart) {
      Eigen::VectorXd u(data.stepper()->view().system().size()), v(data.stepper()->view().system().size());
      PetscCall(gather(ts->vec_sol, u));
      PetscCall(gather(ts->vec_dot, v));
      data.stepper()->start(ts->ptime, u, v);
    }
    if (ts->event || data.keeps_step) {
      data.snapshot.rewind_for_writing();
      data.controller->archive(data.snapshot);
    }
    return advance(ts);
  }));
}

// Restores the beginning of the last step, including contacts.
PetscErrorCode roll_back(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscCheck(!data.snapshot.bytes().empty(), comm_of(ts), PETSC_ERR_ORDER,
             "Call set_rollback() before TSSolve() to enable TSRollBack()");
  PetscFunctionReturn(guarded([&] {
    data.snapshot.rewind_for_reading();
    data.controller->archive(data.snapshot);
    return write_vectors(ts);
  }));
}

PetscErrorCode evaluate_error(TS ts, NormType, PetscInt* order, PetscReal* ratio) {
  PetscFunctionBegin;
  if (order) *order = data_of(ts).stepper()->view().error_order();
  *ratio = data_of(ts).stepper()->view().error_ratio();
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode interpolate(TS ts, PetscReal time, Vec to) {
  PetscFunctionBegin;
  Eigen::VectorXd u, v;
  data_of(ts).stepper()->view().interpolate(time, u, v);
  PetscCall(scatter(u, to));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_up(TS ts) {
  PetscFunctionBegin;
  PetscCheck(ts->vec_sol && ts->vec_dot, comm_of(ts), PETSC_ERR_ORDER, "Call TS2SetSolution() first");
  PetscInt size = 0;
  PetscCall(VecGetSize(ts->vec_sol, &size));
  const Stepper* stepper = data_of(ts).stepper();
  PetscCheck(!stepper || size == stepper->view().system().size(), comm_of(ts), PETSC_ERR_ARG_SIZ,
             "The solution has %d entries, the system of the stepper %d", static_cast<int>(size),
             stepper->view().system().size());
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode view(TS ts, PetscViewer viewer) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscBool ascii = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(viewer), PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  if (!data.controller) PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  const StepView& stepper = data.stepper()->view();
  const StepperOptions& options = stepper.options();
  PetscCall(PetscViewerASCIIPrintf(viewer, "  scheme %s", std::string(options.scheme.name()).c_str()));
  if (options.scheme.kind == Scheme::Kind::generalized_alpha)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", spectral radius %g", options.scheme.spectral_radius));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n  %s\n  %d links, longest step %g s, tolerance %g, %ld events\n",
                                   stepper.base().description().c_str(), stepper.system().links(), options.max_step,
                                   options.tolerance, stepper.events()));
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
  ts->ops->view = view;
  ts->ops->destroy = destroy;
  ts->default_adapt_type = ts_type;
  ts->usessnes = PETSC_FALSE;
  ts->max_reject = -1;
  ts->data = new Data;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

}  // namespace

PetscErrorCode register_ts_pounding() {
  const LibraryLock lock;
  PetscFunctionBegin;
  PetscCall(TSRegister(ts_type, create));
  PetscCall(TSAdaptRegister(ts_type, create_adapt));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_stepper(TS ts, Stepper* stepper) {
  const LibraryLock lock;
  PetscFunctionBegin;
  Data& data = data_of(ts);
  data.controller.reset();
  if (stepper) data.controller.emplace(*stepper);
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_rollback(TS ts, PetscBool keep) {
  const LibraryLock lock;
  PetscFunctionBegin;
  data_of(ts).keeps_step = keep == PETSC_TRUE;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy) {
  const LibraryLock lock;
  PetscFunctionBegin;
  data_of(ts).lazy = lazy == PETSC_TRUE;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode archive(TS ts, Archive& state) {
  const LibraryLock lock;
  PetscFunctionBegin;
  PetscBool plain = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(ts->adapt), &plain, ts_type, TSADAPTBASIC,
                                      TSADAPTNONE, ""));
  if (!plain)
    PetscFunctionReturn(fail(std::make_exception_ptr(
        SolverError("only the TSAdapt types pounding, basic and none can resume from a saved state"))));
  PetscFunctionReturn(guarded([&] {
    state(ts->ptime);
    state(ts->time_step);
    state(ts->steps);
    state(ts->reject);
    state(ts->adapt->timestepjustdecreased);
    data_of(ts).controller->archive(state);
    if (!state.reading()) return static_cast<PetscErrorCode>(POUNDING_PETSC_SUCCESS);
    ts->steprestart = PETSC_FALSE;
    return write_vectors(ts);
  }));
}

}  // namespace pounding::petsc
