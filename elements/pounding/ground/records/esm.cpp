/// ESM and ITACA ASCII (DYNA 1.2; Luzi et al. 2016, Engineering Strong-Motion database, esm-db.eu).
///
/// 64 lines "KEY: value", then one value per line. DATA_TYPE must be ACCELERATION, or DISPLACEMENT if displacements are
/// read.

#include <pounding/ground/records/format.hpp>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t header_length = 64;

bool recognises(const Lines& lines) {
  return lines.size() > 1 && lines[0].starts_with("EVENT_NAME:") && lines[1].starts_with("EVENT_ID:");
}

/// A value of the header, and its line.
struct Entry {
  std::string value;
  std::size_t line;
};

std::optional<Entry> find_entry(const Lines& lines, std::string_view key) {
  for (std::size_t i = 0; i < header_length; ++i)
    if (lines[i].starts_with(key) && lines[i].substr(key.size()).starts_with(':'))
      return Entry{std::string(trimmed(lines[i].substr(key.size() + 1))), i};
  return std::nullopt;
}

Entry entry(const Lines& lines, std::string_view key) {
  const std::optional<Entry> found = find_entry(lines, key);
  if (!found) lines.fail(header_length - 1, fmt::format("the header of 64 lines has no \"{}\"", key));
  return *found;
}

/// Empty if there is none.
std::string value(const Lines& lines, std::string_view key) { return find_entry(lines, key).value_or(Entry{}).value; }

Record read(const Lines& lines, const RecordOptions& options) {
  lines.at(header_length - 1, "the end of the header of 64 lines");
  const Entry type = entry(lines, "DATA_TYPE");
  const std::string_view wanted = options.displacement ? "DISPLACEMENT" : "ACCELERATION";
  if (upper(type.value) != wanted)
    lines.fail(type.line, fmt::format("contains \"{}\"; use the file of {}s", excerpt(type.value),
                                      options.displacement ? "displacement" : "acceleration"));
  Record record;
  record.format = "ESM";
  record.title = single_spaced(value(lines, "EVENT_NAME") + " " + value(lines, "EVENT_DATE_YYYYMMDD"));
  record.station = single_spaced(fmt::format("{} {} {}", value(lines, "NETWORK"), entry(lines, "STATION_CODE").value,
                                             value(lines, "STATION_NAME")));
  const Entry stream = entry(lines, "STREAM");
  record.channel =
      chosen(lines, {{.number = {}, .component = stream.value, .place = {}, .begin = stream.line}}, options).text();
  const Entry units = entry(lines, "UNITS");
  const double unit = agreed_unit(lines, units.line, units.value, options, record.unit);
  const Entry step = entry(lines, "SAMPLING_INTERVAL_S"), npts = entry(lines, "NDATA");
  const double dt =
      checked_positive(lines, step.line, "SAMPLING_INTERVAL_S", lines.number(step.line, step.value), "a time");
  const std::size_t count = checked_count(lines, npts.line, "NDATA", lines.number(npts.line, npts.value));
  if (contains(value(lines, "BASELINE_CORRECTION"), "NOT REMOVED") || upper(value(lines, "PROCESSING")) == "NONE")
    record.remark = "uncorrected";

  record.samples.accelerations = read_numbers(lines, header_length, {count, "NDATA"});
  for (double& a : record.samples.accelerations) a *= unit;
  record.samples.times = even_times(count, dt);
  return record;
}

}  // namespace

constinit const Format esm{"ESM", recognises, read};

}  // namespace pounding::records
