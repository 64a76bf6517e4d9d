#pragma once
/// Keys of `study:`. The Python package reads studies through these tables; the reader of models does not see them.

#include <span>

#include <pounding/input/words/word.hpp>

namespace pounding::words {

/// File of a study: studies.cpp.
extern const Section study_file;

/// Every section of a study, outer ones first; the first is the file.
std::span<const Section* const> sections_of_studies() noexcept;

}  // namespace pounding::words
