/// A pushover as text and as JSON.

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <pounding/core/units.hpp>
#include <pounding/pushover/pushover.hpp>

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

std::string_view word(PushEvent::Kind kind) {
  constexpr std::string_view words[] = {"softens", "yields", "unloads"};
  return words[static_cast<int>(kind)];
}

// Events of one kind at one point, of several parts.
struct Happening {
  int point;
  PushEvent::Kind kind;
  bool is_first;
  std::vector<int> parts;
};

std::vector<Happening> happenings_of(const PushPath& path) {
  std::vector<Happening> rows;
  for (const PushEvent& event : path.events) {
    if (rows.empty() || rows.back().point != event.point || rows.back().kind != event.kind ||
        rows.back().is_first != event.is_first)
      rows.push_back({event.point, event.kind, event.is_first, {}});
    rows.back().parts.push_back(event.part);
  }
  return rows;
}

std::vector<std::string> names_of(const Pushover& found, const std::vector<int>& parts) {
  std::vector<std::string> names;
  for (const int part : parts) names.push_back(found.parts[part].name);
  return names;
}

// Names with both ends of a member as one: "beam 1.1 both ends", in the order of the first of them.
std::vector<std::string> grouped(const std::vector<std::string>& names) {
  constexpr std::string_view start = " start", end = " end";
  const auto has = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  std::vector<std::string> groups;
  for (const std::string& name : names) {
    const bool at_start = name.ends_with(start), at_end = name.ends_with(end);
    const std::string member = name.substr(0, name.size() - (at_start ? start.size() : at_end ? end.size() : 0));
    const bool both = (at_start || at_end) && has(member + std::string(start)) && has(member + std::string(end));
    const std::string group = both ? member + " both ends" : name;
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  return groups;
}

// A list with commas in indented lines of at most 110 characters, except for longer names.
std::string wrapped(const std::vector<std::string>& items, std::size_t indent) {
  constexpr std::size_t width = 110;
  std::string text, line(indent, ' ');
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    if (line.size() > indent && line.size() + 1 + item.size() > width) {
      text += line + '\n';
      line.assign(indent, ' ');
    }
    line += (line.size() > indent ? " " : "") + item;
  }
  return text + line + '\n';
}

std::string point_text(const PushPoint& point) {
  return fmt::format("{:.4f} mm, {:.4f} kN", 1e3 * point.displacement, point.factor / 1e3);
}

std::string events_table(const Pushover& found) {
  std::string text = " no.  displacement    base shear  events\n              (mm)          (kN)\n";
  int number = 0;
  for (const Happening& row : happenings_of(found.path)) {
    const PushPoint& point = found.path.points[row.point];
    text += fmt::format("{:>4}{:14.4f}{:14.4f}  {}: {}{}\n", ++number, 1e3 * point.displacement, point.factor / 1e3,
                        word(row.kind), fmt::join(names_of(found, row.parts), ", "),
                        row.kind == PushEvent::Kind::yields && !row.is_first ? ", again" : "");
  }
  const PushPoint& last = found.path.points.back();
  return text + fmt::format(" end{:14.4f}{:14.4f}\n", 1e3 * last.displacement, last.factor / 1e3);
}

std::string parts_table(const Pushover& found) {
  std::string text =
      "\npart                      ductility       plastic\n                                  (mm, mrad)\n";
  for (int j = 0; j < static_cast<int>(found.parts.size()); ++j)
    if (found.parts[j].stiffness > 0)  // a damper does not act
      text += fmt::format("{:<24}{:11.4f}{:14.4f}\n", found.parts[j].name, found.ductility(j),
                          1e3 * found.plastic_deformation(j));
  return text;
}

std::string summary_text(const Pushover& found) {
  std::string text;
  if (found.path.mechanism)
    text += fmt::format("mechanism     at {}:\n{}", point_text(found.path.points[*found.path.mechanism]),
                        wrapped(grouped(names_of(found, found.path.mechanism_parts)), 14));
  else
    text += "mechanism     none up to the last displacement\n";
  text += fmt::format(
      "overstrength  {}{:.4f} at the largest base shear, over that at the first yield\n",
      found.path.mechanism ? fmt::format("{:.4f} at the mechanism, ", found.overstrength(*found.path.mechanism)) : "",
      found.overstrength(found.strongest()));
  if (found.bilinear)
    text += fmt::format(
        "two lines     yield at {:.4f} mm, {:.4f} kN; level to {:.4f} mm: ductility {:.4f} (EN 1998-1, annex B)\n",
        1e3 * found.bilinear->yield_displacement, found.bilinear->base_shear / 1e3, 1e3 * found.bilinear->displacement,
        found.bilinear->displacement / found.bilinear->yield_displacement);
  if (found.equivalent)
    text += fmt::format("oscillator    m* {:.6g} t, Gamma {:.5f}, T* {:.6f} s\n", found.equivalent->mass / 1e3,
                        found.equivalent->participation, found.equivalent->period);
  return text;
}

std::string ways_text(const Pushover& found) {
  std::vector<std::string> ways;
  for (const double target : found.options.targets)
    ways.push_back(format_quantity(target, dimension::length, 6) +
                   (std::isnan(found.height) ? "" : fmt::format(" ({:.4g} %)", 100 * target / found.height)));
  return fmt::format("{}", fmt::join(ways, ", "));
}

Json point_json(const Pushover& found, int number) {
  const PushPoint& point = found.path.points[number];
  return {{"point", number}, {"displacement", point.displacement}, {"base_shear", point.factor}};
}

Json events_json(const Pushover& found) {
  Json events = Json::array();
  for (const Happening& row : happenings_of(found.path)) {
    Json event = point_json(found, row.point);
    event["kind"] = word(row.kind);
    event["first"] = row.is_first;
    event["parts"] = names_of(found, row.parts);
    events.push_back(std::move(event));
  }
  return events;
}

Json points_json(const Pushover& found) {
  Json columns;
  for (int i = 0; i < static_cast<int>(found.path.points.size()); ++i) {
    const PushPoint& point = found.path.points[i];
    const auto row = found.floor_displacements.row(i);
    std::vector<double> forces;
    for (int j = 0; j < static_cast<int>(found.parts.size()); ++j) forces.push_back(found.force(i, j));
    columns["displacement"].push_back(point.displacement);
    columns["base_shear"].push_back(point.factor);
    columns["floor_displacement"].push_back(std::vector<double>(row.begin(), row.end()));
    columns["deformation"].push_back(std::vector<double>(point.deformations.begin(), point.deformations.end()));
    columns["force"].push_back(forces);
  }
  return columns;
}

Json parts_json(const Pushover& found) {
  Json parts = Json::array();
  for (int j = 0; j < static_cast<int>(found.parts.size()); ++j) {
    const Pushover::Part& part = found.parts[j];
    parts.push_back({{"name", part.name},
                     {"law", part.law},
                     {"stiffness", part.stiffness},
                     {"yield_deformation", part.yield_deformation},
                     {"ductility", found.ductility(j)},
                     {"plastic_deformation", found.plastic_deformation(j)}});
  }
  return parts;
}

}  // namespace

std::string pushover_table(const Pushover& found) {
  std::string text = fmt::format("pushover of {} along {}, {} load on {} floor{}, roof to {}\n\n", found.structure,
                                 found.options.direction == 0 ? "x" : "y", name_of(found.options.pattern),
                                 found.floors.size(), found.floors.size() == 1 ? "" : "s", ways_text(found));
  text += events_table(found);
  if (!found.path.collapse.empty()) text += fmt::format("collapse      {}\n", found.path.collapse);
  return text + "\n" + summary_text(found) + parts_table(found);
}

std::string pushover_json(const Pushover& found, bool with_points) {
  Json all{{"status", found.path.collapse.empty() ? "done" : "collapse: " + found.path.collapse},
           {"structure", found.structure},
           {"direction", found.options.direction == 0 ? "x" : "y"},
           {"load", name_of(found.options.pattern)},
           {"targets", found.options.targets},
           {"height", found.height},
           {"floors", found.floors},
           {"floor_loads", found.loads},
           {"events", events_json(found)},
           {"mechanism", nullptr},
           {"first_yield", nullptr},
           {"largest", point_json(found, found.strongest())},
           {"overstrength", {{"mechanism", nullptr}, {"largest", found.overstrength(found.strongest())}}},
           {"bilinear", nullptr},
           {"equivalent", nullptr},
           {"parts", parts_json(found)}};
  if (with_points) all["points"] = points_json(found);
  if (found.path.mechanism) {
    all["mechanism"] = point_json(found, *found.path.mechanism);
    all["mechanism"]["parts"] = names_of(found, found.path.mechanism_parts);
    all["overstrength"]["mechanism"] = found.overstrength(*found.path.mechanism);
  }
  if (const auto first = found.first_yield()) all["first_yield"] = point_json(found, *first);
  if (found.bilinear)
    all["bilinear"] = {{"yield_displacement", found.bilinear->yield_displacement},
                       {"base_shear", found.bilinear->base_shear},
                       {"displacement", found.bilinear->displacement}};
  if (found.equivalent)
    all["equivalent"] = {{"mass", found.equivalent->mass},
                         {"participation", found.equivalent->participation},
                         {"period", found.equivalent->period}};
  return all.dump();
}

}  // namespace pounding
