#pragma once
/// The state in a results file from which an interrupted run can be resumed.

#include <cstddef>
#include <string>
#include <vector>

namespace pounding {

/// The state between two steps, and everything that must be unchanged for bitwise identical resumption.
struct Checkpoint {
  std::string model_file;            ///< absolute path of the input; relative paths in the input refer to its directory
  std::vector<std::string> options;  ///< PETSc options that affect the results, sorted: "-pounding_ts_rtol 1e-6"
  std::string ground;                ///< checksum of the record's samples; empty for a closed-form motion
  std::vector<std::byte> state;      ///< stepper, TS and recorder of every process (Archive)
};

}  // namespace pounding
