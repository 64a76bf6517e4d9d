#include <pounding/reports/fibre_report.hpp>

#include <cmath>
#include <set>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

constexpr double largest_modulus_difference = 0.25;
constexpr double largest_restraint = 1.05;  // ratio of moments

std::string gigapascal(double modulus) { return format_quantity(modulus, dimension::stress, 4); }

// "fcc 36.2 MPa": strengths are in Pa, all others are numbers.
std::string confined_value(const YieldingPart::Parameter& value) {
  const bool is_stress = value.name.starts_with('f');
  return fmt::format(
      "{} {}", value.name,
      is_stress ? format_quantity(value.value, dimension::stress, 4) : fmt::format("{:.4g}", value.value));
}

std::string describe_law(const FibreSectionReport::Law& law) {
  std::string text = fmt::format("       {}: {}, E0 {}", law.name, law.law, gigapascal(law.modulus));
  if (law.code_modulus > 0) text += fmt::format(" (EN 1992-1-1: {})", gigapascal(law.code_modulus));
  for (const YieldingPart::Parameter& value : law.confinement)
    text += (&value == &law.confinement.front() ? ", confined: " : ", ") + confined_value(value);
  return text + '\n';
}

}  // namespace

std::string describe_fibres(const Structure& s) {
  std::string text;
  for (const FibreSectionReport& section : s.fibre_sections) {
    text += fmt::format("     section {}: area {:.4g} m^2, uncracked EI {:.4g} MN m^2, {} member{}, {}\n", section.name,
                        section.area, section.bending_stiffness / 1e6, section.members, section.members == 1 ? "" : "s",
                        section.yielding == 0                 ? "elastic"
                        : section.yielding == section.members ? "yielding along their length"
                                                              : fmt::format("{} yielding", section.yielding));
    for (const FibreSectionReport::Law& law : section.laws) text += describe_law(law);
  }
  return text;
}

std::vector<Warning> warnings_about_fibres(const Structure& s) {
  std::vector<Warning> warnings;
  std::set<std::string> known;  // materials
  for (const FibreSectionReport& section : s.fibre_sections) {
    for (const FibreSectionReport::Law& law : section.laws) {
      if (!known.insert(law.name).second) continue;
      if (!law.forgets_small_reversals && section.yielding > 0)
        warnings.push_back(
            {"steel02", fmt::format("structure {}: the tolerance does not apply to {}, since a reversal of 1e-9 of "
                                    "the yield strain changes later stresses of {} by up to 0.36 Fy; type "
                                    "menegotto_pinto unless results of OpenSees are to be reproduced",
                                    s.name, law.name, law.law)});
      if (const double ratio = law.code_modulus > 0 ? law.modulus / law.code_modulus - 1 : 0;
          std::abs(ratio) > largest_modulus_difference)
        warnings.push_back(
            {"E0",
             fmt::format("structure {}: the initial modulus of {} is {}, {:.0f} % {} than the {} of EN 1992-1-1 "
                         "for its strength{}",
                         s.name, law.name, gigapascal(law.modulus), 100 * std::abs(ratio), ratio < 0 ? "less" : "more",
                         gigapascal(law.code_modulus),
                         law.law == "concrete04" ? "; check Ec"
                                                 : "; it is 2 fpc/epsc0: check epsc0, or type concrete04 with Ec")});
    }
    if (const auto& by = section.restraint; by && by->moment > largest_restraint * by->free_moment)
      warnings.push_back(
          {"diaphragm",
           fmt::format("structure {}: rigid floors keep the length of {} beam{} with the section {}: at a curvature of "
                       "{:g} 1/m the moment is {:.4g} kN m instead of {:.4g} kN m, with an axial force of {:.4g} kN; "
                       "type rigid_floors: false",
                       s.name, by->beams, by->beams == 1 ? "" : "s", section.name, by->curvature, by->moment / 1e3,
                       by->free_moment / 1e3, by->axial_force / 1e3)});
  }
  return warnings;
}

}  // namespace pounding
