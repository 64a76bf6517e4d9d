#pragma once
/// Initialization of PETSc and SLEPc, their options, and their errors as exceptions.

#include <petscsys.h>

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/core/error.hpp>

namespace pounding::petsc {

/// Initializes PETSc (with MPI) and SLEPc unless the host program has done so, and finalizes only what it initialized.
/// A host that owns PETSc must finalize it after destroying this object. PETSc is initialized without its options files
/// (~/.petscrc, .petscrc and petscrc of the working directory); options come from `options` and the environment
/// variable PETSC_OPTIONS. None of this applies if the host initializes PETSc.
class Environment {
 public:
  /// `options`: command-line arguments as PETSc reads them ("-pounding_ts_rtol", "1e-6").
  explicit Environment(const std::vector<std::string>& options = {});
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// Options with the prefix `-pounding_` that were never read.
  static std::vector<std::string> unread_options();
  /// All options in effect with their values, sorted: "-log_view", "-pounding_ts_rtol 1e-6".
  static std::vector<std::string> all_options();
  /// Options with the prefix `-pounding_` and their current values, sorted: "-pounding_ts_rtol 1e-6". Excludes
  /// `-pounding_red_cache`, which changes only the run time.
  static std::vector<std::string> given_options();

 private:
  bool owns_petsc_ = false, owns_slepc_ = false;
};

/// True for an option name ("-log_view"), false for a value, including a negative number.
bool is_option_name(std::string_view word);

/// Throws SolverError with PETSc's error text if `code` is nonzero, or the exception that was passed to fail().
void check(PetscErrorCode code);

/// Error code for a PETSc callback that caught an exception. The check() around the outer PETSc call rethrows it.
PetscErrorCode fail(std::exception_ptr error = std::current_exception());

}  // namespace pounding::petsc
