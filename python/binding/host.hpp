#pragma once
/// PETSc inside a Python process, which runs already.

#include <string>
#include <vector>

namespace pounding::python {

/// Starts PETSc and MPI, unless mpi4py or petsc4py has; once in a process. Signal handlers and environment variables of
/// the host stay as they are: programs that it starts afterwards, mpirun among them, inherit nothing. Throws
/// SolverError when PETSc has ended or an earlier run failed in this process alone.
void start_petsc();

/// Ends PETSc, and MPI if start_petsc() started it; PETSc cannot start again. MPI_Finalize waits for every process:
/// when this process has `failed` and the others do not end soon too, it aborts them.
void end_petsc(bool failed);

/// Makes this process run its models by itself, also where MPI has started others beside it, as the workers of a study
/// are. Throws std::logic_error when PETSc runs already for all of them.
void run_alone();

/// Notes that this process failed alone in the middle of a run, where the others wait for it: it runs no other model,
/// and its end aborts the others.
void leave_the_others();

/// Holds PETSc for this thread, which does not hold the interpreter meanwhile: a process has one PETSc with one table
/// of options, so one thread at a time may use it.
class PetscForThisThread {
 public:
  /// Waits for other threads; a signal handler that raises (Ctrl-C) ends the wait by its exception. Throws
  /// std::runtime_error in a thread that has PETSc already, which would wait for itself.
  PetscForThisThread();
  ~PetscForThisThread();
  /// Whether this thread has PETSc.
  static bool holds();
  PetscForThisThread(const PetscForThisThread&) = delete;
  PetscForThisThread& operator=(const PetscForThisThread&) = delete;
};

/// PETSc's options of one run, given as words of a command line; removed by the destructor.
class OptionsOfRun {
 public:
  /// Throws InputError for a word that is no option with the prefix -pounding_.
  explicit OptionsOfRun(const std::vector<std::string>& words);
  ~OptionsOfRun();
  OptionsOfRun(const OptionsOfRun&) = delete;
  OptionsOfRun& operator=(const OptionsOfRun&) = delete;

 private:
  std::vector<std::string> names_;
};

}  // namespace pounding::python
