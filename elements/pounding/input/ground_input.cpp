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
#include <pounding/input/fail_at.hpp>
#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

/// Keys next to a motion that only some kinds of motions allow.
struct Beside {
  std::string_view key, kinds;
};
constexpr Beside keys_beside[] = {
    {"channel", "record"}, {"units", "record"}, {"step", "record"},         {"scale", "record"},
    {"pga", "record"},     {"duration", "sum"}, {"start", "record or sum"}, {"initial_velocity", "record or sum"}};

/// Value of a key; 0 if the section does not have it.
double quantity_or_zero(const Input& node, std::string_view key) { return node.knows(key) ? node.quantity(key) : 0; }

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
  return placed(node, [&] { return synthetic_motion(options); });
}

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

/// Period of a harmonic; forces may have a frequency instead.
double read_period(const Input& node) {
  if (!node.knows("frequency") || node.chosen() == "period") return node.quantity("period");
  const Input frequency = node.at("frequency");
  if (frequency.as_text().find("rad") != std::string::npos)
    frequency.fail(
        fmt::format("takes a frequency in Hz such as \"2.5 Hz\"; \"{}\" is an angular frequency, divide it by 2 pi",
                    frequency.as_text()));
  return 1 / frequency.as_quantity();
}

/// Reads a motion with values of this dimension.
class MotionReader {
 public:
  MotionReader(const Input& section, const Dimension& values) : section_(section), values_(values) {}

  GroundMotion read() const {
    const std::string kind = section_.chosen(
        values_ == dimension::acceleration ? "record: FILE, or leave ground_motion out for a ground at rest" : "");
    for (const auto& [key, kinds] : keys_beside)
      if (const auto found = section_.find_known(key); found && kinds.find(kind) == std::string_view::npos)
        refuse_beside(*found, kinds, kind);
    section_.only_keys();
    if (kind == "record") return read_file();
    if (kind == "sum") return read_sum();
    const Input node = section_.at(kind);
    if (kind == "displacement") return MotionReader(node, dimension::length).read();
    node.only_keys();
    if (kind == "harmonic")
      return made(Harmonic{.amplitude = amplitude(node),
                           .period = read_period(node),
                           .duration = node.quantity("duration"),
                           .start = quantity_or_zero(node, "start"),
                           .phase = read_phase(node)},
                  node);
    if (kind == "pulse")
      return GroundMotion(Pulse{.shape = read_shape(node),
                                .amplitude = amplitude(node),
                                .duration = node.quantity("duration"),
                                .start = node.quantity("start")},
                          values_);
    if (kind == "synthetic") return read_synthetic(node);
    return GroundMotion(
        Step{.amplitude = amplitude(node), .start = node.quantity("start"), .rise = node.quantity("rise")}, values_);
  }

 private:
  [[noreturn]] void refuse_beside(const Input& found, std::string_view kinds, const std::string& kind) const {
    const Input node = section_.at(kind);
    const bool is_inside = node.is_map() && node.knows(found.key());
    found.fail_at_key(fmt::format(
        "belongs to a {}{}", kinds,
        is_inside ? fmt::format("; type {}: {{..., {}: {}}}", kind, found.key(), excerpt(found.as_text())) : ""));
  }

  double amplitude(const Input& node) const { return node.at("amplitude").as_quantity(values_); }

  template <class Closed>
  GroundMotion made(const Closed& motion, const Input& node) const {
    if (values_ == dimension::length) return motion_of_displacement(motion);
    const GroundMotion found(motion, values_);
    return node.knows("initial_velocity") ? found.with_initial_motion(node.quantity("initial_velocity")) : found;
  }

  GroundMotion read_sum() const {
    HarmonicSum sum{
        .parts = {}, .duration = section_.quantity("duration"), .start = quantity_or_zero(section_, "start")};
    const Input list = section_.at("sum");
    for (const Input& part : list.items()) {
      part.only_keys();
      sum.parts.push_back({.amplitude = amplitude(part), .period = read_period(part), .phase = read_phase(part)});
    }
    if (sum.parts.empty())
      list.fail(fmt::format("takes at least one harmonic; type sum: [{{amplitude: {}, period: 0.5 s}}]",
                            quantity_example(values_)));
    return made(sum, section_);
  }

  GroundMotion read_file() const {
    const Input file = section_.at("record");
    const auto units = section_.find("units"), channel = section_.find("channel"), scale = section_.find("scale"),
               pga = section_.find_known("pga");
    if (scale && pga) pga->fail_at_key("\"scale\" and \"pga\" both set the intensity; keep one of them");
    double factor = scale ? scale->as_quantity() : 1;
    if (factor == 0)
      scale->fail(section_.knows("start")
                      ? "takes a number other than 0; for no force leave the entry out"
                      : "takes a number other than 0; for a ground at rest leave ground_motion out");
    const double velocity = quantity_or_zero(section_, "initial_velocity");
    RecordOptions options;
    if (units) options.units = units->as_text();
    if (channel) options.channel = channel->as_text();
    options.step = section_.find_quantity("step").value_or(0);
    options.displacement = values_ == dimension::length;
    options.initial_velocity = velocity / factor;
    if (section_.knows("start")) options.force = values_;
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
    if (options.force) return motion.delayed(section_.quantity("start"));
    return options.displacement || velocity == 0 ? motion : motion.with_initial_motion(velocity);
  }

  const Input& section_;
  Dimension values_;
};

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

GroundMotion read_motion(const Input& section, const Dimension& values) { return MotionReader(section, values).read(); }

GroundMotion read_ground_motion(const Input& section) {
  return read_motion(section.in(keys::motion), dimension::acceleration);
}

GroundSection read_ground_section(const Input& node) {
  const Input section = node.in(keys::ground_motion);
  GroundSection ground;
  if (const auto wave = section.find("wave")) ground.wave = read_wave(*wave);
  const std::optional<Input> components = section.find("components");
  if (!components) {
    ground.components[0] = read_motion(section, dimension::acceleration);
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
