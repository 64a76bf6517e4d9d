#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/frame_dofs.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {
namespace {

std::string kilonewtons(double force) { return fmt::format("{:.4g} kN", force / 1e3); }

// Directions in which an isolator acts.
std::vector<Dof> directions_of(const FrameModel& model) {
  return model.frame.dimension() == 2 ? std::vector{Dof::ux} : std::vector{Dof::ux, Dof::uy};
}

std::string name_of(const FrameModel& model, const FrameIsolator& isolator) {
  return "isolator " + model.frame.node_name(isolator.node);
}

[[noreturn]] void refuse_isolator(const FrameModel& model, const FrameIsolator& isolator, const std::string& why) {
  refuse(name_of(model, isolator) + ": " + why);
}

double stiffness_of(const FrameModel& model, const FrameIsolator& isolator) {
  try {
    // The law contains the weight.
    const std::vector<Row> deformations(directions_of(model).size(), Row(1));
    return make_isolator("", deformations, isolator.options, 0).front().stiffness();
  } catch (const std::invalid_argument& error) {
    refuse_isolator(model, isolator, error.what());
  }
}

void add_springs(FrameModel& model) {
  for (const FrameIsolator& isolator : model.isolators)
    for (const Dof along : directions_of(model))
      model.frame.add_spring(isolator.node, along, stiffness_of(model, isolator));
}

// Upward forces of the ground on the isolators [N], for their present laws.
std::vector<double> carried(FrameModel model) {
  add_springs(model);
  const AssembledFrame frame = model.frame.assemble(true);
  std::vector<int> nodes;
  for (const FrameIsolator& isolator : model.isolators) nodes.push_back(isolator.node);
  const Frame::Reactions reactions = model.frame.reactions(nodes, frame, true, true);
  const Eigen::VectorXd forces =
      reactions.by_displacements * (frame.transform * model.frame.rest(frame)) + reactions.at_rest;
  const auto dofs = dofs_of(model.frame.dimension());
  const auto up = std::ranges::find(dofs, Dof::uz) - dofs.begin();
  std::vector<double> weights;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    weights.push_back(forces[static_cast<Eigen::Index>(i * dofs.size()) + up]);
  return weights;
}

// Fixed-point iteration: the load at rest depends slightly on the stiffness of the isolators, which depends on the
// load.
void find_weights(FrameModel& model) {
  constexpr int maximum = 100;
  constexpr double enough = 1e-13;
  std::vector<bool> is_computed;
  for (FrameIsolator& isolator : model.isolators) {
    is_computed.push_back(needs_weight(isolator.options));
    if (!is_computed.back()) continue;
    if (!model.has_gravity())
      refuse_isolator(model, isolator,
                      "its weight is the load at rest, which requires gravity; type gravity: true, "
                      "or weight: 500 kN in its law");
    isolator.options.law.values["weight"] = 1e6;
  }
  if (std::ranges::find(is_computed, true) == is_computed.end()) return;
  for (int round = 0; round < maximum; ++round) {
    const std::vector<double> weights = carried(model);
    double change = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (!is_computed[i]) continue;
      if (!(weights[i] > 0))
        refuse_isolator(model, model.isolators[i],
                        fmt::format("the load at rest is {}, but a slider needs compression; type fix: [uz, ...] if it "
                                    "is not supported vertically, or increase its load",
                                    kilonewtons(weights[i])));
      double& weight = model.isolators[i].options.law.values["weight"];
      change = std::max(change, std::abs(weights[i] / weight - 1));
      weight = weights[i];
    }
    if (change < enough) return;
  }
}

void require_mass(const FrameModel& model, const FrameIsolator& isolator, const AssembledFrame& frame, Dof along,
                  const Row& deformation) {
  if (deformation.nonZeros() == 0)
    refuse_isolator(model, isolator, fmt::format("{} of its node is fixed; remove it from fix", name(along)));
  for (Row::InnerIterator it(deformation); it; ++it)
    if (frame.massless[it.index()])
      refuse_isolator(model, isolator,
                      fmt::format("its node has no mass; type masses: {{\"{}\": 40 t}} for the slab it supports",
                                  model.frame.node_name(isolator.node)));
}

// Laws with corners are linear up to the first one. `parts` are those of one element.
void require_elastic_at_rest(const FrameModel& model, const FrameIsolator& isolator,
                             std::span<const YieldingPart> parts) {
  constexpr double rounding = 1e-12;
  const YieldingPart& first = parts.front();
  std::vector<LinkMotion> motions;
  for (const YieldingPart& part : parts) motions.push_back({part.at_rest, 0});
  const double stiffness = first.stiffness(), yield = first.yield_deformation();
  const double at_rest =
      std::abs(resultant(*first.element, 0, [&](int j) { return motions[static_cast<std::size_t>(j)]; }).penetration);
  const std::array<double, max_deformations> forces = first_response(*first.element, motions).force;
  const auto is_linear = [&](double force) { return std::abs(force) <= rounding * stiffness * yield; };
  if (at_rest <= 1e-3 * yield || std::ranges::all_of(forces, is_linear)) return;
  refuse_isolator(model, isolator,
                  fmt::format("at rest, under gravity and loads, its horizontal force is {}, but it yields at {}; "
                              "connect the isolators by a slab: ties: [{{master: {}, nodes: [...], dofs: [ux]}}]",
                              kilonewtons(stiffness * at_rest), kilonewtons(stiffness * yield),
                              model.frame.node_name(isolator.node)));
}

}  // namespace

void add_part_reactions(const FrameModel& model, const Frame::Reactions& reactions,
                        const std::vector<std::pair<int, Dof>>& springs, int first_part, Structure& s) {
  const int total = static_cast<int>(s.yielding.size());
  if (s.yielding_flexibility.size() > 0) s.yielding_flexibility.conservativeResize(total, total);
  for (Floor& floor : s.floors)
    for (Row& row : floor.storey_shear_by_yielding) row.conservativeResize(total);
  Eigen::SparseMatrix<double, Eigen::RowMajor>& all = s.forces.by_yielding;
  if (all.size() == 0)
    all.resize(s.forces.rows.rows(), total);
  else
    all.conservativeResize(s.forces.rows.rows(), total);
  const auto dofs = dofs_of(model.frame.dimension());
  const int first = static_cast<int>(s.forces.rows.rows() - reactions.at_rest.size());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const auto node = std::ranges::find(reactions.nodes, springs[i].first) - reactions.nodes.begin();
    const auto along = std::ranges::find(dofs, springs[i].second) - dofs.begin();
    all.coeffRef(first + static_cast<int>(node * static_cast<std::ptrdiff_t>(dofs.size()) + along),
                 first_part + static_cast<int>(i)) = -1;
  }
  all.makeCompressed();
}

void place_isolators(FrameModel& model) {
  if (model.isolators.empty()) return;
  const FrameIsolator& first = model.isolators.front();
  if (!model.is_linear())
    refuse_isolator(model, first,
                    fmt::format("isolators are not available with {}; {}", model.nonlinear_key(),
                                instead_of_nonlinear(model, "the isolators")));
  if (model.supports.size() > 1)
    refuse_isolator(model, first,
                    "a frame on isolators needs the same motion at all supports; remove their delay and ground_motion, "
                    "or the isolators");
  find_weights(model);
  add_springs(model);
}

void let_isolators_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s) {
  if (model.isolators.empty()) return;
  const int first = static_cast<int>(s.yielding.size());
  std::vector<std::pair<int, Dof>> springs;
  for (const FrameIsolator& isolator : model.isolators) {
    std::vector<Row> deformations;
    for (const Dof along : directions_of(model)) {
      deformations.push_back(frame.motion(isolator.node, along));
      require_mass(model, isolator, frame, along, deformations.back());
      springs.emplace_back(isolator.node, along);
    }
    std::vector<YieldingPart> parts = make_isolator(name_of(model, isolator), deformations, isolator.options, 0);
    for (YieldingPart& part : parts) part.at_rest = s.at_rest.size() > 0 ? part.deformation.dot(s.at_rest) : 0;
    const auto per_element = static_cast<std::size_t>(parts.front().element->deformations());
    for (std::size_t i = 0; i < parts.size(); i += per_element)
      require_elastic_at_rest(model, isolator, std::span(parts).subspan(i, per_element));
    std::ranges::move(parts, std::back_inserter(s.yielding));
  }
  add_part_reactions(model, reactions, springs, first, s);
}

}  // namespace pounding
