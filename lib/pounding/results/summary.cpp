#include <pounding/results/summary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

// An energy imbalance above this many times the tolerance means that something was not resolved.
constexpr double suspicious_imbalance = 100;

// JSON has no NaN; a missing value is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json structures_json(const std::vector<StructureSummary>& structures) {
  Json all = Json::object();
  for (const StructureSummary& s : structures)
    all[s.name] = {{"peak_displacement", s.peak_displacement},
                   {"peak_drift", s.peak_drift},
                   {"peak_acceleration", s.peak_acceleration}};
  return all;
}

// Shows round-off as zero, without a sign.
double shown(double value, int digits) { return std::abs(value) < 0.5 * std::pow(10.0, -digits) ? 0.0 : value; }

std::string structures_table(const std::vector<StructureSummary>& structures,
                             const std::vector<StructureSummary>& without) {
  std::size_t width = 9;
  for (const StructureSummary& s : structures) width = std::max(width, s.name.size());
  const bool compare = !without.empty();
  std::string text = fmt::format("{:<{}}  floor  displacement       drift  acceleration{}\n", "structure", width,
                                 compare ? "   without links  ratio" : "");
  text += fmt::format("{:<{}}                 (mm)        (mm)       (m/s^2){}\n", "", width,
                      compare ? "            (mm)" : "");
  for (std::size_t k = 0; k < structures.size(); ++k) {
    const StructureSummary& s = structures[k];
    for (std::size_t i = s.peak_displacement.size(); i-- > 0;) {
      const std::string drift = s.peak_drift.empty() ? "-" : fmt::format("{:.4f}", 1e3 * s.peak_drift[i]);
      text += fmt::format("{:<{}}  {:>5}  {:>12.4f}  {:>10}  {:>12.4f}", s.name, width, i + 1,
                          1e3 * s.peak_displacement[i], drift, s.peak_acceleration[i]);
      if (compare) {
        const double alone = without[k].peak_displacement[i];
        text += fmt::format("  {:>14.4f}  {:>5.3f}", 1e3 * alone, s.peak_displacement[i] / alone);
      }
      text += '\n';
    }
  }
  return text;
}

std::string links_table(const std::vector<LinkSummary>& links) {
  std::size_t width = 4;
  for (const LinkSummary& s : links) width = std::max(width, s.name.size());
  std::string text = fmt::format("{:<{}}  impacts  peak force  penetration     impulse  energy lost\n", "link", width);
  text += fmt::format("{:<{}}                 (kN)         (mm)      (kN s)         (kJ)\n", "", width);
  for (const LinkSummary& s : links) {
    const std::string force = std::isnan(s.peak_force) ? "rigid" : fmt::format("{:.3f}", s.peak_force / 1e3);
    text += fmt::format("{:<{}}  {:>7}  {:>10}  {:>11.4f}  {:>10.4f}  {:>11.5f}\n", s.name, width, s.impacts, force,
                        1e3 * s.peak_penetration, s.impulse / 1e3, shown(s.energy_lost / 1e3, 5));
  }
  for (const LinkSummary& s : links)
    if (s.presses)
      text += fmt::format("{} still presses at the end of the run, with {:.5f} kJ stored\n", s.name, shown(s.energy_stored / 1e3, 5));
  return text;
}

}  // namespace

LinkSummary summary_of(const std::string& name, std::span<const ImpactRow> impacts) {
  LinkSummary s;
  s.name = name;
  if (!impacts.empty()) s.peak_force = std::numeric_limits<double>::quiet_NaN();  // fmax() replaces it by the first finite force
  for (const ImpactRow& row : impacts) {
    ++s.impacts;
    s.peak_force = std::fmax(s.peak_force, row.peak_force);
    s.peak_penetration = std::max(s.peak_penetration, row.peak_penetration);
    s.impulse += row.impulse;
    s.energy_lost += row.energy_lost;
    s.energy_stored += row.energy_stored;
    s.presses = s.presses || still_presses(row);
  }
  return s;
}

std::string to_json(const Summary& summary) {
  Json links = Json::array();
  for (const LinkSummary& s : summary.links)
    links.push_back({{"name", s.name},
                     {"impacts", s.impacts},
                     {"peak_force", number(s.peak_force)},
                     {"peak_penetration", s.peak_penetration},
                     {"impulse", s.impulse},
                     {"energy_lost", s.energy_lost},
                     {"energy_stored", s.energy_stored},
                     {"presses", s.presses}});
  const EnergySummary& e = summary.energy;
  Json all = {{"status", summary.status},
              {"links", links},
              {"structures", structures_json(summary.structures)},
              {"energy",
               {{"input", e.input},
                {"kinetic", e.kinetic},
                {"strain", e.strain},
                {"damping", e.damping},
                {"hysteretic", e.hysteretic},
                {"impact", e.impact},
                {"error", e.error}}},
              {"solver",
               {{"integrator", summary.integrator},
                {"steps", summary.solver.steps},
                {"rejected", summary.solver.rejected},
                {"events", summary.solver.events},
                {"wall_seconds", summary.solver.wall_seconds}}}};
  if (!summary.without_pounding.empty()) {
    Json amplification = Json::object();
    for (std::size_t k = 0; k < summary.structures.size(); ++k) {
      Json ratios = Json::array();
      for (std::size_t i = 0; i < summary.structures[k].peak_displacement.size(); ++i)
        ratios.push_back(number(summary.structures[k].peak_displacement[i] /
                                summary.without_pounding[k].peak_displacement[i]));
      amplification[summary.structures[k].name] = ratios;
    }
    all["no_pounding"] = {{"structures", structures_json(summary.without_pounding)}, {"amplification", amplification}};
  }
  return all.dump();
}

std::string warning(const Summary& summary, double tolerance) {
  if (!(summary.energy.error > suspicious_imbalance * tolerance)) return {};
  return fmt::format("the energies do not close, the largest imbalance is {:.1e} of the input; run again with a smaller "
                     "tolerance",
                     summary.energy.error);
}

std::string to_table(const Summary& summary) {
  std::string text = structures_table(summary.structures, summary.without_pounding);
  if (!summary.links.empty()) text += '\n' + links_table(summary.links);
  const EnergySummary& e = summary.energy;
  text += fmt::format(
      "\nenergy (kJ)  input {:.5f} = kinetic {:.5f} + strain {:.5f} + damping {:.5f} + hysteretic {:.5f} + impact {:.5f}\n"
      "             largest imbalance {:.1e} of the input\n",
      shown(e.input / 1e3, 5), shown(e.kinetic / 1e3, 5), shown(e.strain / 1e3, 5), shown(e.damping / 1e3, 5),
      shown(e.hysteretic / 1e3, 5), shown(e.impact / 1e3, 5), e.error);
  text += fmt::format("solver       {}, {} steps, {} rejected, {} events, {:.3f} s\n", summary.integrator, summary.solver.steps,
                      summary.solver.rejected, summary.solver.events, summary.solver.wall_seconds);
  return text;
}

}  // namespace pounding
