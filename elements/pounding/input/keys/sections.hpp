#pragma once
/// The sections of the input, one table each.

#include <span>
#include <string_view>

#include <pounding/input/keys/key.hpp>
#include <pounding/laws/by_name.hpp>

namespace pounding::keys {

/// The whole file, and how it is run: analysis.cpp.
extern const Section model, analysis, checkpoint, reduction;

/// Motions of the ground: ground.cpp. A `motion` is one along one axis.
extern const Section ground_motion, components, motion, wave, harmonic, sum_part, pulse, synthetic;
extern const Section displacement, moved_harmonic, moved_part;

/// Structures of all kinds and their damping: structures.cpp.
extern const Section structure, body, oscillator, shear_building, wall, damping, rayleigh, modal;

/// Forces over time on them: forces.cpp.
extern const Section force, force_harmonic, force_sum_part, force_pulse, step_force;

/// Frames: frames.cpp; their materials, sections and members: members.cpp; their supports and what acts on nodes:
/// nodes.cpp.
extern const Section frame, grid, bay_width, floor, report;
extern const Section material, cross_section, i_section, tube, member, releases, offsets;
extern const Section support, support_springs, support_dashpots, node_masses, node_loads, node_displacements, spring,
    tie;

/// Links without the parameters of their laws, one of the two ends, and estimates of the stiffness: links.cpp.
extern const Section link, link_end, stiffness;

/// Keys of a link that has this law: those of `link`, and the parameters of the law in the order of its table.
const Section& link_with(const laws::Entry& law);

/// Keys that a law adds to a link: its parameters, its formulas, and of restitution, impact_velocity and reduced_mass
/// those that it takes. Beside the reader, which reads through link_with(), everybody reads these.
const Section& parameters_of(const laws::Entry& law);

/// Whether a key of `link` is there for some laws only: formula, restitution, impact_velocity, reduced_mass.
bool belongs_to_law(std::string_view key) noexcept;

/// Every section in the order of reading, without the laws. The first one is the whole file.
std::span<const Section* const> sections() noexcept;

}  // namespace pounding::keys
