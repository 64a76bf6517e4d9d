#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include <pounding/model/model.hpp>

namespace pounding {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_entries(Triplets& entries, const SparseMatrix& block, int first) {
  for (int j = 0; j < block.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(block, j); it; ++it)
      if (it.value() != 0) entries.emplace_back(first + static_cast<int>(it.row()), first + j, it.value());
}

void add_row(Triplets& entries, const Row& row, double factor, int first, int column) {
  for (Row::InnerIterator it(row); it; ++it)
    if (it.value() != 0) entries.emplace_back(first + static_cast<int>(it.index()), column, factor * it.value());
}

SparseMatrix sparse(const Triplets& entries, int rows, int columns) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Later than where the wave arrives first.
double delay_by_wave(const Model& model, const Eigen::Vector3d& position) {
  if (!model.ground.wave) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Structure& s : model.structures)
    for (const Support& support : s.supports) nearest = std::min(nearest, support.position.dot(model.ground.wave->direction));
  return (position.dot(model.ground.wave->direction) - nearest) / model.ground.wave->velocity;
}

// Where a structure has no unknowns it goes with its ground, which what rubs on it feels; a body has none but along x.
bool moves_along(const Structure& s, int direction) { return direction == 0 || !s.is_free; }

int total_size(const Model& model) {
  int count = 0;
  for (const Structure& s : model.structures) count += s.size();
  return count;
}

// Displacement of a point in a direction when the ground at one support moves by one along an axis and the unknowns rest:
// they are relative to the first support, and the statical displacement goes with the others.
void add_ground_motion(Eigen::MatrixXd& closing, int column_of_link, double sign, const LinkEnd& end, const Structure& s,
                       const std::vector<std::array<int, 3>>& under, const Eigen::Vector3d& direction) {
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) continue;
    if (under.front()[i] >= 0) closing(column_of_link, under.front()[i]) += sign * direction[i];
    for (std::size_t k = 1; k < s.supports.size(); ++k)
      for (int j = 0; j < 3; ++j) {
        double moved = end.point.motion[i].dot(s.supports[k].influence.col(j));
        if (end.point.supported[i].nonZeros() > 0) moved += end.point.supported[i].dot(s.supports[k].enforced.col(j));
        const double part = sign * direction[i] * moved;
        if (part == 0) continue;
        if (under[k][j] >= 0) closing(column_of_link, under[k][j]) += part;
        if (under.front()[j] >= 0) closing(column_of_link, under.front()[j]) -= part;
      }
  }
}

// Directions in the plane of a contact in which structures of this dimension slide.
std::vector<Eigen::Vector3d> tangents(const Eigen::Vector3d& normal, int dimension) {
  if (dimension < 3) return {Eigen::Vector3d::UnitZ()};
  return {Eigen::Vector3d::UnitZ().cross(normal), Eigen::Vector3d::UnitZ()};
}

// Motion of all floors: structure by structure, floor by floor, in their directions.
SparseMatrix floor_motions(const Model& model) {
  const std::vector<int> first = offsets(model);
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0, n = 0;
  for (std::size_t k = 0; k < model.structures.size(); ++k) {
    n += model.structures[k].size();
    for (const Floor& floor : model.structures[k].floors)
      for (const Row& row : floor.motion) {
        for (Row::InnerIterator it(row); it; ++it)
          entries.emplace_back(first[k] + static_cast<int>(it.index()), column, it.value());
        ++column;
      }
  }
  SparseMatrix matrix(n, column);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

GroundPlan ground_plan(const Model& model) {
  GroundPlan plan;
  // Which motion (-1 the model's, else that of a support), along which axis, how late.
  std::map<std::tuple<int, int, double>, int> known;
  int own = 0;
  for (const Structure& s : model.structures) {
    std::vector<std::array<int, 3>>& under = plan.under.emplace_back();
    for (const Support& support : s.supports) {
      const int source = support.motion ? own++ : -1;
      const GroundComponents& components = support.motion ? *support.motion : model.ground.components;
      const double delay = support.delay + (support.motion ? 0 : delay_by_wave(model, support.position));
      std::array<int, 3> index{-1, -1, -1};
      for (int i = 0; i < 3; ++i) {
        if (components[i].is_still() || !moves_along(s, i)) continue;
        const auto [place, is_new] = known.emplace(std::tuple(source, i, delay), static_cast<int>(plan.motions.size()));
        if (is_new) plan.motions.push_back(delay == 0 ? components[i] : components[i].delayed(delay));
        index[i] = place->second;
      }
      under.push_back(index);
    }
  }
  if (plan.motions.empty()) plan.motions.emplace_back();
  return plan;
}

double GroundPlan::peak() const {
  double largest = 0;
  for (const GroundMotion& motion : motions) largest = std::max(largest, motion.peak());
  return largest;
}

double GroundPlan::duration() const {
  double last = 0;
  for (const GroundMotion& motion : motions) last = std::max(last, motion.duration());
  return last;
}

double GroundPlan::sample_step() const {
  double shortest = 0;
  for (const GroundMotion& motion : motions)
    if (motion.sample_step() > 0) shortest = shortest > 0 ? std::min(shortest, motion.sample_step()) : motion.sample_step();
  return shortest;
}

double GroundPlan::shortest_period() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const GroundMotion& motion : motions) shortest = std::min(shortest, motion.shortest_period());
  return shortest;
}

std::vector<int> offsets(const Model& model) {
  std::vector<int> first;
  int count = 0;
  for (const Structure& s : model.structures) {
    first.push_back(count);
    count += s.size();
  }
  return first;
}

System assemble(const Model& model, bool with_links) {
  if (!model.is_complete()) throw std::logic_error("this model is not complete; call its complete() before it is assembled");
  const std::vector<int> first = offsets(model);
  const int n = total_size(model);
  const GroundPlan plan = ground_plan(model);
  const double peak = plan.peak();
  System system;
  Triplets mass, damping, stiffness, closing;
  system.grounds = plan.motions;
  system.load = Eigen::MatrixXd::Zero(n, static_cast<int>(plan.motions.size()));
  double fastest = 0;
  for (const Structure& s : model.structures)
    if (!s.is_rigid()) fastest = std::max(fastest, s.initial_velocity.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    if (s.is_rigid()) continue;
    add_entries(mass, s.mass, first[i]);
    add_entries(damping, s.damping, first[i]);
    add_entries(stiffness, s.stiffness, first[i]);
    for (std::size_t k = 0; k < s.supports.size(); ++k)
      for (int j = 0; j < 3; ++j)
        if (plan.under[i][k][j] >= 0)
          system.load.col(plan.under[i][k][j]).segment(first[i], s.size()) += s.supports[k].load.col(j);
    // Errors are compared with the motion so far; before there is any, with a hundredth of what the ground can cause.
    Group group{first[i], s.size(), 1e-12, 1e-9, s.by_mass, s.by_stiffness};
    group.velocity_floor = std::max(group.velocity_floor, 1e-3 * fastest);
    // A free body has no period; the ground moves it for as long as it moves, which a second stands for.
    const double w = std::max(s.frequencies[0], 2 * M_PI);
    group.displacement_floor = std::max(group.displacement_floor, 1e-2 * peak / (w * w));
    group.velocity_floor = std::max(group.velocity_floor, 1e-2 * peak / w);
    group.elastic = s.elastic.get();
    system.groups.push_back(group);
  }
  system.mass = sparse(mass, n, n);
  system.damping = sparse(damping, n, n);
  system.stiffness = sparse(stiffness, n, n);

  // Which way a column closes, for what the ground does to it.
  struct Column {
    const Link* link = nullptr;
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  };
  std::vector<Column> columns;
  const auto add_column = [&](const Link& link, const Eigen::Vector3d& direction) {
    const int column = static_cast<int>(columns.size());
    for (int i = 0; i < 3; ++i) {
      if (direction[i] == 0) continue;
      add_row(closing, link.left.point.motion[i], direction[i], first[link.left.structure], column);
      add_row(closing, link.right.point.motion[i], -direction[i], first[link.right.structure], column);
    }
    columns.push_back({&link, direction});
  };
  if (with_links)
    for (const Link& link : model.links) {
      add_column(link, link.direction);
      system.contacts.push_back(link.contact.get());
      system.names.push_back(link.name);
    }
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const std::vector<YieldingStorey>& storeys = model.structures[i].yielding;
    for (std::size_t storey = 0; storey < storeys.size(); ++storey) {
      const int column = static_cast<int>(columns.size()), floor = first[i] + static_cast<int>(storey);
      closing.emplace_back(floor, column, 1);
      if (storey > 0) closing.emplace_back(floor - 1, column, -1);
      Archive fresh(storeys[storey].fresh);
      storeys[storey].spring->archive(fresh);
      system.springs.push_back(storeys[storey].spring.get());
      columns.emplace_back();
    }
  }
  for (std::size_t i = 0; with_links && i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.friction == 0) continue;
    int dimension = 1;
    for (const LinkEnd* end : {&link.left, &link.right})
      if (const Structure& s = model.structures[end->structure]; !s.is_rigid()) dimension = std::max(dimension, s.dimension);
    const std::vector<Eigen::Vector3d> sliding = tangents(link.direction, dimension);
    system.frictions.push_back({.contact = static_cast<int>(i),
                                .first = static_cast<int>(columns.size()),
                                .count = static_cast<int>(sliding.size()),
                                .coefficient = link.friction,
                                .sliding = link.sliding_velocity});
    for (const Eigen::Vector3d& direction : sliding) add_column(link, direction);
  }
  const int links = static_cast<int>(columns.size());
  system.gap_jacobian = sparse(closing, n, links);

  Eigen::MatrixXd by_ground = Eigen::MatrixXd::Zero(links, system.load.cols());
  Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(links);
  for (int c = 0; c < links; ++c) {
    if (!columns[c].link) continue;
    const Link& link = *columns[c].link;
    for (const auto& [end, sign] : {std::pair(&link.left, 1.0), std::pair(&link.right, -1.0)}) {
      const Structure& s = model.structures[end->structure];
      add_ground_motion(by_ground, c, sign, *end, s, plan.under[end->structure], columns[c].direction);
      if (s.at_rest.size() == 0) continue;
      for (int i = 0; i < 3; ++i) at_rest[c] += sign * columns[c].direction[i] * end->point.motion[i].dot(s.at_rest);
    }
  }
  if (links > 0 && by_ground.cwiseAbs().maxCoeff() > 0) system.gap_by_ground = by_ground;
  if (links > 0 && at_rest.cwiseAbs().maxCoeff() > 0) system.gravity_offset = at_rest;
  system.outputs = floor_motions(model);
  return system;
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model) {
  const std::vector<int> first = offsets(model);
  const int n = total_size(model);
  Eigen::VectorXd u(n), v(n);
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    u.segment(first[i], s.size()) = s.initial_displacement;
    v.segment(first[i], s.size()) = s.initial_velocity;
  }
  return {u, v};
}

}  // namespace pounding
