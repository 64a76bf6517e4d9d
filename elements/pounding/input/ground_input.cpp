#include <pounding/input/ground_input.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/ground/synthetic.hpp>
#include <pounding/input/words/sections.hpp>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 4> kinds = {"record", "harmonic", "pulse", "synthetic"};

GroundMotion read_record_motion(const Input& section, std::initializer_list<std::string_view> beside) {
  std::vector<std::string_view> allowed{"record", "channel", "units", "scale", "pga"};
  allowed.insert(allowed.end(), beside);
  section.only_keys(allowed);
  const Input file = section.at("record");
  const auto channel = section.find("channel");
  const auto units = section.find("units");
  const auto scale = section.find("scale");
  const auto pga = section.find("pga");
  if (scale && pga) pga->fail_at_key("\"scale\" and \"pga\" both set the strength; keep one of them");

  RecordOptions options;
  if (units) options.units = units->as_text();
  if (channel) options.channel = channel->as_text();
  const Record record = [&] {
    try {
      return read_record(find_record(file.as_text(), section.directory()), options);
    } catch (const InputError& error) {
      file.fail(error.what());
    }
  }();
  double factor = 1;
  if (scale) {
    factor = scale->as_quantity();
    if (factor == 0) scale->fail("takes a number other than 0; leave \"ground_motion\" out for a still ground");
  }
  if (pga) {
    if (record.measures.pga == 0) pga->fail("the record is zero throughout and cannot be scaled to a peak");
    factor = pga->as_quantity() / record.measures.pga;
  }
  return scaled(record, factor);
}

GroundMotion read_harmonic(const Input& node) {
  node.only_keys();
  return GroundMotion(Harmonic{.amplitude = node.quantity("amplitude"),
                               .period = node.quantity("period"),
                               .duration = node.quantity("duration")});
}

GroundMotion read_pulse(const Input& node) {
  node.only_keys();
  const std::string name = node.at("shape").as_choice();
  const Pulse::Shape shape = name == "half_sine" ? Pulse::Shape::half_sine
                             : name == "sine"    ? Pulse::Shape::sine
                                                 : Pulse::Shape::rectangle;
  return GroundMotion(Pulse{.shape = shape,
                            .amplitude = node.quantity("amplitude"),
                            .duration = node.quantity("duration"),
                            .start = node.quantity("start")});
}

/// A circular frequency. In units 1 Hz and 1 rad/s are the same number, so the one that is not meant is refused.
double read_omega(const Input& node, std::string_view key) {
  const Input value = node.at(key);
  if (value.as_text().find("Hz") != std::string::npos)
    value.fail(fmt::format("takes a circular frequency such as \"15 rad/s\"; \"{}\" is in Hz, multiply by 2 pi",
                           value.as_text()));
  return value.as_quantity();
}

GroundFilter read_filter(const Input& node) {
  for (const std::string_view key : {"omega_g", "zeta_g", "omega_f", "zeta_f"}) {
    if (!node.has(key)) continue;
    if (const auto soil = node.find("soil"))
      soil->fail_at_key(fmt::format("\"soil\" and \"{}\" both set the filter; keep one of them", key));
    return {.omega_g = read_omega(node, "omega_g"),
            .zeta_g = node.quantity("zeta_g"),
            .omega_f = read_omega(node, "omega_f"),
            .zeta_f = node.quantity("zeta_f")};
  }
  const auto given = node.find("soil");
  const std::string soil = given ? given->as_choice() : "firm";
  return soil == "firm" ? firm_soil : soil == "medium" ? medium_soil : soft_soil;
}

GroundMotion read_synthetic(const Input& node) {
  node.only_keys();
  SyntheticOptions options;
  options.seed = static_cast<std::uint64_t>(node.at("seed").as_integer());
  options.duration = node.quantity("duration");
  options.pga = node.quantity("pga");
  options.filter = read_filter(node);
  options.step = node.quantity("step");
  options.rise = node.quantity("rise");
  options.strong_until = node.quantity("strong_until");
  try {
    return synthetic_motion(options);
  } catch (const std::invalid_argument& error) {
    node.fail(error.what());
  }
}

}  // namespace

namespace {

// Keys of the section that say nothing about the motion itself are allowed beside it.
GroundMotion read_motion(const Input& section, std::initializer_list<std::string_view> beside) {
  std::vector<std::string_view> allowed(kinds.begin(), kinds.end());
  allowed.insert(allowed.end(), beside);
  std::optional<std::string_view> kind;
  for (const std::string_view candidate : kinds) {
    const auto found = section.find(candidate);
    if (!found) continue;
    if (kind) found->fail_at_key(fmt::format("\"{}\" and \"{}\" are both given; keep one of them", *kind, candidate));
    kind = candidate;
  }
  if (kind == "record") return read_record_motion(section, beside);
  if (!kind) {
    section.only_keys(allowed);
    section.fail("takes one of record, harmonic, pulse, synthetic; for a still ground leave \"ground_motion\" out");
  }
  if (const auto channel = section.find("channel")) channel->fail_at_key("belongs to a record");
  for (const std::string_view key : {"units", "scale", "pga"})
    if (const auto found = section.find(key))
      found->fail_at_key(fmt::format("belongs to a record; a {} states its own strength", *kind));
  section.only_keys(allowed);
  const Input node = section.at(*kind);
  if (kind == "harmonic") return read_harmonic(node);
  if (kind == "pulse") return read_pulse(node);
  return read_synthetic(node);
}

TravellingWave read_wave(const Input& node) {
  node.only_keys();
  TravellingWave wave;
  wave.velocity = node.quantity("velocity");
  const std::optional<Input> direction = node.find("direction");
  if (!direction) return wave;
  if (!direction->is_list()) {
    if (direction->as_choice() == "y") wave.direction = Eigen::Vector3d::UnitY();
    return wave;
  }
  const std::vector<Input> parts = direction->items();
  if (parts.size() != 2) direction->fail("takes x, y, or two numbers; type direction: [0.6, 0.8]");
  wave.direction = Eigen::Vector3d(parts[0].as_quantity(), parts[1].as_quantity(), 0);
  if (!(wave.direction.norm() > 0)) direction->fail("has no length; type direction: [0.6, 0.8]");
  wave.direction.normalize();
  return wave;
}

}  // namespace

GroundMotion read_ground_motion(const Input& section) { return read_motion(section.in(words::motion), {}); }

GroundSection read_ground_section(const Input& node) {
  const Input section = node.in(words::ground_motion);
  GroundSection ground;
  if (const auto wave = section.find("wave")) ground.wave = read_wave(*wave);
  const std::optional<Input> components = section.find("components");
  if (!components) {
    ground.components[0] = read_motion(section, {"wave"});
    return ground;
  }
  section.only_keys({"components", "wave"});
  components->only_keys();
  constexpr std::string_view names[] = {"x", "y", "z"};
  bool any = false;
  for (int i = 0; i < 3; ++i)
    if (const auto one = components->find(names[i])) {
      ground.components[i] = read_ground_motion(*one);
      any = true;
    }
  if (!any) components->fail("takes motions along x, y, z; type components: {x: {record: FILE}, y: {record: FILE}}");
  return ground;
}

}  // namespace pounding
