#pragma once
/// Keys of `study:` and of suites of records. The Python package reads studies through these tables; the reader of
/// models does not see them.

#include <span>
#include <string_view>

#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

namespace study_tables {

inline constexpr std::string_view since = "0.2.0";
/// Records and intensity: study_records.cpp; rules of codes: study_separation.cpp; the others: studies.cpp.
extern const Section study, factor, uniform, normal, lognormal, triangular, discrete, sampling, records, files_by_axis,
    files_of_axis, artificial, intensity, separation, behaviour;
/// Records of a suite and their scaling: suite_records.cpp.
extern const Section suite_records, scale_to, target_spectrum, en1998_spectrum, asce_spectrum;

}  // namespace study_tables

/// File of a study: studies.cpp.
extern const Section study_file;
/// File of a suite: suite_records.cpp.
extern const Section suite_file;

/// All sections of a study, then of a suite, outer ones first; the first is the file of a study.
std::span<const Section* const> sections_of_studies() noexcept;

}  // namespace pounding::keys
