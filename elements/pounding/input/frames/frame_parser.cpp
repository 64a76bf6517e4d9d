#include <pounding/input/frames/frame_parser.hpp>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/ground_input.hpp>
#include <pounding/input/isolator_input.hpp>

namespace pounding {
namespace {

constexpr Dimension turning_damping{1, 2, -1};  // [N m s]

bool is_translation(Dof dof) { return dof < Dof::rx; }

int read_dimension(const Input& body) {
  std::optional<Input> spatial;
  if (const auto grid = body.find("grid"))
    if (const auto bays = grid->find("bays"); bays && bays->is_list()) spatial.emplace(*bays);
  if (const auto nodes = body.find("nodes"))
    for (const auto& [name, node] : nodes->entries())
      if (!spatial && node.is_list() && node.items().size() == 3) spatial.emplace(node);
  const auto given = body.find("dimension");
  if (!given) return spatial ? 3 : 2;
  const int dimension = static_cast<int>(given->as_integer());
  if (dimension == 2 && spatial)
    spatial->fail("is for a frame in space, but its dimension is 2; type dimension: 3, or leave y out");
  return dimension;
}

}  // namespace

const Dimension& of_spring(Dof dof) { return is_translation(dof) ? dimension::stiffness : dimension::energy; }
const Dimension& of_dashpot(Dof dof) { return is_translation(dof) ? dimension::damping : turning_damping; }

FrameParser::FrameParser(const Input& frame) : dimension_(read_dimension(frame)) {}

Dof FrameParser::dof(const Input& item) const {
  const std::string read = item.as_text();
  std::vector<std::string_view> allowed;
  for (const Dof dof : dofs_of(dimension_)) {
    allowed.push_back(name(dof));
    if (read == name(dof)) return dof;
  }
  item.fail(fmt::format("unknown displacement \"{}\".{}{}", excerpt(read), suggestion(read, allowed),
                        dimension_ == 2 ? " The frame is plane." : ""));
}

Dof FrameParser::dof_at_key(const std::string& key, const Input& value) const {
  std::vector<std::string_view> allowed;
  for (const Dof dof : dofs_of(dimension_)) {
    allowed.push_back(name(dof));
    if (key == name(dof)) return dof;
  }
  value.fail_at_key(fmt::format("unknown displacement \"{}\".{}{}", excerpt(key), suggestion(key, allowed),
                                dimension_ == 2 ? " The frame is plane." : ""));
}

std::vector<Dof> FrameParser::dofs(const Input& list) const {
  std::vector<Dof> dofs;
  for (const Input& item : list.items()) dofs.push_back(dof(item));
  return dofs;
}

Eigen::Vector3d FrameParser::vector(const Input& node, std::string_view example) const {
  const auto count = static_cast<std::size_t>(dimension_);
  if (!node.is_list() || node.items().size() != count)
    node.fail(fmt::format("takes {} in a frame {}; type {}", dimension_ == 2 ? "[x, z]" : "[x, y, z]",
                          dimension_ == 2 ? "in the plane" : "in space", example));
  const std::vector<Input> items = node.items();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.x() = items.front().as_quantity();
  if (dimension_ == 3) vector.y() = items[1].as_quantity();
  vector.z() = items.back().as_quantity();
  return vector;
}

std::vector<Dof> FrameParser::fixed_by(const Input& spec) const {
  const std::string kind = spec.as_choice();
  if (kind == "roller") return {Dof::uz};
  std::vector<Dof> dofs;
  for (const Dof dof : dofs_of(dimension_))
    if (kind == "fixed" || is_translation(dof)) dofs.push_back(dof);
  return dofs;
}

GroundComponents FrameParser::ground(const Input& node) const {
  if (const auto components = node.find("components"); components && dimension_ == 2) components->only_keys({"x", "z"});
  const GroundSection ground = read_ground_section(node);
  if (ground.wave) node.fail("a wave is allowed only in the ground_motion of the model; give this support a delay");
  return ground.components;
}

// Reads an isolator and adds the restraints of the other degrees of freedom.
void FrameParser::read_isolator(const Input& support, const Input& isolator, SupportWish& wish) const {
  wish.isolator = read_isolator_law(isolator);
  if (const auto coupled = isolator.find("coupled")) {
    if (dimension_ == 2) coupled->fail_at_key("is for frames in space; a plane frame moves along x only. Leave it out");
    wish.isolator->is_coupled = coupled->as_bool();
  }
  if (dimension_ == 3) {
    try {
      make_isolator("", {Row(1), Row(1)}, *wish.isolator, 1);
    } catch (const std::invalid_argument& error) {
      isolator.fail(error.what());
    }
  }
  const auto acts = [&](Dof dof) { return dof == Dof::ux || dof == Dof::uy; };
  if (const auto fix = support.find("fix")) {
    if (std::ranges::any_of(wish.fixed, acts))
      fix->fail("restrains the motion of the isolator; type fix: [uz, ry], or leave fix out");
    return;
  }
  for (const Dof dof : dofs_of(dimension_))
    if (!acts(dof)) wish.fixed.push_back(dof);
}

SupportWish FrameParser::support(const Input& node) const {
  SupportWish wish;
  if (node.is_scalar()) {
    wish.fixed = fixed_by(node);
    return wish;
  }
  node.only_keys();
  if (const auto fix = node.find("fix")) wish.fixed = fix->is_scalar() ? fixed_by(*fix) : dofs(*fix);
  if (const auto isolator = node.find("isolator")) read_isolator(node, *isolator, wish);
  const auto pairs = [&](std::string_view key, auto& into) {
    const auto given = node.find(key);
    if (!given) return;
    for (const auto& [dof_name, value] : given->entries()) {
      const Dof dof = dof_at_key(dof_name, value);
      if (std::find(wish.fixed.begin(), wish.fixed.end(), dof) != wish.fixed.end())
        value.fail_at_key(fmt::format("{} is also fixed; keep one of the two", dof_name));
      into.emplace_back(dof, value.as_quantity());
    }
  };
  pairs("springs", wish.springs);
  pairs("dashpots", wish.dashpots);
  if (wish.fixed.empty() && wish.springs.empty() && wish.dashpots.empty())
    node.fail("the support has no restraints or springs; type fix: [ux, uz], or springs: {ux: 20 MN/m}");
  wish.delay = node.quantity("delay");
  if (const auto motion = node.find("ground_motion")) wish.motion = ground(*motion);
  return wish;
}

}  // namespace pounding
