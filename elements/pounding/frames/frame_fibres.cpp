#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <pounding/frames/section_fibres.hpp>
#include <pounding/sections/moment_curvature.hpp>

namespace pounding {
namespace {

constexpr double compared_curvature = 0.02;  // [1/m]

FibreSectionReport::Law law_report(const FibreMaterial& material) {
  FibreSectionReport::Law report;
  report.name = material.name;
  report.modulus = initial_modulus(material.law);
  std::visit(
      [&]<class M>(const M& law) {
        report.law = M::name;
        report.forgets_small_reversals = materials::forgets_small_reversals(law);
      },
      material.law);
  if (material.concrete_strength > 0) report.code_modulus = code_modulus(material.concrete_strength);
  if (const auto& by = material.confinement)
    report.confinement = {{"ke", by->effectiveness},
                          {"fcc", by->strength},
                          {"ecc", by->strain},
                          {"ecu", by->ultimate_strain},
                          {"fcu", materials::strength_at_ultimate(*by, material.concrete_strength)}};
  return report;
}

// True if both ends of a horizontal member follow the same rigid floor.
bool is_restrained(const FrameModel& model, int member) {
  const auto [start, end] = model.frame.ends(member);
  return std::abs(model.frame.beam(member).axes()(0, 2)) < 1e-6 &&
         std::ranges::any_of(
             model.floors,
             [&, start = start, end = end](const FrameFloor& floor) {
               const auto has = [&](int node) { return std::ranges::find(floor.nodes, node) != floor.nodes.end(); };
               return floor.master >= 0 && has(start) && has(end);
             });
}

// Moments of a section at the curvature that is compared, with and without axial strain of zero.
FibreSectionReport::Restraint restraint_of(const sections::FibreSection& section) {
  const sections::FibreStates states = section.states();
  sections::Deformation bent{0, compared_curvature, 0};
  const auto restrained = section.evaluate(states, bent).force;
  FibreSectionReport::Restraint report{
      .curvature = compared_curvature, .moment = restrained[1], .axial_force = restrained[0]};
  bent[0] = sections::find_axial_strain(section, states, 0, bent);
  report.free_moment = section.evaluate(states, bent).force[1];
  return report;
}

}  // namespace

std::vector<FibreSectionReport> report_fibre_sections(const FrameModel& model) {
  std::vector<FibreSectionReport> reports;
  std::map<const SectionFibres*, std::size_t> indices;
  const auto report_of = [&](int member) -> FibreSectionReport& {
    const Section& section = model.frame.beam(member).section();
    const auto [at, is_new] = indices.try_emplace(section.fibres.get(), reports.size());
    if (is_new) {
      const SectionFibres& fibres = *section.fibres;
      FibreSectionReport& made = reports.emplace_back();
      made.name = fibres.name;
      made.area = section.area;
      made.bending_stiffness = fibres.material.young * section.inertia_y;
      for (const FibreMaterial& material : fibres.materials) made.laws.push_back(law_report(material));
    }
    return reports[at->second];
  };
  for (int member = 0; member < model.frame.members(); ++member)
    if (model.frame.beam(member).section().fibres) ++report_of(member).members;
  for (const FrameFibres& fibres : model.fibres) {
    FibreSectionReport& report = report_of(fibres.member);
    ++report.yielding;
    if (!is_restrained(model, fibres.member)) continue;
    if (!report.restraint) report.restraint = restraint_of(model.frame.beam(fibres.member).section().fibres->section);
    ++report.restraint->beams;
  }
  return reports;
}

}  // namespace pounding
