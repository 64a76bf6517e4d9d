#include <pounding/stepping/ts_pounding.hpp>

#include <petsc/private/tsimpl.h>

#include <cstring>
#include <exception>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/vectors.hpp>
#include <pounding/petsc/version.hpp>
#include <pounding/stepping/step_controller.hpp>

namespace pounding::petsc {
namespace {

struct Data {
  std::optional<StepController> controller;
  SolverOptions options;
  Archive snapshot;         // of the beginning of the step, in case somebody rolls it back
  bool keeps_step = false;  // takes the snapshot even if the TS has no event
  bool lazy = false;        // vectors are written only where PETSc looks at them

  Stepper* stepper() { return controller ? &controller->stepper() : nullptr; }
};

Data& data_of(TS ts) { return *static_cast<Data*>(ts->data); }
MPI_Comm comm_of(TS ts) { return PetscObjectComm(reinterpret_cast<PetscObject>(ts)); }

// Keeps exceptions out of PETSc: check() rethrows what `body` throws.
template <class Body>
PetscErrorCode guarded(const Body& body) {
  try {
    return body();
  } catch (...) {
    return fail();
  }
}

// The TSAdapt of a TS as a policy.
class AdaptPolicy final : public StepSizePolicy {
 public:
  AdaptPolicy(TS ts, bool fixed) : ts_(ts), fixed_(fixed) {}
  bool fixed() const override { return fixed_; }
  Verdict judge(const Stepper&, double step) override {
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
  TS ts_;
  bool fixed_;
  PetscInt rejected_ = 0;  // since the last kept step
};

PetscErrorCode write_vectors(TS ts) {
  PetscFunctionBegin;
  const State& state = data_of(ts).stepper()->state();
  PetscCall(scatter(state.u, ts->vec_sol));
  PetscCall(scatter(state.v, ts->vec_dot));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

// One kept step. The controller throws; the caller keeps exceptions out of PETSc.
PetscErrorCode advance(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  TSAdaptType type = nullptr;
  PetscCall(TSAdaptGetType(ts->adapt, &type));
  AdaptPolicy policy(ts, type && std::strcmp(type, TSADAPTNONE) == 0);
  ts->time_step = data.controller->advance(ts->time_step, ts->max_time, policy);
  ts->ptime = data.stepper()->time();
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
      Eigen::VectorXd u(data.stepper()->system().size()), v(data.stepper()->system().size());
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

// Back to the beginning of the last step, contacts included.
PetscErrorCode roll_back(TS ts) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscCheck(!data.snapshot.bytes().empty(), comm_of(ts), PETSC_ERR_ORDER,
             "Call set_rollback() before TSSolve() to keep the beginning of every step");
  PetscFunctionReturn(guarded([&] {
    data.snapshot.rewind_for_reading();
    data.controller->archive(data.snapshot);
    return write_vectors(ts);
  }));
}

PetscErrorCode evaluate_error(TS ts, NormType, PetscInt* order, PetscReal* ratio) {
  PetscFunctionBegin;
  if (order) *order = data_of(ts).stepper()->error_order();
  *ratio = data_of(ts).stepper()->error_ratio();
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode interpolate(TS ts, PetscReal time, Vec to) {
  PetscFunctionBegin;
  Eigen::VectorXd u, v;
  data_of(ts).stepper()->interpolate(time, u, v);
  PetscCall(scatter(u, to));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_up(TS ts) {
  PetscFunctionBegin;
  PetscCheck(ts->vec_sol && ts->vec_dot, comm_of(ts), PETSC_ERR_ORDER, "Call TS2SetSolution() first");
  PetscInt size = 0;
  PetscCall(VecGetSize(ts->vec_sol, &size));
  const Stepper* stepper = data_of(ts).stepper();
  PetscCheck(!stepper || size == stepper->system().size(), comm_of(ts), PETSC_ERR_ARG_SIZ,
             "The solution has %d entries, the system of the stepper %d", static_cast<int>(size),
             stepper->system().size());
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_from_options(TS ts, OptionItems PetscOptionsObject) {
  static const char* const schemes[] = {Scheme::names[0].data(), Scheme::names[1].data()};
  static const char* const bases[] = {"automatic", "modal", "sparse"};
  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "Steps with condensed links");
  SolverOptions options = data_of(ts).options;
  PetscInt scheme = static_cast<PetscInt>(options.scheme.kind), base = static_cast<PetscInt>(options.solver);
  PetscReal radius = options.scheme.spectral_radius;
  PetscBool radius_given = PETSC_FALSE;
  PetscCall(PetscOptionsEList("-ts_pounding_scheme", "Time-stepping scheme", "set_solver_options", schemes, 2,
                              schemes[scheme], &scheme, nullptr));
  PetscCall(PetscOptionsReal("-ts_pounding_radius", "Spectral radius at infinite frequency", "set_solver_options",
                             radius, &radius, &radius_given));
  PetscCall(PetscOptionsEList("-ts_pounding_base", "How structures are solved", "set_solver_options", bases, 3,
                              bases[base], &base, nullptr));
  options.scheme.kind = static_cast<Scheme::Kind>(scheme);
  options.scheme.spectral_radius = radius;
  options.solver = static_cast<SolverKind>(base);
  PetscCheck(!radius_given || options.scheme.kind == Scheme::Kind::generalized_alpha, comm_of(ts), PETSC_ERR_ARG_INCOMP,
             "-ts_pounding_radius belongs to -ts_pounding_scheme generalized_alpha");
  PetscCall(set_solver_options(ts, options));
  PetscOptionsHeadEnd();
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode view(TS ts, PetscViewer viewer) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  PetscBool ascii = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(viewer), PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  scheme %s", std::string(data.options.scheme.name()).c_str()));
  if (data.options.scheme.kind == Scheme::Kind::generalized_alpha)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", spectral radius %g", data.options.scheme.spectral_radius));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  if (data.controller)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s\n  %d links, longest step %g s, tolerance %g, %ld events\n",
                                     data.stepper()->base().description().c_str(), data.stepper()->system().links(),
                                     data.stepper()->options().max_step, data.stepper()->options().tolerance,
                                     data.stepper()->events()));
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

PetscErrorCode set_solver_options(TS ts, const SolverOptions& options) {
  PetscFunctionBegin;
  PetscCheck(options.scheme.spectral_radius >= 0 && options.scheme.spectral_radius <= 1, comm_of(ts),
             PETSC_ERR_ARG_OUTOFRANGE, "The spectral radius must lie in [0, 1], not %g",
             options.scheme.spectral_radius);
  data_of(ts).options = options;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode get_solver_options(TS ts, SolverOptions* options) {
  PetscFunctionBegin;
  *options = data_of(ts).options;
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

PetscErrorCode set_stepper(TS ts, Stepper* stepper) {
  PetscFunctionBegin;
  Data& data = data_of(ts);
  data.controller.reset();
  if (stepper) data.controller.emplace(*stepper);
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
  if (!plain)
    PetscFunctionReturn(
        fail(std::make_exception_ptr(SolverError("only the adapt types basic and none can go on from a saved state"))));
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
