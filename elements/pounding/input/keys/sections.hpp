#pragma once
/// Sections of the input.

#include <span>
#include <string_view>
#include <vector>

#include <pounding/input/keys/key.hpp>
#include <pounding/laws/by_name.hpp>

namespace pounding::keys {

/// The whole file and its analysis: analysis.cpp.
extern const Section model, analysis, checkpoint, reduction;

/// Ground motions: ground.cpp. A `motion` acts along one axis.
extern const Section ground_motion, components, motion, wave, harmonic, sum_part, pulse, synthetic;
extern const Section displacement, moved_harmonic, moved_part;

/// Structures and damping: structures.cpp.
extern const Section structure, body, oscillator, shear_building, wall, damping, rayleigh, mass_proportional,
    stiffness_proportional, modal;

/// Time-dependent forces: forces.cpp.
extern const Section force, force_harmonic, force_sum_part, force_pulse, step_force;

/// Frames: frames.cpp; materials: materials.cpp; fibres: fibres.cpp; sections and members: members.cpp; supports, nodal
/// masses and loads: nodes.cpp.
extern const Section frame, grid, bay_width, combination, floor, report;
extern const Section material, confined, cross_section, i_section, tube, member, releases, offsets;
extern const Section rc_rectangle, fibres_of_section, patch, patch_rectangle, patch_ring, bar_layer, frame_fibres;
extern const Section support, support_springs, support_dashpots, node_masses, node_loads, node_displacements, spring,
    tie;

/// Storey springs, hinges, isolators and devices, which follow hysteretic laws: springs.cpp, hinges.cpp, isolators.cpp,
/// devices.cpp.
extern const Section storey_spring, hinge, isolator, device, own_device, bar, damper;

/// Parameters and choices of each hysteretic law that applies, in the order of the laws.
std::vector<const Section*> laws_of_materials();
std::vector<const Section*> laws_of_springs();
std::vector<const Section*> laws_of_hinges();
std::vector<const Section*> laws_of_isolators();
std::vector<const Section*> laws_of_devices();

/// Links without the parameters of laws, link ends and stiffness estimates: links.cpp.
extern const Section link, link_end, link_friction, stiffness;

/// Keys of a link with this law: the keys of `link`, then the parameters of the law in the order of its table.
const Section& link_with(const laws::Entry& law);

/// Keys that a law adds to a link, for documentation: parameters, formulas and the applicable ones of restitution,
/// impact_velocity and reduced_mass. The reader uses link_with().
const Section& parameters_of(const laws::Entry& law);

/// True for keys of `link` that apply to some laws only: formula, restitution, impact_velocity, reduced_mass.
bool belongs_to_law(std::string_view key) noexcept;

/// All sections in reading order, without contact laws; the first is the whole file.
std::span<const Section* const> sections() noexcept;

}  // namespace pounding::keys
