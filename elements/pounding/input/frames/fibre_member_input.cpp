#include <pounding/input/frames/fibre_member_input.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/frames/fibre_member.hpp>
#include <pounding/frames/section_fibres.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/frames/whole_members.hpp>
#include <pounding/sections/softening.hpp>

namespace pounding {
namespace {

class FibreMembersReader {
 public:
  FibreMembersReader(const Input& node, FrameModel& model)
      : node_(node), model_(model), wholes_(whole_members(model.frame)) {}

  void read() {
    node_.only_keys();
    read_options();
    std::set<int> added;
    for (const WholeMember& whole : read_members())
      for (int member = whole.first; member <= whole.last; ++member)
        if (added.insert(member).second) add(member, whole);
  }

 private:
  const Section& section(int member) const { return model_.frame.beam(member).section(); }

  void read_options() {
    const auto formulation = node_.find("formulation"), rule = node_.find("rule"), points = node_.find("points");
    if (formulation && formulation->as_choice() == "displacement")
      options_.formulation = MemberFormulation::displacement;
    const std::string name = rule ? rule->as_choice() : "lobatto";
    hinge_length_ = node_.find("hinge_length");
    if (const auto regularized = node_.find("regularized")) regularized->as_choice();
    options_.geometry = model_.geometry;
    if (name == "hinge_radau") {
      if (!hinge_length_) node_.fail("hinge_radau needs a plastic hinge length; type hinge_length: 0.3 m");
      if (points) points->fail_at_key("hinge_radau defines the number of sections; leave points out");
      if (options_.formulation == MemberFormulation::displacement)
        rule->fail("hinge_radau needs formulation: force; type rule: lobatto, legendre or radau");
      lengths_ = read_lengths();
      return;
    }
    if (hinge_length_)
      hinge_length_->fail_at_key(fmt::format("belongs to rule: hinge_radau, and the rule is {}", name));
    const int count = points ? static_cast<int>(points->as_integer()) : 5;
    options_.rule = name == "legendre" ? legendre(count) : name == "radau" ? radau(count) : lobatto(count);
  }

  std::array<double, 2> read_lengths() const {
    if (!hinge_length_->is_list()) {
      const double length = hinge_length_->as_quantity();
      return {length, length};
    }
    const std::vector<Input> items = hinge_length_->items();
    if (items.size() != 2) hinge_length_->fail("takes one length, or two, [start, end]; type hinge_length: 0.3 m");
    return {items[0].as_quantity(), items[1].as_quantity()};
  }

  // Members with fibres, of some members. Fails if there are none.
  std::vector<WholeMember> with_fibres(std::vector<WholeMember> members, const std::string& group,
                                       const Input& location) const {
    std::erase_if(members, [&](const WholeMember& whole) { return !section(whole.first).fibres; });
    if (members.empty())
      location.fail(
          fmt::format("no member of {} has a section of fibres; type a section such as {{rectangle: [0.2 m, "
                      "0.4 m], material: steel}} or rc_rectangle",
                      group));
    return members;
  }

  std::vector<WholeMember> read_members() const {
    const auto members = node_.find("members");
    if (!members) return with_fibres(wholes_, "the frame", node_);
    if (members->is_scalar()) {
      const std::string group = members->as_choice();
      return with_fibres(group == "all" ? wholes_ : members_of_group(model_.frame, group), group, *members);
    }
    std::vector<WholeMember> all;
    std::vector<std::string> known{"all", "beams", "columns"};
    for (const WholeMember& whole : wholes_) known.push_back(whole.name);
    for (const Input& item : members->items()) {
      const std::string name = item.as_text();
      const auto found = std::ranges::find(wholes_, name, &WholeMember::name);
      if (found == wholes_.end() && std::ranges::find(known, name) == known.end())
        item.fail(unknown_name("member", name, known));
      const std::vector<WholeMember> those = found != wholes_.end() ? std::vector{*found}
                                             : name == "all"        ? wholes_
                                                                    : members_of_group(model_.frame, name);
      std::ranges::copy(with_fibres(those, name, item), std::back_inserter(all));
    }
    return all;
  }

  void add(int member, const WholeMember& whole) {
    const Beam& beam = model_.frame.beam(member);
    const SectionFibres& fibres = *beam.section().fibres;
    if (const auto& hinges = model_.frame.hinges(); std::ranges::find(hinges, member, &Hinge::member) != hinges.end())
      node_.fail(fmt::format("{} has fibres and a hinge; leave one of them out", whole.name));
    FibreMemberOptions options = options_;
    if (options.formulation == MemberFormulation::displacement && std::isfinite(beam.section().shear_area_z))
      node_.fail(fmt::format(
          "formulation: displacement has no shear deformation; leave shear: true out of the section {}", fibres.name));
    if (lengths_) options.rule = hinge_rule(whole);
    if (options.formulation == MemberFormulation::force && !lengths_) refuse_softening(fibres);
    options.shear_stiffness_y = beam.material().shear * beam.section().shear_area_y;
    options.shear_stiffness_z = beam.material().shear * beam.section().shear_area_z;
    options.torsion_stiffness = beam.material().shear * beam.section().torsion;
    model_.fibres.push_back({member, std::make_shared<const FibreMemberOptions>(std::move(options))});
  }

  IntegrationRule hinge_rule(const WholeMember& whole) const {
    if (whole.first != whole.last)
      hinge_length_->fail(
          fmt::format("{} is divided into parts; hinge lengths apply to undivided members", whole.name));
    return placed(*hinge_length_,
                  [&] { return hinge_radau((*lengths_)[0] / whole.length, (*lengths_)[1] / whole.length); });
  }

  void refuse_softening(const SectionFibres& fibres) const {
    if (node_.has("regularized") || !checked_.insert(&fibres).second) return;
    const auto softening = sections::find_softening(fibres.section);
    if (!softening) return;
    const auto megapascal = [](double stress) { return fmt::format("{:.4g} MPa", stress / 1e6); };
    node_.find("rule").value_or(node_).fail(fmt::format(
        "the section {} softens: the stress of {} falls from {} to {}, so results of force-based members depend on the "
        "number of points; type rule: hinge_radau with hinge_length: 0.3 m, or regularized: none",
        fibres.name, fibres.materials[softening->material].name, megapascal(softening->strength),
        megapascal(softening->rest)));
  }

  const Input& node_;
  FrameModel& model_;
  std::vector<WholeMember> wholes_;
  FibreMemberOptions options_;
  std::optional<Input> hinge_length_;
  std::optional<std::array<double, 2>> lengths_;  // [m]
  mutable std::set<const SectionFibres*> checked_;
};

}  // namespace

void read_fibre_members(const Input& node, FrameModel& model) { FibreMembersReader(node, model).read(); }

}  // namespace pounding
