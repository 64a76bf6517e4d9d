#include "hysteresis_text.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/hysteresis/all.hpp>

namespace pounding::program {
namespace {

/// A point of a loop: deformation, force, work since the beginning, followed by the state variables.
using Point = std::vector<double>;

template <hysteresis::Law L>
std::vector<Point> loop(const L& law, const std::vector<double>& path, int between) {
  typename L::State kept;
  double work = 0;
  std::vector<Point> points;
  for (const double turn : path) {
    const double begin = kept.deformation, end = turn * law.yield_deformation();
    const int parts = points.empty() ? 1 : between;
    for (int part = 1; part <= parts; ++part) {
      const double d = part == parts ? end : begin + part * (end - begin) / parts;
      work += law.work(kept, d);
      Point point{d, law.respond(kept, d).force, work};
      kept = law.advance(kept, d);
      for (const auto& value : L::state) point.push_back(value.get(kept));
      points.push_back(std::move(point));
    }
  }
  return points;
}

}  // namespace

std::string_view need_text(laws::Need need) {
  switch (need) {
    case laws::Need::required: return "required";
    case laws::Need::optional: return "optional";
    case laws::Need::damping: return "instead of a restitution";
    case laws::Need::together: return "together, instead of all others";
    case laws::Need::instead: return "or others instead";
    case laws::Need::extra: return "may be left out";
  }
  return "";
}

nlohmann::json typical_json(const laws::ParameterInfo& parameter) {
  if (parameter.is_flag) return parameter.typical != 0;
  if (parameter.is_list()) return std::vector(parameter.typical_list.begin(), parameter.typical_list.end());
  return parameter.typical;
}

std::string typical_text(const laws::ParameterInfo& parameter) {
  if (parameter.is_flag) return parameter.typical != 0 ? "true" : "false";
  if (parameter.is_list()) return fmt::format("[{:g}]", fmt::join(parameter.typical_list, ", "));
  return fmt::format("{:g}", parameter.typical);
}

nlohmann::json law_json(const hysteresis::Entry& entry) {
  nlohmann::json law = table_json(entry);
  law["has_corners"] = entry.has_corners;
  law["choices"] = law["state"] = nlohmann::json::array();
  for (const hysteresis::ChoiceInfo& c : entry.choices)
    law["choices"].push_back({{"name", c.name},
                              {"meaning", c.meaning},
                              {"words", std::vector<std::string>(c.words.begin(), c.words.end())}});
  for (const hysteresis::StateInfo& s : entry.state)
    law["state"].push_back({{"name", s.name}, {"unit", s.unit}, {"meaning", s.meaning}});
  return law;
}

void print_law(const hysteresis::Entry& entry) {
  fmt::print("{}: {}\n\n  {}\n\n", entry.name, entry.summary, entry.shape);
  fmt::print(
      "With {}; d [m] deformation, f [N] force; for a hinge [rad] and [N m].\nRange: {}.\nBeware: {}.\nSource: {}\n",
      entry.symbols, entry.range, entry.beware, entry.source);
  fmt::print("\n  {:<22}{:<8}{:>10}\n", "parameter", "unit", "typical");
  for (const hysteresis::ParameterInfo& p : entry.parameters)
    fmt::print("  {:<22}{:<8}{:>10}  {} ({})\n", p.name, p.unit, typical_text(p), p.meaning, need_text(p.need));
  for (const hysteresis::ChoiceInfo& c : entry.choices)
    fmt::print("  {:<22}{:<8}{:>10}  {} ({})\n", c.name, "", c.words.front(), c.meaning, fmt::join(c.words, " or "));
}

std::vector<double> read_path(const std::string& text) {
  std::vector<double> path;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    std::string_view argument = rest.substr(0, end);
    while (!argument.empty() && argument.front() == ' ') argument.remove_prefix(1);
    while (!argument.empty() && argument.back() == ' ') argument.remove_suffix(1);
    double value = 0;
    const auto read = std::from_chars(argument.data(), argument.data() + argument.size(), value);
    if (read.ec != std::errc{} || read.ptr != argument.data() + argument.size() || !std::isfinite(value))
      throw std::invalid_argument("--path: type turning points in yield deformations such as \"0, 3, -3, 1\"; \"" +
                                  excerpt(argument) + "\" is not a number");
    path.push_back(value);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (path.empty())
    throw std::invalid_argument("--path: type turning points in yield deformations such as \"0, 3, -3, 1\"");
  return path;
}

void print_loop(const hysteresis::Entry& entry, const std::vector<double>& path, int between, bool json) {
  std::vector<std::string> columns{"deformation", "force", "work"}, units{"m", "N", "J"};
  for (const hysteresis::StateInfo& s : entry.state) {
    columns.emplace_back(s.name);
    units.emplace_back(s.unit);
  }
  const hysteresis::AnyLaw law = hysteresis::make_law(hysteresis::typical_settings(entry));
  const std::vector<Point> points = std::visit([&](const auto& chosen) { return loop(chosen, path, between); }, law);
  if (json)
    return fmt::print(
        "{}\n", nlohmann::json{{"law", entry.name}, {"columns", columns}, {"units", units}, {"rows", points}}.dump(2));
  for (std::size_t i = 0; i < columns.size(); ++i)
    fmt::print("{:>18}", units[i].empty() ? columns[i] : fmt::format("{} [{}]", columns[i], units[i]));
  fmt::print("\n");
  for (const Point& point : points) {
    for (const double value : point) fmt::print("{:>18.8g}", value);
    fmt::print("\n");
  }
}

}  // namespace pounding::program
