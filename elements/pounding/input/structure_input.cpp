#include <pounding/input/structure_input.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/input/ground_input.hpp>

namespace pounding {
namespace {

constexpr std::string_view damping_example = "damping: 5 %";

// Modal damping fills the matrix.
constexpr int max_for_modal_damping = 1500;

// A key may stand under the kind's own word or beside it, not in both places.
std::optional<Input> beside_or_inside(const Input& place, const Input& body, std::string_view key) {
  const std::optional<Input> inside = body.is_map() ? body.find(key) : std::nullopt;
  const std::optional<Input> beside = place.find(key);
  if (inside && beside) beside->fail_at_key(fmt::format("\"{}\" is given twice; keep one of the two", key));
  return inside ? inside : beside;
}

struct TwoFrequencies {
  double first, second;
  std::string note;
};

int count_of_modes(const Structure& s) { return static_cast<int>(split_by_mass(s.mass).dynamic.size()); }

TwoFrequencies rayleigh_points(const Input& node, const Structure& s, const ModeSolver& solver) {
  const int count = count_of_modes(s);
  const std::optional<Input> chosen = node.find("modes"), periods = node.find("periods");
  if (chosen && periods) periods->fail_at_key("give modes or periods, not both");
  if (periods) {
    const std::vector<double> t = periods->as_quantities(2, dimension::time, bounds::positive);
    return {2 * M_PI / t[0], 2 * M_PI / t[1], fmt::format("periods {:.6g} s and {:.6g} s", t[0], t[1])};
  }
  long long first = 1, second = std::min(2, count);
  if (chosen) {
    if (!chosen->is_list() || chosen->items().size() != 2) chosen->fail("takes two mode numbers; type modes: [1, 2]");
    const std::vector<Input> items = chosen->items();
    first = items[0].as_integer(1, count);
    second = items[1].as_integer(1, count);
  }
  const long long highest = std::max(first, second);
  const Eigen::VectorXd w = highest <= s.frequencies.size()
                                ? s.frequencies
                                : solver(s.mass, s.stiffness, static_cast<int>(highest)).frequencies;
  return {w[first - 1], w[second - 1], fmt::format("modes {} and {}", first, second)};
}

void read_damping(const Input& node, Structure& s, const ModeSolver& solver) {
  const auto use_rayleigh = [&](double ratio, const TwoFrequencies& points) {
    const Rayleigh factors = rayleigh_damping(ratio, points.first, points.second);
    s.by_mass = factors.by_mass;
    s.by_stiffness = factors.by_stiffness;
    s.damping_note = fmt::format("Rayleigh, {:.4g} % in {}", 100 * ratio, points.note);
  };
  if (!node.is_map()) {
    const double ratio = node.as_number(bounds::from_0_below_1);
    if (count_of_modes(s) == 1 && s.size() == 1) {
      s.damping.coeffRef(0, 0) += 2 * ratio * s.frequencies[0] * s.mass.coeff(0, 0);
      s.damping_note = fmt::format("{:.4g} % of critical", 100 * ratio);
      return;
    }
    if (count_of_modes(s) == 1) return use_rayleigh(ratio, {s.frequencies[0], s.frequencies[0], "its only mode"});
    return use_rayleigh(ratio, {s.frequencies[0], s.frequencies[1], "modes 1 and 2"});
  }
  node.only_keys({"rayleigh", "modal"});
  const std::optional<Input> rayleigh = node.find("rayleigh"), modal = node.find("modal");
  if (rayleigh.has_value() == modal.has_value())
    node.fail("takes one of rayleigh and modal; type damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}");
  if (rayleigh) {
    rayleigh->only_keys({"ratio", "modes", "periods"});
    return use_rayleigh(rayleigh->at("ratio", "5 %").as_number(bounds::from_0_below_1),
                        rayleigh_points(*rayleigh, s, solver));
  }
  modal->only_keys({"ratio"});
  const double ratio = modal->at("ratio", "5 %").as_number(bounds::from_0_below_1);
  const int count = count_of_modes(s);
  if (count > max_for_modal_damping)
    modal->fail_at_key(fmt::format("fills a matrix of {0} x {0} modes; type damping: {{rayleigh: {{ratio: 5 %, modes: [1, 2]}}}}",
                                   count));
  // Unknowns without mass take no part in the dashpots, which M Phi shows.
  const Eigenmodes all = dense_modes(s.mass, s.stiffness, count);
  s.damping += SparseMatrix(modal_damping(Eigen::MatrixXd(s.mass), all, ratio).sparseView());
  s.damping_note = fmt::format("modal, {:.4g} % in every mode", 100 * ratio);
}

// What yielded before the start would have to be known.
void refuse_initial_yield(const Input& displacement, const Structure& s) {
  for (std::size_t i = 0; i < s.yielding.size(); ++i) {
    const double drift = s.initial_displacement[i] - (i > 0 ? s.initial_displacement[i - 1] : 0);
    const double yield = s.yielding[i].yield_force / s.storey_stiffness[i];
    if (std::abs(drift) > yield)
      displacement.fail(fmt::format("strains storey {} by {}, and it yields at {}; take less, or an initial_velocity", i + 1,
                                    format_quantity(drift, dimension::length), format_quantity(yield, dimension::length)));
  }
}

// Floors of a structure along x are its unknowns; a frame as a whole moves along x, with all its supports.
Eigen::VectorXd initial_motion(const Input& node, const Structure& s, const Dimension& dimension) {
  if (s.dimension > 1) {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(s.size());
    for (const Support& support : s.supports) whole += support.influence.col(0);
    return node.as_quantity(dimension) * whole;
  }
  const std::vector<double> values = node.as_quantities(s.size(), dimension);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), s.size());
}

void read_initial_motion(const Input& place, const Input& body, Structure& s) {
  const auto velocity = beside_or_inside(place, body, "initial_velocity");
  const auto displacement = beside_or_inside(place, body, "initial_displacement");
  if (s.is_rigid() && velocity) velocity->fail_at_key("a wall moves with the ground; leave it out");
  if (s.is_rigid() && displacement) displacement->fail_at_key("a wall moves with the ground; leave it out");
  s.initial_velocity = s.initial_displacement = Eigen::VectorXd::Zero(s.size());
  if (velocity) s.initial_velocity = initial_motion(*velocity, s, dimension::velocity);
  if (!displacement) return;
  if (s.dimension > 1)
    displacement->fail_at_key("a frame starts from its place at rest; leave it out, or give an initial_velocity");
  s.initial_displacement = initial_motion(*displacement, s, dimension::length);
  refuse_initial_yield(*displacement, s);
}

void read_ground(const Input& place, const std::optional<TravellingWave>& wave, Structure& s) {
  const std::optional<Input> delay = place.find("delay"), motion = place.find("ground_motion");
  if (wave && !motion && s.supports_along) {
    try {
      s.supports = s.supports_along(wave->direction);
    } catch (const std::invalid_argument& error) {
      place.fail(error.what());
    }
  }
  if (motion) {
    const GroundSection ground = read_ground_section(*motion);
    if (ground.wave) motion->fail("a wave belongs to the ground_motion of all structures; give this one a delay");
    refuse_idle_components(*motion, s.dimension, true);
    for (Support& support : s.supports)
      if (!support.motion) support.motion = ground.components;
  }
  if (delay)
    for (Support& support : s.supports) support.delay += delay->as_quantity(dimension::time, bounds::non_negative);
}

}  // namespace

Structure read_structure(const std::string& name, const Input& place, const Kinds& kinds, const ModeSolver& modes,
                         const std::optional<TravellingWave>& wave) {
  std::vector<std::string_view> words, keys{"damping", "initial_velocity", "initial_displacement", "delay", "ground_motion"};
  for (const StructureKind& kind : kinds.structures) words.push_back(kind.word);
  keys.insert(keys.end(), words.begin(), words.end());
  if (name.empty() || name.find_first_of("/.") != std::string::npos)
    place.fail_at_key("a name must not be empty or contain \".\" or \"/\"; type a name such as left_building");
  if (place.is_scalar() && place.as_text() == "wall") place.fail("a wall is written as {wall: {}}");
  place.only_keys(keys);
  const StructureKind* chosen = nullptr;
  for (const StructureKind& kind : kinds.structures) {
    if (!place.has(kind.word)) continue;
    if (chosen)
      place.find(kind.word)->fail_at_key(
          fmt::format("a structure has one kind, and a {} is given too; keep one of the two", chosen->word));
    chosen = &kind;
  }
  if (!chosen) place.fail(fmt::format("the kind of the structure is missing; it is one of {}", fmt::join(words, ", ")));

  const Input body = *place.find(chosen->word);
  Structure s = chosen->read(body);
  s.name = name;
  s.kind = chosen->word;
  if (s.damping.size() == 0) s.damping.resize(s.size(), s.size());

  if (!s.is_rigid() && count_of_modes(s) == 0)
    body.fail("nothing in it has mass; type masses: {NODE: 10 t}, floor_mass: 60 t in a grid, or density: 2500 kg/m^3 in a material");

  const auto damping = beside_or_inside(place, body, "damping");
  const bool takes_damping = !s.is_rigid() && !s.is_free;
  if (damping && !takes_damping) damping->fail_at_key(fmt::format("a {} has no damping of its own; leave it out", s.kind));
  if (takes_damping && !damping)
    body.fail(fmt::format("damping is missing; type {}, or damping: 0 for none", damping_example));
  if (takes_damping) {
    try {
      s.frequencies = modes(s.mass, s.stiffness, std::min(modes_of_a_structure, count_of_modes(s))).frequencies;
    } catch (const std::invalid_argument& error) {
      body.fail(error.what());
    }
    read_damping(*damping, s, modes);
  } else if (!s.is_rigid()) {
    s.frequencies = Eigen::VectorXd::Zero(1);
  }
  read_initial_motion(place, body, s);
  read_ground(place, wave, s);
  return s;
}

}  // namespace pounding
