#include <pounding/input/force_input.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/input/ground_input.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 5> force_kinds = {"record", "harmonic", "sum", "pulse", "step_force"};

/// Keys that only some kinds of forces allow.
struct Beside {
  std::string_view key, kinds;
};
constexpr Beside beside[] = {{"channel", "record"}, {"units", "record"}, {"step", "record"},
                             {"scale", "record"},   {"duration", "sum"}, {"start", "record or sum"}};

/// Period of a harmonic, from its period or frequency.
double read_period(const Input& node) {
  const auto period = node.find("period"), frequency = node.find("frequency");
  if (period && frequency) frequency->fail_at_key("\"period\" and \"frequency\" are both given; keep one of them");
  if (!frequency) return node.quantity("period");
  if (frequency->as_text().find("rad") != std::string::npos)
    frequency->fail(
        fmt::format("takes a frequency in Hz such as \"2.5 Hz\"; \"{}\" is an angular frequency, divide it by 2 pi",
                    frequency->as_text()));
  return 1 / frequency->as_quantity();
}

/// Reads the time history of a force with values of this dimension.
class HistoryReader {
 public:
  HistoryReader(const Input& force, const Dimension& values) : force_(force), values_(values) {}

  GroundMotion read() const {
    const std::string_view kind = only_kind();
    for (const auto& [key, allowed] : beside)
      if (const auto found = force_.find(key); found && allowed.find(kind) == std::string_view::npos)
        found->fail_at_key(
            fmt::format("belongs to a {}{}", allowed,
                        key == "start" || key == "duration" ? fmt::format("; type it inside {}", kind) : ""));
    if (kind == "record") return read_record_of_force();
    if (kind == "sum") return read_sum();
    const Input node = force_.at(kind);
    node.only_keys();
    if (kind == "pulse")
      return GroundMotion(Pulse{.shape = read_shape(node),
                                .amplitude = amplitude(node),
                                .duration = node.quantity("duration"),
                                .start = node.quantity("start")},
                          values_);
    if (kind == "step_force")
      return GroundMotion(
          Step{.amplitude = amplitude(node), .start = node.quantity("start"), .rise = node.quantity("rise")}, values_);
    return GroundMotion(Harmonic{.amplitude = amplitude(node),
                                 .period = read_period(node),
                                 .duration = node.quantity("duration"),
                                 .start = node.quantity("start"),
                                 .phase = read_phase(node)},
                        values_);
  }

 private:
  std::string_view only_kind() const {
    std::optional<std::string_view> kind;
    for (const std::string_view candidate : force_kinds) {
      const auto found = force_.find(candidate);
      if (!found) continue;
      if (kind)
        found->fail_at_key(
            fmt::format("\"{}\" and \"{}\" are both given; write two forces, which add up", *kind, candidate));
      kind = candidate;
    }
    if (!kind) force_.fail("the time history is missing; give one of record, harmonic, sum, pulse, step_force");
    return *kind;
  }

  double amplitude(const Input& node) const { return node.at("amplitude").as_quantity(values_); }

  GroundMotion read_sum() const {
    HarmonicSum sum{.parts = {}, .duration = force_.quantity("duration"), .start = force_.quantity("start")};
    const Input list = force_.at("sum");
    for (const Input& part : list.items()) {
      part.only_keys();
      sum.parts.push_back({.amplitude = amplitude(part), .period = read_period(part), .phase = read_phase(part)});
    }
    if (sum.parts.empty()) list.fail("takes at least one harmonic; type sum: [{amplitude: 20 kN, period: 0.5 s}]");
    return GroundMotion(sum, values_);
  }

  GroundMotion read_record_of_force() const {
    const Input file = force_.at("record");
    RecordOptions options;
    if (const auto units = force_.find("units")) options.units = units->as_text();
    if (const auto channel = force_.find("channel")) options.channel = channel->as_text();
    options.step = force_.find_quantity("step").value_or(0);
    options.force = values_;
    const double scale = force_.quantity("scale");
    if (scale == 0) force_.at("scale").fail("takes a number other than 0; for no force leave the entry out");
    try {
      return scaled(read_named_record(file, options), scale).delayed(force_.quantity("start"));
    } catch (const InputError& error) {
      file.fail(error.what());
    }
  }

  const Input& force_;
  Dimension values_;
};

}  // namespace

std::vector<ForceOptions> read_forces(const Input& list) {
  if (!list.is_list())
    list.fail(
        "takes a list with one force per line; type - {floor: 3, harmonic: {amplitude: 20 kN, period: 0.5 s, duration: "
        "10 s}}");
  if (list.items().empty()) list.fail("the list is empty; leave it out");
  std::vector<ForceOptions> forces;
  for (const Input& item : list.items()) {
    item.only_keys();
    ForceOptions& force = forces.emplace_back();
    if (const auto floor = item.find("floor")) force.floor = static_cast<int>(floor->as_integer());
    if (const auto node = item.find("node")) {
      if (force.floor) node->fail_at_key("a force acts on a floor or a node; keep one of the two");
      force.node = node->as_text();
    }
    if (const auto dof = item.find("dof")) force.dof = dof->as_choice();
    force.history = HistoryReader(item, force.dof[0] == 'r' ? dimension::energy : dimension::force).read();
  }
  return forces;
}

}  // namespace pounding
