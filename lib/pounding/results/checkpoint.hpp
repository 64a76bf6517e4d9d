#pragma once
/// The state in a results file from which an interrupted run goes on.

#include <cstddef>
#include <string>
#include <vector>

namespace pounding {

/// The state between two steps, and what must be the same for the same bits to follow.
struct Checkpoint {
  std::string model_file;            ///< of the input, absolute; relative paths in it start from its folder
  std::vector<std::string> options;  ///< PETSc's that the result depends on, sorted: "-pounding_ts_rtol 1e-6"
  std::string ground;                ///< checksum of the record's samples; empty for a closed form
  std::vector<std::byte> state;      ///< stepper, TS and recorder (Archive)
};

/// Checksum of a checkpoint and of the input beside it, by which damage is found when it is read.
std::string checksum_of(const Checkpoint& checkpoint, const std::string& model_yaml, const std::string& resolved_yaml);

}  // namespace pounding
