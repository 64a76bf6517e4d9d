#include <iterator>
#include <vector>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/studies.hpp>

namespace pounding::keys::study_tables {

constexpr std::string_view suites_since = "0.3.0";

constexpr std::string_view soils[] = {"A", "B", "C", "D", "E"};
constexpr Key en1998_keys[] = {
    {"ag", quantity(dimension::acceleration, bounds::positive), required,
     "Design ground acceleration on ground type A, with the importance factor: gamma_I agR.", "0.3 g", suites_since},
    {"soil", choice(soils, "ground type"), required, "Ground type of table 3.1.", "C", suites_since},
    {"type", integer(1, 2), otherwise("1"), "Type of the spectrum: 1, or 2 for magnitudes up to 5.5.", "1",
     suites_since},
};
constexpr Key asce_keys[] = {
    {"SDS", quantity(dimension::acceleration, bounds::positive), required,
     "Design spectral acceleration at short periods. A bare number is in m/s^2.", "1.0 g", suites_since},
    {"SD1", quantity(dimension::acceleration, bounds::positive), required,
     "Design spectral acceleration at 1 s. A bare number is in m/s^2.", "0.6 g", suites_since},
    {"TL", quantity(dimension::time, bounds::positive), required, "Long-period transition period.", "8 s",
     suites_since},
};
constexpr Key target_keys[] = {
    {"en1998_1", map(en1998_spectrum), exactly_one, "Horizontal elastic response spectrum of EN 1998-1, 3.2.2.2.",
     "{ag: 0.3 g, soil: C, type: 1}", suites_since},
    {"asce_7", map(asce_spectrum), exactly_one, "Design response spectrum of ASCE 7, 11.4.6.",
     "{SDS: 1.0 g, SD1: 0.6 g, TL: 8 s}", suites_since},
    {"sa", quantity(dimension::acceleration, bounds::non_negative).list(2, 100000), exactly_one,
     "Spectral accelerations of a table, one per period. Values between periods are interpolated linearly.",
     "[0.8 g, 0.8 g, 0.3 g]", suites_since},
    {"file", text(), exactly_one,
     "CSV file of a spectrum: the first line has names and units, as in period (s),sa (g).", "target.csv",
     suites_since},
    {"periods", quantity(dimension::time, bounds::non_negative).list(2, 100000), optional,
     "Periods of the table sa, increasing.", "[0 s, 0.5 s, 2 s]", suites_since},
};

constexpr std::string_view methods[] = {"suite", "least_squares", "mean"};
constexpr std::string_view combinations[] = {"geometric_mean", "srss", "rotd100"};
constexpr Key scale_keys[] = {
    {"spectrum", map(target_spectrum), required, "Target spectrum of the records.",
     "{en1998_1: {ag: 0.3 g, soil: C, type: 1}}", suites_since},
    {"from", quantity(dimension::time, bounds::positive),
     otherwise("0.2 times the shortest first period of the structures"), "Shortest period of the range.", "0.2 s",
     suites_since},
    {"to", quantity(dimension::time, bounds::positive), otherwise("2 times the longest first period of the structures"),
     "Longest period of the range.", "2 s", suites_since},
    {"method", choice(methods, "method"), otherwise("suite for the spectrum of a code, else least_squares"),
     "suite: one factor for all records, the smallest with which their mean spectrum is nowhere below the fraction of "
     "the target. least_squares: one factor per record, with the smallest sum of squared differences from the target. "
     "mean: one factor per record, with which its mean over the range is that of the target.",
     "suite", suites_since},
    {"fraction", number(bounds::above_0_to_1), otherwise("90 % for the method suite, else none"),
     "Fraction of the target below which the mean spectrum of the suite may not fall. With factors per record, a "
     "common factor of at least 1 raises all of them.",
     "90 %", suites_since},
    {"components", choice(combinations, "combination"),
     otherwise("srss for EN 1998-1, rotd100 for ASCE 7, else geometric_mean"),
     "Spectrum of a motion with two horizontal components: square root of the sum of squares, maximum over all "
     "directions, or geometric mean. Vertical components have the factor of the horizontal ones.",
     "geometric_mean", suites_since},
    {"damping", number(bounds::from_0_below_1), otherwise("5 %"),
     "Damping ratio of the spectra. The spectrum of EN 1998-1 has the factor eta; that of ASCE 7 has 5 % only.", "5 %",
     suites_since},
};

// Those of a study, with scale_to.
std::span<const Key> suite_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> made(records.keys.begin(), records.keys.end());
    made.push_back({"scale_to", map(scale_to), optional,
                    "Target spectrum and range of periods to which the records are scaled.",
                    "{spectrum: {en1998_1: {ag: 0.3 g, soil: C, type: 1}}, from: 0.2 s, to: 2 s}", suites_since});
    return made;
  }();
  return all;
}

constinit const Section en1998_spectrum{"en1998_spectrum", "records.scale_to.spectrum.en1998_1",
                                        "Elastic response spectrum of EN 1998-1.", en1998_keys};
constinit const Section asce_spectrum{"asce_spectrum", "records.scale_to.spectrum.asce_7",
                                      "Design response spectrum of ASCE 7.", asce_keys};
constinit const Section target_spectrum{"target_spectrum", "records.scale_to.spectrum",
                                        "Target spectrum: that of a code, a table, or a file.", target_keys};
constinit const Section scale_to{"scale_to", "records.scale_to", "Scaling of a suite to a target spectrum.",
                                 scale_keys};
const Section suite_records{"suite_records", "records", "Records of a suite, and their scaling.", suite_keys()};

constexpr Key suite_file_keys[] = {
    {"records", map(suite_records), required,
     "Records of a suite, one run each, instead of the model's ground_motion. A file with this key runs with pounding "
     "suite.",
     "{files: records/*.AT2}", suites_since},
};

}  // namespace pounding::keys::study_tables

namespace pounding::keys {

constinit const Section suite_file{"suite_file", "", "The file of a suite: its key next to those of the model.",
                                   study_tables::suite_file_keys};

}  // namespace pounding::keys
