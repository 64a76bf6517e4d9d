#include <pounding/results/pushover_file.hpp>

#include <vector>

#include <pounding/core/version.hpp>
#include <pounding/results/hdf5.hpp>
#include <pounding/results/replaced_file.hpp>

namespace pounding {
namespace {

using namespace hdf5;

void write_points(hid_t place, const Pushover& found) {
  const hsize_t count = found.path.points.size(), floors = found.floors.size(), parts = found.parts.size();
  std::vector<double> roof, shear, displacements, deformations, forces;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const PushPoint& point = found.path.points[i];
    const auto row = found.floor_displacements.row(i);
    roof.push_back(point.displacement);
    shear.push_back(point.factor);
    displacements.insert(displacements.end(), row.begin(), row.end());
    deformations.insert(deformations.end(), point.deformations.begin(), point.deformations.end());
    for (int j = 0; j < static_cast<int>(parts); ++j) forces.push_back(found.force(i, j));
  }
  array(place, {"displacement", "m", "displacement of the roof at the points of the path"}, roof, {count});
  array(place, {"base_shear", "N", "base shear"}, shear, {count});
  array(place, {"floor_displacement", "m", "displacement of each floor, from the ground up"}, displacements,
        {count, floors});
  array(place, {"deformation", "m or rad", "deformation of each part that yields"}, deformations, {count, parts});
  array(place, {"force", "N or N m", "force of each part that yields"}, forces, {count, parts});
}

void write_events(hid_t parent, const Pushover& found) {
  const Handle place = group(parent, "events");
  std::vector<int> points, parts, kinds, firsts;
  for (const PushEvent& event : found.path.events) {
    points.push_back(event.point);
    parts.push_back(event.part);
    kinds.push_back(static_cast<int>(event.kind));
    firsts.push_back(event.is_first);
  }
  integers(place, {"point", "1", "number of the point, from 0"}, points, {points.size()});
  integers(place, {"part", "1", "number of the part, from 0"}, parts, {parts.size()});
  integers(place, {"kind", "1", "0 softens, 1 yields, 2 unloads"}, kinds, {kinds.size()});
  integers(place, {"first", "1", "1 if the part had never yielded before"}, firsts, {firsts.size()});
}

void write_all(hid_t file, const Pushover& found, const std::string& model_text) {
  attribute(file, "program", std::string("pounding"));
  attribute(file, "version", std::string(POUNDING_VERSION));
  attribute(file, "content", std::string("pushover"));
  const Handle input = group(file, "input");
  text(input, "model.yaml", "input as given", model_text);
  const Handle place = group(file, "pushover");
  attribute(place, "structure", found.structure);
  attribute(place, "status", found.path.collapse.empty() ? std::string("done") : "collapse: " + found.path.collapse);
  texts(place, "floors", "labels of the floors, from the ground up", found.floors);
  std::vector<std::string> names;
  for (const Pushover::Part& part : found.parts) names.push_back(part.name);
  texts(place, "parts", "names of the parts that yield", names);
  array(place, {"floor_loads", "1", "share of each floor in the load"}, found.loads, {found.loads.size()});
  write_points(place, found);
  write_events(place, found);
  text(place, "summary", "what pounding pushover --json prints, without the points", pushover_json(found, false));
}

}  // namespace

void write_pushover(const std::string& path, const Pushover& found, const std::string& model_text) {
  ReplacedFile(path).replace(hdf5::checked_image([&](hid_t file) { write_all(file, found, model_text); }));
}

}  // namespace pounding
