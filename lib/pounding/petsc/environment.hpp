#pragma once
/// Start and end of PETSc and SLEPc, their options, and their errors as exceptions.

#include <petscsys.h>

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/core/error.hpp>

namespace pounding::petsc {

/// Starts PETSc (with MPI) and SLEPc, each of them unless the host program has started it, and ends only what it
/// started. A host that owns PETSc must end it after this object. PETSc starts without its options files (~/.petscrc,
/// .petscrc and petscrc of the working folder); options come from `options` and from the environment variable
/// PETSC_OPTIONS. A host that starts PETSc decides for itself.
class Environment {
 public:
  /// `options`: words of a command line, as PETSc reads them ("-pounding_ts_rtol", "1e-6").
  explicit Environment(const std::vector<std::string>& options = {});
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// Options with the prefix `-pounding_` that nothing has read.
  static std::vector<std::string> unread_options();
  /// All options in force with their values, sorted: "-log_view", "-pounding_ts_rtol 1e-6".
  static std::vector<std::string> all_options();
  /// Options with the prefix `-pounding_` and their values as PETSc has them now, sorted: "-pounding_ts_rtol 1e-6". Not
  /// `-pounding_red_cache`, with which nothing changes but time.
  static std::vector<std::string> given_options();

 private:
  bool owns_petsc_ = false, owns_slepc_ = false;
};

/// True for the name of an option ("-log_view"), false for a value, which may be a negative number.
bool is_option_name(std::string_view word);

/// Throws SolverError with PETSc's own text if `code` is not zero, or the exception that was given to fail().
void check(PetscErrorCode code);

/// Error code for a PETSc callback that caught an exception. The check() of the outer PETSc call rethrows the
/// exception.
PetscErrorCode fail(std::exception_ptr error = std::current_exception());

}  // namespace pounding::petsc
