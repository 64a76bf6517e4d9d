#include <pounding/results/results.hpp>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/core/error.hpp>
#include <pounding/results/replaced_file.hpp>
#include <pounding/results/table_writer.hpp>
#include <pounding/results/tables.hpp>

namespace pounding {
namespace {

using namespace hdf5;

template <class Histories>
void check_names(const Histories& histories, const std::string& kind) {
  std::set<std::string_view> seen;
  for (const auto& history : histories) {
    const std::string& name = history.name;
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
      throw InputError(kind + " name \"" + name +
                       "\" cannot be the name of a group in the results file: type a name that is not empty, \".\" or "
                       "\"..\" and has no '/' in it.");
    if (!seen.insert(name).second)
      throw InputError("two " + kind + "s have the name \"" + name + "\": type a different name for each.");
  }
}

constexpr struct {
  Label label;
  double ImpactRow::* value;
} impact_fields[] = {
    {{"t_start", "s", "touch"}, &ImpactRow::t_start},
    {{"t_end", "s", "separation"}, &ImpactRow::t_end},
    {{"t_release", "s", "the force fell to zero for the last time"}, &ImpactRow::t_release},
    {{"v_approach", "m/s", "closing speed at touch"}, &ImpactRow::v_approach},
    {{"v_separation", "m/s", "opening speed at separation"}, &ImpactRow::v_separation},
    {{"restitution", "1", "v_separation / v_approach, NaN for a touch at rest"}, &ImpactRow::restitution},
    {{"peak_force", "N", "largest contact force"}, &ImpactRow::peak_force},
    {{"t_peak", "s", "time of the largest contact force"}, &ImpactRow::t_peak},
    {{"peak_penetration", "m", "largest penetration"}, &ImpactRow::peak_penetration},
    {{"impulse", "N s", "integral of the contact force"}, &ImpactRow::impulse},
    {{"energy_lost", "J", "energy dissipated by the link"}, &ImpactRow::energy_lost},
    {{"energy_stored", "J", "recoverable energy of a contact that is still closed; otherwise zero"},
     &ImpactRow::energy_stored},
};

/// One table with one row per impact: the name of the link as fixed-length text, then the numbers.
void write_impacts(hid_t file, const Results& results) {
  std::size_t name_size = 1;
  for (const LinkHistory& link : results.links) name_size = std::max(name_size, link.name.size());
  const std::size_t fields = std::size(impact_fields);
  const std::size_t row_size = name_size + fields * sizeof(double);

  const Handle row(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "create the type of an impact");
  checked(H5Tinsert(row, "link", 0, hdf5::text_type(name_size)), "add link to the type of an impact");
  std::vector<std::string> units{"text"}, long_names{"name of the link"};
  for (std::size_t i = 0; i < fields; ++i) {
    const Label& label = impact_fields[i].label;
    checked(H5Tinsert(row, label.name, name_size + i * sizeof(double), H5T_NATIVE_DOUBLE),
            std::string("add ") + label.name + " to the type of an impact");
    units.emplace_back(label.units);
    long_names.emplace_back(label.long_name);
  }

  std::vector<std::byte> table(results.impacts.size() * row_size);
  std::byte* place = table.data();
  for (const ImpactRow& impact : results.impacts) {
    if (impact.link < 0 || static_cast<std::size_t>(impact.link) >= results.links.size())
      throw std::invalid_argument("an impact refers to link " + std::to_string(impact.link) + "; there are " +
                                  std::to_string(results.links.size()) + " links, counted from 0");
    const std::string& name = results.links[static_cast<std::size_t>(impact.link)].name;
    std::memcpy(place, name.data(), name.size());
    for (std::size_t i = 0; i < fields; ++i)
      std::memcpy(place + name_size + i * sizeof(double), &(impact.*impact_fields[i].value), sizeof(double));
    place += row_size;
  }

  const Handle made = hdf5::table(file, "impacts", "impacts in order of touch", row, results.impacts.size(),
                                  table.data(), units, long_names);
  // The group of the run without links is in that of the run with links, and has another number of impacts.
  if (results.links.empty()) return hide(file, "impacts");
  const Scale impact = scale(file, "impact", results.impacts.size());
  attach(made, std::vector{&impact});
}

// Writes the ends of a LinkHistory or a DeviceHistory, with position and direction.
template <class Joined>
void write_ends(hid_t place, const Joined& joined) {
  attribute(place, "left", joined.left.structure);
  attribute(place, "left_floor", joined.left.floor);
  attribute(place, "right", joined.right.structure);
  attribute(place, "right_floor", joined.right.floor);
  attribute(place, "left_end", joined.left.label);
  attribute(place, "right_end", joined.right.label);
  attribute(place, "position", std::vector<double>(joined.position.begin(), joined.position.end()));
  attribute(place, "direction", std::vector<double>(joined.direction.begin(), joined.direction.end()));
}

void write_attributes(hid_t place, const StructureHistory& history) {
  attribute(place, "kind", history.kind);
  attribute(place, "dimension", history.dimension);
  attribute(place, "floors", history.floors);
  attribute(place, "elevations", history.elevations);
  attribute(place, "directions", history.directions);
}

void write_attributes(hid_t place, const LinkHistory& history) {
  attribute(place, "gap", history.gap);
  attribute(place, "gap_units", std::string("m"));
  attribute(place, "largest_opening", history.largest_opening);
  attribute(place, "largest_opening_units", std::string("m"));
  attribute(place, "t_opening", history.t_opening);
  attribute(place, "t_opening_units", std::string("s"));
  attribute(place, "seat", history.seat);
  attribute(place, "seat_units", std::string("m"));
  attribute(place, "law", history.law);
  write_ends(place, history);
}

void write_attributes(hid_t place, const DeviceHistory& device) {
  write_ends(place, device);
  attribute(place, "stiffness", device.stiffness);
  attribute(place, "coefficient", device.coefficient);
  attribute(place, "exponent", device.exponent);
}

void write_attributes(hid_t, const ReducedStructure&) {}

void write_content(hid_t place, const Results& results) {
  check_names(results.structures, "structure");
  check_names(results.links, "link");
  check_names(results.devices, "device");
  attribute(place, "program", results.program);
  attribute(place, "version", results.version);
  attribute(place, "created", results.created);
  attribute(place, "title", results.title);
  attribute(place, "command", results.command);
  attribute(place, "status", results.status);
  const tables::Scales scales = tables::TableWriter(place, "results", tables::of_results, results).write();

  // xarray requires that a dimension of a group equals that of the groups above. Links, energies and the run without
  // links have their own times, so each group has its time, and the one here is hidden.
  hdf5::write(place, {"time", "s", "output times"}, {results.time.size()}, results.time);
  hide(place, "time");
  const tables::Scales with_time{{"time", scales.at("ground/time")}};
  const auto write_each = [&](const char* name, const auto& table, const auto& objects, const tables::Scales& above) {
    const Handle all = group(place, name);
    for (const auto& object : objects) {
      const Handle one = group(all, object.name);
      write_attributes(one, object);
      if (above.contains("time"))
        checked(H5Lcreate_hard(place, "ground/time", one, "time", H5P_DEFAULT, H5P_DEFAULT), "link the time");
      tables::TableWriter(one, object.name, table, object, above).write();
    }
  };
  write_each("structures", tables::of_structure, results.structures, with_time);
  write_each("links", tables::of_link, results.links, {});
  if (!results.devices.empty()) write_each("devices", tables::of_device, results.devices, with_time);

  const Handle envelopes = group(place, "envelopes");
  const tables::Scales with_extreme{{"extreme", scale(envelopes, "extreme", tables::extremes)}};
  const Handle structures = group(envelopes, "structures");
  for (const StructureHistory& history : results.structures) {
    const Handle one = group(structures, history.name);
    attribute(one, "floors", history.floors);
    tables::TableWriter(one, history.name, tables::of_envelope, history, with_extreme).write();
  }

  write_impacts(place, results);
  const Handle solver(H5Gopen2(place, "solver", H5P_DEFAULT), H5Gclose, "open the group solver");
  attribute(solver, "integrator", results.integrator);
  attribute(solver, "options", fmt::format("{}", fmt::join(results.options, " ")));
  if (!results.reduced.empty()) {
    write_each("solver/reduction", tables::of_reduction, results.reduced, {});
    const Handle reduction(H5Gopen2(solver, "reduction", H5P_DEFAULT), H5Gclose, "open the group reduction");
    attribute(reduction, "deeper", std::to_string(results.deeper));
  }
  if (results.checkpoint) {
    const Handle checkpoint = group(place, "checkpoint");
    attribute(checkpoint, "ground", results.checkpoint->ground);
    tables::TableWriter(checkpoint, "checkpoint", tables::of_checkpoint, *results.checkpoint).write();
  }
}

}  // namespace

bool Results::has_devices() const {
  return !devices.empty() || std::ranges::any_of(structures, [](const StructureHistory& s) {
    return std::ranges::any_of(s.springs.laws, [](const std::string& law) { return law.ends_with("damper"); });
  });
}

void visit_histories(Results& results,
                     const std::function<void(const std::string& path, std::vector<double>& values)>& visit) {
  tables::visit_histories(tables::of_results, results, "", visit);
  const auto visit_each = [&](const char* group, const auto& table, auto& objects) {
    for (auto& object : objects)
      tables::visit_histories(table, object, fmt::format("{}/{}/", group, object.name), visit);
  };
  visit_each("structures", tables::of_structure, results.structures);
  visit_each("links", tables::of_link, results.links);
  visit_each("devices", tables::of_device, results.devices);
}

FileImage results_image(const Results& results) {
  return hdf5::checked_image([&](hid_t file) {
    write_content(file, results);
    if (results.add_no_pounding) results.add_no_pounding(file);
  });
}

std::function<void(std::int64_t file)> group_without_links(std::shared_ptr<const Results> results) {
  return [results = std::move(results)](std::int64_t file) {
    const Handle place = group(file, without_links_group);
    write_content(place, *results);
    checked(H5Ldelete(place, "input", H5P_DEFAULT), "delete the input");  // that of the enclosing file
  };
}

void write_results(const Results& results, const std::string& path) {
  ReplacedFile(path).replace(results_image(results));
}

}  // namespace pounding
