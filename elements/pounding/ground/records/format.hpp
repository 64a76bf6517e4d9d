#pragma once
/// Tools that the readers of record formats share. Users call read_record() instead.
///
/// To add a format: write NAME.cpp in this folder, which defines `constinit const Format NAME`, and add FORMAT(NAME) to
/// formats.inc.

#include <cstddef>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/ground/record.hpp>

namespace pounding::records {

// Limits of a file, far above the largest records.
inline constexpr std::size_t longest_record = 128'000'000;  ///< bytes
inline constexpr std::size_t longest_line = 10'000'000;     ///< bytes
inline constexpr std::size_t most_lines = 5'000'000;
inline constexpr std::size_t most_numbers = 20'000'000;
inline constexpr std::size_t most_samples = 5'000'000;
inline constexpr std::size_t longest_header = 200'000;  ///< bytes
/// Largest absolute value of a time or a sample, as it stands in the file.
inline constexpr double largest_value = 1e30;

/// The lines of a file, and errors that name them. Lines count from 0 here and from 1 in messages. They end with LF, CR
/// LF, or, where there is no LF at all, with CR. Form feeds and the DOS end-of-file mark 0x1A at the ends of lines are
/// ignored, as are zero bytes behind the last line.
class Lines {
 public:
  /// Throws InputError for a text in UTF-16 and one beyond the limits.
  Lines(std::string_view text, std::string name);

  std::size_t size() const { return lines_.size(); }
  std::string_view operator[](std::size_t i) const { return lines_[i]; }
  const std::string& name() const { return name_; }
  /// Line i. Fails at the last line, naming `expected`, when the file has no line i.
  std::string_view at(std::size_t i, std::string_view expected) const;
  /// Throws InputError with "file:line: ".
  [[noreturn]] void fail(std::size_t i, const std::string& message) const;
  /// The number that `text`, a part of line i, is.
  double number(std::size_t i, std::string_view text) const;
  /// A number among the samples; fails where it is larger than any.
  double sample(std::size_t i, std::string_view text) const;

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
};

/// One format of records.
struct Format {
  std::string_view name;  ///< for messages and reports
  /// Whether a file is of this format, by its content; formats before it in formats.inc were asked first and did not
  /// recognise it.
  bool (*recognises)(const Lines& lines);
  /// Reads the record; read_record() fills `file`, `uniform` and `measures` afterwards, and turns displacements [m],
  /// which stand for the accelerations until then, into accelerations. Throws InputError with "file:line: ".
  Record (*read)(const Lines& lines, const RecordOptions& options);
};

#define FORMAT(name) extern const Format name;
#include <pounding/ground/records/formats.inc>
#undef FORMAT

/// Every format, in the order of formats.inc.
std::span<const Format* const> formats();

// Words.

std::string_view trimmed(std::string_view text);
std::string upper(std::string_view text);
/// Without blanks at the ends, and with one where there were several.
std::string single_spaced(std::string_view text);
std::vector<std::string_view> split_at_blanks(std::string_view text);
/// Whether `text` contains `part`, or begins with it, in capitals or not; `part` is in capitals.
bool contains(std::string_view text, std::string_view part);
bool begins_with(std::string_view text, std::string_view part);
/// Groups that the pattern captured in the line; empty when the line does not match.
std::optional<std::vector<std::string>> captured(std::string_view line, const std::regex& pattern);
/// A pattern that does not distinguish capitals.
std::regex pattern(const char* text);

// Numbers.

/// A count of samples. Fails unless it is an integer from 2 to most_samples.
std::size_t checked_count(const Lines& lines, std::size_t i, std::string_view name, double value);
/// A spacing or a rate. Fails unless it is > 0; `what`: "a time".
double checked_positive(const Lines& lines, std::size_t i, std::string_view name, double value, std::string_view what);

/// Number of values that a file must hold, and the part of the file that states it.
struct Stated {
  std::size_t count;
  std::string by;  ///< "NPTS", "line 46"
};

/// Numbers parted by blanks, from line `begin` to the end of the file, or to a line such as "*** End Data ***". Fails
/// when there are fewer or more than stated.
std::vector<double> read_numbers(const Lines& lines, std::size_t begin, const Stated& stated);

/// Numbers in columns as Fortran writes them, often without a blank between: (8F10.3) is {8, 10}, (1X,10F7.3) is {10,
/// 7, 1}.
struct Columns {
  std::size_t per_line, width;
  std::size_t indent = 0;

  /// First character of a field of a line.
  std::size_t begin_of(std::size_t field) const { return indent + field * width; }
  std::size_t lines_for(std::size_t count) const { return (count + per_line - 1) / per_line; }
};

/// The first "(8F10.3)", "(10I8)" or "(5E15.7)" in a line, in capitals or not; nothing when there is none.
std::optional<Columns> fortran_columns(std::string_view line);

/// Field i, from 0, of the numbers that begin at a line; fails when the file ends before it.
std::string_view column_field(const Lines& lines, std::size_t begin, const Columns& columns, std::size_t i);

/// Numbers in columns from line `begin` on. Fails when there are fewer or more than stated.
std::vector<double> read_columns(const Lines& lines, std::size_t begin, const Columns& columns, const Stated& stated);

/// 0, dt, 2 dt, ... [s]
std::vector<double> even_times(std::size_t count, double dt);

// Units, of accelerations or, where the options say so, of displacements or forces.

/// A unit that the header of a file states, and the line where it does.
struct StatedUnit {
  std::string text;
  std::size_t line;
};

/// The value in SI of the unit of an acceleration, or displacement, as records spell it ("G", "CM/SEC/SEC", "m/s**2",
/// "g/10"); nothing when it is none.
std::optional<double> unit_of_values(std::string_view text, const RecordOptions& options);

/// Seconds in the unit of a time ("s", "sec", "ms"); nothing when it is none.
std::optional<double> unit_of_time(std::string_view text);

/// Whether a text is the unit of a time, a length, a velocity or an acceleration.
bool is_unit(std::string_view text);

/// Units of values in the prose of lines 0 to `end`: "acc (g)", "acceleration[m/s^2]", "units are g", "in cm/s/s"; not
/// "0.32 g".
std::vector<StatedUnit> stated_units(const Lines& lines, std::size_t end, const RecordOptions& options);

/// Value in SI of 1 in the file [m/s^2], or [m], from what the file states (empty: nothing) and what the user says;
/// `unit` becomes what was taken. Fails when neither or both and not alike, and for another dimension.
double agreed_unit(const Lines& lines, std::size_t stated_at, const std::string& stated, const RecordOptions& options,
                   std::string& unit);

/// Agrees likewise where the file may state units in several places; where they differ, the user must say one of them.
double agreed_unit(const Lines& lines, const std::vector<StatedUnit>& stated, const RecordOptions& options,
                   std::string& unit);

// Channels.

/// One channel of a file with several.
struct Channel {
  std::string number;     ///< as in the file; may be empty
  std::string component;  ///< "90 deg", "Up", "N-S"; may be empty
  std::string place;      ///< where in a structure or borehole; may be empty
  std::size_t begin = 0;  ///< first line

  /// "2: 90 deg, roof"
  std::string text() const;
};

/// The channel that the options name by number or component, or the only one. Where numbers lack or repeat, channels
/// are numbered as they come. Fails with the list of them when none, or none of these, was named.
Channel chosen(const Lines& lines, std::vector<Channel> channels, const RecordOptions& options);

/// Fails when a channel is asked for of a format that does not name any.
void refuse_channel(const Lines& lines, const RecordOptions& options);

}  // namespace pounding::records
