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

Record read(const Lines& lines, const RecordOptions& options) {
  lines.at(header_length - 1, "the end of the header of 64 lines");
  const NamedLines header(lines, header_length);
  const std::string type = header.value("DATA_TYPE:");
  const std::string_view wanted = options.displacement ? "DISPLACEMENT" : "ACCELERATION";
  if (upper(type) != wanted)
    lines.fail(header.at("DATA_TYPE:"), fmt::format("contains \"{}\"; use the file of {}s", excerpt(type),
                                                    options.displacement ? "displacement" : "acceleration"));
  Record record;
  record.format = "ESM";
  record.title =
      single_spaced(header.value_or_none("EVENT_NAME:") + " " + header.value_or_none("EVENT_DATE_YYYYMMDD:"));
  record.station = single_spaced(fmt::format("{} {} {}", header.value_or_none("NETWORK:"),
                                             header.value("STATION_CODE:"), header.value_or_none("STATION_NAME:")));
  record.channel = chosen(lines, {{.component = header.value("STREAM:")}}, options).text();
  const double unit = agreed_unit(lines, header.at("UNITS:"), header.value("UNITS:"), options, record.unit);
  const std::size_t step_line = header.at("SAMPLING_INTERVAL_S:"), count_line = header.at("NDATA:");
  const double dt =
      checked_positive(lines, step_line, "SAMPLING_INTERVAL_S", header.number("SAMPLING_INTERVAL_S:"), "a time");
  const std::size_t count = checked_count(lines, count_line, "NDATA", header.number("NDATA:"));
  if (contains(header.value_or_none("BASELINE_CORRECTION:"), "NOT REMOVED") ||
      upper(header.value_or_none("PROCESSING:")) == "NONE")
    record.remark = "uncorrected";
  set_samples(record, read_numbers(lines, header_length, {count, "NDATA"}), unit, dt);
  return record;
}

}  // namespace

constinit const Format esm{"ESM", recognises, read};

}  // namespace pounding::records
