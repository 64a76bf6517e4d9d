#pragma once
/// PETSc inside a running Python process.

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

/// Makes this process run models independently of other MPI processes, as workers of a study do. Throws
/// std::logic_error if PETSc already runs on all of them.
void run_alone();

/// Marks that only this process failed during a collective run: it can run no other model, and its end aborts the
/// others.
void leave_the_others();

/// Use of PETSc, whose options apply to the whole process. Runs without options share it and proceed in
/// parallel; a run with options uses it alone.
enum class PetscUse { shared, alone };

/// Permission of this thread to use PETSc, taken without the GIL. Under mpirun every use is PetscUse::alone.
class PetscForThisThread {
 public:
  /// Waits for other threads; an exception of a signal handler (Ctrl-C) ends the wait. Throws std::runtime_error if
  /// this thread already has the permission.
  explicit PetscForThisThread(PetscUse use = PetscUse::shared);
  ~PetscForThisThread();
  PetscForThisThread(const PetscForThisThread&) = delete;
  PetscForThisThread& operator=(const PetscForThisThread&) = delete;

 private:
  bool alone_;
};

/// PETSc options of one run, from command-line arguments; removed by the destructor.
class OptionsOfRun {
 public:
  /// Throws InputError for an argument without the prefix -pounding_.
  explicit OptionsOfRun(const std::vector<std::string>& words);
  ~OptionsOfRun();
  OptionsOfRun(const OptionsOfRun&) = delete;
  OptionsOfRun& operator=(const OptionsOfRun&) = delete;

 private:
  std::vector<std::string> names_;
};

}  // namespace pounding::python
