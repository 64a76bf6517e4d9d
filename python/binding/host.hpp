#pragma once
/// PETSc inside a Python process, which was there first.

#include <string>
#include <vector>

namespace pounding::python {

/// Starts PETSc and MPI, unless somebody has (mpi4py, petsc4py); once in a process. Signal handlers and environment variables
/// stay those of the host: programs that it starts afterwards, mpirun among them, inherit nothing.
void start_petsc();

/// Ends what start_petsc() started; PETSc cannot start again. MPI's end waits for every process: when this one of several
/// ends because it `failed`, and the others do not end soon too, it ends them.
void end_petsc(bool failed);

/// This process has failed while the others wait for it in the middle of a run: it cannot run anything, and its end is theirs.
void leave_the_others();

/// PETSc's options of one run: words of a command line. Gone afterwards.
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
