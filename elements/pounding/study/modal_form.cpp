#include <pounding/study/modal_form.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <variant>

#include <pounding/links/gap_contact.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/structure_damping.hpp>

namespace pounding::study {
namespace {

// Relative size of off-diagonal entries of a modal damping matrix that are round-off.
constexpr double rounding = 1e-11;

// Law of a contact, if it is a law of the library with a force.
template <std::size_t I = 0>
std::optional<laws::AnyLaw> law_of(const Contact& contact) {
  if constexpr (I == std::variant_size_v<laws::AnyLaw>) {
    return std::nullopt;
  } else {
    using Law = std::variant_alternative_t<I, laws::AnyLaw>;
    if constexpr (!laws::instantaneous<Law>)
      if (const auto* link = dynamic_cast<const GapContact<Law>*>(&contact)) return link->law();
    return law_of<I + 1>(contact);
  }
}

struct Block {
  int first = 0;
  Eigen::MatrixXd shapes;  // Phi, with Phi^T M Phi = 1
  Eigen::VectorXd squares, damping;
  bool classical = true;
};

Block block_of(const Structure& s, int first) {
  const Eigenmodes found = dense_modes(s.mass, s.stiffness, count_of_modes(s));
  Block block{.first = first, .shapes = found.shapes, .squares = found.frequencies.array().square(), .damping = {}};
  Eigen::MatrixXd damping = found.shapes.transpose() * (s.whole_damping() * found.shapes);
  block.damping = damping.diagonal().cwiseMax(0);
  damping.diagonal().setZero();
  block.classical = damping.cwiseAbs().maxCoeff() <= rounding * block.damping.maxCoeff();
  return block;
}

std::string unfit(const Structure& s) {
  if (!s.yielding.empty()) return s.name + " yields";
  if (const std::string why = s.why_stiffness_changes(); !why.empty()) return s.name + ": " + why;
  if (!s.applied_forces.empty()) return s.name + " has forces over time";
  return "";
}

std::string unfit(const Model& model) {
  for (const Structure& s : model.structures)
    if (const std::string why = unfit(s); !why.empty()) return why;
  if (!model.devices.empty()) return "there are bars or dampers between structures";
  std::optional<std::size_t> law;
  for (const Link& link : model.links) {
    if (link.friction > 0) return "link " + link.name + " has friction";
    if (link.preload) return "link " + link.name + " is closed at the start";
    const std::optional<laws::AnyLaw> found = law_of(*link.contact);
    if (!found) return "link " + link.name + ": its law is not a penalty law of the library";
    if (law && *law != found->index()) return "links by different laws";
    law = found->index();
  }
  if (model.ground.components[0].is_still() || !model.ground.components[1].is_still() ||
      !model.ground.components[2].is_still())
    return "the ground motion is not along x only";
  if (ground_plan(model).motions.size() != 1) return "the ground motion differs between supports";
  return "";
}

std::vector<double> numbers_of(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

}  // namespace

std::string needs_solver(const Model& model) {
  if (std::string why = unfit(model); !why.empty()) return why;
  for (const Structure& s : model.structures)
    if (!s.is_rigid() && !block_of(s, 0).classical) return "the damping of " + s.name + " couples its modes";
  const System system = assemble(model);
  if (system.gap_by_ground.size() > 0) return "the ground motion differs between the two sides of a link";
  return "";
}

LinearModel modal_form(const Model& model, bool accelerations) {
  if (const std::string why = needs_solver(model); !why.empty())
    throw std::invalid_argument("this model requires the solver: " + why);
  const std::vector<int> first = offsets(model);
  const System system = assemble(model);
  const auto [u, v] = initial_state(model);
  std::vector<Block> blocks(model.structures.size());
  std::vector<Eigen::Index> mode(model.structures.size());
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    mode[i] = count;
    if (model.structures[i].is_rigid()) continue;
    blocks[i] = block_of(model.structures[i], first[i]);
    count += blocks[i].shapes.cols();
  }
  Eigen::VectorXd squares(count), damping(count), load(count), q(count), dq(count);
  // Modal factors from factors of the unknowns.
  const auto in_modes = [&](const Eigen::VectorXd& factors) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(count);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (blocks[i].shapes.size() > 0)
        all.segment(mode[i], blocks[i].shapes.cols()) =
            blocks[i].shapes.transpose() * factors.segment(first[i], blocks[i].shapes.rows());
    return all;
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].shapes.size() == 0) continue;
    const Eigen::Index modes = blocks[i].shapes.cols();
    squares.segment(mode[i], modes) = blocks[i].squares;
    damping.segment(mode[i], modes) = blocks[i].damping;
  }
  load = in_modes(system.load.col(0));
  q = in_modes(system.mass * u);
  dq = in_modes(system.mass * v);
  LinearModel linear;
  linear.stiffness = numbers_of(squares), linear.damping = numbers_of(damping), linear.load = numbers_of(load);
  if (!q.isZero(0)) linear.displacement = numbers_of(q);
  if (!dq.isZero(0)) linear.velocity = numbers_of(dq);
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    const auto column = static_cast<Eigen::Index>(l);
    const double offset = system.gravity_offset.size() > 0 ? system.gravity_offset[column] : 0;
    linear.links.push_back({.gap = model.links[l].gap - offset,
                            .closing = numbers_of(in_modes(Eigen::VectorXd(system.gap_jacobian.col(column)))),
                            .law = *law_of(*model.links[l].contact)});
  }
  const auto output = [&](Output::Kind kind, std::size_t i, const Row& row) {
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(system.size());
    factors.segment(first[i], row.size()) = Eigen::VectorXd(row);
    linear.outputs.push_back({.kind = kind, .factors = numbers_of(in_modes(factors))});
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].shapes.size() == 0) continue;
    const std::vector<Floor>& floors = model.structures[i].floors;
    for (const Floor& floor : floors) output(Output::Kind::displacement, i, floor.motion[0]);
    if (model.structures[i].has_storeys())
      for (std::size_t f = 0; f < floors.size(); ++f)
        output(Output::Kind::displacement, i,
               f == 0 ? floors[f].motion[0] : Row(floors[f].motion[0] - floors[f - 1].motion[0]));
    if (accelerations)
      for (const Floor& floor : floors) output(Output::Kind::acceleration, i, floor.motion[0]);
  }
  linear.check();
  return linear;
}

}  // namespace pounding::study
