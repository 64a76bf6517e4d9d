#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/start/start.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_row(Triplets& entries, const Row& row, double factor, int first, int column) {
  for (Row::InnerIterator it(row); it; ++it)
    if (it.value() != 0) entries.emplace_back(first + static_cast<int>(it.index()), column, factor * it.value());
}

// Per structure, see rest_by_yielding().
std::vector<Eigen::VectorXd> rests_by_yielding(const Model& model) {
  std::vector<Eigen::VectorXd> rests;
  for (const Structure& s : model.structures) try {
      rests.push_back(rest_by_yielding(s));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: {}", s.name, error.what()));
    }
  return rests;
}

// Which structures an assembly includes, and the first unknown of each.
struct Included {
  std::vector<bool> structures;
  std::vector<int> first;
  int size = 0, whole = 0;  // unknowns of the assembly, and of the model

  Included(const Model& model, const std::vector<int>& wanted)
      : structures(model.structures.size(), wanted.empty()), first(model.structures.size(), 0) {
    for (const int structure : wanted) structures.at(static_cast<std::size_t>(structure)) = true;
    for (std::size_t i = 0; i < structures.size(); ++i) {
      structures[i] = structures[i] || model.structures[i].is_rigid();
      first[i] = size;
      if (structures[i]) size += model.structures[i].size();
      whole += model.structures[i].size();
    }
  }
  // True if a link or device acts: none of its ends may be left out.
  template <class Link>
  bool joins(const Model& model, const Link& link) const {
    const auto acts = [&](const LinkEnd& end) { return structures[end.structure]; };
    const auto moves = [&](const LinkEnd& end) { return acts(end) && !model.structures[end.structure].is_rigid(); };
    if (acts(link.left) && acts(link.right)) return size == whole || moves(link.left) || moves(link.right);
    if (moves(link.left) || moves(link.right))
      throw std::invalid_argument(fmt::format("{} joins a structure of the assembly with one outside it", link.name));
    return false;
  }
};

// Adds the displacement of one end of a link along `direction`, at zero unknowns, to the row of the link in terms of
// ground motions. The first support moves the whole structure; the others add differences.
void add_ground_motion(Eigen::MatrixXd& by_ground, int link, double sign, const LinkEnd& end, const Structure& s,
                       const SupportMotion& ground, const Eigen::Vector3d& direction) {
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) continue;
    if (ground.at_first(i) >= 0) by_ground(link, ground.at_first(i)) += sign * direction[i];
    const auto influence = [&](std::size_t support, int axis) {
      double moved = end.point.motion[i].dot(s.supports[support].influence.col(axis));
      if (end.point.supported[i].nonZeros() > 0)
        moved += end.point.supported[i].dot(s.supports[support].enforced.col(axis));
      return sign * direction[i] * moved;
    };
    ground.project(influence, by_ground.row(link));
  }
}

// Sliding directions in the plane of a contact, for structures of this dimension.
std::vector<Eigen::Vector3d> tangents(const Eigen::Vector3d& normal, int dimension) {
  if (dimension < 3) return {Eigen::Vector3d::UnitZ()};
  return {Eigen::Vector3d::UnitZ().cross(normal), Eigen::Vector3d::UnitZ()};
}

// Displacements of all floors: structure by structure, floor by floor, in their directions.
SparseMatrix floor_motions(const Model& model, const Included& included) {
  Triplets entries;
  int column = 0;
  for (std::size_t k = 0; k < model.structures.size(); ++k)
    if (included.structures[k])
      for (const Floor& floor : model.structures[k].floors)
        for (const Row& row : floor.motion) add_row(entries, row, 1, included.first[k], column++);
  return sparse_matrix(included.size, column, entries);
}

}  // namespace

std::vector<int> offsets(const Model& model) { return Included(model, {}).first; }

System assemble(const Model& model, const Assembly& assembly) {
  if (!model.is_complete()) throw std::logic_error("the model is not complete; call complete() before assemble()");
  const Included included(model, assembly.structures);
  const std::vector<int>& first = included.first;
  const int n = included.size;
  const bool with_links = assembly.with_links;
  const GroundPlan plan = ground_plan(model);
  System system;
  Triplets mass, damping, modal, stiffness, closing, relief;
  system.grounds = plan.motions;
  system.load = Eigen::MatrixXd::Zero(n, static_cast<int>(plan.motions.size()));
  double fastest = 0;
  for (std::size_t i = 0; i < model.structures.size(); ++i)
    if (const Structure& s = model.structures[i]; included.structures[i] && !s.is_rigid())
      fastest = std::max(fastest, s.initial_velocity.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    if (s.is_rigid() || !included.structures[i]) continue;
    add_entries(mass, s.mass, first[i]);
    add_entries(damping, s.damping, first[i]);
    add_entries(modal, s.modal_damping, first[i]);
    add_entries(stiffness, s.stiffness, first[i]);
    for (std::size_t k = 0; k < s.supports.size(); ++k)
      for (int j = 0; j < 3; ++j)
        if (const int ground = plan.supports[i].at(k, j); ground >= 0)
          system.load.col(ground).segment(first[i], s.size()) += s.supports[k].load.col(j);
    Group group{.first = first[i],
                .count = s.size(),
                .displacement_floor = 1e-12,
                .velocity_floor = 1e-9,
                .by_mass = s.by_mass,
                .by_stiffness = s.by_stiffness,
                .modal_ratio = s.modal_ratio};
    // A structure without supports has no period; one second is used instead.
    const double w = s.rigid_motions > 0 ? 2 * M_PI : std::max(s.frequencies[0], 2 * M_PI);
    group.rigid_motions = s.rigid_motions;
    // Errors are relative to the maximum motion up to then; initially, to a fraction of the possible response to the
    // ground motion.
    const int number = static_cast<int>(i);
    if (const double minimum = plan.min_displacement(number, w); minimum > 0) group.displacement_floor = minimum;
    if (const double minimum = plan.min_velocity(number, w); minimum > 0) group.velocity_floor = minimum;
    group.velocity_floor = std::max(group.velocity_floor, 1e-3 * fastest);
    // Maximum velocity after release from the state at rest under a preload.
    if (with_links && s.preload_displacement.size() > 0)
      group.velocity_floor = std::max(group.velocity_floor, 1e-2 * w * s.preload_displacement.cwiseAbs().maxCoeff());
    group.elastic = s.elastic.get();
    group.tangent = s.tangent.get();
    system.groups.push_back(group);
  }
  // A structure driven by a force may hit one at rest.
  double driven = 0;
  for (const GroundPlan::Force& force : plan.forces)
    for (const Group& group : system.groups)
      if (included.structures[force.structure] && group.first == first[force.structure])
        driven = std::max(driven, group.velocity_floor);
  for (Group& group : system.groups) group.velocity_floor = std::max(group.velocity_floor, 0.1 * driven);
  // The load is -P ag, where ag is the force itself.
  auto of_plan = plan.forces.begin();
  for (std::size_t i = 0; i < model.structures.size(); ++i)
    for (const AppliedForce& force : model.structures[i].applied_forces)
      if (const int motion = (of_plan++)->motion; included.structures[i])
        system.load.col(motion).segment(first[i], model.structures[i].size()) -= force.direction;
  system.mass = sparse_matrix(n, n, mass);
  system.damping = sparse_matrix(n, n, damping);
  if (!modal.empty()) system.modal_damping = sparse_matrix(n, n, modal);
  system.stiffness = sparse_matrix(n, n, stiffness);

  // Before the run, initial displacements load the springs slowly from the state at rest.
  const bool is_displaced =
      std::ranges::any_of(model.structures, [](const Structure& s) { return s.initial_displacement.any(); });
  std::vector<double> loaded_from;

  // Ends and sign of a column, for the effect of the ground motion.
  struct Column {
    const LinkEnd *left = nullptr, *right = nullptr;
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    bool is_device = false;
    double at_rest = 0;
  };
  std::vector<Column> columns;
  const auto add_column = [&](const auto& link, const Eigen::Vector3d& direction, bool is_device = false) {
    const int column = static_cast<int>(columns.size());
    for (const auto& [end, sign] : {std::pair(&link.left, 1), std::pair(&link.right, -1)})
      add_row(closing, motion_along(*end, direction, model.structures[end->structure].size()), sign,
              first[end->structure], column);
    columns.push_back({.left = &link.left, .right = &link.right, .direction = direction, .is_device = is_device});
  };
  if (with_links)
    for (const Link& link : model.links) {
      if (!included.joins(model, link)) continue;
      add_column(link, link.direction);
      system.contacts.push_back(link.contact.get());
      ContactMemory& memory = system.initial_contacts.emplace_back(link.contact->initial());
      if (link.pressed > 0) link.contact->press(memory, link.pressed);
      system.names.push_back(link.name);
    }
  const std::vector<Eigen::VectorXd> given_way = rests_by_yielding(model);
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    if (!included.structures[i]) continue;
    if (is_displaced)
      for (const double deformation : deformations_at_rest(model.structures[i])) loaded_from.push_back(deformation);
    add_entries(relief, model.structures[i].yielding_flexibility, static_cast<int>(system.is_part.size()));
    for (const YieldingPart& part : model.structures[i].yielding) {
      add_row(closing, part.deformation, 1, first[i], static_cast<int>(columns.size()));
      if (part.direction == 0) system.elements.push_back(part.element.get());
      system.is_part.push_back(!part.is_device());
      system.names.push_back(fmt::format("{} of {}", part.name, model.structures[i].name));
      columns.push_back({.at_rest = part.at_rest});
      // Preloads leave a device undeformed, as does gravity.
      if (const Structure& s = model.structures[i]; part.is_device() && with_links && s.preload_displacement.size() > 0)
        columns.back().at_rest -= part.deformation.dot(s.preload_displacement);
      if (part.is_device() && given_way[i].size() > 0) columns.back().at_rest -= part.deformation.dot(given_way[i]);
    }
  }
  for (const Device& device : model.devices) {
    if (!included.joins(model, device)) continue;
    add_column(device, -device.direction, true);  // elongation
    system.elements.push_back(device.member.get());
    system.is_part.push_back(false);
    system.names.push_back(device.name);
  }
  int contact = -1;
  for (const Link& link : model.links) {
    if (!with_links || !included.joins(model, link)) continue;
    ++contact;
    if (link.friction == 0) continue;
    int dimension = 1;
    for (const LinkEnd* end : {&link.left, &link.right})
      if (const Structure& s = model.structures[end->structure]; !s.is_rigid())
        dimension = std::max(dimension, s.dimension);
    const std::vector<Eigen::Vector3d> sliding = tangents(link.direction, dimension);
    system.frictions.push_back({.contact = contact,
                                .first = static_cast<int>(columns.size()),
                                .count = static_cast<int>(sliding.size()),
                                .coefficient = link.friction,
                                .sliding = link.sliding_velocity,
                                .static_coefficient = link.static_friction,
                                .stribeck = link.stribeck_velocity,
                                .stiffness = link.tangential_stiffness,
                                .ratio = link.tangential_ratio});
    for (const Eigen::Vector3d& direction : sliding) add_column(link, direction);
  }
  const int links = static_cast<int>(columns.size());
  system.gap_jacobian = sparse_matrix(n, links, closing);
  const int springs = system.spring_count();
  if (is_displaced) {
    loaded_from.resize(static_cast<std::size_t>(springs), 0.0);  // devices between structures are undeformed at rest
    system.loaded_from = Eigen::Map<const Eigen::VectorXd>(loaded_from.data(), springs);
  }
  if (!relief.empty()) system.spring_flexibility = sparse_matrix(springs, springs, relief);

  Eigen::MatrixXd by_ground = Eigen::MatrixXd::Zero(links, system.load.cols());
  Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(links);
  for (int c = 0; c < links; ++c) {
    at_rest[c] = columns[c].at_rest;
    if (!columns[c].left) continue;
    for (const auto& [end, sign] : {std::pair(columns[c].left, 1.0), std::pair(columns[c].right, -1.0)}) {
      const Structure& s = model.structures[end->structure];
      add_ground_motion(by_ground, c, sign, *end, s, plan.supports[end->structure], columns[c].direction);
      const Row row = motion_along(*end, columns[c].direction, s.size());
      if (columns[c].is_device) {
        // Preloads leave it undeformed, as does gravity.
        if (with_links && s.preload_displacement.size() > 0) at_rest[c] -= sign * row.dot(s.preload_displacement);
        if (given_way[end->structure].size() > 0) at_rest[c] -= sign * row.dot(given_way[end->structure]);
      } else if (s.at_rest.size() > 0) {
        at_rest[c] += sign * row.dot(s.at_rest);
      }
    }
  }
  if (links > 0 && by_ground.cwiseAbs().maxCoeff() > 0) system.gap_by_ground = by_ground;
  if (links > 0 && at_rest.cwiseAbs().maxCoeff() > 0) system.gravity_offset = at_rest;
  system.outputs = floor_motions(model, included);
  return system;
}

System assemble(const Model& model, bool with_links) { return assemble(model, Assembly{.with_links = with_links}); }

std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model, const Assembly& assembly) {
  const Included included(model, assembly.structures);
  Eigen::VectorXd u(included.size), v(included.size);
  const std::vector<Eigen::VectorXd> given_way = rests_by_yielding(model);
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    if (!included.structures[i]) continue;
    const Structure& s = model.structures[i];
    auto own = u.segment(included.first[i], s.size());
    own = s.initial_displacement;
    if (assembly.with_links && s.preload_displacement.size() > 0) own += s.preload_displacement;
    if (given_way[i].size() > 0) own += given_way[i];
    v.segment(included.first[i], s.size()) = s.initial_velocity;
  }
  return {u, v};
}

}  // namespace pounding
