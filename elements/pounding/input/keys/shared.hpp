#pragma once
/// Words and choices that stand in several tables.

#include <pounding/input/keys/sections.hpp>

namespace pounding::keys {

inline constexpr Key damping_key{
    "damping", number(bounds::from_0_below_1).or_map(damping),
    otherwise("none: every structure but bodies and walls needs it; 0 for no damping"),
    "Damping ratio: Rayleigh damping that has this ratio in modes 1 and 2, of an oscillator in its only mode. It "
    "stands beside the kind of the structure or among its keys.",
    "5 %"};
inline constexpr std::string_view reductions[] = {"auto", "none", "all modes"};
inline constexpr Key reduction_key{
    "reduction",
    choice(reductions, "reduction").or_map(reduction),
    otherwise("none"),
    "Structures whose linear equations are solved in a few hundred coordinates. none: all natural modes of structures "
    "with up to 500 unknowns with mass, else factors of all unknowns. auto: larger ones are reduced, as deep as the "
    "tolerance asks. all modes: natural modes up to 5000 unknowns with mass. Keys say how deep.",
    "{links: 5, ground: 20}",
    "0.2.0"};
inline constexpr Key velocity_key{"initial_velocity", quantity(dimension::velocity).or_each(), otherwise("0 m/s"),
                                  "Velocity at time 0 relative to the ground, positive to the right: one for all "
                                  "floors, or a list from the ground up; of a frame one along x.",
                                  "0.5 m/s"};
inline constexpr Key displacement_key{"initial_displacement", quantity(dimension::length).or_each(), otherwise("0 m"),
                                      "Displacement at time 0 relative to the ground, positive to the right: one for "
                                      "all floors, or a list from the ground up; of a frame relative to its place at "
                                      "rest, and all between the floors follows as if forces held them there.",
                                      "-5 mm"};

inline constexpr std::string_view auto_face[] = {"auto"};
inline constexpr Key face_key{"face",
                              quantity(dimension::length, bounds::non_negative).or_one_of(auto_face),
                              otherwise("0 m: frames are drawn by their faces"),
                              "Distance from the axes by which a frame is drawn to its face, where it is hit; gaps are "
                              "measured between faces. auto: half the depth of the outer columns, the deepest of those "
                              "in line with the floor or column that is hit, in all storeys.",
                              "auto",
                              "0.3.0"};

/// Supports of a node of a frame by one word.
inline constexpr std::string_view supports[] = {"fixed", "pinned", "roller"};

/// Pulses over time.
inline constexpr std::string_view pulse_shapes[] = {"half_sine", "sine", "rectangle"};

/// Displacements of a node: in the plane ux, uz, ry.
inline constexpr std::string_view displacements[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

}  // namespace pounding::keys
