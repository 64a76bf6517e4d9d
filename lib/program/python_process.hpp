#pragma once
/// Pictures, animations and exports by Python, in a process of its own.

#include <string>
#include <vector>

namespace pounding::program {

struct PythonTask {
  std::string module;           ///< of the package pounding: "plots"
  std::string product;          ///< for messages: "no picture: ..."
  bool shows_progress = false;  ///< it takes --progress-to and writes a line there, when standard error is a terminal
};

/// Runs `python3 -m pounding.MODULE OPTIONS -- FILES` and waits for it. Throws InputError with what it said when it fails,
/// and with what to install when Python or its packages are missing.
void run_python(const PythonTask& task, const std::vector<std::string>& options, const std::vector<std::string>& files);

}  // namespace pounding::program
