#include <pounding/frames/frame.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <pounding/core/refuse.hpp>
#include <pounding/frames/frame_dofs.hpp>

namespace pounding {

using Eigen::Vector3d;
using namespace frame_dofs;

namespace {

constexpr std::array in_space{Dof::ux, Dof::uy, Dof::uz, Dof::rx, Dof::ry, Dof::rz};
constexpr std::array in_plane_dofs{Dof::ux, Dof::uz, Dof::ry};

}  // namespace

std::span<const Dof> dofs_of(int dimension) {
  return dimension == 2 ? std::span<const Dof>(in_plane_dofs) : std::span<const Dof>(in_space);
}

const char* name(Dof dof) {
  constexpr std::array names{"ux", "uy", "uz", "rx", "ry", "rz"};
  return names[static_cast<int>(dof)];
}

namespace frame_dofs {

int place(int dimension, Dof dof) {
  const auto dofs = dofs_of(dimension);
  const auto found = std::find(dofs.begin(), dofs.end(), dof);
  return found == dofs.end() ? -1 : static_cast<int>(found - dofs.begin());
}

std::vector<std::pair<Dof, double>> on_rigid_body(Dof dof, const Vector3d& arm) {
  switch (dof) {
    case Dof::ux: return {{dof, 1}, {Dof::ry, arm.z()}, {Dof::rz, -arm.y()}};
    case Dof::uy: return {{dof, 1}, {Dof::rz, arm.x()}, {Dof::rx, -arm.z()}};
    case Dof::uz: return {{dof, 1}, {Dof::rx, arm.y()}, {Dof::ry, -arm.x()}};
    default: return {{dof, 1}};
  }
}

void require_node(int node, int nodes) {
  if (node < 0 || node >= nodes)
    refuse("unknown node " + std::to_string(node) + "; number of nodes: " + std::to_string(nodes));
}

void refuse_out_of_plane(const std::string& node_name, Dof dof) {
  refuse("node " + node_name + ": a plane frame has no " + name(dof));
}

}  // namespace frame_dofs

Frame::Frame(int dimension) : dimension_(dimension) {
  if (dimension != 2 && dimension != 3) refuse("the dimension of a frame must be 2 or 3");
}

int Frame::checked(int node) const {
  require_node(node, nodes());
  return node;
}

int Frame::index(int node, Dof dof) const {
  const int at = place(dimension_, dof);
  if (at < 0) refuse_out_of_plane(node_name(node), dof);
  return checked(node) * dofs() + at;
}

std::size_t Frame::checked_member(int member) const {
  if (member < 0 || member >= members())
    refuse("unknown member " + std::to_string(member) + "; number of members: " + std::to_string(members()));
  return static_cast<std::size_t>(member);
}

std::array<int, 2> Frame::ends(int member) const { return {of(member).start, of(member).end}; }

std::string Frame::node_name(int node) const {
  const std::string& given = names_[checked(node)];
  return given.empty() ? std::to_string(node) : given;
}

std::string Frame::member_name(int member) const {
  const Member& m = of(member);
  return m.name.empty() ? std::to_string(member) + nodes_text(m.start, m.end) : m.name;
}

std::string Frame::nodes_text(int start, int end) const {
  return " (nodes " + node_name(start) + " and " + node_name(end) + ")";
}

std::string Frame::label(int at) const { return node_text(at / dofs()) + name(dofs_of(dimension_)[at % dofs()]); }

void Frame::require_not_negative(double value, int node, const char* what) const {
  if (!(value >= 0) || std::isinf(value)) refuse(node_text(node) + what + " must be finite and not negative");
}

void Frame::move_by(const Vector3d& shift) {
  if (!shift.allFinite()) refuse("the shift of a frame must be finite");
  if (dimension_ == 2 && shift.y() != 0) refuse("y must be 0 in a plane frame");
  shift_ += shift;
}

int Frame::add_node(const Vector3d& position, const std::string& name) {
  const std::string where = "node " + (name.empty() ? std::to_string(nodes()) : name) + ": ";
  if (!position.allFinite()) refuse(where + "coordinates must be finite");
  if (dimension_ == 2 && position.y() != 0) refuse(where + "y must be 0 in a plane frame");
  positions_.push_back(position - shift_);
  names_.push_back(name);
  return nodes() - 1;
}

void Frame::fix(int node, const std::vector<Dof>& dofs) {
  for (const Dof dof : dofs) fixed_.insert(index(node, dof));
}

void Frame::fix(int node) {
  for (const Dof dof : dofs_of(dimension_)) fixed_.insert(index(node, dof));
}

int Frame::add_member(int start, int end, const Section& section, const Material& material,
                      const BeamOptions& options) {
  const Vector3d &from = positions_[checked(start)], &to = positions_[checked(end)];
  const std::string where = "member " + std::to_string(members()) + nodes_text(start, end) + ": ";
  if (dimension_ == 3 && !(section.torsion > 0 && section.inertia_z > 0 && material.shear > 0))
    refuse(where + "in space, torsion, inertia_z and shear must be positive");
  if (dimension_ == 2) {
    if (options.reference) refuse(where + "a plane frame takes no reference vector");
    if (options.start_offset.y() != 0 || options.end_offset.y() != 0) refuse(where + "offsets must be in the plane");
    for (const auto* releases : {&options.start_releases, &options.end_releases})
      for (const Dof dof : *releases)
        if (place(2, dof) < 0) refuse(where + "a plane frame has no " + name(dof) + " to release");
  }
  try {
    members_.push_back({start, end, Beam(from, to, section, material, options), "", Vector3d::Zero()});
  } catch (const std::invalid_argument& error) {
    refuse(where + error.what());
  }
  connected_.insert({start, end});
  for (const int node : {start, end})
    for (const Dof dof : dofs_of(dimension_)) engaged_.insert(index(node, dof));
  return members() - 1;
}

int Frame::add_truss(int start, int end, double area, const Material& material) {
  const Vector3d &from = positions_[checked(start)], &to = positions_[checked(end)];
  try {
    members_.push_back({start, end, Beam::truss(from, to, area, material), "", Vector3d::Zero()});
  } catch (const std::invalid_argument& error) {
    refuse("truss " + std::to_string(members()) + nodes_text(start, end) + ": " + error.what());
  }
  connected_.insert({start, end});
  trussed_.insert({start, end});
  return members() - 1;
}

void Frame::set_name(int member, const std::string& name) { of(member).name = name; }

void Frame::set_axial_force(int member, double force) {
  try {
    of(member).beam.set_axial_force(force);
  } catch (const std::invalid_argument& error) {
    refuse("member " + member_name(member) + ": " + error.what());
  }
}

void Frame::add_mass(int node, double mass) {
  for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz})
    if (place(dimension_, dof) >= 0) add_mass(node, dof, mass);
}

void Frame::add_mass(int node, Dof dof, double mass) {
  const int at = index(node, dof);
  require_not_negative(mass, node, "mass");
  masses_.emplace_back(at, at, mass);
  engaged_.insert(at);
}

int Frame::add_to_ground(Entries& entries, int node, Dof dof, double value, const char* what) {
  const int at = index(node, dof);
  require_not_negative(value, node, what);
  entries.emplace_back(at, at, value);
  engaged_.insert(at);
  connected_.insert(node);
  return at;
}

void Frame::add_between(Entries& entries, int node_a, int node_b, Dof dof, double value, const std::string& what) {
  if (checked(node_a) == checked(node_b)) refuse(node_text(node_a) + what + " must connect two different nodes");
  const int a = index(node_a, dof), b = index(node_b, dof);
  entries.insert(entries.end(), {{a, a, value}, {b, b, value}, {a, b, -value}, {b, a, -value}});
  engaged_.insert({a, b});
  connected_.insert({node_a, node_b});
}

void Frame::add_spring(int node, Dof dof, double stiffness) {
  ground_springs_.emplace_back(add_to_ground(springs_, node, dof, stiffness, "stiffness"), stiffness);
}

void Frame::add_spring(int node_a, int node_b, Dof dof, double stiffness) {
  require_not_negative(stiffness, node_a, "stiffness");
  add_between(springs_, node_a, node_b, dof, stiffness, "a spring");
  between_.push_back({node_a, node_b, dof, stiffness});
}

void Frame::add_dashpot(int node, Dof dof, double coefficient) {
  add_to_ground(dashpots_, node, dof, coefficient, "the dashpot's coefficient");
}

void Frame::add_dashpot(int node_a, int node_b, Dof dof, double coefficient) {
  require_not_negative(coefficient, node_a, "the dashpot's coefficient");
  add_between(dashpots_, node_a, node_b, dof, coefficient, "a dashpot");
}

void Frame::add_load(int node, Dof dof, double force) {
  const int at = index(node, dof);
  if (!std::isfinite(force)) refuse(label(at) + ": the load must be finite");
  loads_.emplace_back(at, force);
  is_loaded_ = true;
}

void Frame::add_member_load(int member, const Vector3d& per_length) {
  Member& m = of(member);
  if (!per_length.allFinite()) refuse("member " + member_name(member) + ": the load must be finite");
  if (dimension_ == 2 && per_length.y() != 0)
    refuse("member " + member_name(member) + ": the load must be in the plane");
  m.load += per_length;
  is_loaded_ = true;
}

std::vector<double> Frame::masses_along_x() const {
  std::vector<double> masses(nodes(), 0.0);
  for (const Eigen::Triplet<double>& entry : masses_)
    if (entry.row() % dofs() == place(dimension_, Dof::ux)) masses[entry.row() / dofs()] += entry.value();
  return masses;
}

std::vector<int> Frame::grounded_nodes() const {
  std::vector<int> found;
  std::vector<bool> is_found(nodes(), false);
  const auto add = [&](int at) {
    const int node = at / dofs();
    if (!is_found[node]) found.push_back(node);
    is_found[node] = true;
  };
  for (const int at : fixed_) add(at);
  for (const auto& [at, stiffness] : ground_springs_) add(at);
  return found;
}

void Frame::follow(int node, Dof dof, int master, Row row) {
  const int at = index(node, dof);
  if (checked(master) == node) refuse(node_text(node) + "a node cannot be tied to itself");
  engaged_.insert(at);
  for (const auto& [of_master, factor] : row) engaged_.insert(of_master);
  if (!follows_.emplace(at, std::move(row)).second)
    refuse(node_text(node) + name(dof) + " is tied to more than one master");
  connected_.insert({master, node});
}

void Frame::tie(int master, int node, const std::vector<Dof>& dofs) {
  for (const Dof dof : dofs) follow(node, dof, master, {{index(master, dof), 1.0}});
}

void Frame::follow_rigidly(int node, std::span<const Dof> dofs, int master, const Vector3d& arm) {
  for (const Dof dof : dofs) {
    Row row;
    for (const auto& [of_master, factor] : on_rigid_body(dof, arm))
      if (factor != 0) row.emplace_back(index(master, of_master), factor);
    follow(node, dof, master, std::move(row));
  }
}

void Frame::tie_rigidly(int master, int node) {
  follow_rigidly(node, dofs_of(dimension_), master, positions_[checked(node)] - positions_[checked(master)]);
}

void Frame::tie_floor(int master, const std::vector<int>& nodes) {
  constexpr std::array in_floor{Dof::ux, Dof::uy, Dof::rz};
  for (const int node : nodes) {
    Vector3d arm = positions_[checked(node)] - positions_[checked(master)];
    arm.z() = 0;
    follow_rigidly(node, dimension_ == 2 ? std::span(in_floor).first(1) : std::span<const Dof>(in_floor), master, arm);
  }
}

}  // namespace pounding
