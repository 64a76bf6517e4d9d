/// `pounding section MODEL.yaml [NAME]`: moment-curvature and N-M interaction of sections of fibres.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <pounding/core/error.hpp>
#include <pounding/core/names.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/input/frames/section_input.hpp>
#include <pounding/results/replaced_file.hpp>
#include <pounding/sections/bending.hpp>
#include "program/commands.hpp"

namespace pounding::program {
namespace {

using sections::Axis, sections::Bending, sections::CurvePoint, sections::InteractionPoint;

constexpr int steps_of_path = 120, printed_points = 12;
constexpr double usual_edge_strain = 0.025;  // of the largest curvature, over the depth
const FileKind curve_files{"table of moments and curvatures", "--csv section.csv",
                           [](std::string_view start) { return start.starts_with("section,axial force (N),"); }};

struct SectionArguments {
  std::string model, name, axis = "y", curvature, csv, picture;
  std::vector<std::string> axial;
  bool json = false;
};

double read_option(const char* option, const std::string& text, const Dimension& dimension) {
  try {
    return parse_quantity(text, dimension);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

/// A section and its bending about one axis.
struct BentSection {
  const NamedSection& of;
  Axis axis;
  std::vector<Bending> bendings;
  std::vector<InteractionPoint> diagram;

  const SectionFibres& fibres() const { return *of.section.fibres; }
};

double largest_curvature(const SectionArguments& given, const Section& section, Axis axis) {
  if (!given.curvature.empty()) {
    const double value = read_option("--curvature", given.curvature, {0, -1, 0});
    if (!(value > 0))
      throw InputError(fmt::format("--curvature: must be positive, not \"{}\"", excerpt(given.curvature)));
    return value;
  }
  const auto& [low, high] = section.fibres->section.extent();
  const double extent = axis == Axis::y ? high.z - low.z : high.y - low.y;
  if (!(extent > 0))
    throw InputError(
        fmt::format("--axis: the section {} has no fibres along {}, since its frame is plane; type --axis y",
                    section.fibres->name, axis == Axis::y ? "z" : "y"));
  return usual_edge_strain / extent;
}

BentSection bend_section(const SectionArguments& given, const NamedSection& named) {
  const Axis axis = given.axis == "z" ? Axis::z : Axis::y;
  const sections::FibreSection& section = named.section.fibres->section;
  std::vector<double> forces;
  for (const std::string& text : given.axial) forces.push_back(read_option("--axial", text, dimension::force));
  const sections::AxialStrength strength = sections::axial_strength(section);
  if (forces.empty()) forces = {0, 0.1 * strength.compression, 0.2 * strength.compression, 0.3 * strength.compression};
  for (const double force : forces)
    if (!(force >= strength.compression && force <= strength.tension))
      throw InputError(
          fmt::format("--axial: the section {} resists {:.4g} kN in compression to {:.4g} kN in tension; "
                      "{:.6g} kN is outside",
                      named.name(), strength.compression / 1e3, strength.tension / 1e3, force / 1e3));
  const double largest = largest_curvature(given, named.section, axis);
  std::vector<double> curvatures;
  for (int i = 1; i <= steps_of_path; ++i) curvatures.push_back(largest * i / steps_of_path);
  BentSection bent{named, axis, {}, {}};
  try {
    for (const double force : forces) bent.bendings.push_back(sections::bend(section, force, curvatures, axis));
    for (const double force : sections::forces_of_diagram(section))
      bent.diagram.push_back({force, sections::bend(section, force, curvatures, axis).largest_moment});
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("section {}: {}", named.name(), error.what()));
  }
  return bent;
}

/// A value in these units with four digits, or a dash if it was not reached.
std::string or_dash(double value, double unit) { return value == 0 ? "-" : fmt::format("{:.4g}", value / unit); }

void print_section(const BentSection& bent) {
  const char* const axis = bent.axis == Axis::y ? "y" : "z";
  std::string laws;
  for (const FibreMaterial& material : bent.fibres().materials)
    laws += fmt::format("{}{} ({})", laws.empty() ? "" : ", ", material.name,
                        std::visit([]<class M>(const M&) { return M::name; }, material.law));
  fmt::print("section {}: area {:.4g} m^2, {} fibres of {}\n", bent.of.name(), bent.of.section.area,
             bent.fibres().section.fibres().size(), laws);
  fmt::print("bending about {}, axial force negative in compression; uncracked EI {:.4g} MN m^2\n", axis,
             sections::initial_bending_stiffness(bent.fibres().section, bent.axis) / 1e6);
  fmt::print(
      "EI cracked, to first yield (phi_y, M_y); phi_n = phi_y M_max/M_y; phi_u when the core crushes or M falls to 0.8 "
      "M_max\n");
  fmt::print("{:>12} {:>13} {:>13} {:>11} {:>11} {:>13} {:>14}\n", "N [kN]", "EI [MN m^2]", "phi_y [1/m]", "M_y [kN m]",
             "M_max", "phi_n [1/m]", "phi_u [1/m]");
  for (const Bending& b : bent.bendings)
    fmt::print("{:>12.6g} {:>13} {:>13} {:>11} {:>11.6g} {:>13} {:>14}{}\n", b.axial_force / 1e3,
               or_dash(b.cracked_stiffness(), 1e6), or_dash(b.yield_curvature, 1), or_dash(b.yield_moment, 1e3),
               b.largest_moment / 1e3, or_dash(b.idealized_yield_curvature(), 1), or_dash(b.ultimate_curvature, 1),
               b.ultimate_curvature == 0 ? ""
               : b.crushes               ? " crushing"
                                         : " 0.8 M_max");
  fmt::print("\nmoment [kN m]\n{:>12}", "phi [1/m]");
  for (const Bending& b : bent.bendings) fmt::print(" {:>12}", fmt::format("N {:.5g} kN", b.axial_force / 1e3));
  fmt::print("\n");
  for (int i = steps_of_path / printed_points - 1; i < steps_of_path; i += steps_of_path / printed_points) {
    const auto at = static_cast<std::size_t>(i);
    const auto reached = std::ranges::find_if(bent.bendings, [&](const Bending& b) { return at < b.curve.size(); });
    if (reached == bent.bendings.end()) break;
    fmt::print("{:>12.4g}", reached->curve[at].curvature);
    for (const Bending& b : bent.bendings)
      fmt::print(" {:>12}", at < b.curve.size() ? fmt::format("{:.6g}", b.curve[at].moment / 1e3) : "-");
    fmt::print("\n");
  }
  fmt::print("\ninteraction\n{:>12} {:>12}\n", "N [kN]", "M [kN m]");
  for (const InteractionPoint& point : bent.diagram)
    fmt::print("{:>12.5g} {:>12.5g}\n", point.axial_force / 1e3, point.moment / 1e3);
}

nlohmann::ordered_json bending_json(const BentSection& bent) {
  nlohmann::ordered_json curves = nlohmann::ordered_json::array();
  const auto list = [](const auto& points, auto member) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const auto& point : points) values.push_back(point.*member);
    return values;
  };
  for (const Bending& b : bent.bendings)
    curves.push_back({{"axial_force", b.axial_force},
                      {"cracked_stiffness", b.cracked_stiffness()},
                      {"yield_curvature", b.yield_curvature},
                      {"yield_moment", b.yield_moment},
                      {"largest_moment", b.largest_moment},
                      {"idealized_yield_curvature", b.idealized_yield_curvature()},
                      {"ultimate_curvature", b.ultimate_curvature},
                      {"curvature", list(b.curve, &CurvePoint::curvature)},
                      {"moment", list(b.curve, &CurvePoint::moment)},
                      {"axial_strain", list(b.curve, &CurvePoint::axial_strain)}});
  return {{"name", bent.of.name()},
          {"axis", bent.axis == Axis::y ? "y" : "z"},
          {"area", bent.of.section.area},
          {"uncracked_stiffness", sections::initial_bending_stiffness(bent.fibres().section, bent.axis)},
          {"curves", std::move(curves)},
          {"interaction",
           {{"axial_force", list(bent.diagram, &InteractionPoint::axial_force)},
            {"moment", list(bent.diagram, &InteractionPoint::moment)}}}};
}

void write_curves(const std::vector<BentSection>& all, const std::string& path) {
  std::string file = "section,axial force (N),curvature (1/m),moment (N m),axial strain\n";
  for (const BentSection& bent : all)
    for (const Bending& b : bent.bendings)
      for (const CurvePoint& point : b.curve)
        file += fmt::format("{},{:.10g},{:.10g},{:.10g},{:.10g}\n", bent.of.name(), b.axial_force, point.curvature,
                            point.moment, point.axial_strain);
  ReplacedFile(path, curve_files).replace(std::as_bytes(std::span(file)));
}

void show_sections(const SectionArguments& given) {
  const std::vector<NamedSection> known = read_fibre_sections(Input::read_file(given.model));
  std::vector<std::string> names;
  std::vector<BentSection> bent;
  for (const NamedSection& each : known) {
    names.push_back(each.name());
    if (given.name.empty() || given.name == each.name() || given.name == each.section.fibres->name)
      bent.push_back(bend_section(given, each));
  }
  if (bent.empty())
    throw InputError(fmt::format("{}: {}", excerpt(given.model), unknown_name("section", given.name, names)));
  if (!given.csv.empty()) write_curves(bent, given.csv);
  nlohmann::ordered_json all{{"sections", nlohmann::ordered_json::array()}};
  for (const BentSection& each : bent) all["sections"].push_back(bending_json(each));
  const std::string json = all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  if (!given.picture.empty()) draw_json("_section_curves", json, given.picture);
  if (given.json) {
    fmt::print("{}\n", json);
    return;
  }
  if (!given.csv.empty()) fmt::print("curves       {}\n", given.csv);
  if (!given.picture.empty()) fmt::print("picture      {}\n", given.picture);
  if (!given.csv.empty() || !given.picture.empty()) return;
  for (const BentSection& each : bent) {
    if (&each != &bent.front()) fmt::print("\n");
    print_section(each);
  }
}

}  // namespace

void add_section(CLI::App& app) {
  const auto given = std::make_shared<SectionArguments>();
  CLI::App* const command =
      app.add_subcommand("section", "Sections of fibres: stiffness, moment-curvature, N-M interaction");
  command->add_option("MODEL", given->model, "Input file (YAML)")->required();
  command->add_option("NAME", given->name, "Name of the section, or STRUCTURE.SECTION (default: all)");
  command
      ->add_option("--axial", given->axial,
                   "Axial forces, negative in compression: \"0, -500 kN, -1 MN\" (default: 0 to 30 % of the strength)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--curvature", given->curvature,
                      "Largest curvature, such as 0.06 [1/m] (default: 0.025 over the depth of the fibres)");
  command->add_option("--axis", given->axis, "Local axis of bending: y, or z in space")
      ->capture_default_str()
      ->check(CLI::IsMember({"y", "z"}));
  command->add_flag("--json", given->json, "Print one JSON object, in SI");
  names_a_file(command->add_option("--csv", given->csv, "Write the curves to this file, in SI, instead of printing"));
  names_a_file(
      command->add_option("--picture", given->picture, "Draw to this file, .png, .pdf or .svg, instead of printing"));
  command->callback([given] { show_sections(*given); });
}

}  // namespace pounding::program
