#pragma once
/// PETSc inside a Python process, which was there first.

#include <string>
#include <vector>

namespace pounding::python {

/// Starts PETSc and MPI, unless somebody has (mpi4py, petsc4py); once in a process. Signal handlers and environment variables
/// stay those of the host: programs that it starts afterwards, mpirun among them, inherit nothing.
void start_petsc();

/// Ends what start_petsc() started; PETSc cannot start again.
void end_petsc();

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
