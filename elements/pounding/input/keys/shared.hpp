#pragma once
/// Keys and choices shared by several tables.

#include <pounding/input/keys/sections.hpp>

namespace pounding::keys {

inline constexpr Key damping_key("damping", number(bounds::from_0_below_1).or_map(damping),
                                 otherwise("none; required except for bodies and walls, 0 for no damping"),
                                 "Damping ratio: Rayleigh damping with this ratio in modes 1 and 2, or in the only "
                                 "mode of an oscillator. Allowed at the level of the structure or inside its kind.",
                                 "5 %");
inline constexpr std::string_view reductions[] = {"auto", "none", "all modes"};
inline constexpr Key reduction_key(
    "reduction", choice(reductions, "reduction").or_map(reduction), otherwise("none"),
    "Model order reduction of linear structures to a few hundred coordinates. none: no reduction; all natural modes up "
    "to 500 degrees of freedom with mass, else a factorization of the full system. auto: larger structures are reduced "
    "as far as the tolerance permits. all modes: natural modes up to 5000 degrees of freedom with mass. A map sets the "
    "size of the reduced model.",
    "{links: 5, ground: 20}", "0.2.0");
inline constexpr Key velocity_key("initial_velocity", quantity(dimension::velocity).or_each(), otherwise("0 m/s"),
                                  "Velocity relative to the ground at time 0, positive to the right: one value for all "
                                  "floors, or a list from the ground up. A frame takes one value, along x.",
                                  "0.5 m/s");
inline constexpr Key displacement_key(
    "initial_displacement", quantity(dimension::length).or_each(), otherwise("0 m"),
    "Displacement relative to the ground at time 0, positive to the right: one value for all floors, or a list from "
    "the ground up. In a frame it is measured from the position at rest, and all other nodes follow statically.",
    "-5 mm");

inline constexpr std::string_view auto_face[] = {"auto"};
inline constexpr Key face_key(
    "face", quantity(dimension::length, bounds::non_negative).or_one_of(auto_face),
    otherwise("0 m, for a frame drawn along its faces"),
    "Distance from the member axes of a frame to its face, where contact occurs. Gaps are measured between faces. "
    "auto: half the depth of the deepest outer column in line with the floor or column in contact, over all storeys.",
    "auto", "0.3.0");

/// Named supports of a node of a frame.
inline constexpr std::string_view supports[] = {"fixed", "pinned", "roller"};

/// Pulses over time.
inline constexpr std::string_view pulse_shapes[] = {"half_sine", "sine", "rectangle"};

/// Displacements of a node: in the plane ux, uz, ry.
inline constexpr std::string_view displacements[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

}  // namespace pounding::keys
