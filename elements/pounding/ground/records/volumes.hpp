#pragma once
/// Layout of Caltech's Volumes I and II (Hudson et al., 1969 to 1975), shared by CSMIP, USC and BHRC. Users call
/// read_record() instead.
///
/// A channel of Volume I: 13 lines of text, integers, reals, then pairs of time and acceleration, or evenly spaced
/// accelerations. A channel of Volume II: 25 lines of text, integers, reals, then acceleration, velocity and
/// displacement, each after a line that states points, spacing and unit.

#include <string>
#include <string_view>

#include <pounding/ground/records/format.hpp>

namespace pounding::records::volumes {

/// Unit without the text after it: "cm/sec2. (8f10.6)", "CM/SEC/SEC)", "g .      Format: (8f9.6)".
std::string unit_alone(std::string_view text);

/// Line after the integers and reals of a channel of Volume I that starts at `begin`.
std::size_t after_headers(const Lines& lines, std::size_t begin);

/// Reads evenly spaced accelerations below line i, which states `count`, `unit` and optionally columns such as
/// (8F10.3). Otherwise the columns follow from the length of the first line, or are the `usual` ones. `dt` [s].
void read_even(const Lines& lines, std::size_t i, const std::string& count, const std::string& unit, double dt,
               const Columns& usual, const RecordOptions& options, Record& record);

/// Reads the accelerations below the line "2000 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC, IN CM/SEC2" between
/// two lines; false if there is none.
bool read_stated(const Lines& lines, std::size_t begin, std::size_t end, const Columns& usual,
                 const RecordOptions& options, Record& record);

/// Reads pairs of time [s] and acceleration from line `first`, uneven because film was digitised by hand. Line
/// `count_line` states their number, `unit_line` the unit.
void read_pairs(const Lines& lines, std::size_t count_line, std::size_t unit_line, std::size_t first,
                const RecordOptions& options, Record& record);

}  // namespace pounding::records::volumes
