#pragma once
/// A pushover analysis as typed on the command line or in Python.

#include <string>

#include <pounding/model/model.hpp>
#include <pounding/pushover/pushover.hpp>

namespace pounding {

struct PushoverInput {
  std::string structure{};          ///< name; may be empty if exactly one structure of the model yields
  std::string load = "triangular";  ///< triangular, uniform, mode1, or a file with one force per floor from the ground
                                    ///< up, to any scale
  std::string direction = "x";      ///< x or y
  std::string to{};                 ///< roof displacement: "250 mm", or "2 % roof" of its height
  std::string cyclic{};             ///< preceding displacements, separated by commas: "1 %, -1 %, 2 %"
  std::string mark = "--";          ///< prefix of option names in messages
};

/// Runs a pushover analysis of one structure of the model. Throws InputError for arguments that cannot be read or do
/// not suit the structure, SolverError if the analysis fails.
Pushover pushover(const Model& model, const PushoverInput& keys, const ModeSolver& modes = dense_modes);

}  // namespace pounding
