#include <pounding/results/pushover_file.hpp>

#include <vector>

#include <pounding/core/version.hpp>
#include <pounding/results/replaced_file.hpp>
#include <pounding/results/table_writer.hpp>

namespace pounding {
namespace {

using namespace hdf5;

// One value per point, floor, part or event.
template <class List, class Of>
auto each(const List& list, const Of& of) {
  std::vector<decltype(of(list.front()))> values;
  for (const auto& one : list) values.push_back(of(one));
  return values;
}

template <auto member>
constexpr auto of_events = [](const Pushover& p) {
  return each(p.path.events, [](const PushEvent& event) { return static_cast<int>(event.*member); });
};

template <auto member>
constexpr auto of_points =
    [](const Pushover& p) { return each(p.path.points, [](const PushPoint& point) { return point.*member; }); };

std::vector<std::string> names_of_parts(const Pushover& p) {
  return each(p.parts, [](const Pushover::Part& part) { return part.name; });
}

// [point, part]
std::vector<double> deformations(const Pushover& p) {
  std::vector<double> values;
  for (const PushPoint& point : p.path.points)
    values.insert(values.end(), point.deformations.begin(), point.deformations.end());
  return values;
}

std::vector<double> forces(const Pushover& p) {
  std::vector<double> values;
  for (int i = 0; i < static_cast<int>(p.path.points.size()); ++i)
    for (int j = 0; j < static_cast<int>(p.parts.size()); ++j) values.push_back(p.force(i, j));
  return values;
}

std::vector<double> floor_displacements(const Pushover& p) {
  std::vector<double> values;
  for (const auto& row : p.floor_displacements.rowwise()) values.insert(values.end(), row.begin(), row.end());
  return values;
}

constexpr tables::Dimension<Pushover> dimensions[] = {
    {"point", [](const Pushover& p) { return p.path.points.size(); }},
    {"floor", tables::value<&Pushover::floors>},
    {"spring", names_of_parts},
    {"events/event", [](const Pushover& p) { return p.path.events.size(); }},
};

constexpr tables::Variable<Pushover> variables[] = {
    {"floors", "floor", "text", "labels of the floors, from the ground up", tables::value<&Pushover::floors>},
    {"parts", "spring", "text", "names of the parts that yield", names_of_parts},
    {"floor_loads", "floor", "1", "share of each floor in the load", tables::stored<&Pushover::loads>},
    {"displacement", "point", "m", "displacement of the roof at the points of the path",
     of_points<&PushPoint::displacement>},
    {"base_shear", "point", "N", "base shear", of_points<&PushPoint::factor>},
    {"floor_displacement", "point floor", "m", "displacement of each floor, from the ground up", floor_displacements},
    {"deformation", "point spring", "m or rad", "deformation of each part that yields", deformations},
    {"force", "point spring", "N or N m", "force of each part that yields", forces},
    {"events/point", "event", "1", "number of the point, from 0", of_events<&PushEvent::point>},
    {"events/part", "event", "1", "number of the part, from 0", of_events<&PushEvent::part>},
    {"events/kind", "event", "1", "0 softens, 1 yields, 2 unloads", of_events<&PushEvent::kind>},
    {"events/first", "event", "1", "1 if the part had never yielded before", of_events<&PushEvent::is_first>},
    {"summary", "", "text", "what pounding pushover --json prints, without the points",
     [](const Pushover& p) { return pushover_json(p, false); }},
};

constexpr tables::Table<Pushover> table{{}, dimensions, variables};

void write_all(hid_t file, const Pushover& found, const std::string& model_text) {
  attribute(file, "program", std::string("pounding"));
  attribute(file, "version", std::string(POUNDING_VERSION));
  attribute(file, "content", std::string("pushover"));
  write(group(file, "input"), {"model.yaml", "text", "input as given"}, {}, model_text);
  const Handle place = group(file, "pushover");
  attribute(place, "structure", found.structure);
  attribute(place, "status", found.path.collapse.empty() ? std::string("done") : "collapse: " + found.path.collapse);
  tables::TableWriter(place, "pushover", table, found).write();
}

}  // namespace

void write_pushover(const std::string& path, const Pushover& found, const std::string& model_text) {
  ReplacedFile(path).replace(hdf5::checked_image([&](hid_t file) { write_all(file, found, model_text); }));
}

}  // namespace pounding
