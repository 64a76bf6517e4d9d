#include <pounding/reports/yielding_report.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <pounding/core/units.hpp>
#include <pounding/structures/storey_heights.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// One end of a column.
struct ColumnEnd {
  std::string name;   // like that of a hinge there
  double sags, hogs;  // yield moments [N m]; 0 if pinned, NaN if elastic
};

// A member from joint to joint, including all its segments.
struct Column {
  int first, last;  // members of the frame
};

std::vector<Column> whole_members(const Structure& s) {
  std::vector<Column> all;
  std::string before;
  for (int member = 0; member < static_cast<int>(s.geometry.member_names.size()); ++member) {
    const std::string& name = s.geometry.member_names[member];
    const std::string whole = name.substr(0, name.find('/'));
    if (all.empty() || whole != before) all.push_back({member, member});
    all.back().last = member;
    before = whole;
  }
  return all;
}

ColumnEnd end_of(const Structure& s, int member, bool is_start) {
  ColumnEnd end{s.geometry.member_names[member] + (is_start ? " start" : " end"), none, none};
  const auto part = std::ranges::find(s.yielding, end.name, &YieldingPart::name);
  if (part != s.yielding.end() && part->hinge) return {end.name, part->hinge->sagging, part->hinge->hogging};
  const auto& components = s.forces.components;
  const auto place = std::ranges::find(components, is_start ? "start My" : "end My") - components.begin();
  const auto row = static_cast<Eigen::Index>(member * components.size() + place);
  const double largest = s.forces.rows.row(row).cwiseAbs().sum();
  if (largest == 0) end.sags = end.hogs = 0;
  return end;
}

// True if the member connects this floor to the level below; floors count from 0, the ground below the lowest is -1.
bool reaches(const Structure& s, const Column& column, int floor) {
  const auto& floors = s.geometry.floor_of_node;
  const int a = s.geometry.members[column.first][0], b = s.geometry.members[column.last][1];
  return std::max(floors[a], floors[b]) == floor && std::min(floors[a], floors[b]) < floor;
}

bool is_upright(const Structure& s, const Column& column) {
  const Eigen::Vector3d way = s.geometry.positions[s.geometry.members[column.last][1]] -
                              s.geometry.positions[s.geometry.members[column.first][0]];
  return std::hypot(way.x(), way.y()) < 1e-9 * way.norm();
}

StoreyMechanism mechanism_of(const Structure& s, int floor, double height) {
  StoreyMechanism found{s.floors[floor].label, none, ""};
  double one_way = 0, other_way = 0;
  for (const Column& column : whole_members(s)) {
    if (!reaches(s, column, floor)) continue;
    const ColumnEnd start = end_of(s, column.first, true), end = end_of(s, column.last, false);
    if (!is_upright(s, column)) found.elastic = s.geometry.member_names[column.first];
    for (const ColumnEnd& each : {start, end})
      if (std::isnan(each.sags) && found.elastic.empty()) found.elastic = each.name;
    // In double curvature one end sags while the other hogs.
    one_way += start.sags + end.hogs;
    other_way += start.hogs + end.sags;
  }
  if (found.elastic.empty()) found.shear = std::min(one_way, other_way) / height;
  return found;
}

// Groups of identical parts, in the order of their first members.
std::vector<std::vector<YieldingFacts>> alike(const std::vector<YieldingFacts>& facts) {
  std::vector<std::vector<YieldingFacts>> groups;
  const auto key = [](const YieldingFacts& f) {
    return fmt::format("{} {:.5g} {:.5g} {:.5g} {:.5g} {:.3g} {:.3g} {:.5g} {:.5g}", f.law, f.force, f.deformation,
                       f.stiffness, f.hardening, f.over_weight, f.at_rest, f.end_stiffness, f.end_tangent);
  };
  std::map<std::string, std::size_t> places;
  for (const YieldingFacts& one : facts) {
    const auto [place, is_new] = places.try_emplace(key(one), groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(one);
  }
  return groups;
}

// Tangents of member ends, one line for all hinges with the same value; moments at rest are irrelevant here.
std::string tangents_of(const std::vector<YieldingFacts>& facts) {
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const YieldingFacts& one : facts) {
    if (!one.is_hinge) continue;
    const std::string keeps = fmt::format(
        "after yielding at both ends in double curvature the end of the member keeps {:.4g} MN m/rad, {:.3g} % of "
        "{:.4g} MN m/rad",
        one.end_tangent / 1e6, 100 * one.end_tangent / one.end_stiffness, one.end_stiffness / 1e6);
    auto known = std::ranges::find(lines, keeps, &std::pair<std::string, std::vector<std::string>>::first);
    if (known == lines.end()) known = lines.insert(lines.end(), {keeps, {}});
    known->second.push_back(one.name);
  }
  std::string text;
  for (const auto& [keeps, names] : lines)
    text += fmt::format("{}{}: {}\n", names.front(),
                        names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "", keeps);
  return text;
}

std::string table_of(const Structure& s) {
  const std::vector<YieldingFacts> facts = yielding_facts(s);
  if (facts.empty()) return {};
  const bool turns = s.dimension > 1;
  std::string text =
      fmt::format("{:<14}  {:>12}  {:>12}  {:>12}  {:>7}  {:>8}  {}\n", s.name, turns ? "moment" : "yield force",
                  turns ? "rotation" : "drift", "k", "b", turns ? "at rest" : "/ weight", "yields");
  text += fmt::format("{:<14}  {:>12}  {:>12}  {:>12}  {:>7}  {:>8}\n", "", turns ? "(kN m)" : "(kN)",
                      turns ? "(mrad)" : "(mm)", turns ? "(MN m/rad)" : "(MN/m)", "", turns ? "(%)" : "");
  for (const std::vector<YieldingFacts>& group : alike(facts)) {
    const YieldingFacts& one = group.front();
    std::string names = one.name;
    if (group.size() > 1) names += fmt::format(" and {} more", group.size() - 1);
    const double last = turns ? 100 * one.at_rest : one.over_weight;
    text += fmt::format("{:<14}  {:>12.5g}  {:>12.4g}  {:>12.5g}  {:>7.4g}  {:>8}  {}\n", one.law, one.force / 1e3,
                        1e3 * one.deformation, one.stiffness / 1e6, one.hardening,
                        std::isnan(last) ? "-" : fmt::format("{:.3g}", last), names);
  }
  text += tangents_of(facts);
  const std::vector<StoreyMechanism> mechanisms = storey_mechanisms(s);
  const auto sways = [](const StoreyMechanism& one) { return one.elastic.empty(); };
  for (const StoreyMechanism& one : mechanisms)
    if (sways(one))
      text +=
          fmt::format("storey mechanism possible in storey {}, at a shear of {:.5g} kN\n", one.storey, one.shear / 1e3);
  if (!mechanisms.empty() && std::ranges::none_of(mechanisms, sways))
    text += fmt::format("no storey mechanism, as columns stay elastic; in storey {}: {}\n", mechanisms.front().storey,
                        mechanisms.front().elastic);
  return text;
}

}  // namespace

std::vector<YieldingFacts> yielding_facts(const Structure& s) {
  std::vector<YieldingFacts> all;
  const bool storeys = !s.storey_stiffness.empty();
  double carried = 0;
  for (const Floor& floor : s.floors) carried += floor.mass;
  for (std::size_t i = 0; i < s.yielding.size(); ++i) {
    const YieldingPart& part = s.yielding[i];
    YieldingFacts facts{.name = part.name, .law = part.law, .stiffness = part.stiffness() + part.first_slope()};
    if (facts.stiffness == 0) continue;  // a damper
    facts.is_hinge = part.kind == YieldingPart::Kind::hinge;
    facts.deformation = part.yield_deformation();
    facts.force = part.has_spring() ? part.spring().yield_force() : part.stiffness() * part.yield_deformation();
    facts.hardening =
        (part.is_device() ? 0 : 1) + slope_far_behind_yield(*part.element, part.direction) / facts.stiffness;
    facts.at_rest = std::abs(part.at_rest) / facts.deformation;
    if (part.hinge) {
      if (part.hinge->is_rigid_plastic) facts.law = "rigid-plastic";
      facts.end_stiffness = part.hinge->end_stiffness;
      facts.end_tangent = part.hinge->end_tangent;
    }
    if (storeys && !part.is_device()) {
      facts.over_weight = facts.force / (carried * standard_gravity);
      carried -= s.floors[i].mass;
    }
    all.push_back(std::move(facts));
  }
  return all;
}

std::vector<StoreyMechanism> storey_mechanisms(const Structure& s) {
  std::vector<StoreyMechanism> all;
  if (s.dimension != 2 || s.yielding.empty()) return all;
  const std::vector<double> heights = storey_heights(s);
  for (int i = 0; i < static_cast<int>(heights.size()); ++i) all.push_back(mechanism_of(s, i, heights[i]));
  return all;
}

std::string yielding_table(const Model& model) {
  std::string text;
  for (const Structure& s : model.structures)
    if (const std::string table = table_of(s); !table.empty()) text += (text.empty() ? "" : "\n") + table;
  return text;
}

std::string yielding_json(const Model& model) {
  Json all = Json::object();
  for (const Structure& s : model.structures) {
    if (s.yielding.empty()) continue;
    Json parts = Json::array(), mechanisms = Json::array();
    for (const YieldingFacts& one : yielding_facts(s))
      parts.push_back({{"name", one.name},
                       {"law", one.law},
                       {"hinge", one.is_hinge},
                       {"yield_force", one.force},
                       {"yield_deformation", one.deformation},
                       {"stiffness", one.stiffness},
                       {"hardening", one.hardening},
                       {"end_stiffness", one.end_stiffness},
                       {"end_tangent", one.end_tangent},
                       {"over_weight", one.over_weight},
                       {"at_rest", one.at_rest}});
    for (const StoreyMechanism& one : storey_mechanisms(s))
      mechanisms.push_back({{"storey", one.storey}, {"shear", one.shear}, {"elastic", one.elastic}});
    all[s.name] = {{"parts", std::move(parts)}, {"storey_mechanisms", std::move(mechanisms)}};
  }
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pounding
