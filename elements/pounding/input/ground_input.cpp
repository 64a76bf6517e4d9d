#include <pounding/input/ground_input.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/ground/displacement_motion.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/ground/synthetic.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 6> motion_kinds = {"record", "harmonic",  "sum",
                                                          "pulse",  "synthetic", "displacement"};

/// Quantity by which a motion is given.
enum class Given { acceleration, displacement };

GroundMotion read_record_motion(const Input& section, std::initializer_list<std::string_view> beside, Given given) {
  std::vector<std::string_view> allowed{"record", "channel", "units", "step", "scale", "initial_velocity"};
  if (given == Given::acceleration) allowed.push_back("pga");
  allowed.insert(allowed.end(), beside);
  section.only_keys(allowed);
  const Input file = section.at("record");
  const auto channel = section.find("channel");
  const auto units = section.find("units");
  const auto scale = section.find("scale");
  const auto pga = given == Given::acceleration ? section.find("pga") : std::nullopt;
  if (scale && pga) pga->fail_at_key("\"scale\" and \"pga\" both set the intensity; keep one of them");

  double factor = 1;
  if (scale) {
    factor = scale->as_quantity();
    if (factor == 0) scale->fail("takes a number other than 0; for no ground motion leave \"ground_motion\" out");
  }
  const double velocity = section.quantity("initial_velocity");
  RecordOptions options;
  if (units) options.units = units->as_text();
  if (channel) options.channel = channel->as_text();
  options.step = section.find_quantity("step").value_or(0);
  options.displacement = given == Given::displacement;
  options.initial_velocity = velocity / factor;
  const Record record = [&] {
    try {
      return read_named_record(file, options);
    } catch (const InputError& error) {
      file.fail(error.what());
    }
  }();
  if (pga) {
    if (record.measures.pga == 0) pga->fail("all values of the record are zero, so it cannot be scaled to a peak");
    factor = pga->as_quantity() / record.measures.pga;
  }
  const GroundMotion motion = scaled(record, factor);
  return given == Given::displacement || velocity == 0 ? motion : motion.with_initial_motion(velocity);
}

GroundMotion read_harmonic(const Input& node, Given given) {
  node.only_keys();
  const Harmonic harmonic{.amplitude = node.quantity("amplitude"),
                          .period = node.quantity("period"),
                          .duration = node.quantity("duration"),
                          .phase = read_phase(node)};
  if (given == Given::displacement) return motion_of_displacement(harmonic);
  return GroundMotion(harmonic).with_initial_motion(node.quantity("initial_velocity"));
}

/// Reads `sum` with its `duration`.
GroundMotion read_sum(const Input& section, std::initializer_list<std::string_view> beside, Given given) {
  std::vector<std::string_view> allowed{"sum", "duration"};
  if (given == Given::acceleration) allowed.push_back("initial_velocity");
  allowed.insert(allowed.end(), beside);
  section.only_keys(allowed);
  const Input list = section.at("sum");
  HarmonicSum sum{.parts = {}, .duration = section.quantity("duration")};
  for (const Input& part : list.items()) {
    part.only_keys();
    sum.parts.push_back(
        {.amplitude = part.quantity("amplitude"), .period = part.quantity("period"), .phase = read_phase(part)});
  }
  if (sum.parts.empty()) list.fail("takes at least one harmonic; type sum: [{amplitude: 0.2 g, period: 0.5 s}]");
  if (given == Given::displacement) return motion_of_displacement(sum);
  return GroundMotion(sum).with_initial_motion(section.quantity("initial_velocity"));
}

GroundMotion read_displacement(const Input& node) {
  std::optional<std::string_view> kind;
  for (const std::string_view candidate : {"record", "harmonic", "sum"}) {
    const auto found = node.find(candidate);
    if (!found) continue;
    if (kind) found->fail_at_key(fmt::format("\"{}\" and \"{}\" are both given; keep one of them", *kind, candidate));
    kind = candidate;
  }
  if (kind == "record") return read_record_motion(node, {}, Given::displacement);
  if (kind == "sum") return read_sum(node, {}, Given::displacement);
  node.only_keys({"record", "harmonic", "sum"});
  if (!kind)
    node.fail(
        "takes one of record, harmonic, sum; type displacement: {harmonic: {amplitude: 20 mm, period: 1 s, duration: "
        "10 s}}");
  return read_harmonic(node.at("harmonic"), Given::displacement);
}

GroundMotion read_pulse(const Input& node) {
  node.only_keys();
  return GroundMotion(Pulse{.shape = read_shape(node),
                            .amplitude = node.quantity("amplitude"),
                            .duration = node.quantity("duration"),
                            .start = node.quantity("start")});
}

/// Reads an angular frequency. Hz and rad/s are the same SI unit, so a value in Hz is rejected.
double read_omega(const Input& node, std::string_view key) {
  const Input value = node.at(key);
  if (value.as_text().find("Hz") != std::string::npos)
    value.fail(fmt::format("takes an angular frequency such as \"15 rad/s\"; \"{}\" is in Hz, multiply it by 2 pi",
                           excerpt(value.as_text())));
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

// Also allows other keys, which do not describe the motion.
GroundMotion read_motion(const Input& section, std::initializer_list<std::string_view> beside) {
  std::vector<std::string_view> allowed(motion_kinds.begin(), motion_kinds.end());
  allowed.insert(allowed.end(), beside);
  std::optional<std::string_view> kind;
  for (const std::string_view candidate : motion_kinds) {
    const auto found = section.find(candidate);
    if (!found) continue;
    if (kind) found->fail_at_key(fmt::format("\"{}\" and \"{}\" are both given; keep one of them", *kind, candidate));
    kind = candidate;
  }
  if (kind == "record") return read_record_motion(section, beside, Given::acceleration);
  if (kind == "sum") return read_sum(section, beside, Given::acceleration);
  if (!kind) {
    section.only_keys(allowed);
    section.fail(
        "takes one of record, harmonic, sum, pulse, synthetic, displacement; for no ground motion leave "
        "\"ground_motion\" out");
  }
  for (const std::string_view key : {"channel", "step"})
    if (const auto found = section.find(key)) found->fail_at_key("belongs to a record");
  if (const auto duration = section.find("duration"))
    duration->fail_at_key(fmt::format("belongs to a sum; type {}: {{..., duration: {}}}", *kind,
                                      duration->is_scalar() ? excerpt(duration->as_text()) : "10 s"));
  if (const auto velocity = section.find("initial_velocity"))
    velocity->fail_at_key("belongs to a record, a harmonic (inside it) or a sum");
  for (const std::string_view key : {"units", "scale", "pga"})
    if (const auto found = section.find(key))
      found->fail_at_key(fmt::format("belongs to a record; the values of a {} are absolute", *kind));
  section.only_keys(allowed);
  const Input node = section.at(*kind);
  if (kind == "harmonic") return read_harmonic(node, Given::acceleration);
  if (kind == "displacement") return read_displacement(node);
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
  if (!(wave.direction.norm() > 0)) direction->fail("the vector is zero; type direction: [0.6, 0.8]");
  wave.direction.normalize();
  return wave;
}

}  // namespace

// A number without a unit above a full cycle is rejected, since it is probably in degrees.
double read_phase(const Input& harmonic) {
  const auto phase = harmonic.find("phase");
  if (!phase) return 0;
  const std::string text = phase->as_text();
  const double angle = phase->as_quantity(dimension::none, bounds::any);
  if (text.find('%') != std::string::npos)
    phase->fail(fmt::format("takes an angle such as \"90 deg\"; \"{}\" was read", excerpt(text)));
  if (!(std::abs(angle) <= 2 * std::numbers::pi))
    phase->fail(fmt::format("takes an angle from -360 deg to 360 deg such as \"90 deg\"; \"{}\" is {:g} deg",
                            excerpt(text), angle * 180 / std::numbers::pi));
  return angle;
}

Pulse::Shape read_shape(const Input& pulse) {
  const std::string name = pulse.at("shape").as_choice();
  return name == "half_sine" ? Pulse::Shape::half_sine : name == "sine" ? Pulse::Shape::sine : Pulse::Shape::rectangle;
}

Record read_named_record(const Input& file, const RecordOptions& options) {
  if (const std::string* const content = file.file_content())
    return read_record_text(*content, file.as_text(), options);
  return read_record(find_record(file.as_text(), file.directory()), options);
}

GroundMotion read_ground_motion(const Input& section) { return read_motion(section.in(keys::motion), {}); }

GroundSection read_ground_section(const Input& node) {
  const Input section = node.in(keys::ground_motion);
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
