#include <pounding/results/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pounding {
namespace {

using ComparisonJson = nlohmann::ordered_json;

// Forces below this fraction of the largest one of their component are round-off.
constexpr double round_off = 1e-9;

// A peak of a floor or storey in both runs.
struct FloorComparison {
  std::size_t floor = 0;  // from 1 at the lowest
  std::string direction;  // of a storey shear in space: x or y; empty for a length of a vector
  WithWithout peak;
};

std::vector<FloorComparison> compare_floors(const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<FloorComparison> all;
  for (std::size_t i = 0; i < std::min(with.size(), without.size()); ++i)
    all.push_back({i + 1, "", {with[i], without[i]}});
  return all;
}

std::vector<FloorComparison> compare_shears(const StructureSummary& with, const StructureSummary& without) {
  const Extremes &a = with.envelope.storey_shear, &b = without.envelope.storey_shear;
  const std::size_t directions = with.directions.size() > 1 ? 2 : 1;
  std::vector<FloorComparison> all;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    all.push_back({i / directions + 1, directions == 1 ? "" : std::string(1, "xy"[i % 2]), {a.peak(i), b.peak(i)}});
  return all;
}

// Largest first; values that are not numbers last, and equal ones in their order.
template <class Row, class Value>
std::vector<Row> largest(std::vector<Row> rows, const Value& value) {
  const auto key = [&](const Row& row) {
    const double number = value(row);
    return std::isnan(number) ? -std::numeric_limits<double>::infinity() : number;
  };
  std::ranges::stable_sort(rows, std::ranges::greater{}, key);
  if (rows.size() > worst_count) rows.erase(rows.begin() + worst_count, rows.end());
  return rows;
}

// A run that ended early has no comparable peaks.
bool both_complete(const Summary& summary) {
  return summary.status == "done" && summary.without_links_status == "done";
}

ComparisonJson pair_json(const WithWithout& pair, bool comparable) {
  return {{"with", pair.with},
          {"without", pair.without},
          {"ratio", comparable ? ComparisonJson(pair.ratio()) : ComparisonJson(nullptr)}};
}

ComparisonJson floors_json(const std::vector<FloorComparison>& floors, bool comparable) {
  ComparisonJson all = ComparisonJson::array();
  for (const FloorComparison& one : floors) {
    ComparisonJson row{{"floor", one.floor}};
    if (!one.direction.empty()) row["direction"] = one.direction;
    row.update(pair_json(one.peak, comparable));
    all.push_back(std::move(row));
  }
  return all;
}

ComparisonJson members_json(const std::vector<MemberComparison>& members, bool comparable) {
  ComparisonJson all = ComparisonJson::array();
  for (const MemberComparison& one : members) {
    ComparisonJson row{{"member", one.member}, {"component", one.component}};
    row.update(pair_json(one.force, comparable));
    row["demand"] = one.demand;
    all.push_back(std::move(row));
  }
  return all;
}

ComparisonJson parts_json(const std::vector<PartComparison>& parts, bool comparable) {
  ComparisonJson all = ComparisonJson::array();
  for (const PartComparison& one : parts)
    all.push_back({{"part", one.part},
                   {"hinge", one.is_hinge},
                   {"ductility", pair_json(one.ductility, comparable)},
                   {"plastic", pair_json(one.plastic, comparable)}});
  return all;
}

std::string shown_ratio(const WithWithout& pair, bool comparable) {
  return comparable && std::isfinite(pair.ratio()) ? fmt::format("{:.3f}", pair.ratio()) : "-";
}

// Columns of a pair: with, without, ratio.
std::string pair_text(const WithWithout& pair, double scale, int digits, bool comparable) {
  return fmt::format("  {:>10.{}f}  {:>10.{}f}  {:>6}", scale * pair.with, digits, scale * pair.without, digits,
                     shown_ratio(pair, comparable));
}

std::string floors_text(const Summary& summary, std::size_t width, bool comparable) {
  std::string text, rows;
  for (std::size_t k = 0; k < summary.structures.size(); ++k) {
    const StructureSummary &with = summary.structures[k], &without = summary.without_pounding[k];
    const auto drifts = compare_floors(with.peak_drift, without.peak_drift);
    const auto accelerations = compare_floors(with.peak_acceleration, without.peak_acceleration);
    const auto shears = compare_shears(with, without);
    const std::size_t directions = with.directions.size() > 1 ? 2 : 1;
    for (std::size_t i = accelerations.size(); i-- > 0;) {
      rows += fmt::format("{:<{}}  {:>5}", with.name, width, i + 1);
      rows += i < drifts.size() ? pair_text(drifts[i].peak, 1e3, 4, comparable) : fmt::format("{:>32}", "-");
      rows += pair_text(accelerations[i].peak, 1, 4, comparable);
      // In space the larger of the two directions.
      const std::size_t at = i * directions;
      if (at < shears.size()) {
        const bool second = directions == 2 && shears[at + 1].peak.with > shears[at].peak.with;
        const FloorComparison& shear = shears[at + (second ? 1 : 0)];
        rows += pair_text(shear.peak, 1e-3, 3, comparable);
        if (!shear.direction.empty()) rows += "  " + shear.direction;
      } else {
        rows += fmt::format("{:>32}", "-");
      }
      rows += '\n';
    }
  }
  if (rows.empty()) return {};
  text = fmt::format("{:<{}}  floor{:>32}{:>32}{:>32}\n", "structure", width, "drift (mm)", "acceleration (m/s^2)",
                     "storey shear (kN)");
  text += fmt::format("{:<{}}       ", "", width);
  for (int i = 0; i < 3; ++i) text += fmt::format("  {:>10}  {:>10}  {:>6}", "with", "without", "ratio");
  return text + '\n' + rows;
}

// A name of a structure and rows of one of its rankings.
template <class Row>
using Ranked = std::vector<std::pair<std::string, Row>>;

// The worst of all structures.
template <class Row, class Compare, class Rank>
Ranked<Row> ranked(const Summary& summary, const Compare& compare, const Rank& rank,
                   const std::function<double(const Row&)>& value) {
  Ranked<Row> all;
  for (std::size_t k = 0; k < summary.structures.size(); ++k)
    for (const Row& row : rank(compare(summary.structures[k], summary.without_pounding[k])))
      all.emplace_back(summary.structures[k].name, row);
  return largest(std::move(all), [&](const std::pair<std::string, Row>& one) { return value(one.second); });
}

std::string members_text(const Ranked<MemberComparison>& rows, const char* heading, std::size_t width,
                         std::size_t name_width, bool comparable) {
  if (rows.empty()) return {};
  std::string text = fmt::format("{:<{}}  {:<{}}  {:<10}  {:>10}  {:>10}  {:>6}  {}\n", "structure", width, "member",
                                 name_width, "force", "with", "without", "ratio", heading);
  for (const auto& [structure, row] : rows) {
    const bool moment = row.component[0] == 'M' || row.component[0] == 'T';
    text += fmt::format("{:<{}}  {:<{}}  {:<10}{}\n", structure, width, row.member, name_width,
                        row.component + (moment ? " (kN m)" : " (kN)"), pair_text(row.force, 1e-3, 3, comparable));
  }
  return text;
}

std::string parts_text(const Ranked<PartComparison>& rows, const char* heading, std::size_t width,
                       std::size_t name_width, bool comparable) {
  if (rows.empty()) return {};
  std::string text = fmt::format("{:<{}}  {:<{}}{:>32}{:>32}  {}\n", "structure", width, "part", name_width,
                                 "ductility", "plastic (mm, mrad)", heading) +
                     fmt::format("{:<{}}  {:<{}}", "", width, "", name_width);
  for (int i = 0; i < 2; ++i) text += fmt::format("  {:>10}  {:>10}  {:>6}", "with", "without", "ratio");
  text += '\n';
  for (const auto& [structure, row] : rows)
    text += fmt::format("{:<{}}  {:<{}}{}{}\n", structure, width, row.part, name_width,
                        pair_text(row.ductility, 1, 3, comparable), pair_text(row.plastic, 1e3, 4, comparable));
  return text;
}

}  // namespace

std::vector<MemberComparison> compare_members(const StructureSummary& with, const StructureSummary& without) {
  const StructureEnvelope& e = with.envelope;
  const std::size_t components = e.components.size();
  std::vector<MemberComparison> all;
  if (e.member_force.size() == 0 || without.envelope.member_force.size() != e.member_force.size()) return all;
  std::map<std::string, double> peaks;
  for (std::size_t m = 0; m < e.members.size(); ++m) {
    const std::size_t first = all.size();
    for (std::size_t c = 0; c < components; ++c) {
      const std::string component = e.components[c].substr(e.components[c].find(' ') + 1);
      const std::size_t i = m * components + c;
      auto row = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                              [&](const MemberComparison& one) { return one.component == component; });
      if (row == all.end()) row = all.insert(all.end(), {e.members[m], component, {}, 0});
      row->force.with = std::max(row->force.with, e.member_force.peak(i));
      row->force.without = std::max(row->force.without, without.envelope.member_force.peak(i));
      peaks[component] = std::max(peaks[component], row->force.with);
    }
  }
  for (MemberComparison& row : all) row.demand = peaks[row.component] > 0 ? row.force.with / peaks[row.component] : 0;
  std::erase_if(all, [](const MemberComparison& row) { return row.demand < round_off; });
  return all;
}

std::vector<PartComparison> compare_parts(const StructureSummary& with, const StructureSummary& without) {
  std::vector<PartComparison> all;
  for (std::size_t i = 0; i < std::min(with.springs.size(), without.springs.size()); ++i) {
    const SpringSummary &a = with.springs[i], &b = without.springs[i];
    all.push_back({a.name, a.is_hinge, {a.ductility, b.ductility}, {a.plastic, b.plastic}});
  }
  return all;
}

std::vector<MemberComparison> worst_by_ratio(std::vector<MemberComparison> members) {
  std::erase_if(members, [](const MemberComparison& row) {
    return row.demand < min_ranked_demand || std::isnan(row.force.ratio());
  });
  return largest(std::move(members), [](const MemberComparison& row) { return row.force.ratio(); });
}

std::vector<PartComparison> worst_by_ratio(std::vector<PartComparison> parts) {
  std::erase_if(
      parts, [](const PartComparison& row) { return !(row.ductility.with > 1) || std::isnan(row.ductility.ratio()); });
  return largest(std::move(parts), [](const PartComparison& row) { return row.ductility.ratio(); });
}

std::vector<MemberComparison> worst_by_demand(std::vector<MemberComparison> members) {
  return largest(std::move(members), [](const MemberComparison& row) { return row.demand; });
}

std::vector<PartComparison> worst_by_demand(std::vector<PartComparison> parts) {
  return largest(std::move(parts), [](const PartComparison& row) { return row.ductility.with; });
}

ComparisonJson comparison_json(const Summary& summary) {
  const bool comparable = both_complete(summary);
  ComparisonJson all = ComparisonJson::object();
  for (std::size_t k = 0; k < summary.structures.size(); ++k) {
    const StructureSummary &with = summary.structures[k], &without = summary.without_pounding[k];
    ComparisonJson& one = all[with.name] = ComparisonJson::object();
    one["drift"] = floors_json(compare_floors(with.peak_drift, without.peak_drift), comparable);
    one["acceleration"] = floors_json(compare_floors(with.peak_acceleration, without.peak_acceleration), comparable);
    one["storey_shear"] = floors_json(compare_shears(with, without), comparable);
    if (const auto members = compare_members(with, without); !members.empty())
      one["members"] = {{"by_ratio", members_json(worst_by_ratio(members), comparable)},
                        {"by_demand", members_json(worst_by_demand(members), comparable)}};
    if (const auto parts = compare_parts(with, without); !parts.empty())
      one["hinges"] = {{"by_ratio", parts_json(worst_by_ratio(parts), comparable)},
                       {"by_demand", parts_json(worst_by_demand(parts), comparable)}};
  }
  return all;
}

std::string comparison_table(const Summary& summary) {
  if (summary.without_pounding.empty()) return {};
  const bool comparable = both_complete(summary);
  std::size_t width = 9, member_width = 6, part_width = 4;
  for (const StructureSummary& s : summary.structures) {
    width = std::max(width, s.name.size());
    for (const std::string& member : s.envelope.members) member_width = std::max(member_width, member.size());
    for (const SpringSummary& part : s.springs) part_width = std::max(part_width, part.name.size());
  }
  const auto by_ratio = [](auto rows) { return worst_by_ratio(std::move(rows)); };
  const auto by_demand = [](auto rows) { return worst_by_demand(std::move(rows)); };
  std::vector<std::string> tables{floors_text(summary, width, comparable)};
  if (comparable)
    tables.push_back(
        members_text(ranked<MemberComparison>(summary, compare_members, by_ratio,
                                              [](const MemberComparison& row) { return row.force.ratio(); }),
                     "largest ratios", width, member_width, comparable));
  tables.push_back(members_text(ranked<MemberComparison>(summary, compare_members, by_demand,
                                                         [](const MemberComparison& row) { return row.demand; }),
                                "largest forces", width, member_width, comparable));
  if (comparable)
    tables.push_back(parts_text(ranked<PartComparison>(summary, compare_parts, by_ratio,
                                                       [](const PartComparison& row) { return row.ductility.ratio(); }),
                                "largest ratios", width, part_width, comparable));
  tables.push_back(parts_text(ranked<PartComparison>(summary, compare_parts, by_demand,
                                                     [](const PartComparison& row) { return row.ductility.with; }),
                              "largest ductilities", width, part_width, comparable));
  std::erase(tables, "");
  return fmt::format("{}", fmt::join(tables, "\n"));
}

}  // namespace pounding
