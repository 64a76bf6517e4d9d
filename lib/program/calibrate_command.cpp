#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/collision.hpp>
#include <pounding/laws/cyclic_calibration.hpp>
#include "commands.hpp"

namespace pounding::program {
namespace {

struct CalibrateArguments {
  CollisionInput collision;
  std::vector<std::string> parameters;  // NAME=VALUE
  bool json = false, cyclic = false;
};

CollisionInput collision_words(const CalibrateArguments& arguments) {
  CollisionInput collision = arguments.collision;
  collision.before_names = "--";
  for (const std::string& text : arguments.parameters) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw InputError(fmt::format("--parameter {}: type NAME=VALUE", excerpt(text)));
    collision.parameters.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return collision;
}

std::string quantity_header(const laws::Quantity& q, double exponent) {
  const std::string unit = laws::resolved_unit(q.unit, exponent);
  return fmt::format("{} [{}]", q.name, unit.empty() ? "-" : unit);
}

void print_head(const Collision& c) {
  fmt::print("{}: {}\n", c.law.name, c.law.shape);
  fmt::print("Free impact: reduced mass {:g} kg, closing speed {:g} m/s", c.settings.reduced_mass, c.velocity);
  for (const laws::ParameterInfo& p : c.law.parameters)
    if (const auto set = c.settings.values.find(p.name); set != c.settings.values.end())
      fmt::print(", {} {:g}{}{}", p.name, set->second, p.unit.empty() ? "" : " ",
                 laws::resolved_unit(p.unit, c.exponent));
  fmt::print("\n");
  if (!c.assumed.empty()) fmt::print("Typical values used for: {}\n", fmt::join(c.assumed, ", "));
}

void print(const Collision& c, const std::vector<CalibratedRow>& rows) {
  print_head(c);
  const bool dissipates = !c.law.number.name.empty();
  const bool two = dissipates && c.law.number.name != c.law.coefficient.name;
  const std::string number = quantity_header(c.law.number, c.exponent);
  const std::string coefficient = quantity_header(c.law.coefficient, c.exponent);
  fmt::print("\n{:<24}", dissipates ? "formula" : "");
  if (dissipates) fmt::print("{:>{}}", number, number.size() + 2);
  if (two) fmt::print("{:>{}}", coefficient, coefficient.size() + 2);
  fmt::print("{:>18}{:>17}{:>17}{:>14}\n", "restitution [-]", "peak force [N]", "penetration [m]", "duration [s]");
  for (const CalibratedRow& r : rows) {
    fmt::print("{:<24}", r.formula);
    if (!r.refused.empty()) {
      fmt::print("  {}\n", r.refused);
      continue;
    }
    if (dissipates) fmt::print("{:>{}.6g}", r.number, number.size() + 2);
    if (two) fmt::print("{:>{}.6g}", r.coefficient, coefficient.size() + 2);
    fmt::print("{:>18.6f}{:>17.6g}{:>17.6g}{:>14.6g}\n", r.impact.restitution, r.impact.peak_force,
               r.impact.peak_penetration, r.impact.duration);
  }
}

void print_json(const Collision& c, const std::vector<CalibratedRow>& rows) {
  nlohmann::json result{{"law", c.law.name},           {"reduced_mass", c.settings.reduced_mass},
                        {"closing_speed", c.velocity}, {"parameters", c.settings.values},
                        {"assumed", c.assumed},        {"formulas", nlohmann::json::array()}};
  if (c.settings.restitution) result["restitution"] = *c.settings.restitution;
  for (const CalibratedRow& r : rows) {
    if (!r.refused.empty()) {
      result["formulas"].push_back({{"formula", r.formula}, {"refused", r.refused}});
      continue;
    }
    nlohmann::json row{{"formula", r.formula},
                       {"restitution", r.impact.restitution},
                       {"peak_force", r.impact.peak_force},
                       {"time_of_peak", r.impact.time_of_peak},
                       {"peak_penetration", r.impact.peak_penetration},
                       {"duration", r.impact.duration},
                       {"energy_lost", r.impact.energy_lost},
                       {"impulse", r.impact.impulse}};
    if (!c.law.number.name.empty()) {
      row[std::string(c.law.number.name)] = r.number;
      row[std::string(c.law.coefficient.name)] = r.coefficient;
    }
    result["formulas"].push_back(row);
  }
  fmt::print("{}\n", result.dump(2));
}

/// Result of the cyclic calibration for one formula.
struct CyclicRow {
  std::string_view formula;
  laws::CyclicCalibration process;
  double number = 0;    ///< final damping number
  std::string refused;  ///< why the calibration does not converge
};

std::vector<CyclicRow> calibrate_cyclically(const Collision& c) {
  if (c.law.formulas.empty() || c.law.instantaneous)
    throw InputError(fmt::format("--cyclic: {} has no damping formula to correct by its hysteresis loop", c.law.name));
  std::vector<CyclicRow> rows;
  for (const laws::Formula& f : c.law.formulas) {
    CyclicRow row{.formula = f.name, .process = {}, .refused = {}};
    laws::Settings settings = c.settings;
    settings.formula = f.name;
    try {
      row.process = laws::calibrate_cyclically(settings, *c.settings.restitution, c.settings.reduced_mass, c.velocity);
      settings.restitution = row.process.assumed();
      row.number = damping_number(laws::make_law(settings), c.velocity);
    } catch (const std::invalid_argument& error) {
      if (f.name == "exact") throw;
      row.refused = error.what();
    } catch (const std::domain_error&) {
      row.refused = refused_impact("--cyclic", f.name, "has no number");
    } catch (const std::runtime_error&) {
      row.refused = refused_impact("--cyclic", f.name, "does not end");
    }
    rows.push_back(row);
  }
  return rows;
}

void print(const Collision& c, const std::vector<CyclicRow>& rows) {
  print_head(c);
  fmt::print("Required kinetic energy loss: {:.6g} J\n", rows.front().process.kinetic_loss);
  const std::string number = quantity_header(c.law.number, c.exponent);
  fmt::print("\n{:<24}{:>25}{:>12}{:>17}{:>18}{:>{}}\n", "formula", "restitution to assume [-]", "analyses",
             "loop area [J]", "restitution [-]", number, number.size() + 2);
  for (const CyclicRow& r : rows) {
    fmt::print("{:<24}", r.formula);
    if (!r.refused.empty()) {
      fmt::print("  {}\n", r.refused);
      continue;
    }
    const laws::CyclicAnalysis& last = r.process.analyses.back();
    fmt::print("{:>25.9f}{:>12}{:>17.6g}{:>18.6f}{:>{}.6g}\n", last.assumed, r.process.analyses.size(), last.loop_area,
               last.restitution, r.number, number.size() + 2);
  }
}

void print_json(const Collision& c, const std::vector<CyclicRow>& rows) {
  nlohmann::json result{{"law", c.law.name},
                        {"reduced_mass", c.settings.reduced_mass},
                        {"closing_speed", c.velocity},
                        {"parameters", c.settings.values},
                        {"assumed", c.assumed},
                        {"restitution", *c.settings.restitution},
                        {"kinetic_loss", rows.front().process.kinetic_loss},
                        {"formulas", nlohmann::json::array()}};
  for (const CyclicRow& r : rows) {
    if (!r.refused.empty()) {
      result["formulas"].push_back({{"formula", r.formula}, {"refused", r.refused}});
      continue;
    }
    nlohmann::json analyses = nlohmann::json::array();
    for (const laws::CyclicAnalysis& a : r.process.analyses)
      analyses.push_back({{"assumed", a.assumed}, {"loop_area", a.loop_area}, {"restitution", a.restitution}});
    result["formulas"].push_back(
        {{"formula", r.formula}, {std::string(c.law.number.name), r.number}, {"analyses", analyses}});
  }
  fmt::print("{}\n", result.dump(2));
}

}  // namespace

void add_calibrate(CLI::App& app) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Damping of a law for a target restitution by every formula, and the obtained restitution");
  command->add_option("--law", arguments->collision.law, "Contact law (see pounding laws)")->required();
  command->add_option("--restitution", arguments->collision.restitution, "Target restitution, in (0, 1]");
  command->add_option("--m1", arguments->collision.m1, "Mass of the first body, such as 100 t or 1e5")->required();
  command->add_option("--m2", arguments->collision.m2, "Mass of the second body, or wall")->capture_default_str();
  command->add_option("--stiffness", arguments->collision.stiffness, "Contact stiffness, SI or with its unit");
  command->add_option("--velocity", arguments->collision.velocity, "Closing speed");
  command->add_option("--exponent", arguments->collision.exponent, "Exponent n of the law");
  command->add_option("--parameter", arguments->parameters, "Another parameter of the law, NAME=VALUE");
  command->add_flag("--cyclic", arguments->cyclic,
                    "Calibrate by the cyclic process of Naderpour et al. 2015: adjust the restitution passed to the "
                    "formula until the area of the hysteresis loop equals the kinetic energy loss");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] {
    const Collision collision = read_collision(collision_words(*arguments));
    if (arguments->cyclic) {
      const std::vector<CyclicRow> rows = calibrate_cyclically(collision);
      return arguments->json ? print_json(collision, rows) : print(collision, rows);
    }
    const std::vector<CalibratedRow> rows = calibrate(collision);
    arguments->json ? print_json(collision, rows) : print(collision, rows);
  });
}

}  // namespace pounding::program
