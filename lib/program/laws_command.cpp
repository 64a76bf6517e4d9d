#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/laws/compiled.hpp>
#include "commands.hpp"
#include "hysteresis_text.hpp"

namespace pounding::program {
namespace {

constexpr int tenths = 9;  // restitutions 0.1 ... 0.9

/// Restitution obtained with a formula for a target restitution and typical values of the law; nullopt if the formula
/// has no value.
std::optional<double> obtained(const laws::Entry& entry, std::string_view formula, double restitution) {
  laws::Settings settings = laws::typical_settings(entry);
  settings.formula = formula;
  settings.restitution = restitution;
  try {
    return laws::free_impact(laws::make_law(settings), laws::typical_reduced_mass, laws::typical_closing_speed)
        .restitution;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

nlohmann::json law_json(const laws::Entry& entry) {
  nlohmann::json law = table_json(entry);
  law.update({{"restitution", entry.takes_restitution},
              {"impact_velocity", entry.takes_impact_velocity},
              {"reduced_mass", entry.takes_reduced_mass},
              {"may_pull", entry.may_pull},
              {"leaves_indentation", entry.leaves_indentation},
              {"instantaneous", entry.instantaneous},
              {"sticks_at_zero", entry.sticks_at_zero}});
  law["formulas"] = nlohmann::json::array();
  for (const laws::Formula& f : entry.formulas)
    law["formulas"].push_back({{"name", f.name}, {"equation", f.equation}, {"source", f.source}, {"note", f.note}});
  return law;
}

nlohmann::json law_json_with_table(const laws::Entry& entry) {
  nlohmann::json law = law_json(entry);
  for (nlohmann::json& formula : law["formulas"]) {
    formula["obtained"] = nlohmann::json::array();
    for (int i = 1; i <= tenths; ++i) {
      const auto e = obtained(entry, formula["name"].get<std::string>(), 0.1 * i);
      formula["obtained"].push_back({{"asked", i / 10.0}, {"obtained", e ? nlohmann::json(*e) : nlohmann::json()}});
    }
  }
  return law;
}

void print_all() {
  for (const laws::Entry& entry : laws::catalogue()) fmt::print("{:<30}{}\n", entry.name, entry.summary);
  fmt::print("\nHysteretic laws of storeys, hinges and isolators:\n\n");
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) fmt::print("{:<30}{}\n", entry.name, entry.summary);
  fmt::print(
      "\npounding laws NAME shows one law; for a hysteretic law, --path \"0, 3, -3, 1\" prints its loop as a table.\n");
}

void print_parameters(const laws::Entry& entry) {
  const auto line = [](std::string_view name, std::string_view unit, const std::string& typical,
                       std::string_view meaning, std::string_view need) {
    fmt::print("  {:<22}{:<14}{:>10}  {} ({})\n", name, unit, typical, meaning, need);
  };
  fmt::print("\n  {:<22}{:<14}{:>10}\n", "parameter", "unit", "typical");
  for (const laws::ParameterInfo& p : entry.parameters)
    line(p.name, p.unit, typical_text(p), p.meaning, need_text(p.need));
  if (entry.takes_restitution)
    line("restitution", "", fmt::format("{:g}", laws::typical_restitution),
         entry.sticks_at_zero ? "coefficient of restitution e, in [0, 1]" : "coefficient of restitution e, in (0, 1]",
         entry.direct_damping().empty() ? "required" : "or a direct damping value");
  if (entry.takes_impact_velocity)
    line("impact_velocity", "m/s", "", "fixed design velocity; default: the closing speed of each impact", "optional");
  if (entry.takes_reduced_mass)
    line("reduced_mass", "kg", "", "m1 m2/(m1+m2) of the linked floors", "computed by the link");
}

void print_formulas(const laws::Entry& entry) {
  fmt::print("\nObtained restitution (typical values, closing speed {:g} m/s)\n\n  {:<24}", laws::typical_closing_speed,
             "asked");
  for (int i = 1; i <= tenths; ++i) fmt::print("{:>8.1f}", 0.1 * i);
  fmt::print("\n");
  for (const laws::Formula& f : entry.formulas) {
    fmt::print("  {:<24}", f.name);
    for (int i = 1; i <= tenths; ++i) {
      const auto e = obtained(entry, f.name, 0.1 * i);
      fmt::print("{:>8}", e ? fmt::format("{:.4f}", *e) : "-");
    }
    fmt::print("\n");
  }
  fmt::print("\n");
  for (const laws::Formula& f : entry.formulas)
    fmt::print("  {:<24}{}\n  {:<24}{}; {}\n", f.name, f.equation, "", f.source, f.note);
}

void print_law(const laws::Entry& entry) {
  fmt::print("{}: {}\n\n  {}\n\n", entry.name, entry.summary, entry.shape);
  fmt::print("With {}.\nRange: {}.\nBeware: {}.\nSource: {}\n", entry.symbols, entry.range, entry.beware, entry.source);
  print_parameters(entry);
  if (!entry.formulas.empty()) print_formulas(entry);
}

/// True if an unknown name is similar to that of a hysteretic law but to no contact law.
bool is_meant_to_yield(std::string_view name) {
  return nearest_name(name, laws::names(laws::catalogue())).empty() &&
         !nearest_name(name, laws::names(hysteresis::catalogue())).empty();
}

}  // namespace

void add_laws(CLI::App& app) {
  struct Arguments {
    std::string name, path;
    int points = 1;
    bool json = false, yielding = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "laws", "Contact laws and hysteretic laws: formulas, parameters, obtained restitutions and loops");
  command->add_option("NAME", arguments->name, "One law in detail");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->add_flag("--yielding", arguments->yielding,
                    "Hysteretic laws only: with --json and no NAME, or with a NAME that a contact law also has");
  command->add_option(
      "--path", arguments->path,
      "Loop of a hysteretic law with typical parameters, through these turning points in yield deformations");
  command->add_option("--points", arguments->points, "Points per segment of the loop; 1 for the turning points only")
      ->check(CLI::Range(1, 100000));
  command->callback([arguments] {
    if (!arguments->path.empty() && arguments->name.empty())
      throw std::invalid_argument("--path: type the NAME of a hysteretic law");
    if (arguments->name.empty() && !arguments->json) return print_all();
    if (arguments->name.empty()) {
      nlohmann::json list = nlohmann::json::array();
      if (arguments->yielding)
        for (const hysteresis::Entry& entry : hysteresis::catalogue()) list.push_back(law_json(entry));
      else
        for (const laws::Entry& entry : laws::catalogue()) list.push_back(law_json(entry));
      return fmt::print("{}\n", list.dump(2));
    }
    for (const hysteresis::Entry& entry : hysteresis::catalogue()) {
      if (entry.name != arguments->name) continue;
      const bool is_contact_law_too =
          std::ranges::find(laws::catalogue(), entry.name, &laws::Entry::name) != laws::catalogue().end();
      if (is_contact_law_too && !arguments->yielding && arguments->path.empty()) break;
      if (!arguments->path.empty())
        return print_loop(entry, read_path(arguments->path), arguments->points, arguments->json);
      return arguments->json ? fmt::print("{}\n", law_json(entry).dump(2)) : print_law(entry);
    }
    if (is_meant_to_yield(arguments->name)) hysteresis::find_law(arguments->name);
    const laws::Entry& entry = laws::find_law(arguments->name);
    if (!arguments->path.empty())
      throw std::invalid_argument("--path: " + arguments->name +
                                  " is a contact law; type the NAME of a hysteretic law");
    if (arguments->json) return fmt::print("{}\n", law_json_with_table(entry).dump(2));
    print_law(entry);
  });
}

}  // namespace pounding::program
