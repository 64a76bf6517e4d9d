#pragma once
/// Results file of a pushover.

#include <string>

#include <pounding/pushover/pushover.hpp>

namespace pounding {

/// Writes the group /pushover and the text of the model to a new file. Throws InputError as ReplacedFile.
void write_pushover(const std::string& path, const Pushover& found, const std::string& model_text);

}  // namespace pounding
