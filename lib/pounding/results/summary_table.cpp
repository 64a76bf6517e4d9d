#include <pounding/results/summary.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/results/comparison.hpp>

namespace pounding {
namespace {

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

// Rotation of rigid floors in space, and the largest displacement of a corner of their plan; empty without such floors.
std::string torsion_table(const std::vector<StructureSummary>& structures,
                          const std::vector<StructureSummary>& without) {
  std::size_t width = 9;
  bool turns = false;
  for (const StructureSummary& s : structures) {
    if (!s.peak_rotation.empty()) width = std::max(width, s.name.size());
    turns = turns || !s.peak_rotation.empty();
  }
  if (!turns) return {};
  const bool compare = !without.empty();
  std::string text = fmt::format("{:<{}}  floor      rotation  edge displacement  edge/middle{}\n", "structure", width,
                                 compare ? "  without links  without links  ratio" : "");
  text += fmt::format("{:<{}}               (mrad)               (mm)             {}\n", "", width,
                      compare ? "         (mrad)           (mm)" : "");
  for (std::size_t k = 0; k < structures.size(); ++k) {
    const StructureSummary& s = structures[k];
    for (std::size_t i = s.peak_rotation.size(); i-- > 0;) {
      if (std::isnan(s.peak_rotation[i])) continue;
      text += fmt::format("{:<{}}  {:>5}  {:>12.5f}  {:>17.4f}  {:>11.3f}", s.name, width, i + 1,
                          shown(1e3 * s.peak_rotation[i], 5), 1e3 * s.peak_edge_displacement[i],
                          s.peak_edge_displacement[i] / s.peak_displacement[i]);
      if (compare) {
        const double rotation = without[k].peak_rotation[i], edge = without[k].peak_edge_displacement[i];
        text += fmt::format("  {:>13.5f}  {:>13.4f}  {:>5.3f}", shown(1e3 * rotation, 5), 1e3 * edge,
                            s.peak_edge_displacement[i] / edge);
      }
      text += '\n';
    }
  }
  return text;
}

std::string links_table(const std::vector<LinkSummary>& links) {
  std::size_t width = 4;
  for (const LinkSummary& s : links) width = std::max(width, s.name.size());
  const bool seats = std::ranges::any_of(links, [](const LinkSummary& s) { return s.seat.has_value(); });
  std::string text =
      fmt::format("{:<{}}  impacts  peak force  penetration     impulse  energy lost     opening    at{}\n", "link",
                  width, seats ? "      seat" : "");
  text += fmt::format("{:<{}}                 (kN)         (mm)      (kN s)         (kJ)        (mm)   (s){}\n", "",
                      width, seats ? "      (mm)" : "");
  for (const LinkSummary& s : links) {
    const std::string force = std::isnan(s.peak_force) ? "rigid" : fmt::format("{:.3f}", s.peak_force / 1e3);
    text += fmt::format("{:<{}}  {:>7}  {:>10}  {:>11.4f}  {:>10.4f}  {:>11.5f}  {:>10.4f}  {:>4.2f}", s.name, width,
                        s.impacts, force, 1e3 * s.peak_penetration, s.impulse / 1e3, shown(s.energy_lost / 1e3, 5),
                        1e3 * s.largest_opening, s.t_opening);
    if (s.seat) text += fmt::format("  {:>8.6g}{}", 1e3 * *s.seat, s.unseated() ? "  unseated" : "");
    text += '\n';
  }
  for (const LinkSummary& s : links)
    if (s.presses)
      text += fmt::format("{} is still in contact at the end of the run, with {:.5f} kJ stored\n", s.name,
                          shown(s.energy_stored / 1e3, 5));
  return text;
}

std::string devices_table(const std::vector<DeviceSummary>& devices) {
  std::size_t width = 6;
  for (const DeviceSummary& s : devices) width = std::max(width, s.name.size());
  std::string text = fmt::format("{:<{}}  {:<15}  {:>12}  {:>8}  {:>12}  {:>8}  {:>16}\n", "device", width, "",
                                 "minimum", "at (s)", "maximum", "at (s)", "energy lost (kJ)");
  for (const DeviceSummary& s : devices)
    for (int i = 1; i >= 0; --i) {
      const Extremes& e = s.extremes;
      const double scale = i == 0 ? 1e3 : 1e-3;
      text += fmt::format("{:<{}}  {:<15}  {:>12.4f}  {:>8.3f}  {:>12.4f}  {:>8.3f}", s.name, width,
                          i == 0 ? "elongation (mm)" : "force (kN)", shown(scale * e.min[i], 4), e.t_min[i],
                          shown(scale * e.max[i], 4), e.t_max[i]);
      text += i == 0 ? "\n" : fmt::format("  {:>16.5f}\n", shown(s.energy_lost / 1e3, 5));
    }
  return text;
}

// One line of the table of forces: minimum and maximum in kN or kN m, with location and time.
struct ForceLine {
  std::string structure, force;
  double min = 0, max = 0, t_min = 0, t_max = 0;
  std::string at_min, at_max;
};

ForceLine base_shear(const StructureSummary& s, std::size_t j, const std::string& name) {
  const Extremes& e = s.envelope.storey_shear;
  return {s.name, name, e.min[j], e.max[j], e.t_min[j], e.t_max[j], "", ""};
}

// Includes an extreme in a line if it is beyond its range.
void widen(ForceLine& line, const Extremes& of, std::size_t i, const std::string& where) {
  if (line.at_min.empty() || of.min[i] < line.min) {
    line.min = of.min[i];
    line.t_min = of.t_min[i];
    line.at_min = where;
  }
  if (line.at_max.empty() || of.max[i] > line.max) {
    line.max = of.max[i];
    line.t_max = of.t_max[i];
    line.at_max = where;
  }
}

// Forces below this fraction of the largest one are round-off.
constexpr double no_force = 1e-9;

// For each kind of force (N, Vz, My ...) the extremes over the sections at both ends of all members. End forces would
// contain each axial force with both signs, so compression and tension would be indistinguishable.
std::vector<ForceLine> member_lines(const StructureSummary& s) {
  const StructureEnvelope& e = s.envelope;
  const Extremes sections = section_forces(e);
  std::vector<ForceLine> lines;
  const std::size_t components = e.components.size();
  const auto kind_of = [&](std::size_t i) {
    return e.components[i % components].substr(e.components[i % components].find(' ') + 1);
  };
  std::map<std::string, double> peaks;
  for (std::size_t i = 0; i < sections.size(); ++i) peaks[kind_of(i)] = std::max(peaks[kind_of(i)], sections.peak(i));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::string& component = e.components[i % components];
    const std::string kind = kind_of(i);
    // Beams in rigid floors have no axial force; including them would hide that every column remains in compression.
    if (peaks[kind] > 0 && sections.peak(i) < no_force * peaks[kind]) continue;
    auto line = std::find_if(lines.begin(), lines.end(), [&](const ForceLine& one) { return one.force == kind; });
    if (line == lines.end()) line = lines.insert(lines.end(), {s.name, kind, 0, 0, 0, 0, "", ""});
    widen(*line, sections, i,
          fmt::format("{}, {}", e.members[i / components], component.substr(0, component.find(' '))));
  }
  return lines;
}

// The vertical reaction, which shows uplift: it is negative if the ground holds a support down.
std::vector<ForceLine> reaction_line(const StructureSummary& s) {
  const StructureEnvelope& e = s.envelope;
  const auto vertical = std::find(e.directions.begin(), e.directions.end(), "z");
  if (e.reaction.size() == 0 || vertical == e.directions.end()) return {};
  ForceLine line{s.name, "reaction z", 0, 0, 0, 0, "", ""};
  for (std::size_t i = 0; i < e.supports.size(); ++i)
    widen(line, e.reaction, i * e.directions.size() + static_cast<std::size_t>(vertical - e.directions.begin()),
          e.supports[i]);
  return {line};
}

// Local axes: N and V are forces, T and M moments.
std::string with_unit(const std::string& force) {
  return force + (force[0] == 'M' || force[0] == 'T' ? " (kN m)" : " (kN)");
}

// Sign conventions of the table of forces, and the loads included; structures with the same loads share a line.
std::string notes_on_forces(const std::vector<StructureSummary>& structures) {
  std::string text = "base shear: positive if the floor above has moved along the axis\n";
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;
  for (const StructureSummary& s : structures) {
    const StructureEnvelope& e = s.envelope;
    if (e.member_force.size() == 0 && e.reaction.size() == 0) continue;
    const std::string others =
        e.included.substr(e.with_gravity ? std::min(e.included.size(), std::string("gravity, ").size()) : 0);
    const std::string more = others.empty() ? "" : fmt::format(", {} {}", e.with_gravity ? "with" : "but", others);
    const std::string note = e.with_gravity
                                 ? fmt::format("gravity is included{}", more)
                                 : fmt::format(
                                       "gravity is not included{}: weights add compression, so tension and uplift are "
                                       "overestimated; type gravity: true in the frame to include it",
                                       more);
    auto known = std::ranges::find(notes, note, &std::pair<std::string, std::vector<std::string>>::first);
    if (known == notes.end()) known = notes.insert(notes.end(), {note, {}});
    known->second.push_back(s.name);
  }
  if (notes.empty()) return text;
  text +=
      "members: internal forces in local axes, N positive in tension, without damping; reaction: of the ground, "
      "positive up, negative in uplift\n";
  for (const auto& [note, names] : notes) text += fmt::format("{}: {}\n", fmt::join(names, ", "), note);
  return text;
}

std::string forces_table(const std::vector<StructureSummary>& structures) {
  std::vector<ForceLine> lines;
  for (const StructureSummary& s : structures) {
    if (s.envelope.storey_shear.size() > 0) {
      const bool in_plan = s.directions.size() > 1;
      lines.push_back(base_shear(s, 0, in_plan ? "base shear x" : "base shear"));
      if (in_plan) lines.push_back(base_shear(s, 1, "base shear y"));
    }
    const std::vector<ForceLine> members = member_lines(s);
    lines.insert(lines.end(), members.begin(), members.end());
    const std::vector<ForceLine> reaction = reaction_line(s);
    lines.insert(lines.end(), reaction.begin(), reaction.end());
  }
  if (lines.empty()) return {};
  std::size_t width = 9;
  for (const ForceLine& line : lines) width = std::max(width, line.structure.size());
  std::string text = fmt::format("{:<{}}  {:<18}  {:>12}  {:>8}  {:>12}  {:>8}\n", "structure", width, "force",
                                 "minimum", "at (s)", "maximum", "at (s)");
  for (const ForceLine& line : lines) {
    text +=
        fmt::format("{:<{}}  {:<18}  {:>12.3f}  {:>8.3f}  {:>12.3f}  {:>8.3f}", line.structure, width,
                    with_unit(line.force), shown(line.min / 1e3, 3), line.t_min, shown(line.max / 1e3, 3), line.t_max);
    if (!line.at_min.empty() || !line.at_max.empty())
      text += fmt::format("  {}; {}", line.at_min.empty() ? "-" : line.at_min, line.at_max.empty() ? "-" : line.at_max);
    text += '\n';
  }
  return text + notes_on_forces(structures);
}

// Maximum number of parts shown per structure, those with the largest ductility.
constexpr std::size_t max_shown_springs = 12;

// Hinges beyond their ultimate rotation, one line per structure.
std::string beyond_ultimate(const std::vector<StructureSummary>& structures) {
  std::string text;
  for (const StructureSummary& s : structures) {
    const SpringSummary* worst = nullptr;
    int count = 0;
    for (const SpringSummary& part : s.springs)
      if (part.is_beyond_ultimate()) {
        ++count;
        if (!worst || part.plastic / part.ultimate > worst->plastic / worst->ultimate) worst = &part;
      }
    if (worst)
      text += fmt::format("{}: {} hinge{} beyond {} ultimate rotation; largest: {} with {:.4g} of {:.4g} mrad\n",
                          s.name, count, count == 1 ? "" : "s", count == 1 ? "its" : "their", worst->name,
                          1e3 * worst->plastic, 1e3 * worst->ultimate);
  }
  return text;
}

// Residual displacements and drifts, one line per structure.
std::string residuals(const std::vector<StructureSummary>& structures) {
  std::string text;
  for (const StructureSummary& s : structures) {
    if (s.residual_displacement.empty()) continue;
    text += fmt::format(
        "{}: at the end of the run, possibly still moving, the residual displacement of the top is {:.4g} mm", s.name,
        std::abs(1e3 * s.residual_displacement.back()));
    const auto size = [](double value) { return std::abs(value); };
    if (const auto worst = std::ranges::max_element(s.residual_drift, {}, size); worst != s.residual_drift.end()) {
      const auto storey = worst - s.residual_drift.begin();
      text += fmt::format(", and the largest residual drift is that of storey {}, {:.4g} mm", storey + 1,
                          1e3 * std::abs(*worst));
      if (!s.residual_drift_ratio.empty())
        text += fmt::format(" or {:.3g} % of its height", 100 * s.residual_drift_ratio[storey]);
    }
    text += '\n';
  }
  return text;
}

std::string springs_table(const std::vector<StructureSummary>& structures) {
  std::size_t width = 9, part_width = 4;
  bool any = false;
  for (const StructureSummary& s : structures) {
    if (!s.springs.empty()) width = std::max(width, s.name.size());
    for (const SpringSummary& part : s.springs) part_width = std::max(part_width, part.name.size());
    any = any || !s.springs.empty();
  }
  if (!any) return {};
  std::string text = fmt::format("{:<{}}  {:<{}}  {:>10}  {:>8}  {:>9}  {:>10}  {:>6}  {:>10}  {:>13}  {:>13}\n",
                                 "structure", width, "part", part_width, "largest", "at (s)", "ductility", "at the end",
                                 "cycles", "lost (kJ)", "yields at (s)", "damping shear");
  text += fmt::format("{:<{}}  {:<{}}  {:>10}  {:>8}  {:>9}  {:>10}  {:>6}  {:>10}  {:>13}  {:>13}\n", "", width, "",
                      part_width, "(mm, mrad)", "", "", "(mm, mrad)", "", "", "", "/ yield shear");
  for (const StructureSummary& s : structures) {
    std::vector<const SpringSummary*> parts;
    for (const SpringSummary& part : s.springs) parts.push_back(&part);
    const std::size_t shown_parts = std::min(parts.size(), max_shown_springs);
    if (shown_parts < parts.size()) std::ranges::stable_sort(parts, std::ranges::greater{}, &SpringSummary::ductility);
    for (std::size_t i = 0; i < shown_parts; ++i) {
      const SpringSummary& part = *parts[i];
      text +=
          fmt::format("{:<{}}  {:<{}}  {:>10.4f}  {:>8.3f}  {:>9.3f}  {:>10.4f}  {:>6.1f}  {:>10.4f}  {:>13}  {:>13}\n",
                      s.name, width, part.name, part_width, shown(1e3 * part.peak, 4), part.peak_time, part.ductility,
                      shown(1e3 * part.residual, 4), part.cycles, shown(part.energy_lost / 1e3, 4),
                      part.yielded() ? fmt::format("{:.3f}", part.first_yield) : "elastic",
                      std::isnan(part.damping_shear) ? "-" : fmt::format("{:.3f}", part.damping_shear));
    }
    if (shown_parts < parts.size())
      text += fmt::format("{:<{}}  {} more parts with smaller ductility are in the results file\n", s.name, width,
                          parts.size() - shown_parts);
  }
  return text + beyond_ultimate(structures) + residuals(structures);
}

std::string separations_table(const std::vector<LinkSeparation>& separations) {
  std::size_t width = 4;
  for (const LinkSeparation& s : separations) width = std::max(width, s.link.size());
  std::string text = fmt::format(
      "{:<{}}         gap      sufficient gap    at (s)         ABS        SRSS         DDC\n", "link", width);
  text +=
      fmt::format("{:<{}}        (mm)                (mm)                  (mm)        (mm)        (mm)\n", "", width);
  for (const LinkSeparation& s : separations)
    text += fmt::format("{:<{}}  {:>10.4f}  {:>18.4f}  {:>8.3f}  {:>10.4f}  {:>10.4f}  {:>10}\n", s.link, width,
                        1e3 * s.gap, 1e3 * s.enough, s.time, 1e3 * s.absolute_sum, 1e3 * s.srss,
                        std::isfinite(s.ddc) ? fmt::format("{:.4f}", 1e3 * s.ddc) : "-");
  return text;
}

// Reason why a completed run ended early; empty otherwise.
std::string early_end(const std::string& status) {
  const std::size_t colon = status.find(": ");
  return status.starts_with("done") && colon != std::string::npos ? status.substr(colon + 2) : "";
}

}  // namespace

std::string to_table(const Summary& summary) {
  std::string text = structures_table(summary.structures, summary.without_pounding);
  if (const std::string torsion = torsion_table(summary.structures, summary.without_pounding); !torsion.empty())
    text += '\n' + torsion;
  if (const std::string forces = forces_table(summary.structures); !forces.empty()) text += '\n' + forces;
  if (const std::string springs = springs_table(summary.structures); !springs.empty()) text += '\n' + springs;
  if (const std::string compared = comparison_table(summary); !compared.empty()) text += '\n' + compared;
  if (!summary.devices.empty()) text += '\n' + devices_table(summary.devices);
  if (!summary.separations.empty()) text += '\n' + separations_table(summary.separations);
  if (!summary.links.empty()) text += '\n' + links_table(summary.links);
  const EnergySummary& e = summary.energy;
  text += fmt::format(
      "\nenergy (kJ)  input {:.5f} = kinetic {:.5f} + strain {:.5f} + damping {:.5f} + hysteretic {:.5f} + impact "
      "{:.5f}{}\n"
      "             largest imbalance {:.1e} of the input\n",
      shown(e.input / 1e3, 5), shown(e.kinetic / 1e3, 5), shown(e.strain / 1e3, 5), shown(e.damping / 1e3, 5),
      shown(e.hysteretic / 1e3, 5), shown(e.impact / 1e3, 5),
      summary.devices.empty() && !(e.devices > 0) ? "" : fmt::format(" + devices {:.5f}", shown(e.devices / 1e3, 5)),
      e.error);
  if (const std::string why = early_end(summary.status); !why.empty()) text += fmt::format("ended        by {}\n", why);
  if (const std::string why = early_end(summary.without_links_status); !why.empty())
    text += fmt::format("the run without links ended by {}: its values in the tables cover the time until then\n", why);
  text +=
      fmt::format("solver       {}, {} steps, {} rejected, {} events, {:.3f} s\n", summary.integrator,
                  summary.solver.steps, summary.solver.rejected, summary.solver.events, summary.solver.wall_seconds);
  // The command line does not show options from PETSC_OPTIONS.
  if (!summary.options.empty()) {
    text += "options     ";
    for (const std::string& option : summary.options) text += " " + excerpt(option);
    text += '\n';
  }
  for (const ReducedStructure& s : summary.reduced)
    text += fmt::format("reduced      {}; errors of the reduction: {}{}{}\n", s.size_text(), s.error_text(),
                        s.checked_windows > 0 ? "; " : "", s.check_text());
  return text;
}

}  // namespace pounding
