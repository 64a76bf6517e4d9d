/// Units stated in the headers of records or given by the user.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>
#include <pounding/ground/records/format.hpp>

namespace pounding::records {
namespace {

struct Wanted {
  Dimension dimension;
  std::string_view name, several, units;
};

Wanted wanted(const RecordOptions& options) {
  if (options.force == dimension::energy) return {dimension::energy, "a moment", "moments", "N m, kN m or MN m"};
  if (options.force) return {*options.force, "a force", "forces", "N, kN or MN"};
  if (options.displacement) return {dimension::length, "a displacement", "displacements", "m, cm, mm or in"};
  return {dimension::acceleration, "an acceleration", "accelerations", "g, m/s^2, cm/s^2 or gal"};
}

// Maximum length of a unit.
constexpr std::size_t longest_unit = 60;

std::optional<Unit> unit_of(std::string_view text) {
  if (text.size() > longest_unit) return std::nullopt;
  std::string unit;
  for (const char c : trimmed(text)) unit += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (unit == "g/10") return Unit{dimension::acceleration, standard_gravity / 10};
  if (unit == "mg") return Unit{dimension::acceleration, standard_gravity / 1000};  // milli-g, not milligram
  for (std::size_t at; (at = unit.find("sec")) != std::string::npos;) unit.erase(at + 1, 2);
  for (std::size_t at; (at = unit.find("**")) != std::string::npos; unit.erase(at + 1, 1)) unit[at] = '^';
  for (std::size_t at; (at = unit.find("\xC2\xB2")) != std::string::npos; unit[at + 1] = '2')
    unit[at] = '^';  // the sign for "squared"
  try {
    return parse_unit(unit);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::optional<Unit> unit_of_force(std::string_view text) {
  try {
    return parse_unit(std::string(trimmed(text)));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A token of a header line.
struct Key {
  std::string text;
  bool bracketed;
};

/// Tokens between blanks, brackets and punctuation; characters that occur in units are not separators.
std::vector<Key> words_of(std::string_view line) {
  constexpr std::string_view marks = " \t,;:=\"'()[]#";
  std::vector<Key> words;
  for (std::size_t begin = line.find_first_not_of(marks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(marks, begin), line.size());
    std::string_view text = line.substr(begin, end - begin);
    const bool opened = begin > 0 && (line[begin - 1] == '(' || line[begin - 1] == '[');
    const bool closed = end < line.size() && (line[end] == ')' || line[end] == ']');
    while (text.ends_with('.')) text.remove_suffix(1);
    words.push_back({std::string(text), opened && closed});
    begin = line.find_first_not_of(marks, end);
  }
  return words;
}

bool is_number(const std::vector<Key>& words, std::size_t i) {
  double value = 0;
  return i < words.size() && parse_number(words[i].text, value);
}

/// True if token i states a unit of the values: it is in brackets, follows a token such as "units", or is a formula.
/// Next to a number it belongs to that number.
bool states_unit(const std::vector<Key>& words, std::size_t i) {
  const auto& [text, bracketed] = words[i];
  if (bracketed) return true;
  if (i > 0 && is_number(words, i - 1)) return false;
  if (text.find_first_of("/^") != std::string::npos) return true;
  if (i == 0 || (text == "M" && is_number(words, i + 1))) return false;  // a magnitude
  const std::string before = upper(words[i - 1].text);
  if (before == "UNIT" || before == "UNITS" || before == "OF") return true;
  return text != "in" && (before == "ARE" || before == "IS" || before == "IN");
}

}  // namespace

std::optional<double> unit_of_values(std::string_view text, const RecordOptions& options) {
  const std::optional<Unit> unit = options.force ? unit_of_force(text) : unit_of(text);
  return unit && unit->dimension == wanted(options).dimension ? std::optional(unit->factor) : std::nullopt;
}

std::optional<double> unit_of_time(std::string_view text) {
  constexpr std::pair<std::string_view, double> words[] = {
      {"SECOND", 1}, {"SECONDS", 1}, {"SECS", 1}, {"MSECS", 1e-3}, {"MILLISECOND", 1e-3}, {"MILLISECONDS", 1e-3}};
  for (const auto& [word, seconds] : words)
    if (upper(trimmed(text)) == word) return seconds;
  const std::optional<Unit> unit = unit_of(text);
  return unit && unit->dimension == dimension::time ? std::optional(unit->factor) : std::nullopt;
}

bool is_unit(std::string_view text) {
  const std::optional<Unit> unit = unit_of(text);
  return unit && (unit->dimension == dimension::time || unit->dimension == dimension::length ||
                  unit->dimension == dimension::velocity || unit->dimension == dimension::acceleration);
}

std::vector<StatedUnit> stated_units(const Lines& lines, std::size_t end, const RecordOptions& options) {
  std::vector<StatedUnit> stated;
  std::size_t header = 0;
  for (std::size_t i = 0; i < end; ++i) {
    header += lines[i].size();
    if (header > longest_header)
      lines.fail(
          i, fmt::format(
                 "the header has more than {} bytes and does not state the unit of the values; add \"units:\" with it",
                 longest_header));
    const std::vector<Key> words = words_of(lines[i]);
    for (std::size_t k = 0; k < words.size(); ++k)
      if (states_unit(words, k) && unit_of_values(words[k].text, options)) stated.push_back({words[k].text, i});
  }
  return stated;
}

double agreed_unit(const Lines& lines, std::size_t stated_at, const std::string& stated, const RecordOptions& options,
                   std::string& unit) {
  const auto& [kind, name, several, units] = wanted(options);
  std::optional<double> said;
  if (!options.units.empty()) {
    said = unit_of_values(options.units, options);
    if (!said)
      throw InputError(fmt::format("{}: units: \"{}\" is not the unit of {}; type {}", lines.name(),
                                   excerpt(options.units), name, units));
  }
  if (stated.empty()) {
    if (!said)
      throw InputError(fmt::format("{}: the file does not state the unit of its {}; add \"units:\" with {}",
                                   lines.name(), several, units));
    unit = options.units;
    return *said;
  }
  const std::optional<double> factor = unit_of_values(stated, options);
  if (!factor) {
    const std::optional<Unit> other = unit_of(stated);
    const bool is_length = other && other->dimension == dimension::length;
    lines.fail(stated_at, fmt::format("\"{}\" is not the unit of {}; allowed are {}{}", excerpt(stated), name, units,
                                      is_length ? "; for displacements type displacement: {record: FILE}" : ""));
  }
  if (said && std::abs(*said - *factor) > 1e-9 * *factor)
    lines.fail(stated_at, fmt::format("the file states {}, but \"units\" is {}; remove \"units\"", excerpt(stated),
                                      excerpt(options.units)));
  unit = stated;
  return *factor;
}

double agreed_unit(const Lines& lines, const std::vector<StatedUnit>& stated, const RecordOptions& options,
                   std::string& unit) {
  if (stated.empty()) return agreed_unit(lines, 0, {}, options, unit);
  const auto same = [&](const StatedUnit& one, std::string_view other) {
    return unit_of_values(one.text, options) == unit_of_values(other, options);
  };
  const auto& [text, line] = stated.front();
  for (const StatedUnit& other : stated) {
    if (!options.units.empty() && same(other, options.units))
      return agreed_unit(lines, other.line, other.text, options, unit);
    if (options.units.empty() && !same(other, text))
      lines.fail(other.line, fmt::format("unit {}, but line {} states {}; add \"units:\" with one of them", other.text,
                                         line + 1, text));
  }
  return agreed_unit(lines, line, text, options, unit);
}

}  // namespace pounding::records
