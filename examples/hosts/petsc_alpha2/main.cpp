// Two oscillators of examples/02 in a separate PETSc program: a GapLink in its TSALPHA2, on its communicator.
//   petsc_alpha2 [-steps 30000]     prints the peak displacements [m], the peak force [N] and the number of impacts
// Every TS, SNES and KSP option works: -ts_monitor, -snes_monitor, -ts_alpha_radius 0.9 ...
#include <petscts.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pounding/links.hpp>

namespace laws = pounding::laws;
using pounding::LinkMotion, pounding::LinkStep;
using std::numbers::pi;

struct Oscillators {
  pounding::GapLink<pounding::laws::Jankowski> link{{.stiffness = 2.75e9, .restitution = 0.65, .reduced_mass = 6e4},
                                                    0.02};
  double mass[2] = {1e5, 1.5e5}, stiffness[2], damping[2];  // [kg], [N/m], [N s/m]
  double peak[2] = {0, 0};                                  // [m]
  LinkMotion motion{link.penetration(0), 0};                // at the last kept state, with its time and acceleration
  double time = 0, acceleration = 0;

  Oscillators() {
    const double frequency[] = {2 * pi / 0.8, 2 * pi / 0.4};
    for (int i = 0; i < 2; ++i) {
      stiffness[i] = mass[i] * frequency[i] * frequency[i];
      damping[i] = 2 * 0.05 * mass[i] * frequency[i];
    }
  }
  LinkMotion motion_of(const double* u, const double* v) const { return {link.penetration(u[0] - u[1]), v[0] - v[1]}; }
};

// M a + C v + K u + B F + M r ag = 0.
static PetscErrorCode residual(TS, PetscReal t, Vec U, Vec V, Vec A, Vec R, void* context) {
  const Oscillators& o = *static_cast<Oscillators*>(context);
  const PetscScalar *u, *v, *a;
  PetscScalar* r;
  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(V, &v));
  PetscCall(VecGetArrayRead(A, &a));
  PetscCall(VecGetArrayWrite(R, &r));
  const double force = o.link.evaluate(o.motion_of(u, v)).force, ground = 3 * std::sin(2 * pi * t / 0.6);
  for (int i = 0; i < 2; ++i)
    r[i] = o.mass[i] * (a[i] + ground) + o.damping[i] * v[i] + o.stiffness[i] * u[i] + (i == 0 ? force : -force);
  PetscCall(VecRestoreArrayWrite(R, &r));
  PetscCall(VecRestoreArrayRead(A, &a));
  PetscCall(VecRestoreArrayRead(V, &v));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscFunctionReturn(0);
}

static PetscErrorCode jacobian(TS, PetscReal, Vec U, Vec V, Vec, PetscReal shift_v, PetscReal shift_a, Mat J, Mat,
                               void* context) {
  const Oscillators& o = *static_cast<Oscillators*>(context);
  const PetscScalar *u, *v;
  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(V, &v));
  const laws::Response f = o.link.evaluate(o.motion_of(u, v));
  const double slope = f.by_penetration + shift_v * f.by_rate;
  for (int i = 0; i < 2; ++i) {
    const double own = shift_a * o.mass[i] + shift_v * o.damping[i] + o.stiffness[i];
    PetscCall(MatSetValue(J, i, i, own + slope, INSERT_VALUES));
    PetscCall(MatSetValue(J, i, 1 - i, -slope, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscCall(VecRestoreArrayRead(V, &v));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscFunctionReturn(0);
}

// The link moves on at kept steps only: it keeps the step, and enters the phase that the end of the step lies in.
static PetscErrorCode after_step(TS ts) {
  Oscillators* o;
  PetscReal t;
  Vec U, V;
  const PetscScalar *u, *v;
  PetscFunctionBegin;
  PetscCall(TSGetApplicationContext(ts, &o));
  PetscCall(TSGetTime(ts, &t));
  PetscCall(TS2GetSolution(ts, &U, &V));
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(V, &v));

  LinkStep step;
  step.begin = o->time, step.end = t;
  step.motion_begin = o->motion, step.motion_end = o->motion_of(u, v);
  const double ground = 3 * std::sin(2 * pi * t / 0.6);
  step.force_begin = o->link.evaluate(step.motion_begin).force;
  step.force_end = o->link.evaluate(step.motion_end).force;
  double a[2];
  for (int i = 0; i < 2; ++i)
    a[i] = -ground - (o->damping[i] * v[i] + o->stiffness[i] * u[i] + (i == 0 ? 1 : -1) * step.force_end) / o->mass[i];
  step.acceleration_begin = o->acceleration;
  step.acceleration_end = a[0] - a[1];
  step.motion_middle = interpolate(step, 0.5);
  step.force_middle = o->link.evaluate(step.motion_middle).force;

  o->link.accept(step);
  const auto values = o->link.event_functions(step.motion_end, step.force_end);
  const auto ended = std::find_if(values.begin(), values.end(), [](double value) { return value < 0; });
  if (ended != values.end()) o->link.on_event(static_cast<int>(ended - values.begin()), t, step.motion_end);

  for (int i = 0; i < 2; ++i) o->peak[i] = std::max(o->peak[i], std::abs(u[i]));
  o->time = t, o->motion = step.motion_end, o->acceleration = step.acceleration_end;
  PetscCall(VecRestoreArrayRead(V, &v));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscFunctionReturn(0);
}

int main(int argc, char** argv) {
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
  MPI_Comm comm;
  PetscCallMPI(MPI_Comm_dup(PETSC_COMM_SELF, &comm));
  PetscInt steps = 30000;
  PetscCall(PetscOptionsGetInt(nullptr, nullptr, "-steps", &steps, nullptr));

  Oscillators oscillators;
  Vec u, v;
  Mat j;
  TS ts;
  SNES snes;
  PetscCall(VecCreateSeq(comm, 2, &u));
  PetscCall(VecDuplicate(u, &v));
  PetscCall(MatCreateSeqDense(comm, 2, 2, nullptr, &j));
  PetscCall(TSCreate(comm, &ts));
  PetscCall(TSSetType(ts, TSALPHA2));
  PetscCall(TSAlpha2SetRadius(ts, 1));
  PetscCall(TS2SetSolution(ts, u, v));
  PetscCall(TSSetI2Function(ts, nullptr, residual, &oscillators));
  PetscCall(TSSetI2Jacobian(ts, j, j, jacobian, &oscillators));
  PetscCall(TSSetApplicationContext(ts, &oscillators));
  PetscCall(TSSetPostStep(ts, after_step));
  PetscCall(TSSetMaxTime(ts, 3));
  PetscCall(TSSetTimeStep(ts, 3.0 / steps));
  PetscCall(TSSetMaxSteps(ts, PETSC_MAX_INT));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, 1e-11, 1e-14, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TSSetFromOptions(ts));
  PetscCall(TSSolve(ts, nullptr));

  double peak_force = 0;
  for (const pounding::ImpactRow& row : oscillators.link.impacts()) peak_force = std::max(peak_force, row.peak_force);
  PetscCall(PetscPrintf(comm, "%.9f %.9f %.3f %d\n", oscillators.peak[0], oscillators.peak[1], peak_force,
                        static_cast<int>(oscillators.link.impacts().size())));
  PetscCall(TSDestroy(&ts));
  PetscCall(MatDestroy(&j));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&u));
  PetscCallMPI(MPI_Comm_free(&comm));
  PetscCall(PetscFinalize());
  return 0;
}
