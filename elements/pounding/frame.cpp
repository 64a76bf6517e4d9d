#include <pounding/frame.hpp>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>

namespace pounding {
namespace {

using Eigen::SparseMatrix;
using Eigen::Triplet;
using Eigen::Vector3d;

constexpr std::array in_space{Dof::ux, Dof::uy, Dof::uz, Dof::rx, Dof::ry, Dof::rz};
constexpr std::array in_plane_dofs{Dof::ux, Dof::uz, Dof::ry};

std::span<const Dof> dofs_of(int dimension) {
  return dimension == 2 ? std::span<const Dof>(in_plane_dofs) : std::span<const Dof>(in_space);
}

const char* name(Dof dof) {
  constexpr std::array names{"ux", "uy", "uz", "rx", "ry", "rz"};
  return names[static_cast<int>(dof)];
}

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument(text); }

std::string node_text(int node) { return "node " + std::to_string(node) + ": "; }

void require_not_negative(double value, int node, const char* what) {
  if (!(value >= 0) || std::isinf(value)) refuse(node_text(node) + what + " must be finite and not negative");
}

// Place of a displacement among those of a node, -1 if the node has it not.
int place(int dimension, Dof dof) {
  const auto dofs = dofs_of(dimension);
  const auto found = std::find(dofs.begin(), dofs.end(), dof);
  return found == dofs.end() ? -1 : static_cast<int>(found - dofs.begin());
}

int index_of(int dimension, int nodes, int node, Dof dof) {
  if (node < 0 || node >= nodes) refuse("there is no node " + std::to_string(node) + " among " + std::to_string(nodes));
  const int at = place(dimension, dof);
  if (at < 0) refuse(node_text(node) + "a plane frame has no " + name(dof));
  return node * static_cast<int>(dofs_of(dimension).size()) + at;
}

// The displacement of a point by those of a rigid body's node, u + r x arm, as (displacement of the node, factor).
std::vector<std::pair<Dof, double>> on_rigid_body(Dof dof, const Vector3d& arm) {
  switch (dof) {
    case Dof::ux: return {{dof, 1}, {Dof::ry, arm.z()}, {Dof::rz, -arm.y()}};
    case Dof::uy: return {{dof, 1}, {Dof::rz, arm.x()}, {Dof::rx, -arm.z()}};
    case Dof::uz: return {{dof, 1}, {Dof::rx, arm.y()}, {Dof::ry, -arm.x()}};
    default: return {{dof, 1}};
  }
}

SparseMatrix<double> symmetric(const SparseMatrix<double>& m) { return 0.5 * (m + SparseMatrix<double>(m.transpose())); }

// A motion without inertia that is no single unknown, such as the turning of a rigid floor with its mass at one node
// other than the master, would leave the accelerations undetermined.
void require_regular(const SparseMatrix<double>& mass, const AssembledFrame& frame) {
  std::vector<Triplet<double>> entries;
  for (int j = 0; j < mass.outerSize(); ++j) {
    if (frame.massless[j]) entries.emplace_back(j, j, 1.0);
    for (SparseMatrix<double>::InnerIterator it(mass, j); it; ++it) entries.emplace_back(it.row(), j, it.value());
  }
  SparseMatrix<double> padded(mass.rows(), mass.cols());
  padded.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix<double>> factor(padded);
  const Eigen::VectorXd pivots = factor.permutationPinv() * factor.vectorD();
  for (int j = 0; j < mass.rows(); ++j)
    if (!(pivots[j] > 1e-12 * padded.coeff(j, j)))
      refuse(node_text(frame.unknowns[j].first) + "the masses leave a motion with " + name(frame.unknowns[j].second) +
             " without inertia; put the mass of a rigid part at its master, spread it, or give the master a rotational one");
}

}  // namespace

Eigen::SparseVector<double> AssembledFrame::motion(int node, Dof dof, const Vector3d& arm) const {
  Eigen::SparseVector<double> sum(size());
  for (const auto& [of_node, factor] : on_rigid_body(dof, arm)) {
    if (factor == 0) continue;
    const int row = index_of(dimension, static_cast<int>(positions.size()), node, of_node);
    sum += factor * Eigen::SparseVector<double>(transform.row(row).transpose());
  }
  return sum;
}

Frame::Frame(int dimension) : dimension_(dimension) {
  if (dimension != 2 && dimension != 3) refuse("a frame has 2 or 3 dimensions");
}

int Frame::checked(int node) const { return index(node, Dof::ux) / dofs(); }

int Frame::index(int node, Dof dof) const { return index_of(dimension_, nodes(), node, dof); }

int Frame::add_node(const Vector3d& position) {
  if (!position.allFinite()) refuse(node_text(nodes()) + "its coordinates must be finite");
  if (dimension_ == 2 && position.y() != 0) refuse(node_text(nodes()) + "y must be 0 in a plane frame");
  positions_.push_back(position);
  return nodes() - 1;
}

void Frame::fix(int node, const std::vector<Dof>& dofs) {
  for (const Dof dof : dofs) fixed_.insert(index(node, dof));
}

void Frame::fix(int node) {
  for (const Dof dof : dofs_of(dimension_)) fixed_.insert(index(node, dof));
}

int Frame::add_member(int start, int end, const Section& section, const Material& material, const BeamOptions& options) {
  const std::string where = "member " + std::to_string(members()) + " (nodes " + std::to_string(start) + " and " +
                            std::to_string(end) + "): ";
  const Vector3d &from = position(start), &to = position(end);
  if (dimension_ == 3 && !(section.torsion > 0 && section.inertia_z > 0 && material.shear > 0))
    refuse(where + "in space torsion, inertia_z and shear must be positive");
  if (dimension_ == 2) {
    if (options.reference) refuse(where + "a plane frame takes no reference vector");
    if (options.start_offset.y() != 0 || options.end_offset.y() != 0) refuse(where + "offsets leave the plane");
    for (const auto* releases : {&options.start_releases, &options.end_releases})
      for (const Dof dof : *releases)
        if (place(2, dof) < 0) refuse(where + "a plane frame has no " + name(dof) + " to release");
  }
  try {
    members_.push_back({start, end, Beam(from, to, section, material, options)});
  } catch (const std::invalid_argument& error) {
    refuse(where + error.what());
  }
  connected_.insert({start, end});
  return members() - 1;
}

void Frame::add_mass(int node, double mass) {
  for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz})
    if (place(dimension_, dof) >= 0) add_mass(node, dof, mass);
}

void Frame::add_mass(int node, Dof dof, double mass) {
  require_not_negative(mass, node, "mass");
  const int at = index(node, dof);
  masses_.emplace_back(at, at, mass);
}

void Frame::add_spring(int node, Dof dof, double stiffness) {
  require_not_negative(stiffness, node, "stiffness");
  const int at = index(node, dof);
  springs_.emplace_back(at, at, stiffness);
  connected_.insert(node);
}

void Frame::add_spring(int node_a, int node_b, Dof dof, double stiffness) {
  require_not_negative(stiffness, node_a, "stiffness");
  const int a = index(node_a, dof), b = index(node_b, dof);
  if (a == b) refuse(node_text(node_a) + "a spring from the node to itself");
  springs_.insert(springs_.end(), {{a, a, stiffness}, {b, b, stiffness}, {a, b, -stiffness}, {b, a, -stiffness}});
  connected_.insert({node_a, node_b});
}

void Frame::follow(int node, Dof dof, int master, Row row) {
  const int at = index(node, dof);
  if (checked(master) == node) refuse(node_text(node) + "tied to itself");
  std::erase_if(row, [](const auto& term) { return term.second == 0; });
  if (!follows_.emplace(at, std::move(row)).second) refuse(node_text(node) + name(dof) + " is tied twice");
  connected_.insert({master, node});
}

void Frame::tie(int master, int node, const std::vector<Dof>& dofs) {
  for (const Dof dof : dofs) follow(node, dof, master, {{index(master, dof), 1.0}});
}

void Frame::tie_rigidly(int master, int node) {
  const Vector3d arm = position(node) - position(master);
  for (const Dof dof : dofs_of(dimension_)) {
    Row row;
    for (const auto& [of_master, factor] : on_rigid_body(dof, arm))
      if (factor != 0) row.emplace_back(index(master, of_master), factor);
    follow(node, dof, master, std::move(row));
  }
}

void Frame::tie_floor(int master, const std::vector<int>& nodes) {
  for (const int node : nodes) {
    if (dimension_ == 2) {
      tie(master, node, {Dof::ux});
      continue;
    }
    const Vector3d arm = position(node) - position(master);
    follow(node, Dof::ux, master, {{index(master, Dof::ux), 1.0}, {index(master, Dof::rz), -arm.y()}});
    follow(node, Dof::uy, master, {{index(master, Dof::uy), 1.0}, {index(master, Dof::rz), arm.x()}});
    tie(master, node, {Dof::rz});
  }
}

SparseMatrix<double, Eigen::RowMajor> Frame::transform(std::vector<std::pair<int, Dof>>& unknowns) const {
  const int all = nodes() * dofs();
  const auto label = [&](int at) { return node_text(at / dofs()) + name(dofs_of(dimension_)[at % dofs()]); };
  std::vector<int> column(all, -1);
  for (int at = 0; at < all; ++at) {
    const bool is_fixed = fixed_.contains(at), follows = follows_.contains(at);
    if (is_fixed && follows) refuse(label(at) + " is both fixed and tied to another node");
    if (is_fixed || follows) continue;
    column[at] = static_cast<int>(unknowns.size());
    unknowns.emplace_back(at / dofs(), dofs_of(dimension_)[at % dofs()]);
  }

  std::vector<Triplet<double>> entries;
  for (int row = 0; row < all; ++row) {
    // Terms still to be traced back to unknowns; a chain longer than all displacements is a circle.
    std::vector<Triplet<double>> open{{row, 0, 1.0}};
    while (!open.empty()) {
      const auto [at, depth, factor] = std::tuple(open.back().row(), open.back().col(), open.back().value());
      open.pop_back();
      if (column[at] >= 0) entries.emplace_back(row, column[at], factor);
      const auto master = follows_.find(at);
      if (master == follows_.end()) continue;
      if (depth > static_cast<int>(follows_.size())) refuse(label(row) + " is tied to itself through others");
      for (const auto& [next, share] : master->second) open.emplace_back(next, depth + 1, factor * share);
    }
  }
  SparseMatrix<double, Eigen::RowMajor> t(all, unknowns.size());
  t.setFromTriplets(entries.begin(), entries.end());
  return t;
}

// Of all displacements: the entries at the nodes and the members' matrices.
SparseMatrix<double> Frame::gathered(const std::vector<Triplet<double>>& nodal,
                                     Matrix12 (Beam::*of_member)() const) const {
  std::vector<Triplet<double>> entries = nodal;
  for (const Member& member : members_) {
    const Matrix12 matrix = (member.beam.*of_member)();
    std::vector<std::pair<int, int>> rows;  // of the frame, of the member
    for (const Dof dof : dofs_of(dimension_)) {
      rows.emplace_back(index(member.start, dof), static_cast<int>(dof));
      rows.emplace_back(index(member.end, dof), 6 + static_cast<int>(dof));
    }
    for (const auto& [row, i] : rows)
      for (const auto& [column, j] : rows)
        if (matrix(i, j) != 0) entries.emplace_back(row, column, matrix(i, j));
  }
  SparseMatrix<double> sum(nodes() * dofs(), nodes() * dofs());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

AssembledFrame Frame::assemble() const {
  for (int node = 0; node < nodes(); ++node)
    if (!connected_.contains(node)) refuse(node_text(node) + "no member, spring or constraint is connected to it");

  AssembledFrame out;
  out.dimension = dimension_;
  out.positions = positions_;
  out.transform = transform(out.unknowns);
  const SparseMatrix<double> t = out.transform;
  const SparseMatrix<double> mass = gathered(masses_, &Beam::mass);
  const int n = static_cast<int>(t.cols());
  out.stiffness = symmetric(t.transpose() * gathered(springs_, &Beam::stiffness) * t);
  out.mass = symmetric(t.transpose() * mass * t);
  // At the centre of a floor's mass the products m x arm add up to zero but for rounding.
  const Eigen::VectorXd diagonal = out.mass.diagonal();
  out.mass.prune([&](int i, int j, double value) { return std::abs(value) > 1e-14 * std::sqrt(diagonal[i] * diagonal[j]); });

  out.influence = Eigen::MatrixX3d::Zero(n, 3);
  for (int j = 0; j < n; ++j) {
    const int direction = static_cast<int>(out.unknowns[j].second);
    if (direction < 3) out.influence(j, direction) = 1;
    out.massless.push_back(diagonal[j] == 0);
    if (diagonal[j] == 0 && out.stiffness.coeff(j, j) == 0)
      refuse(node_text(out.unknowns[j].first) + name(out.unknowns[j].second) +
             " has neither stiffness nor mass; fix it or connect it");
  }
  Eigen::MatrixX3d moving = Eigen::MatrixX3d::Zero(t.rows(), 3);
  for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz})
    if (place(dimension_, dof) >= 0)
      for (int node = 0; node < nodes(); ++node) moving(index(node, dof), static_cast<int>(dof)) = 1;
  out.load = t.transpose() * (mass * moving);
  require_regular(out.mass, out);
  return out;
}

Vector12 Frame::end_forces(int member, const AssembledFrame& assembled, const Eigen::VectorXd& q) const {
  if (member < 0 || member >= members())
    refuse("there is no member " + std::to_string(member) + " among " + std::to_string(members()));
  const Member& of = members_[member];
  Vector12 displacements = Vector12::Zero();
  for (const Dof dof : dofs_of(dimension_)) {
    displacements[static_cast<int>(dof)] = assembled.transform.row(index(of.start, dof)).dot(q);
    displacements[6 + static_cast<int>(dof)] = assembled.transform.row(index(of.end, dof)).dot(q);
  }
  return of.beam.end_forces(displacements);
}

namespace {

// One value for all or one each, positive.
std::vector<double> spread(const std::vector<double>& given, int count, const char* what, bool may_be_zero = false) {
  std::vector<double> all = given.size() == 1 ? std::vector<double>(count, given.front()) : given;
  if (static_cast<int>(all.size()) != count) refuse(std::string(what) + ": one value, or " + std::to_string(count));
  for (const double value : all)
    if (!(may_be_zero ? value >= 0 : value > 0) || std::isinf(value))
      refuse(std::string(what) + (may_be_zero ? " must be finite and not negative" : " must be positive and finite"));
  return all;
}

// Coordinates of the grid lines.
std::vector<double> lines(double origin, const std::vector<double>& widths) {
  std::vector<double> at{origin};
  for (const double width : widths) at.push_back(at.back() + width);
  return at;
}

// Part of the whole width that belongs to each line, half a bay on each side; all of it when there is one line only.
std::vector<double> shares(const std::vector<double>& widths) {
  if (widths.empty()) return {1.0};
  const double whole = std::accumulate(widths.begin(), widths.end(), 0.0);
  std::vector<double> share(widths.size() + 1, 0.0);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    share[i] += 0.5 * widths[i] / whole;
    share[i + 1] += 0.5 * widths[i] / whole;
  }
  return share;
}

}  // namespace

int GridFrame::node(int storey, int i, int k) const {
  if (storey < 0 || storey > storeys || i < 0 || i > bays_x || k < 0 || k > bays_y)
    refuse("the grid has no node (" + std::to_string(storey) + ", " + std::to_string(i) + ", " + std::to_string(k) + ")");
  return (storey * (bays_y + 1) + k) * (bays_x + 1) + i;
}

int GridFrame::floor(int storey) const {
  const int first = node(storey, 0);
  if (storey == 0) refuse("the ground is no floor");
  return bays_y == 0 ? first : node(storeys, bays_x, bays_y) + storey;
}

Frame make_frame(const GridFrame& grid) {
  if (grid.storeys < 1 || grid.bays_x < 1 || grid.bays_y < 0) refuse("a grid needs a storey and a bay along x");
  const std::vector<double> width_x = spread(grid.bay_width_x, grid.bays_x, "bay_width_x");
  const std::vector<double> width_y =
      grid.bays_y > 0 ? spread(grid.bay_width_y, grid.bays_y, "bay_width_y") : std::vector<double>{};
  const std::vector<double> x = lines(grid.origin.x(), width_x), y = lines(grid.origin.y(), width_y);
  const std::vector<double> z = lines(grid.origin.z(), spread(grid.storey_height, grid.storeys, "storey_height"));
  const std::vector<double> floor_mass = spread(grid.floor_mass, grid.storeys, "floor_mass", true);
  const std::vector<double> share_x = shares(width_x), share_y = shares(width_y);

  Frame frame(grid.bays_y == 0 ? 2 : 3);
  const auto each = [&](int storey, auto&& act) {
    for (int k = 0; k <= grid.bays_y; ++k)
      for (int i = 0; i <= grid.bays_x; ++i) act(grid.node(storey, i, k), i, k);
  };
  for (int storey = 0; storey <= grid.storeys; ++storey)
    each(storey, [&](int, int i, int k) {
      const int node = frame.add_node({x[i], y[k], z[storey]});
      if (storey == 0) frame.fix(node);
      else frame.add_mass(node, floor_mass[storey - 1] * share_x[i] * share_y[k]);
    });

  const BeamOptions options{.mass = grid.mass};
  for (int storey = 1; storey <= grid.storeys; ++storey)
    each(storey, [&](int node, int i, int k) {
      frame.add_member(grid.node(storey - 1, i, k), node, grid.column, grid.material, options);
      if (i < grid.bays_x) frame.add_member(node, grid.node(storey, i + 1, k), grid.beam, grid.material, options);
      if (k < grid.bays_y) frame.add_member(node, grid.node(storey, i, k + 1), grid.beam, grid.material, options);
    });

  for (int storey = 1; grid.rigid_floors && storey <= grid.storeys; ++storey) {
    std::vector<int> nodes;
    Vector3d centre(0, 0, z[storey]);
    each(storey, [&](int node, int i, int k) {
      nodes.push_back(node);
      centre += share_x[i] * share_y[k] * Vector3d(x[i], y[k], 0);
    });
    if (grid.bays_y == 0) nodes.erase(nodes.begin());
    else frame.fix(frame.add_node(centre), {Dof::uz, Dof::rx, Dof::ry});
    frame.tie_floor(grid.floor(storey), nodes);
  }
  return frame;
}

}  // namespace pounding
