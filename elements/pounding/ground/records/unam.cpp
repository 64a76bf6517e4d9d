/// UNAM, "archivo estandar de aceleracion" 2.0 of Mexico's strong-motion networks (Base Mexicana de Datos de Sismos
/// Fuertes, Instituto de Ingenieria, UNAM; Quaas et al. 1995).
///
/// About 109 lines of text, usually "KEY : value", with lists of channels such as "/V/N00E/N90E"; below "DATOS DE
/// ACELERACION" the names of the channels between two rules, then lines with one value per channel (3F10.4). Fields
/// read: orientations, intervals [s], numbers of samples and durations of channels 1 to 6 and 7 to 12, the unit, and
/// the columns.

#include <pounding/ground/records/format.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding::records {
namespace {

constexpr std::size_t header_lines = 300, title_lines = 20;
constexpr std::string_view title = "ARCHIVO ESTANDAR DE ACELERACION", values_title = "DATOS DE ACELERACION";

bool recognises(const Lines& lines) {
  for (std::size_t i = 0; i < std::min(lines.size(), title_lines); ++i)
    if (begins_with(trimmed(lines[i]), title)) return true;
  return false;
}

/// Entries of "/V/N00E/N90E", one per channel, for keys that end in C1-C6 or C7-C12.
std::vector<std::string> list(const Lines& lines, std::string_view key) {
  std::vector<std::string> entries;
  for (const std::string_view range : {"C1-C6", "C7-C12"})
    for (std::size_t i = 0; i < std::min(lines.size(), header_lines); ++i) {
      const std::string_view name = lines[i].substr(0, lines[i].find(" :"));
      if (!begins_with(trimmed(lines[i]), key) || !contains(name, range)) continue;
      const std::string text = NamedLines(lines, header_lines).value(i);
      for (std::size_t at = text.find('/'); at != std::string::npos;) {
        const std::size_t next = text.find('/', at + 1);
        entries.emplace_back(
            trimmed(std::string_view(text).substr(at + 1, next == std::string::npos ? next : next - at - 1)));
        at = next;
      }
      break;
    }
  return entries;
}

/// Number of a list for a channel.
double number(const Lines& lines, std::string_view key, std::size_t channel) {
  const std::vector<std::string> entries = list(lines, key);
  const std::size_t i = NamedLines(lines, header_lines).at(key);
  if (channel >= entries.size()) lines.fail(i, fmt::format("has no entry for channel {}", channel + 1));
  return lines.number(i, entries[channel]);
}

Columns columns_of(const Lines& lines, const NamedLines& header, std::size_t channels) {
  const std::size_t i = header.at("FORMATO DATOS");
  const auto columns = fortran_columns("(" + header.value(i) + ")");
  if (!columns || columns->per_line < channels)
    lines.fail(i, fmt::format("\"{}\" does not state columns for {} channels, such as 3F10.4", excerpt(header.value(i)),
                              channels));
  return *columns;
}

Record read(const Lines& lines, const RecordOptions& options) {
  const NamedLines header(lines, header_lines);
  std::vector<Channel> channels;
  for (const std::string& orientation : list(lines, "ORIENTACION C"))
    channels.push_back({.number = std::to_string(channels.size() + 1),
                        .component = single_spaced(orientation.substr(0, orientation.find(';'))),
                        .begin = channels.size()});
  if (channels.empty()) lines.fail(header.at("ORIENTACION C"), "does not name channels, as in /V/N00E/N90E");
  const Channel channel = chosen(lines, channels, options);
  const std::size_t k = channel.begin;

  Record record;
  record.format = "UNAM";
  record.channel = channel.text();
  record.title = single_spaced(header.value("FECHA DEL SISMO") + " " + header.value("MAGNITUD"));
  record.station = single_spaced(header.value("CLAVE DE LA ESTACION") + " " + header.value("NOMBRE DE LA ESTACION"));
  const std::size_t unit_line = header.at("UNIDADES DE LOS DATOS");
  const std::string unit_text = header.value(unit_line);
  const double unit =
      agreed_unit(lines, unit_line, single_spaced(unit_text.substr(0, unit_text.find('('))), options, record.unit);
  const std::size_t count_line = header.at("NUM. TOTAL DE MUESTRAS"), step_line = header.at("INTERVALO DE MUESTREO");
  const std::size_t count =
      checked_count(lines, count_line, "the number of samples", number(lines, "NUM. TOTAL DE MUESTRAS", k));
  const double dt =
      checked_positive(lines, step_line, "the interval", number(lines, "INTERVALO DE MUESTREO", k), "a time");
  // With "factor de decimacion", the interval may be that of the instrument before decimation.
  const double duration = number(lines, "DURACION DEL REGISTRO", k);
  if (std::abs(static_cast<double>(count) * dt - duration) > std::max(2 * dt, 0.01 * duration))
    lines.fail(step_line, fmt::format("{} samples every {:g} s disagree with the duration of {:g} s on line {}", count,
                                      dt, duration, header.at("DURACION DEL REGISTRO") + 1));

  std::size_t begin = header.at(values_title) + 1;
  for (std::size_t rules = 0; rules < 2; ++begin)
    if (lines.at(begin, "the values").starts_with("---")) ++rules;
  const Columns columns = columns_of(lines, header, channels.size());
  if (begin + count > lines.size())
    lines.fail(lines.size() - 1, fmt::format("the values end here, after {}, but line {} states {}",
                                             lines.size() - begin, count_line + 1, count));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(lines.sample(begin + i, column_field(lines, begin, columns, i * columns.per_line + k)));
  std::size_t more = 0;
  while (begin + count + more < lines.size() &&
         !column_field(lines, begin, columns, (count + more) * columns.per_line + k).empty())
    ++more;
  // Files of the network may end with a few repeated samples.
  if (more > count / 100)
    lines.fail(begin + count, fmt::format("more values than the {} that line {} states", count, count_line + 1));
  if (more > 0)
    record.warnings.push_back(
        fmt::format("{} rows in excess of the {} stated on line {} are omitted", more, count, count_line + 1));
  set_samples(record, std::move(values), unit, dt);
  return record;
}

}  // namespace

constinit const Format unam{"UNAM", recognises, read};

}  // namespace pounding::records
