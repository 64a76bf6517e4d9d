#pragma once
/// The results file of a pushover.

#include <string>

#include <pounding/pushover/pushover.hpp>

namespace pounding {

/// Writes the group /pushover of a file of its own, with the text of the model beside it. Throws InputError as
/// ReplacedFile.
void write_pushover(const std::string& path, const Pushover& found, const std::string& model_text);

}  // namespace pounding
