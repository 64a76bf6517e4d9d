#pragma once
/// Common tools of the readers of record formats. Users call read_record() instead.
///
/// To add a format, write NAME.cpp in this folder, which defines `constinit const Format NAME`, and add FORMAT(NAME) to
/// formats.inc.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/core/text.hpp>
#include <pounding/ground/record.hpp>

namespace pounding::records {

// Limits of a file, far above the largest known records.
inline constexpr std::size_t longest_record = 128'000'000;  ///< bytes
inline constexpr std::size_t longest_line = 10'000'000;     ///< bytes
inline constexpr std::size_t max_lines = 5'000'000;
inline constexpr std::size_t max_numbers = 20'000'000;
inline constexpr std::size_t max_samples = 5'000'000;
inline constexpr std::size_t longest_header = 200'000;  ///< bytes
/// Maximum absolute value of a time or sample, in the unit of the file.
inline constexpr double largest_value = 1e30;

/// Lines of a file, with errors that refer to them. Lines are numbered from 0 here and from 1 in messages. Line ends
/// are LF or CR LF, or CR if the file contains no LF. Form feeds and the DOS end-of-file mark 0x1A at the ends of lines
/// are ignored, as are zero bytes after the last line.
class Lines {
 public:
  /// Throws InputError for a text in UTF-16 and for one that exceeds the limits.
  Lines(std::string_view text, std::string name);

  std::size_t size() const { return lines_.size(); }
  std::string_view operator[](std::size_t i) const { return lines_[i]; }
  const std::string& name() const { return name_; }
  /// Line i. Throws at the last line, naming `expected`, if the file is shorter.
  std::string_view at(std::size_t i, std::string_view expected) const;
  /// Throws InputError with "file:line: ".
  [[noreturn]] void fail(std::size_t i, const std::string& message) const;
  /// Value of the number `text`, a part of line i.
  double number(std::size_t i, std::string_view text) const;
  /// Value of a sample; throws if it exceeds largest_value.
  double sample(std::size_t i, std::string_view text) const;

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
};

/// A format of records.
struct Format {
  std::string_view name;  ///< for messages and reports
  /// True if a file has this format, based on its content. Formats listed earlier in formats.inc have been tested
  /// before.
  bool (*recognises)(const Lines& lines);
  /// Reads the record. read_record() then sets `file`, `uniform` and `measures`, and converts displacements [m], which
  /// are returned in place of accelerations. Throws InputError with "file:line: ".
  Record (*read)(const Lines& lines, const RecordOptions& options);
};

#define FORMAT(name) extern const Format name;
#include <pounding/ground/records/formats.inc>
#undef FORMAT

/// All formats, in the order of formats.inc.
std::span<const Format* const> formats();

// Text.

std::string upper(std::string_view text);
/// Removes blanks at the ends, and reduces several blanks to one.
std::string single_spaced(std::string_view text);
std::vector<std::string_view> split_at_blanks(std::string_view text);
/// True if `text` contains, or starts with, `part`, ignoring case; `part` must be in capitals.
bool contains(std::string_view text, std::string_view part);
bool begins_with(std::string_view text, std::string_view part);
/// Groups captured by the pattern in the line; empty if the line does not match.
std::optional<std::vector<std::string>> captured(std::string_view line, const std::regex& pattern);
/// A case-insensitive pattern.
std::regex pattern(const char* text);

// Headers.

/// Lines of a header that start with a name, given in capitals, and have a value behind a colon or a fixed width.
class NamedLines {
 public:
  /// The first `count` lines of a file; `width` is the number of characters of all names, 0 if a colon ends them.
  NamedLines(const Lines& lines, std::size_t count, std::size_t width = 0)
      : lines_(lines), count_(std::min(lines.size(), count)), width_(width) {}
  std::optional<std::size_t> find(std::string_view name) const;
  /// Line with this name. Throws at the end of the header if there is none.
  std::size_t at(std::string_view name) const;
  /// Value of a line, without blanks at its ends.
  std::string value(std::size_t line) const;
  std::string value(std::string_view name) const { return value(at(name)); }
  double number(std::string_view name) const { return lines_.number(at(name), value(name)); }
  /// Value of a line, empty if there is none.
  std::string value_or_none(std::string_view name) const;

 private:
  const Lines& lines_;
  std::size_t count_, width_;
};

// Numbers.

/// A number of samples. Throws unless it is an integer from 2 to max_samples.
std::size_t checked_count(const Lines& lines, std::size_t i, std::string_view name, double value);
/// A spacing or rate. Throws unless it is > 0; `what` is for example "a time".
double checked_positive(const Lines& lines, std::size_t i, std::string_view name, double value, std::string_view what);

/// Required number of values, and the part of the file that states it.
struct Stated {
  std::size_t count;
  std::string by;  ///< "NPTS", "line 46"
};

/// Numbers separated by blanks, from line `begin` to the end of the file or to an end mark such as "*** End Data ***".
/// Throws if their number differs from the stated one.
std::vector<double> read_numbers(const Lines& lines, std::size_t begin, const Stated& stated);

/// Fortran columns of numbers, often without separating blanks: (8F10.3) is {8, 10}, (1X,10F7.3) is {10, 7, 1}.
struct Columns {
  std::size_t per_line, width;
  std::size_t indent = 0;

  /// First character of a field of a line.
  std::size_t begin_of(std::size_t field) const { return indent + field * width; }
  std::size_t lines_for(std::size_t count) const { return (count + per_line - 1) / per_line; }
};

/// First format such as "(8F10.3)", "(10I8)" or "(5E15.7)" in a line, ignoring case; `nullopt` if there is none.
std::optional<Columns> fortran_columns(std::string_view line);

/// Field i, from 0, of the numbers that start at line `begin`; throws if the file ends before it.
std::string_view column_field(const Lines& lines, std::size_t begin, const Columns& columns, std::size_t i);

/// Numbers in columns from line `begin`. Throws if their number differs from the stated one.
std::vector<double> read_columns(const Lines& lines, std::size_t begin, const Columns& columns, const Stated& stated);

/// Number i, from 0, in columns that start at line `begin`.
double column_number(const Lines& lines, std::size_t begin, const Columns& columns, std::size_t i);

/// Sets samples at the times 0, dt, 2 dt, ... [s]: values of the file times their unit.
void set_samples(Record& record, std::vector<double> values, double unit, double dt);

// Units of accelerations or, depending on the options, of displacements or forces.

/// A unit stated in the header of a file, and its line.
struct StatedUnit {
  std::string text;
  std::size_t line;
};

/// Value in SI units of the unit of an acceleration or displacement, in the spellings of records ("G", "CM/SEC/SEC",
/// "m/s**2", "g/10"); `nullopt` for other texts.
std::optional<double> unit_of_values(std::string_view text, const RecordOptions& options);

/// Seconds per unit of time ("s", "sec", "ms"); `nullopt` for other texts.
std::optional<double> unit_of_time(std::string_view text);

/// True for a unit of time, length, velocity or acceleration.
bool is_unit(std::string_view text);

/// Units of values in the text of lines 0 to `end`: "acc (g)", "acceleration[m/s^2]", "units are g", "in cm/s/s"; but
/// not "0.32 g".
std::vector<StatedUnit> stated_units(const Lines& lines, std::size_t end, const RecordOptions& options);

/// Factor from file values to SI [m/s^2], or [m], from the unit stated in the file (may be empty) and that of the
/// options; `unit` is set to the one used. Throws if both are missing or disagree, and for another dimension.
double agreed_unit(const Lines& lines, std::size_t stated_at, const std::string& stated, const RecordOptions& options,
                   std::string& unit);

/// Version for a file that may state units in several places; if they differ, the options must select one of them.
double agreed_unit(const Lines& lines, const std::vector<StatedUnit>& stated, const RecordOptions& options,
                   std::string& unit);

// Channels.

/// One channel of a file with several.
struct Channel {
  std::string number{};     ///< as in the file; may be empty
  std::string component{};  ///< "90 deg", "Up", "N-S"; may be empty
  std::string place{};      ///< location in a structure or borehole; may be empty
  std::size_t begin = 0;    ///< first line

  /// "2: 90 deg, roof"
  std::string text() const;
};

/// Channel selected by number or component in the options, or the only channel. If numbers are missing or not unique,
/// channels are numbered in order. Throws with a list of channels if the selection is missing or does not match.
Channel chosen(const Lines& lines, std::vector<Channel> channels, const RecordOptions& options);

/// Throws if a channel is selected for a format without named channels.
void refuse_channel(const Lines& lines, const RecordOptions& options);

}  // namespace pounding::records
