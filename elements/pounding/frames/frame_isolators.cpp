#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <cmath>
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

std::string name_of(const FrameModel& model, const FrameIsolator& isolator) {
  const std::string node = model.frame.node_name(isolator.node);
  return model.frame.dimension() == 2 ? "isolator " + node
                                      : fmt::format("isolator {} {}", node, isolator.along == Dof::ux ? "x" : "y");
}

[[noreturn]] void refuse_isolator(const FrameModel& model, const FrameIsolator& isolator, const std::string& why) {
  refuse(name_of(model, isolator) + ": " + why);
}

double stiffness_of(const FrameModel& model, const FrameIsolator& isolator) {
  try {
    // The law contains the weight.
    return make_isolator("", Row(1), isolator.options, 0).stiffness();
  } catch (const std::invalid_argument& error) {
    refuse_isolator(model, isolator, error.what());
  }
}

void add_springs(FrameModel& model) {
  for (const FrameIsolator& isolator : model.isolators)
    model.frame.add_spring(isolator.node, isolator.along, stiffness_of(model, isolator));
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

void require_mass(const FrameModel& model, const FrameIsolator& isolator, const AssembledFrame& frame,
                  const Row& deformation) {
  if (deformation.nonZeros() == 0)
    refuse_isolator(model, isolator, fmt::format("{} of its node is fixed; remove it from fix", name(isolator.along)));
  for (Row::InnerIterator it(deformation); it; ++it)
    if (frame.massless[it.index()])
      refuse_isolator(model, isolator,
                      fmt::format("its node has no mass; type masses: {{\"{}\": 40 t}} for the slab it supports",
                                  model.frame.node_name(isolator.node)));
}

// Laws with corners are linear up to the first one.
void require_elastic_at_rest(const FrameModel& model, const FrameIsolator& isolator, const YieldingPart& part) {
  const LoadedSpring spring(part.spring());
  const double yield = part.yield_deformation();
  if (std::abs(part.at_rest) <= 1e-3 * yield || (spring->has_corners() && !spring.corner(part.at_rest))) return;
  refuse_isolator(model, isolator,
                  fmt::format("at rest, under gravity and loads, its horizontal force is {}, but it yields at {}; "
                              "connect the isolators by a slab: ties: [{{master: {}, nodes: [...], dofs: [ux]}}]",
                              kilonewtons(part.stiffness() * std::abs(part.at_rest)),
                              kilonewtons(part.stiffness() * yield), model.frame.node_name(isolator.node)));
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
  if (model.geometry == FrameGeometry::corotational)
    refuse_isolator(
        model, first,
        "isolators are not available with geometry: corotational; type geometry: p_delta, or remove the isolators");
  if (model.supports.size() > 1)
    refuse_isolator(model, first,
                    "a frame on isolators needs the same motion at all supports; remove their delay and ground_motion, "
                    "or the isolators");
  for (const FrameIsolator& isolator : model.isolators)
    if (model.frame.dimension() == 3 && isolator.options.is_coupled)
      refuse_isolator(model, isolator,
                      "in space, laws that couple x and y are not implemented; type coupled: false for independent "
                      "axes, which overestimate the force along a diagonal by up to 1.41 times");
  find_weights(model);
  add_springs(model);
}

void let_isolators_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s) {
  if (model.isolators.empty()) return;
  const int first = static_cast<int>(s.yielding.size());
  std::vector<std::pair<int, Dof>> springs;
  for (const FrameIsolator& isolator : model.isolators) {
    Row deformation = frame.motion(isolator.node, isolator.along);
    require_mass(model, isolator, frame, deformation);
    const double at_rest = s.at_rest.size() > 0 ? deformation.dot(s.at_rest) : 0;
    YieldingPart& part =
        s.yielding.emplace_back(make_isolator(name_of(model, isolator), std::move(deformation), isolator.options, 0));
    part.at_rest = at_rest;
    require_elastic_at_rest(model, isolator, part);
    springs.emplace_back(isolator.node, isolator.along);
  }
  add_part_reactions(model, reactions, springs, first, s);
}

}  // namespace pounding
