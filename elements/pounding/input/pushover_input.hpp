#pragma once
/// A pushover as it is asked for in words, on the command line and in Python.

#include <string>

#include <pounding/model/model.hpp>
#include <pounding/pushover/pushover.hpp>

namespace pounding {

struct PushoverInput {
  std::string structure{};  ///< name; may be empty in a model in which one structure yields
  std::string load =
      "triangular";  ///< triangular, uniform, mode1, or a file with one force a floor, from the ground up, to any scale
  std::string direction = "x";  ///< x or y
  std::string to{};             ///< displacement of the roof: "250 mm", or "2 % roof" of its height
  std::string cyclic{};         ///< displacements that are reached before, parted by commas: "1 %, -1 %, 2 %"
  std::string mark = "--";      ///< that messages put in front of the names of options
};

/// Pushes a structure of a model. Throws InputError for words that cannot be read or do not fit the structure: it says
/// which one, what was read and what to type; SolverError with the name of the structure as push().
Pushover pushover(const Model& model, const PushoverInput& keys, const ModeSolver& modes = dense_modes);

}  // namespace pounding
