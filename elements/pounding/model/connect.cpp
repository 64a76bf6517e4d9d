/// Creates the contacts of a link from its options: points, names, laws.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/limits.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/units.hpp>
#include <pounding/model/contact_law.hpp>
#include <pounding/model/contact_stiffness.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/facing.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/refuse_option.hpp>
#include <pounding/model/rounding.hpp>

namespace pounding {
namespace {

// Default regularisation velocity: friction is proportional to slower velocities [m/s].
constexpr double usual_sliding = 5e-3;

std::string text_of(const PairEnd& end, const Structure& s) {
  if (end.elevation) return fmt::format("{}@{:.6g}m", s.name, *end.elevation);
  if (!end.node.empty()) return fmt::format("{}:{}", s.name, end.node);
  return end.is_numbered && end.floor ? fmt::format("{}.{}", s.name, *end.floor + 1) : s.name;
}

// Displacement along a direction at the start.
double start_of(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction) {
  const Row row = motion_along(end, direction, s.size());
  return row.dot(s.initial_displacement) + (s.at_rest.size() > 0 ? row.dot(s.at_rest) : 0);
}

double reduced_mass(double left, double right) {
  if (std::isinf(left)) return right;
  if (std::isinf(right)) return left;
  if (left == 0 || right == 0) return 0;
  return left * right / (left + right);
}

// Name of one link of several pairs or points.
std::string name_of(const LinkOptions& options, const LinkPair& pair, const Structure& a, const Structure& b,
                    int number, bool is_one) {
  if (!options.name) return text_of(pair.left, a) + "-" + text_of(pair.right, b);
  return is_one ? *options.name : fmt::format("{}.{}", *options.name, number + 1);
}

void check_name(const std::string& name, const LinkOptions& options, const std::vector<Link>& others) {
  const bool is_given = options.name.has_value();
  if (is_given && (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos))
    refuse(ModelOption::link_name,
           "a name must not be empty, \".\" or \"..\", or contain \"/\"; type a name such as third_floor");
  if (const std::string wrong = is_given ? wrong_name(name) : std::string(); !wrong.empty())
    refuse(ModelOption::link_name, wrong);
  for (const Link& other : others)
    if (other.name == name)
      refuse(is_given ? ModelOption::link_name : ModelOption::between,
             fmt::format("a link \"{}\" exists already; give this one another name, such as name: second", name));
}

void check_options(const LinkOptions& options, const ContactLaw& law, bool is_drawn) {
  if (options.gap.empty() && !is_drawn) refuse(ModelOption::gap, "the gap is missing; give it, as in {.gap = 0.02}");
  if (options.points && (*options.points < 1 || *options.points > 100))
    refuse(ModelOption::points, fmt::format("takes an integer from 1 to 100; {} was given", *options.points));
  require_positive(ModelOption::reduced_mass, "reduced_mass", options.reduced_mass);
  if (options.reduced_mass && law.reduced_mass() > 0)
    refuse(ModelOption::reduced_mass,
           "the reduced mass is given twice, by the law and by the link; keep one of the two");
  require_positive(ModelOption::seat, "seat", options.seat);
  if (options.level_within && !options.floors && !is_drawn)
    refuse_idle(ModelOption::level_within, "applies only to floors: all, level or any, and to drawn ends; remove it");
  if (options.sliding_velocity && !options.friction)
    refuse_idle(ModelOption::sliding_velocity, "requires friction; add friction: 0.3, or remove it");
  const bool is_compliant = options.tangential_stiffness || options.tangential_ratio;
  if ((is_compliant || options.static_friction || options.stribeck_velocity) && !options.friction)
    refuse(ModelOption::friction, "the coefficient is missing; give it, such as 0.3");
  if (options.tangential_stiffness && options.tangential_ratio)
    refuse(ModelOption::friction, "tangential_stiffness and tangential_ratio were both given; keep one of them");
  if (options.sliding_velocity && is_compliant)
    refuse_idle(ModelOption::sliding_velocity,
                "applies only to friction without a tangential stiffness, which sticks without it; remove it");
  if (options.static_friction && !is_compliant)
    refuse(ModelOption::friction,
           "static friction needs a tangential stiffness, at which the contact sticks; add one, such as "
           "tangential_stiffness: 50 MN/m");
  if (options.static_friction.has_value() != options.stribeck_velocity.has_value())
    refuse(ModelOption::friction, options.static_friction
                                      ? "static needs the velocity over which it decays; add stribeck_velocity: 10 mm/s"
                                      : "stribeck_velocity needs the coefficient at rest; add static: 0.4");
}

// Faces belong to a drawing: for other ends the gap is given.
void set_faces(Link& link, const ContactLocation& left, const ContactLocation& right, const Structure& a,
               const Structure& b, Side side, bool is_drawn) {
  for (const auto& [location, option] : {std::pair(&left, ModelOption::left), std::pair(&right, ModelOption::right)})
    if (location->face && !is_drawn)
      refuse(
          option,
          fmt::format(
              "face applies only to drawn gaps, and the one between {} and {} is given, from face to face; remove face",
              a.name, b.name));
  if (!is_drawn) return;
  set_face(link.left, a, left.face, side, ModelOption::left);
  set_face(link.right, b, right.face, opposite(side), ModelOption::right);
}

// Maximum difference in height of two ends that face each other [m].
double level_of_ends(const LinkEnd& left, const LinkEnd& right, const Structure& a, const Structure& b,
                     std::optional<double> level_within) {
  if (left.floor < 0 || right.floor < 0) return usual_offset;
  return level_within.value_or(std::max(usual_offset, level_of(a.floors[left.floor], b.floors[right.floor], {})));
}

// Empty values if the drawing defines the gap.
std::vector<std::optional<double>> gaps_of(const LinkOptions& options, int count) {
  if (options.gap.empty()) return std::vector<std::optional<double>>(count);
  const std::vector<double> gaps = checked(ModelOption::gap, [&] { return options.gap.of_each(count, "gap"); });
  for (const double gap : gaps)
    if (!std::isfinite(gap) || (gap < 0 && !options.preload))
      refuse(ModelOption::gap, "gap must be finite and not negative; it may be negative with preload: true");
  return {gaps.begin(), gaps.end()};
}

// Contact points that close together share the masses of their floors.
void set_law(Link& link, const LinkOptions& options, const ContactLaw& law, double share, double factor, int number) {
  const double left = link.left.point.mass / share, right = link.right.point.mass / share;
  const double of_ends = reduced_mass(left, right);
  link.reduced_mass_given = options.reduced_mass.has_value() || law.reduced_mass() > 0;
  link.reduced_mass = options.reduced_mass     ? *options.reduced_mass
                      : law.reduced_mass() > 0 ? law.reduced_mass()
                                               : of_ends;
  ContactStiffness stiffness{.factor = factor};
  if (options.stiffness) {
    const CollidingMasses bodies{{left, right}, link.reduced_mass};
    stiffness.estimate = [&, bodies](double exponent) {
      return estimated_stiffness(*options.stiffness, bodies, exponent);
    };
    link.stiffness_from = describe(*options.stiffness, bodies);
  }
  ContactLaw::Made made =
      checked(ModelOption::law, [&] { return law.make(link.reduced_mass, link.gap, number, stiffness); });
  link.law = std::move(made.name);
  link.formula = std::move(made.formula);
  link.parameters = std::move(made.parameters);
  link.contact = std::move(made.contact);
}

void set_friction(Link& link, const LinkOptions& options, const Structure& a, const Structure& b) {
  if (!options.friction) return;
  link.friction = *options.friction;
  link.sliding_velocity = options.sliding_velocity.value_or(usual_sliding);
  if (!(link.friction >= 0) || std::isinf(link.friction))
    refuse(ModelOption::friction, "friction must be finite and not negative");
  require_positive(ModelOption::sliding_velocity, "sliding_velocity", link.sliding_velocity);
  const auto take = [](double& value, std::optional<double> given, const char* name) {
    require_positive(ModelOption::friction, name, given);
    value = given.value_or(0);
  };
  take(link.tangential_stiffness, options.tangential_stiffness, "tangential_stiffness");
  take(link.tangential_ratio, options.tangential_ratio, "tangential_ratio");
  take(link.static_friction, options.static_friction, "static");
  take(link.stribeck_velocity, options.stribeck_velocity, "stribeck_velocity");
  if (options.static_friction && link.static_friction < link.friction)
    refuse(ModelOption::friction, fmt::format("static is {:g}, below the coefficient of sliding, {:g}; give at least "
                                              "that coefficient",
                                              link.static_friction, link.friction));
  const auto slides = [](const Structure& s) { return !s.is_rigid() && s.dimension > 1; };
  if (!slides(a) && !slides(b))
    refuse_idle(ModelOption::friction,
                "only for frames: other structures move only along x and cannot slide; remove it");
  if (link.contact->is_rigid())
    refuse_idle(ModelOption::friction,
                "only for laws with a force; a stereomechanical contact has only velocity jumps");
}

// Rejects a gap that is closed at rest if the law requires the closing speed of an impact.
void require_closing_speed(const Link& link, double overlap, const Structure& a, const Structure& b) {
  constexpr double closed = 1e-9;  // [m]
  if (overlap < -closed || !link.contact->needs_closing_speed() || a.initial_velocity.any() || b.initial_velocity.any())
    return;
  refuse(ModelOption::gap, fmt::format("{} derives its stiffness from the closing speed of each impact, but the bodies "
                                       "of {} are in contact at rest at the start; give a design speed, such as "
                                       "impact_velocity: 0.5 m/s, or initial_stiffness, secondary_stiffness and "
                                       "yield_penetration",
                                       link.law, link.name));
}

void refuse_overlap(const Link& link, const Structure& a, const Structure& b) {
  const double overlap = start_of(link.left, a, link.direction) - start_of(link.right, b, link.direction) - link.gap;
  require_closing_speed(link, overlap, a, b);
  if (!(overlap > 0)) return;
  // Two equal frames at a gap of zero lean by the same displacement, up to round-off.
  const auto rounding = [&](const LinkEnd& end, const Structure& s) {
    Eigen::VectorXd u = s.initial_displacement;
    if (s.at_rest.size() > 0) u += s.at_rest;
    return displacement_rounding(end, s, link.direction, u);
  };
  if (overlap <= rounding(link.left, a) + rounding(link.right, b) + std::numeric_limits<double>::epsilon() * link.gap)
    return;
  const std::string by = format_quantity(overlap, dimension::length);
  const bool displaced = a.initial_displacement.any() || b.initial_displacement.any();
  const std::string apart =
      are_drawn(a, b)
          ? fmt::format("they {} towards each other{}: move the origin of {} away by {} or more",
                        displaced ? "are displaced" : "lean", displaced ? "" : " under their loads", b.name, by)
          : fmt::format("a gap of {} or more keeps them apart", format_quantity(overlap + link.gap, dimension::length));
  refuse(ModelOption::gap, fmt::format("{} and {} overlap by {} at the start; {}", a.name, b.name, by, apart));
}

}  // namespace

void Model::link(const ContactLocation& left, const ContactLocation& right, const LinkOptions& options,
                 const ContactLaw& law) {
  require_open();
  const std::vector<LinkPair> pairs = pairs_of(*this, left, right, options.floors, options.level_within);
  const Structure &a = structures[left.structure], &b = structures[right.structure];
  if (a.is_rigid() && b.is_rigid())
    refuse(ModelOption::between,
           "both ends are walls, and a link needs a structure that can move; connect walls by a device");
  const Side side = facing_side(a, b);
  const bool is_drawn = are_drawn(a, b);
  check_options(options, law, is_drawn);
  const int count = static_cast<int>(pairs.size());
  const std::vector<std::optional<double>> gaps = gaps_of(options, count);
  if (options.preload && std::none_of(gaps.begin(), gaps.end(), [](const auto& gap) { return gap && *gap < 0; }))
    refuse_idle(ModelOption::preload,
                "requires a negative gap, the overlap of the undeformed ends, as in gap: -2 mm; otherwise remove it");
  for (int i = 0; i < count; ++i) {
    const std::vector<double> along = along_the_edge(options.points, pairs[i], a, b, side);
    if (static_cast<double>(links.size() + along.size()) > limits::links)
      refuse(ModelOption::between,
             fmt::format("a model has at most {:g} links; link fewer floors, or use fewer points along their edges",
                         limits::links));
    for (std::size_t k = 0; k < along.size(); ++k) {
      Link link;
      link.left = place_end(pairs[i].left, a, side, along[k], ModelOption::left);
      link.right = place_end(pairs[i].right, b, opposite(side), along[k], ModelOption::right);
      require_inertia(link.left, a, side, ModelOption::left);
      require_inertia(link.right, b, side, ModelOption::right);
      link.direction = outward(side);
      link.preload = gaps[i] && *gaps[i] < 0;
      link.seat = options.seat;
      set_faces(link, left, right, a, b, side, is_drawn);
      link.gap = is_drawn && !link.preload ? drawn_gap(*this, link.left, link.right, side, gaps[i],
                                                       level_of_ends(link.left, link.right, a, b, options.level_within))
                                           : *gaps[i];
      link.name = name_of(options, pairs[i], a, b, i, count == 1);
      if (along.size() > 1) link.name += fmt::format("#{}", k + 1);
      check_name(link.name, options, links);
      set_law(link, options, law, static_cast<double>(along.size()), stiffness_factor, static_cast<int>(links.size()));
      set_friction(link, options, a, b);
      if (!link.preload) refuse_overlap(link, a, b);
      links.push_back(std::move(link));
    }
  }
}

}  // namespace pounding
