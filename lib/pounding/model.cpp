#include <pounding/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include <pounding/damping.hpp>
#include <pounding/error.hpp>
#include <pounding/ground_motion_input.hpp>

namespace pounding {
namespace {

// Histories are kept in memory.
constexpr double most_outputs = 1e7;

constexpr std::string_view damping_example = "damping: 5 %";

// A key may stand under the kind's own word or beside it, not in both places.
std::optional<Input> beside_or_inside(const Input& place, const Input& body, std::string_view key) {
  const std::optional<Input> inside = body.is_map() ? body.find(key) : std::nullopt;
  const std::optional<Input> beside = place.find(key);
  if (inside && beside) beside->fail_at_key(fmt::format("\"{}\" is given twice; keep one of the two", key));
  return inside ? inside : beside;
}

Eigen::VectorXd from_the_ground_up(const Input& node, int floors, const Dimension& dimension) {
  const std::vector<double> values = node.as_quantities(floors, dimension);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), floors);
}

struct TwoFrequencies {
  double first, second;
  std::string note;
};

TwoFrequencies rayleigh_points(const Input& node, const Eigenmodes& modes) {
  const int count = static_cast<int>(modes.frequencies.size());
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
  return {modes.frequencies[first - 1], modes.frequencies[second - 1], fmt::format("modes {} and {}", first, second)};
}

void read_damping(const Input& node, Structure& s) {
  const Eigenmodes modes = eigenmodes(s.mass, s.stiffness);
  const auto use_rayleigh = [&](double ratio, const TwoFrequencies& points) {
    s.damping = rayleigh_damping(s.mass, s.stiffness, ratio, points.first, points.second);
    s.damping_note = fmt::format("Rayleigh, {:.4g} % in {}", 100 * ratio, points.note);
  };
  if (!node.is_map()) {
    const double ratio = node.as_number(bounds::from_0_below_1);
    if (s.size() == 1) {
      s.damping(0, 0) = 2 * ratio * modes.frequencies[0] * s.mass(0, 0);
      s.damping_note = fmt::format("{:.4g} % of critical", 100 * ratio);
      return;
    }
    return use_rayleigh(ratio, {modes.frequencies[0], modes.frequencies[1], "modes 1 and 2"});
  }
  node.only_keys({"rayleigh", "modal"});
  const std::optional<Input> rayleigh = node.find("rayleigh"), modal = node.find("modal");
  if (rayleigh.has_value() == modal.has_value())
    node.fail("takes one of rayleigh and modal; type damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}");
  if (rayleigh) {
    rayleigh->only_keys({"ratio", "modes", "periods"});
    return use_rayleigh(rayleigh->at("ratio", "5 %").as_number(bounds::from_0_below_1),
                        rayleigh_points(*rayleigh, modes));
  }
  modal->only_keys({"ratio"});
  const double ratio = modal->at("ratio", "5 %").as_number(bounds::from_0_below_1);
  s.damping = modal_damping(s.mass, modes, ratio);
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

Structure read_structure(const std::string& name, const Input& place, const Kinds& kinds) {
  std::vector<std::string_view> words, keys{"damping", "initial_velocity", "initial_displacement"};
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

  const auto damping = beside_or_inside(place, body, "damping");
  const auto velocity = beside_or_inside(place, body, "initial_velocity");
  const auto displacement = beside_or_inside(place, body, "initial_displacement");
  if (s.storey_stiffness.empty()) {
    if (damping) damping->fail_at_key(fmt::format("a {} has no damping of its own; leave it out", s.kind));
  } else if (!damping) {
    body.fail(fmt::format("damping is missing; type {}, or damping: 0 for none", damping_example));
  } else {
    read_damping(*damping, s);
  }
  if (s.is_rigid() && velocity) velocity->fail_at_key("a wall moves with the ground; leave it out");
  if (s.is_rigid() && displacement) displacement->fail_at_key("a wall moves with the ground; leave it out");
  if (velocity) s.initial_velocity = from_the_ground_up(*velocity, s.size(), dimension::velocity);
  if (displacement) s.initial_displacement = from_the_ground_up(*displacement, s.size(), dimension::length);
  if (displacement) refuse_initial_yield(*displacement, s);
  return s;
}

struct End {
  int structure = 0;
  std::optional<int> floor;  // from 0
};

End read_end(const Input& node, const std::vector<Structure>& structures) {
  const std::string text = node.as_text();
  const std::size_t dot = text.find('.');
  const std::string name = text.substr(0, dot);
  std::vector<std::string_view> names;
  for (const Structure& s : structures) names.push_back(s.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) node.fail(fmt::format("unknown structure \"{}\".{}", name, suggestion(name, names)));
  End end{static_cast<int>(found - names.begin()), std::nullopt};
  if (dot == std::string::npos) return end;
  const Structure& s = structures[end.structure];
  double number = 0;
  const bool whole = parse_number(text.substr(dot + 1), number) && number == std::floor(number);
  if (s.is_rigid()) node.fail(fmt::format("\"{}\" is a wall and has no floors; type {}", name, name));
  if (s.size() == 1 && (!whole || number != 1))
    node.fail(fmt::format("\"{}\" names no floor of {}, which has one; type {}", text, name, name));
  if (!whole || number < 1 || number > s.size())
    node.fail(fmt::format("\"{}\" names no floor of {}, which has the floors 1 to {}; type {}.{}", text, name, s.size(),
                          name, s.size()));
  end.floor = static_cast<int>(number) - 1;
  return end;
}

double elevation(const Structure& s, int floor) {
  double sum = 0;
  for (int i = 0; i <= floor; ++i) sum += s.heights[i];
  return sum;
}

// Pairs of facing floors, from the ground up.
std::vector<std::pair<int, int>> facing_floors(const Input& node, const Structure& left, const Structure& right) {
  if (left.is_rigid() && right.is_rigid()) node.fail("both ends are walls; one of them must be able to move");
  const int count = left.is_rigid()    ? right.size()
                    : right.is_rigid() ? left.size()
                                       : std::min(left.size(), right.size());
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < count; ++i) {
    if (!left.heights.empty() && !right.heights.empty()) {
      const double a = elevation(left, i), b = elevation(right, i);
      if (std::abs(a - b) > 1e-6 * std::max(a, b))
        node.fail(fmt::format("floor {0} of {1} is {2:.6g} m up and floor {0} of {3} {4:.6g} m: they do not face each other; "
                              "without \"floors: all\" a link names its two floors, as in [{1}.{0}, {3}.{0}]",
                              i + 1, left.name, a, right.name, b));
    }
    pairs.emplace_back(left.is_rigid() ? -1 : i, right.is_rigid() ? -1 : i);
  }
  return pairs;
}

double floor_mass(const Structure& s, int floor) {
  return floor < 0 ? std::numeric_limits<double>::infinity() : s.mass(floor, floor);
}

double initial_closure(const Model& model, const Link& link) {
  const auto displacement = [&](int structure, int floor) {
    return floor < 0 ? 0.0 : model.structures[structure].initial_displacement[floor];
  };
  return displacement(link.left, link.left_floor) - displacement(link.right, link.right_floor);
}

void read_link(const Input& node, Model& model, const Kinds& kinds) {
  static constexpr std::string_view keys[] = {"between", "floors", "gap", "name"};
  const Input between = node.at("between", "[left, right]");
  if (!between.is_list() || between.items().size() != 2)
    between.fail("takes two structures, the left one first; type between: [left, right]");
  const std::vector<Input> ends = between.items();
  const End left = read_end(ends[0], model.structures), right = read_end(ends[1], model.structures);
  const Structure& a = model.structures[left.structure];
  const Structure& b = model.structures[right.structure];
  if (left.structure == right.structure)
    between.fail(fmt::format("\"{}\" cannot hit itself; name two structures, the left one first", a.name));

  std::vector<std::pair<int, int>> pairs;
  const std::optional<Input> floors = node.find("floors");
  if (floors) {
    floors->as_choice("choice of floors", {"all"});
    if (left.floor || right.floor) floors->fail_at_key("names all floors, but \"between\" names one; keep one of the two");
    pairs = facing_floors(between, a, b);
  } else {
    const auto floor_of = [&](const End& end, const Structure& s, const Input& place) {
      if (s.is_rigid()) return -1;
      if (end.floor) return *end.floor;
      if (s.size() == 1) return 0;
      place.fail(fmt::format("which of the {} floors of {}? Type {}.{}, or add floors: all", s.size(), s.name, s.name,
                             s.size()));
    };
    pairs = {{floor_of(left, a, ends[0]), floor_of(right, b, ends[1])}};
    if (a.is_rigid() && b.is_rigid()) between.fail("both ends are walls; one of them must be able to move");
  }

  const Input gap_node = node.at("gap", "20 mm");
  const int count = static_cast<int>(pairs.size());
  const std::vector<double> gaps = gap_node.as_quantities(count, dimension::length, bounds::non_negative);
  const std::optional<Input> name = node.find("name");
  for (int i = 0; i < count; ++i) {
    Link link;
    link.left = left.structure;
    link.right = right.structure;
    link.left_floor = pairs[i].first;
    link.right_floor = pairs[i].second;
    link.gap = gaps[i];
    const auto label = [&](const Structure& s, int floor, bool numbered) {
      return numbered && floor >= 0 ? fmt::format("{}.{}", s.name, floor + 1) : s.name;
    };
    const bool number_left = floors || left.floor, number_right = floors || right.floor;
    link.name = label(a, link.left_floor, number_left) + "-" + label(b, link.right_floor, number_right);
    if (name) link.name = count == 1 ? name->as_text() : fmt::format("{}.{}", name->as_text(), i + 1);
    if (name && (link.name.empty() || link.name == "." || link.name == ".." || link.name.find('/') != std::string::npos))
      name->fail("a name must not be empty, \".\" or \"..\", or contain \"/\"; type a name such as third_floor");
    for (const Link& other : model.links)
      if (other.name == link.name)
        (name ? *name : between)
            .fail(fmt::format("a link \"{}\" exists already; give this one a name of its own, such as name: second", link.name));
    LinkLaw law = kinds.read_law(node, std::span(keys), link.gap, floor_mass(a, link.left_floor), floor_mass(b, link.right_floor),
                                 static_cast<int>(model.links.size()));
    link.law = law.law;
    link.formula = law.formula;
    link.reduced_mass = law.reduced_mass;
    link.reduced_mass_given = law.reduced_mass_given;
    link.parameters = std::move(law.parameters);
    link.contact = std::move(law.contact);
    const double overlap = initial_closure(model, link) - link.gap;
    if (overlap > 0)
      gap_node.fail(fmt::format("{} and {} overlap by {} at the start; a gap of {} or more keeps them apart", a.name, b.name,
                                format_quantity(overlap, dimension::length),
                                format_quantity(overlap + link.gap, dimension::length)));
    model.links.push_back(std::move(link));
  }
}

AnalysisSettings read_analysis(const Input& input, const Model& model) {
  AnalysisSettings settings;
  const std::optional<Input> node = input.find("analysis");
  if (node) {
    node->only_keys({"duration", "tolerance", "output_step", "integrator", "spectral_radius", "max_step"});
    settings.duration = node->quantity_or("duration", dimension::time, 0, bounds::positive);
    settings.tolerance = node->quantity_or("tolerance", dimension::none, settings.tolerance,
                                           Bounds{.low = least_tolerance, .high = largest_tolerance});
    if (const auto output_step = node->find("output_step")) {
      const double longest = settings.duration > 0 ? settings.duration : std::numeric_limits<double>::infinity();
      settings.output_step = output_step->as_quantity(dimension::time, Bounds{.low = 0, .high = longest, .without_low = true});
    }
    if (const auto integrator = node->find("integrator"))
      settings.scheme.kind = Scheme::kind_of(integrator->as_choice("integrator", Scheme::names));
    if (const auto radius = node->find("spectral_radius")) {
      if (settings.scheme.kind != Scheme::Kind::generalized_alpha)
        radius->fail(fmt::format("belongs to generalized_alpha; leave it out with integrator: {}", settings.scheme.name()));
      settings.scheme.spectral_radius = radius->as_quantity(dimension::none, bounds::from_0_to_1);
    }
    settings.max_step = node->quantity_or("max_step", dimension::time, 0, bounds::positive);
  }
  if (settings.duration == 0) settings.duration = model.ground.duration();
  if (settings.duration == 0) input.fail("the duration is missing; type analysis: {duration: 10 s}");
  if (settings.output_step == 0) {
    const double sample = model.ground.sample_step();
    settings.output_step = sample > 0 ? std::min(sample, settings.duration) : settings.duration / 1000;
  }
  if (settings.duration / settings.output_step > most_outputs)
    input.fail(fmt::format("{:.3g} output times are too many; type analysis: {{output_step: {:.3g}}}",
                           settings.duration / settings.output_step, settings.duration / 1e4));
  return settings;
}

CheckpointSettings read_checkpoints(const Input& node) {
  if (!node.is_map() || node.entries().empty())
    node.fail("takes how often; type checkpoint: {every: 60 s} for run time, {every_simulated: 1 s} for simulated time");
  node.only_keys({"every", "every_simulated"});
  return {node.quantity_or("every", dimension::time, 0, bounds::positive),
          node.quantity_or("every_simulated", dimension::time, 0, bounds::positive)};
}

}  // namespace

Model read_model(const Input& input, const Kinds& kinds) {
  input.only_keys({"title", "ground_motion", "structures", "links", "analysis", "checkpoint", "compare"});
  Model model;
  model.source_text = input.text();
  model.source_file = input.file();
  if (const auto title = input.find("title")) model.title = title->as_text();
  if (const auto motion = input.find("ground_motion")) model.ground = read_ground_motion(*motion);
  const Input structures = input.at("structures", "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}");
  for (const auto& [name, place] : structures.entries()) model.structures.push_back(read_structure(name, place, kinds));
  if (std::all_of(model.structures.begin(), model.structures.end(), [](const Structure& s) { return s.is_rigid(); }))
    structures.fail("no structure that can move; add a body, an oscillator or a shear_building");
  if (const auto links = input.find("links")) {
    if (!links->is_list())
      links->fail("takes a list, one link a line; type - {between: [left, right], gap: 20 mm, law: hertz_damped, ...}");
    for (const Input& link : links->items()) read_link(link, model, kinds);
  }
  model.analysis = read_analysis(input, model);
  if (const auto checkpoint = input.find("checkpoint")) model.checkpoint = read_checkpoints(*checkpoint);
  if (const auto compare = input.find("compare")) {
    compare->as_choice("comparison", {"no_pounding"});
    model.compare_no_pounding = true;
  }
  return model;
}

YieldingStorey::YieldingStorey(double force, double ratio, std::unique_ptr<Spring> undeformed)
    : yield_force(force), hardening(ratio), spring(std::move(undeformed)) {
  Archive archive;
  spring->archive(archive);
  fresh = archive.bytes();
}

std::vector<int> offsets(const Model& model) {
  std::vector<int> first;
  int count = 0;
  for (const Structure& s : model.structures) {
    first.push_back(count);
    count += s.size();
  }
  return first;
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_entries(Triplets& entries, const Eigen::MatrixXd& block, int first) {
  for (int j = 0; j < block.cols(); ++j)
    for (int i = 0; i < block.rows(); ++i)
      if (block(i, j) != 0) entries.emplace_back(first + i, first + j, block(i, j));
}

SparseMatrix sparse(const Triplets& entries, int rows, int columns) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

System assemble(const Model& model, bool with_links) {
  const std::vector<int> first = offsets(model);
  const int n = first.back() + model.structures.back().size();
  System system;
  Triplets mass, damping, stiffness, closing;
  system.grounds = {model.ground};
  double fastest = 0;
  for (const Structure& s : model.structures)
    if (!s.is_rigid()) fastest = std::max(fastest, s.initial_velocity.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    if (s.is_rigid()) continue;
    add_entries(mass, s.mass, first[i]);
    add_entries(damping, s.damping, first[i]);
    add_entries(stiffness, s.stiffness, first[i]);
    // Errors are compared with the motion so far; before there is any, with a hundredth of what the ground can cause.
    Group group{first[i], s.size(), 1e-12, 1e-9};
    group.velocity_floor = std::max(group.velocity_floor, 1e-3 * fastest);
    // A free body has no period; the ground moves it for as long as it moves, which a second stands for.
    const double w = std::max(eigenmodes(s.mass, s.stiffness).frequencies[0], 2 * M_PI);
    group.displacement_floor = std::max(group.displacement_floor, 1e-2 * model.ground.peak() / (w * w));
    group.velocity_floor = std::max(group.velocity_floor, 1e-2 * model.ground.peak() / w);
    system.groups.push_back(group);
  }
  system.mass = sparse(mass, n, n);
  system.damping = sparse(damping, n, n);
  system.stiffness = sparse(stiffness, n, n);
  system.load = system.mass * Eigen::VectorXd::Ones(n);
  for (std::size_t i = 0; with_links && i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const int column = static_cast<int>(i);
    if (link.left_floor >= 0) closing.emplace_back(first[link.left] + link.left_floor, column, 1);
    if (link.right_floor >= 0) closing.emplace_back(first[link.right] + link.right_floor, column, -1);
    system.contacts.push_back(link.contact.get());
    system.names.push_back(link.name);
  }
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const std::vector<YieldingStorey>& storeys = model.structures[i].yielding;
    for (std::size_t storey = 0; storey < storeys.size(); ++storey) {
      const int column = static_cast<int>(system.contacts.size() + system.springs.size()), floor = first[i] + static_cast<int>(storey);
      closing.emplace_back(floor, column, 1);
      if (storey > 0) closing.emplace_back(floor - 1, column, -1);
      Archive fresh(storeys[storey].fresh);
      storeys[storey].spring->archive(fresh);
      system.springs.push_back(storeys[storey].spring.get());
    }
  }
  system.closing = sparse(closing, n, static_cast<int>(system.contacts.size() + system.springs.size()));
  return system;
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model) {
  const std::vector<int> first = offsets(model);
  const int n = first.back() + model.structures.back().size();
  Eigen::VectorXd u(n), v(n);
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    u.segment(first[i], s.size()) = s.initial_displacement;
    v.segment(first[i], s.size()) = s.initial_velocity;
  }
  return {u, v};
}

}  // namespace pounding
