#include <pounding/input/frames/hinge_input.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/hysteresis/all.hpp>
#include <pounding/input/frames/frame_parts_input.hpp>
#include <pounding/input/frames/whole_members.hpp>
#include <pounding/input/keys/yielding_keys.hpp>
#include <pounding/input/spring_input.hpp>

namespace pounding {
namespace {

// Yield moments: sagging, and hogging if given.
std::pair<double, std::optional<double>> read_moments(const Input& node) {
  if (!node.is_list()) return {node.as_quantity(dimension::energy, bounds::positive), std::nullopt};
  const std::vector<Input> items = node.items();
  if (items.size() != 2)
    node.fail(
        fmt::format("takes one moment, or two, [sagging, -hogging]; type [210 kN m, -260 kN m]; a list of {} was read",
                    items.size()));
  const double hogging = items[1].as_quantity(dimension::energy, bounds::any);
  if (!(hogging < 0))
    items[1].fail("the second moment is the hogging moment and must be negative; type [210 kN m, -260 kN m]");
  return {items[0].as_quantity(dimension::energy, bounds::positive), -hogging};
}

// The law of this name with the parameters that a hinge does not set.
hysteresis::HingeLaw read_hinge_law(const Input& node, std::string_view name) {
  hysteresis::HingeLaw found;
  keys::EachLaw<hysteresis::HingeLaw>::visit([&]<class L>(L law) {
    if (L::name != name) return;
    for (const auto& parameter : L::parameters) {
      if (is_set_by_hinge(parameter)) continue;
      const std::string_view key = name_at(hysteresis::Use::hinge, parameter.info);
      const bool required = parameter.info.need == laws::Need::required;
      if (const auto value = required ? std::optional(node.at(key)) : node.find(key))
        parameter.set(law, value->as_quantity());
    }
    if constexpr (requires { L::choices; })
      for (const auto& choice : L::choices)
        if (const auto word = node.find(choice.info.name)) hysteresis::choose(law, choice.info.name, word->as_choice());
    found = law;
  });
  return found;
}

class HingeReader {
 public:
  HingeReader(const Input& hinges, FrameInput& frame)
      : hinges_(hinges), frame_(frame), wholes_(whole_members(frame.model.frame)) {
    grounded_ = frame.model.frame.grounded_nodes();
  }

  void read() {
    for (const auto& [name, node] : hinges_.entries())
      if (name == "beams" || name == "columns") read_entry(chosen(name, node), node);
    for (const auto& [name, node] : hinges_.entries())
      if (name != "beams" && name != "columns") read_entry({named(name, node)}, node);
    for (const auto& [location, hinge] : found_) {
      placed(hinge.second, [&, &made = hinge.first] { frame_.model.frame.add_hinge(made); });
      frame_.hinge_locations.push_back(hinge.second);
    }
  }

 private:
  const Frame& frame() const { return frame_.model.frame; }

  // All horizontal or all vertical members.
  std::vector<WholeMember> chosen(const std::string& group, const Input& node) const {
    std::vector<WholeMember> all = members_of_group(frame(), group);
    if (all.empty())
      node.fail_at_key(fmt::format("the frame has no {}: no member is {}; give hinges by member", group,
                                   group == "beams" ? "horizontal" : "vertical"));
    return all;
  }

  WholeMember named(const std::string& name, const Input& node) const {
    std::vector<std::string> known{"beams", "columns"};
    for (const WholeMember& whole : wholes_) {
      known.push_back(whole.name);
      if (whole.name == name) return whole;
    }
    node.fail_at_key(unknown_name("member", name, known));
  }

  std::vector<BendingAxis> read_axes(const Input& node) const {
    const auto axis = node.find("axis");
    const bool is_plane = frame().dimension() == 2;
    if (!axis && is_plane) return {BendingAxis::y};
    if (!axis)
      node.fail("the axis is missing, and a member in space bends about two; type axis: y, axis: z or axis: both");
    const std::string spec = axis->as_choice();
    if (is_plane && spec != "y") axis->fail("a plane frame bends about y only; leave the axis out");
    if (spec == "both") return {BendingAxis::y, BendingAxis::z};
    return {spec == "y" ? BendingAxis::y : BendingAxis::z};
  }

  bool is_foot(const WholeMember& whole, MemberEnd end) const {
    const int node = end == MemberEnd::start ? frame().ends(whole.first)[0] : frame().ends(whole.last)[1];
    return std::find(grounded_.begin(), grounded_.end(), node) != grounded_.end();
  }

  void read_entry(const std::vector<WholeMember>& members, const Input& node) {
    if (!node.is_map()) node.fail("takes a map; type {at: both, yield_moment: 210 kN m, hardening: 3 %}");
    node.only_keys();
    const std::string at = node.at("at").as_choice();
    Hinge hinge = read_law(node);
    hinge.ultimate_rotation = node.find_quantity("ultimate_rotation");
    const std::vector<BendingAxis> about = read_axes(node);
    bool is_any = false;
    for (const WholeMember& whole : members)
      for (const MemberEnd end : {MemberEnd::start, MemberEnd::end}) {
        const bool is_requested =
            at == "both" || (at == "feet" ? is_foot(whole, end) : (at == "start") == (end == MemberEnd::start));
        if (!is_requested) continue;
        is_any = true;
        for (const BendingAxis axis : about) {
          hinge.member = end == MemberEnd::start ? whole.first : whole.last;
          hinge.at = end;
          hinge.about = axis;
          hinge.member_length = whole.length;
          if (const auto strength = node.find("strength")) hinge.yield_moment = read_capacity(*strength, hinge);
          found_.insert_or_assign(std::tuple(hinge.member, end, axis), std::pair(hinge, node));
        }
      }
    if (!is_any) node.at("at").fail("no end is at a supported node; type at: start, at: end or at: both");
  }

  // Plastic moment of the section of a hinge.
  double read_capacity(const Input& strength, const Hinge& hinge) const {
    const Beam& beam = frame().beam(hinge.member);
    const bool of_material = strength.as_text() == "material";
    if (of_material && beam.material().strength == 0)
      strength.fail(
          fmt::format("the material of {} has no strength; type material: S355, or strength: 355 MPa in the material",
                      frame().member_name(hinge.member)));
    const double value = of_material ? beam.material().strength : strength.as_quantity();
    return placed(strength, [&] { return plastic_moment(beam.section(), hinge.about, value); });
  }

  // Reads a rigid-plastic hinge or a spring in series.
  Hinge read_law(const Input& node) const {
    if (const hysteresis::Entry* law = law_among_keys(node, "a hinge")) {
      for (const char* const key : {"yield_moment", "strength", "hardening"})
        if (const auto found = node.find(key))
          found->fail_at_key(fmt::format(
              "belongs to a rigid-plastic hinge, and {0} is also given; write it inside {0}, or leave {0} out",
              law->name));
      return read_spring(node.at(law->name), law->name);
    }
    const auto moments = node.find("yield_moment"), strength = node.find("strength");
    if (moments && strength)
      strength->fail_at_key("yield_moment and strength both set the yield moment; keep one of them");
    if (!moments && !strength)
      node.fail("the yield moment is missing; type yield_moment: 210 kN m, or strength: 355 MPa for steel");
    Hinge hinge{.hardening = node.quantity("hardening")};
    if (strength) return hinge;
    std::tie(hinge.yield_moment, hinge.hogging_moment) = read_moments(*moments);
    return hinge;
  }

  Hinge read_spring(const Input& node, std::string_view name) const {
    node.only_keys();
    Hinge hinge{.law = read_hinge_law(node, name)};
    const Input moment = node.at("yield_moment");
    std::tie(hinge.yield_moment, hinge.hogging_moment) = read_moments(moment);
    if (hinge.hogging_moment && !hinge.takes_two_moments())
      moment.fail(fmt::format("{} has the same yield moment in both directions; give one", name));
    const auto stiffness = node.find("stiffness"), factor = node.find("stiffness_factor");
    if (stiffness && factor) factor->fail_at_key("give stiffness or stiffness_factor, not both");
    if (stiffness)
      hinge.stiffness = stiffness->as_quantity();
    else
      hinge.stiffness_factor = node.quantity("stiffness_factor");
    const auto of_member = node.find_known("hardening"), of_spring = node.find_known("spring_hardening");
    if (of_member && of_spring)
      of_spring->fail_at_key(
          "give hardening (ratio of the member end) or spring_hardening (ratio of the spring alone), not both");
    if (of_member) hinge.hardening = of_member->as_quantity();
    if (of_spring) hinge.spring_hardening = of_spring->as_quantity();
    return hinge;
  }

  const Input& hinges_;
  FrameInput& frame_;
  std::vector<WholeMember> wholes_;
  std::vector<int> grounded_;
  std::map<std::tuple<int, MemberEnd, BendingAxis>, std::pair<Hinge, Input>> found_;  // ordered by member
};

}  // namespace

void read_hinges(const Input& hinges, FrameInput& frame) { HingeReader(hinges, frame).read(); }

}  // namespace pounding
