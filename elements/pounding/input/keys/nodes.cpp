#include <array>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/shared.hpp>

namespace pounding::keys {
namespace {

constexpr Dimension turning_damping{1, 2, -1};  // [N m s]

/// One key per degree of freedom of a node; rotations and translations have different dimensions.
constexpr std::array<Key, 6> by_displacement(const Dimension& of_translation, const Dimension& of_rotation,
                                             const Bounds& bounds, const std::array<std::string_view, 2>& examples) {
  constexpr std::array<std::string_view, 6> meanings{"Along x.",
                                                     "Along y, in space.",
                                                     "Along z, positive up.",
                                                     "About x, in space.",
                                                     "About y; positive from z to x.",
                                                     "About z, in space."};
  std::array<Key, 6> keys{};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool turns = i >= 3;
    keys[i] = {displacements[i],
               quantity(turns ? of_rotation : of_translation, bounds)
                   .in(of_rotation == turning_damping && turns ? "N m s" : std::string_view{}),
               optional, meanings[i], examples[turns]};
  }
  return keys;
}

constexpr auto masses =
    by_displacement(dimension::mass, dimension::rotational_inertia, bounds::non_negative, {"10 t", "5 t m^2"});
constexpr auto loads = by_displacement(dimension::force, dimension::energy, bounds::any, {"-10 kN", "5 kN m"});
constexpr auto moved = by_displacement(dimension::length, dimension::none, bounds::any, {"-5 mm", "0.002"});
constexpr auto springs =
    by_displacement(dimension::stiffness, dimension::energy, bounds::positive, {"20 MN/m", "100 MN m"});
constexpr auto dashpots =
    by_displacement(dimension::damping, turning_damping, bounds::positive, {"100 kN s/m", "1 MN m s"});

constexpr Key support_keys[] = {
    {"fix", choice(displacements, "support").or_list().or_one_of(supports),
     otherwise("none; with an isolator all except ux, in space also except uy"),
     "Restrained degrees of freedom: a list, or fixed, pinned or roller.", "[uz, ry]"},
    {"isolator", map(isolator), otherwise("none"),
     "Isolator along ux, in space also along uy. The foot neither uplifts nor rotates unless fix specifies the "
     "restraints.",
     "{friction_pendulum: {radius: 2 m, friction: 6 %, weight: 500 kN}}", "0.2.0"},
    {"springs", map(support_springs), optional, "Springs to the ground, by degree of freedom.",
     "{ux: 20 MN/m, ry: 100 MN m}"},
    {"dashpots", map(support_dashpots), optional, "Dashpots to the ground, by degree of freedom.", "{ux: 100 kN s/m}"},
    {"delay", quantity(dimension::time, bounds::non_negative), otherwise("0 s"),
     "Time delay of the ground motion at this support.", "0.05 s"},
    {"ground_motion", map(ground_motion), otherwise("ground motion of the structure"),
     "Ground motion of this support only; without a wave.",
     "{harmonic: {amplitude: 3 m/s^2, period: 0.6 s, duration: 3 s}}"},
};

constexpr std::string_view directions_of_springs[] = {"both", "compression"};

constexpr Key spring_keys[] = {
    {"node", text(), exactly_one, "Node of a spring or dashpot to the ground.", "b"},
    {"between", text().list(2), exactly_one, "The two nodes that a spring or dashpot connects.", "[b, c]"},
    {"dof", choice(displacements, "displacement"), required,
     "Degree of freedom on which the spring acts. A spring between two nodes has no length.", "ux"},
    {"stiffness", quantity(dimension::stiffness, bounds::non_negative).or_rotation(dimension::energy), at_least_one,
     "Spring stiffness; on a rotation, moment per radian.", "1 MN/m"},
    {"damping", quantity(dimension::damping, bounds::non_negative).or_rotation(turning_damping).in("N s/m or N m s"),
     at_least_one, "Dashpot coefficient: force per velocity.", "100 kN s/m"},
    {"acts_in", choice(directions_of_springs, "direction"), otherwise("both"),
     "compression: the spring supports its node along uz and lifts off when its compression at rest is exhausted; it "
     "needs a mass at the node and gravity or loads. A dashpot acts in both directions.",
     "compression", "0.3.0"},
};

constexpr Key tie_keys[] = {
    {"master", text(), required, "Master node.", "a"},
    {"nodes", text().nonempty_list(), required, "Nodes that follow the master.", "[b, c]"},
    {"dofs", choice(displacements, "displacement").list(), exactly_one,
     "Degrees of freedom equal to those of the master.", "[ux]"},
    {"rigid", boolean(), exactly_one, "true connects the nodes rigidly to the master.", "true"},
};

}  // namespace

constinit const Section support{"supports", "structures.NAME.frame.supports.NODE", "Support of a frame.", support_keys};
constinit const Section support_springs{"support_springs", "structures.NAME.frame.supports.NODE.springs",
                                        "Springs to the ground.", springs};
constinit const Section support_dashpots{"support_dashpots", "structures.NAME.frame.supports.NODE.dashpots",
                                         "Dashpots to the ground.", dashpots};
constinit const Section node_masses{"masses", "structures.NAME.frame.masses.NODE", "Masses of a node.", masses};
constinit const Section node_loads{"loads", "structures.NAME.frame.loads.NODE",
                                   "Forces and moments on a node, in global axes.", loads};
constinit const Section node_displacements{
    "node_displacements", "structures.NAME.frame.initial_node_displacements.NODE",
    "Displacements and rotations of a node at time 0, relative to its position at rest.", moved};
constinit const Section spring{"springs", "structures.NAME.frame.springs[]", "Spring, dashpot, or both in parallel.",
                               spring_keys};
constinit const Section tie{"ties", "structures.NAME.frame.ties[]",
                            "Rigid constraint: nodes that follow a master node.", tie_keys};

}  // namespace pounding::keys
