#pragma once
/// The state in a results file from which an interrupted run goes on.

#include <cstddef>
#include <string>
#include <vector>

namespace pounding {

/// The state between two steps, and everything that must be the same for the run to continue with the same bits.
struct Checkpoint {
  std::string model_file;            ///< absolute path of the input; relative paths in the input start from its folder
  std::vector<std::string> options;  ///< PETSc options that change the results, sorted: "-pounding_ts_rtol 1e-6"
  std::string ground;                ///< checksum of the record's samples; empty for a closed form
  std::vector<std::byte> state;      ///< stepper, TS and recorder of every process (Archive)
};

}  // namespace pounding
