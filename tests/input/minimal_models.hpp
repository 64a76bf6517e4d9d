#pragma once
/// Small models that contain one key of a section of the input.

#include <algorithm>
#include <fstream>
#include <map>
#include <string>

#include <fmt/format.h>

#include <pounding/input/keys/sections.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::test {

using keys::Key;
using keys::Need;
using keys::Section;

/// Keys with their values as typed.
using Keys = std::map<std::string, std::string>;

inline std::string map_of(const Keys& keys) {
  std::string text;
  for (const auto& [key, value] : keys) text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", key, value);
  return "{" + text + "}";
}

inline const std::string shaken =
    "ground_motion: {harmonic: {amplitude: 1, period: 0.5, duration: 1}}\nanalysis: {duration: 1}\n";
inline const std::string pair =
    "structures:\n  left: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}\n  right: {oscillator: {mass: 150 t, "
    "period: 0.4}, damping: 5 %}\n";
inline const std::string rectangle = "{rectangle: [0.4 m, 0.6 m]}";

inline const std::string others =
    "b1: {between: [b, c], section: " + rectangle + "}, c2: {between: [d, c], section: " + rectangle + "}";

// A bent of two columns and a beam: nodes a and d on the ground, b and c above them.
inline const Keys bent = {{"material", "{E: 30 GPa, density: 2500}"},
                          {"nodes", "{a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}"},
                          {"members", "{c1: {between: [a, b], section: " + rectangle + "}, " + others + "}"},
                          {"supports", "{a: fixed, d: fixed}"},
                          {"masses", "{b: 10 t, c: 10 t}"},
                          {"damping", "5 %"}};

// Laws of fibres that examples refer to.
inline const std::string fibre_laws =
    "core: {concrete02: {fpc: -36 MPa, epsc0: -0.004, fpcu: -36 MPa, epsU: -0.03, lambda: 0.1, ft: 0, Ets: 1 GPa}}, "
    "cover: {concrete01: {fpc: -28 MPa, epsc0: -0.002, fpcu: -5.6 MPa, epsU: -0.006}}, "
    "bars: {steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01}}, steel: {steel01: {Fy: 355 MPa, E0: 200 GPa, b: 0.01}}";

inline std::string in_frame(const Keys& changed) {
  Keys frame = bent;
  for (const auto& [key, value] : changed) frame[key] = value;
  return shaken + "structures: {tower: {frame: " + map_of(frame) + "}}\n";
}

// This bent as a frame in space, which has every displacement.
inline std::string in_space(Keys changed) {
  changed["nodes"] = "{a: [0, 0, 0], b: [0, 0, 3 m], c: [6 m, 0, 3 m], d: [6 m, 0, 0]}";
  return in_frame(changed);
}

inline const std::string grid_of_space =
    "{storeys: 1, bays: [1, 1], storey_height: 3 m, bay_width: 6 m, columns: " + rectangle + ", beams: " + rectangle +
    ", floor_mass: 20 t}";
inline const std::string two_in_space =
    "analysis: {duration: 1}\nstructures:\n  left: {frame: {material: {E: 30 GPa}, grid: " + grid_of_space +
    "}, damping: 5 %}\n" + "  right: {frame: {origin: [6.02 m, 0 m], material: {E: 30 GPa}, grid: " + grid_of_space +
    "}, damping: 5 %}\n";

// Four storeys, whose columns can be hit, next to a wall.
inline const std::string beside_wall =
    "analysis: {duration: 1}\nstructures:\n  right: {wall: {}}\n  left: {frame: {material: {E: 30 GPa, density: 2500}, "
    "mass: consistent, grid: {storeys: 4, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: " +
    rectangle + ", beams: " + rectangle + "}}, damping: 5 %}\n";

/// The bent with a section of fibres; the others are elastic.
inline std::string with_fibres(const std::string& section) {
  return in_frame({{"materials", "{" + fibre_laws + "}"}, {"sections", "{one: " + section + "}"}});
}
inline std::string with_patches(const std::string& patch) {
  return with_fibres("{fibres: {patches: [" + patch + "]}}");
}

/// Two storeys that yield by this spring.
inline std::string yielding(const std::string& spring) {
  return shaken + pair +
         "  a: {shear_building: {storeys: 2, mass: 1 t, stiffness: 10 MN/m, damping: 5 %, spring: " + spring + "}}";
}

/// The bent in space on one isolator.
inline std::string isolated(const std::string& isolator) {
  return in_space({{"supports", "{a: {isolator: " + isolator + "}, d: fixed}"}, {"gravity", "true"}});
}

/// Model around a section; the @ is replaced by the keys.
inline std::string around(const Section& s) {
  Keys with_floor = bent;
  with_floor["floors"] = "[{nodes: [b, c]}]";
  const std::map<const Section*, std::string> models = {
      {&keys::model, "@"},
      {&keys::analysis,
       "structures: {left: {shear_building: {storeys: 1, mass: 100 t, stiffness: 60 MN/m, height: 3 m}, damping: 5 "
       "%}}\nanalysis: @"},
      {&keys::reduction, pair + "analysis: {duration: 1, reduction: @}"},
      {&keys::checkpoint, pair + "analysis: {duration: 1}\ncheckpoint: @"},
      {&keys::ground_motion, two_in_space + "ground_motion: @"},
      {&keys::components, two_in_space + "ground_motion: {components: @}"},
      {&keys::motion, pair + "ground_motion: {components: {x: @}}"},
      {&keys::wave, two_in_space + "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}, wave: @}"},
      {&keys::harmonic, pair + "ground_motion: {harmonic: @}"},
      {&keys::sum_part, pair + "ground_motion: {sum: [@], duration: 1}"},
      {&keys::displacement, pair + "analysis: {duration: 1}\nground_motion: {displacement: @}"},
      {&keys::moved_harmonic, pair + "ground_motion: {displacement: {harmonic: @}}"},
      {&keys::moved_part, pair + "ground_motion: {displacement: {sum: [@], duration: 1}}"},
      {&keys::pulse, pair + "ground_motion: {pulse: @}"},
      {&keys::synthetic, pair + "ground_motion: {synthetic: @}"},
      {&keys::structure, shaken + pair + "  a: @"},
      {&keys::body, shaken + pair + "  a: {body: @}"},
      {&keys::oscillator, shaken + pair + "  a: {oscillator: @}"},
      {&keys::shear_building, shaken + pair + "  a: {shear_building: @}"},
      {&keys::storey_spring, yielding("@")},
      {&keys::wall, shaken + pair + "  a: {wall: @}"},
      {&keys::damping, shaken + pair + "  a: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m}, damping: @}"},
      {&keys::rayleigh,
       shaken + pair + "  a: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m}, damping: {rayleigh: @}}"},
      {&keys::mass_proportional,
       shaken + pair + "  a: {oscillator: {mass: 1 t, period: 1}, damping: {mass_proportional: @}}"},
      {&keys::stiffness_proportional,
       shaken + pair + "  a: {oscillator: {mass: 1 t, period: 1}, damping: {stiffness_proportional: @}}"},
      {&keys::modal,
       shaken + pair + "  a: {shear_building: {storeys: 3, mass: 1 t, stiffness: 1 MN/m}, damping: {modal: @}}"},
      {&keys::force, shaken + "structures: {tower: {frame: " + map_of(with_floor) + ", forces: [@]}}"},
      {&keys::force_harmonic, shaken + pair + "  a: {body: {mass: 1 t}, forces: [{harmonic: @}]}"},
      {&keys::force_sum_part, shaken + pair + "  a: {body: {mass: 1 t}, forces: [{sum: [@], duration: 1}]}"},
      {&keys::force_pulse, shaken + pair + "  a: {body: {mass: 1 t}, forces: [{pulse: @}]}"},
      {&keys::step_force, shaken + pair + "  a: {body: {mass: 1 t}, forces: [{step_force: @}]}"},
      {&keys::frame, shaken + "structures: {tower: {frame: @}}"},
      {&keys::material, in_frame({{"materials", "{one: @, " + fibre_laws + "}"}})},
      {&keys::confined, in_frame({{"materials", "{one: {confined: @}, " + fibre_laws + "}"}})},
      {&keys::cross_section, with_fibres("@")},
      {&keys::rc_rectangle, with_fibres("{rc_rectangle: @}")},
      {&keys::fibres_of_section, with_fibres("{fibres: @}")},
      {&keys::patch, with_patches("@")},
      {&keys::patch_rectangle, with_patches("{rectangle: @, cells: [1, 4], material: core}")},
      {&keys::patch_ring, with_patches("{ring: @, cells: [1, 8], material: core}")},
      {&keys::bar_layer, with_fibres("{fibres: {layers: [@]}}")},
      {&keys::frame_fibres,
       shaken + "structures: {tower: {frame: {materials: {" + fibre_laws +
           "}, grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4], "
           "material: steel}, beams: {rectangle: [0.3, 0.5], material: steel}, floor_mass: 20 t}, damping: 5 %, "
           "fibres: @}}}"},
      {&keys::i_section, in_frame({{"sections", "{one: {i_section: @}}"}})},
      {&keys::tube, in_frame({{"sections", "{one: {tube: @}}"}})},
      {&keys::grid, shaken + "structures: {tower: {frame: {material: {E: 30 GPa}, grid: @, damping: 5 %}}}"},
      {&keys::bay_width, shaken +
                             "structures: {tower: {frame: {material: {E: 30 GPa}, damping: 5 %, grid: {storeys: 1, "
                             "bays: [1, 1], storey_height: 3 m, columns: " +
                             rectangle + ", beams: " + rectangle + ", floor_mass: 20 t, bay_width: @}}}}"},
      {&keys::combination, shaken +
                               "structures: {tower: {frame: {material: {E: 30 GPa}, damping: 5 %, grid: {storeys: 1, "
                               "bays: 1, storey_height: 3 m, bay_width: 6 m, columns: " +
                               rectangle + ", beams: " + rectangle +
                               ", floor_mass: 20 t, dead_load: -20 kN/m, live_load: -10 kN/m, combination: @}}}}"},
      {&keys::member, in_frame({{"members", "{c1: @, " + others + "}"}})},
      {&keys::releases,
       in_frame({{"members", "{c1: {between: [a, b], section: " + rectangle + ", releases: @}, " + others + "}"}})},
      {&keys::offsets,
       in_frame({{"members", "{c1: {between: [a, b], section: " + rectangle + ", offsets: @}, " + others + "}"}})},
      {&keys::support, in_frame({{"supports", "{a: @, d: fixed}"}})},
      {&keys::support_springs, in_space({{"supports", "{a: {springs: @}, d: fixed}"}})},
      {&keys::support_dashpots,
       in_space({{"supports", "{a: {dashpots: @}, d: fixed}"},
                 {"masses", "{a: {rx: 1 t m^2, ry: 1 t m^2, rz: 1 t m^2}, b: 10 t, c: 10 t}"}})},
      {&keys::isolator, isolated("@")},
      {&keys::floor, in_frame({{"floors", "[@]"}})},
      {&keys::node_masses, in_space({{"masses", "{b: @, c: 10 t}"}})},
      {&keys::node_loads, in_space({{"loads", "{b: @}"}})},
      {&keys::node_displacements, in_space({{"mass", "consistent"}, {"initial_node_displacements", "{b: @}"}})},
      {&keys::spring, in_space({{"springs", "[@]"}, {"gravity", "true"}})},
      {&keys::tie, in_frame({{"ties", "[@]"}})},
      {&keys::report, in_frame({{"report", "@"}})},
      {&keys::hinge, in_frame({{"hinges", "{b1: @}"}})},
      {&keys::link, two_in_space + "links: [@]"},
      {&keys::link_friction,
       two_in_space + "links: [{between: [left.1, right.1], law: hertz, stiffness: 2.75e9, friction: @}]"},
      {&keys::stiffness, shaken + pair + "links: [{between: [left, right], gap: 20 mm, law: hertz, stiffness: @}]"},
      {&keys::device, shaken + pair + "devices: {tie: @}"},
      {&keys::own_device,
       shaken + pair +
           "  a: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m, damping: 5 %, devices: {tie: @}}}"},
      {&keys::bar, two_in_space + "devices: {tie: {between: [left.1, right.1], bar: @}}"},
      {&keys::damper, shaken + pair + "devices: {tie: {between: [left, right], damper: @}}"},
      {&keys::link_end, beside_wall + "links: [{between: [@, right], gap: 20 mm, law: hertz, stiffness: 1e9}]"}};
  for (const Section* law : keys::laws_of_materials())  // they are called material_LAW
    if (law == &s) return in_frame({{"materials", fmt::format("{{one: {{{}: @}}}}", law->name.substr(9))}});
  for (const Section* law : keys::laws_of_springs())
    if (law == &s) return yielding(fmt::format("{{{}: @}}", law->name));
  for (const Section* law : keys::laws_of_devices())  // they are called device_LAW
    if (law == &s)
      return shaken + pair + fmt::format("devices: {{tie: {{between: [left, right], {}: @}}}}", law->name.substr(7));
  for (const Section* law : keys::laws_of_hinges())  // they are called hinge_LAW
    if (law == &s) return in_frame({{"hinges", fmt::format("{{b1: {{at: both, {}: @}}}}", law->name.substr(6))}});
  for (const Section* law : keys::laws_of_isolators())  // they are called isolator_LAW
    if (law == &s) return isolated(fmt::format("{{coupled: false, {}: @}}", law->name.substr(9)));
  return models.at(&s);
}

/// Keys that a section needs in addition to its required keys, and values for its minimal models.
inline const std::map<const Section*, Keys> beside = {
    {&keys::model, {{"analysis", "{duration: 1}"}}},
    {&keys::analysis, {{"duration", "1"}}},
    {&keys::reduction, {{"links", "5"}}},
    {&keys::ground_motion, {{"pulse", "{shape: sine, amplitude: 1, duration: 1}"}}},
    {&keys::components, {{"x", "{harmonic: {amplitude: 1, period: 1, duration: 1}}"}}},
    {&keys::motion, {{"pulse", "{shape: sine, amplitude: 1, duration: 1}"}}},
    {&keys::displacement, {{"harmonic", "{amplitude: 1 mm, period: 1, duration: 1}"}}},
    {&keys::structure, {{"oscillator", "{mass: 100 t, period: 0.8}"}, {"damping", "5 %"}}},
    {&keys::force, {{"pulse", "{shape: sine, amplitude: 1, duration: 1}"}}},
    {&keys::force_harmonic, {{"period", "1"}}},
    {&keys::force_sum_part, {{"period", "1"}}},
    {&keys::damping, {{"stiffness_proportional", "{ratio: 5 %}"}}},
    {&keys::rayleigh, {{"ratio", "5 %"}}},
    {&keys::mass_proportional, {{"ratio", "5 %"}}},
    {&keys::stiffness_proportional, {{"ratio", "5 %"}}},
    {&keys::modal, {{"ratio", "5 %"}}},
    {&keys::combination, {{"live", "0.3"}}},
    {&keys::grid, {{"floor_mass", "20 t"}}},
    {&keys::oscillator, {{"damping", "5 %"}}},
    {&keys::shear_building, {{"damping", "5 %"}}},
    {&keys::frame, bent},
    {&keys::cross_section, {{"rectangle", "[0.4 m, 0.6 m]"}}},
    {&keys::bar_layer, {{"from", "[0, 0.1 m]"}, {"to", "[0, -0.1 m]"}}},
    {&keys::member, {{"between", "[a, b]"}, {"section", rectangle}}},
    {&keys::hinge, {{"yield_moment", "210 kN m"}}},
    {&keys::isolator, {{"coupled", "false"}}},
    {&keys::support, {{"fix", "[uz]"}, {"springs", "{ux: 20 MN/m}"}}},
    {&keys::support_springs, {{"uz", "20 MN/m"}, {"ux", "20 MN/m"}}},
    {&keys::link, {{"law", "hertz_damped"}, {"stiffness", "2.75e9"}, {"restitution", "0.65"}}}};

/// Keys in addition to a key; an empty value removes the key.
inline const std::map<std::string, Keys> beside_key = {
    {"reduction.modes", {{"links", ""}}},
    {"reduction.error", {{"links", ""}}},
    {"reduction.of", {{"links", ""}, {"error", "1e-4"}}},
    {"model.links",
     {{"structures", "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}, right: {wall: {}}}"}}},
    {"model.devices",
     {{"structures", "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}, right: {wall: {}}}"}}},
    {"hinges.bilinear", {{"yield_moment", ""}}},
    {"hinges.menegotto_pinto", {{"yield_moment", ""}}},
    {"hinges.bouc_wen", {{"yield_moment", ""}}},
    {"hinges.peak_oriented", {{"yield_moment", ""}}},
    {"hinges.imk_bilinear", {{"yield_moment", ""}}},
    {"hinges.imk_peak_oriented", {{"yield_moment", ""}}},
    {"hinges.imk_pinching", {{"yield_moment", ""}}},
    {"hinges.bilin", {{"yield_moment", ""}}},
    {"hinges.mod_imk_peak_oriented", {{"yield_moment", ""}}},
    {"hinges.mod_imk_pinching", {{"yield_moment", ""}}},
    {"hinges.hysteretic", {{"yield_moment", ""}}},
    {"hinges.pinching4", {{"yield_moment", ""}}},
    {"hinge_peak_oriented.cracking_moment", {{"yield_rotation", "0.03"}}},
    {"hinge_peak_oriented.yield_rotation", {{"cracking_moment", "50 kN m"}}},
    {"device_peak_oriented.cracking_force", {{"yield_deformation", "30 mm"}}},
    {"device_peak_oriented.yield_deformation", {{"cracking_force", "50 kN"}}},
    {"device_restrainer.hardening", {{"strength", "400 kN"}}},
    {"springs.acts_in", {{"node", "b"}, {"dof", "uz"}, {"stiffness", "20 MN/m"}}},
    {"supports.isolator", {{"springs", ""}, {"fix", ""}}},
    {"isolator_lead_rubber.strength", {{"post_yield_stiffness", "3.5 MN/m"}}},
    {"isolator_lead_rubber.yield_displacement", {{"post_yield_stiffness", "3.5 MN/m"}}},
    {"isolator_lead_rubber.shear_modulus", {{"area", "1.75 m^2"}, {"rubber_thickness", "0.2 m"}}},
    {"isolator_lead_rubber.area", {{"shear_modulus", "0.4 MPa"}, {"rubber_thickness", "0.2 m"}}},
    {"isolator_lead_rubber.rubber_thickness", {{"shear_modulus", "0.4 MPa"}, {"area", "1.75 m^2"}}},
    {"isolator_elastomeric.strength", {{"post_yield_stiffness", "3.5 MN/m"}}},
    {"isolator_elastomeric.yield_displacement", {{"post_yield_stiffness", "3.5 MN/m"}}},
    {"isolator_elastomeric.exponent", {{"post_yield_stiffness", "3.5 MN/m"}}},
    {"isolator_elastomeric.shear_modulus", {{"area", "1.75 m^2"}, {"rubber_thickness", "0.2 m"}}},
    {"isolator_elastomeric.area", {{"shear_modulus", "0.4 MPa"}, {"rubber_thickness", "0.2 m"}}},
    {"isolator_elastomeric.rubber_thickness", {{"shear_modulus", "0.4 MPa"}, {"area", "1.75 m^2"}}},
    {"isolator_friction_pendulum.rate", {{"friction", "[4 %, 8 %]"}}},
    {"isolator_peak_oriented.cracking_force", {{"yield_deformation", "30 mm"}}},
    {"isolator_peak_oriented.yield_deformation", {{"cracking_force", "50 kN"}}},
    {"members.truss", {{"section", ""}}},
    {"damping.rayleigh", {{"stiffness_proportional", ""}}},
    {"damping.mass_proportional", {{"stiffness_proportional", ""}}},
    {"damping.modal", {{"stiffness_proportional", ""}}},
    {"rayleigh.alpha", {{"ratio", ""}}},
    {"rayleigh.beta", {{"ratio", ""}}},
    {"mass_proportional.alpha", {{"ratio", ""}}},
    {"stiffness_proportional.beta", {{"ratio", ""}}},
    {"modal.ratios", {{"ratio", ""}, {"others", "2 %"}}},
    {"modal.others", {{"ratio", ""}, {"ratios", "[5 %, 5 %]"}}},
    {"hinges.strength", {{"yield_moment", ""}}},
    {"material_concrete04.ft", {{"et", "0.001"}}},
    {"sections.profile", {{"rectangle", ""}}},
    {"sections.material", {{"rectangle", "[0.4 m, 0.6 m]"}}},
    {"sections.layers", {{"material", "steel"}}},
    {"sections.across", {{"material", "steel"}}},
    {"sections.density", {{"material", "steel"}}},
    {"sections.GJ", {{"material", "steel"}}},
    {"layers.radius", {{"from", ""}, {"to", ""}}},
    {"layers.centre", {{"radius", "0.2 m"}, {"from", ""}, {"to", ""}}},
    {"fibres.hinge_length", {{"rule", "hinge_radau"}}},
    {"frame.fibres",
     {{"materials", "{" + fibre_laws + "}"},
      {"members", "{c1: {between: [a, b], section: {rectangle: [0.4, 0.6], material: steel}}, " + others + "}"}}},
    {"sections.plastic_modulus_y", {{"rectangle", ""}, {"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}}},
    {"sections.plastic_modulus_z", {{"rectangle", ""}, {"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}}},
    {"grid.combination", {{"dead_load", "-20 kN/m"}, {"live_load", "-10 kN/m"}}},
    {"grid.live_load", {{"combination", "{dead: 1, live: 0.3}"}}},
    {"grid.mass_from_loads", {{"beams_load", "-25 kN/m"}}},
    {"bar.E", {{"area", "20 cm^2"}}},
    {"bar.area", {{"E", "210 GPa"}, {"stiffness", ""}}},
    {"damper.exponent", {{"coefficient", "2e5"}}},
    {"damper.rounding_velocity", {{"coefficient", "2e5"}, {"exponent", "0.35"}}},
    {"friction.static", {{"stribeck_velocity", "10 mm/s"}, {"tangential_stiffness", "50 MN/m"}}},
    {"friction.stribeck_velocity", {{"static", "0.4"}, {"tangential_stiffness", "50 MN/m"}}},
    {"stiffness.area", {{"length", "9 m"}}},
    {"stiffness.length", {{"area", "3 m^2"}}},
    {"stiffness.velocity", {{"penetration", "5 mm"}}},
    {"analysis.spectral_radius", {{"integrator", "generalized_alpha"}}},
    {"ground_motion.channel", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"ground_motion.units", {{"record", "plain.csv"}, {"pulse", ""}}},
    {"ground_motion.scale", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"ground_motion.pga", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"ground_motion.components", {{"pulse", ""}}},
    {"motion.channel", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"motion.units", {{"record", "plain.csv"}, {"pulse", ""}}},
    {"motion.scale", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"motion.pga", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"ground_motion.step", {{"record", "values.txt"}, {"units", "g"}, {"pulse", ""}}},
    {"ground_motion.initial_velocity", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"ground_motion.sum", {{"duration", "1"}}},
    {"ground_motion.duration", {{"sum", "[{amplitude: 1, period: 1}]"}, {"pulse", ""}}},
    {"motion.step", {{"record", "values.txt"}, {"units", "g"}, {"pulse", ""}}},
    {"motion.initial_velocity", {{"record", "knet.txt"}, {"pulse", ""}}},
    {"motion.sum", {{"duration", "1"}}},
    {"motion.duration", {{"sum", "[{amplitude: 1, period: 1}]"}, {"pulse", ""}}},
    {"displacement.channel", {{"record", "channels.csv"}, {"harmonic", ""}}},
    {"displacement.units", {{"record", "plain.csv"}, {"harmonic", ""}}},
    {"displacement.step", {{"record", "values.txt"}, {"units", "mm"}, {"harmonic", ""}}},
    {"displacement.scale", {{"record", "moved.csv"}, {"harmonic", ""}}},
    {"displacement.initial_velocity", {{"record", "moved.csv"}, {"harmonic", ""}}},
    {"displacement.sum", {{"duration", "1"}}},
    {"displacement.duration", {{"sum", "[{amplitude: 1 mm, period: 1}]"}, {"harmonic", ""}}},
    {"forces.channel", {{"record", "channels_of_force.csv"}, {"pulse", ""}}},
    {"forces.units", {{"record", "plain.csv"}, {"pulse", ""}}},
    {"forces.step", {{"record", "values.txt"}, {"units", "kN"}, {"pulse", ""}}},
    {"forces.scale", {{"record", "forces.csv"}, {"pulse", ""}}},
    {"forces.start", {{"record", "forces.csv"}, {"pulse", ""}}},
    {"forces.sum", {{"duration", "1"}}},
    {"forces.duration", {{"sum", "[{amplitude: 1, period: 1}]"}, {"pulse", ""}}},
    {"synthetic.omega_g", {{"zeta_g", "0.6"}, {"omega_f", "1.5 rad/s"}, {"zeta_f", "0.6"}}},
    {"synthetic.zeta_g", {{"omega_g", "15 rad/s"}, {"omega_f", "1.5 rad/s"}, {"zeta_f", "0.6"}}},
    {"synthetic.omega_f", {{"omega_g", "15 rad/s"}, {"zeta_g", "0.6"}, {"zeta_f", "0.6"}}},
    {"synthetic.zeta_f", {{"omega_g", "15 rad/s"}, {"zeta_g", "0.6"}, {"omega_f", "1.5 rad/s"}}},
    {"structures.body", {{"damping", ""}}},
    {"structures.oscillator", {{"damping", ""}}},
    {"structures.shear_building", {{"damping", ""}}},
    {"structures.frame", {{"damping", ""}}},
    {"structures.wall", {{"damping", ""}}},
    {"oscillator.hardening", {{"yield_force", "1 MN"}}},
    {"shear_building.hardening", {{"yield_force", "1 MN"}}},
    {"peak_oriented.cracking_force", {{"yield_deformation", "30 mm"}}},
    {"peak_oriented.yield_deformation", {{"cracking_force", "50 kN"}}},
    {"frame.initial_displacement", {{"floors", "[{nodes: [b, c]}]"}}},
    {"frame.grid", {{"nodes", ""}, {"members", ""}, {"supports", ""}, {"masses", ""}}},
    {"frame.nodes",
     {{"members", "{c1: {between: [a, b], section: " + rectangle + "}}"}, {"supports", "{a: fixed}"}, {"masses", ""}}},
    {"frame.members", {{"nodes", "{a: [0, 0], b: [0, 3 m]}"}, {"supports", "{a: fixed}"}, {"masses", ""}}},
    {"sections.inertia_y", {{"area", "0.16 m^2"}, {"rectangle", ""}}},
    {"sections.inertia_z", {{"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}, {"rectangle", ""}}},
    {"sections.torsion", {{"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}, {"rectangle", ""}}},
    {"sections.shear_area_y", {{"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}, {"rectangle", ""}}},
    {"sections.shear_area_z", {{"area", "0.16 m^2"}, {"inertia_y", "2.1e-3 m^4"}, {"rectangle", ""}}},
    {"sections.area", {{"inertia_y", "2.1e-3 m^4"}}},
    {"structures.face", {{"oscillator", ""}, {"frame", "{material: {E: 30 GPa}, grid: " + grid_of_space + "}"}}},
    {"links.within", {{"between", "neighbours"}}},
    {"links.sliding_velocity", {{"friction", "0.3"}}},
    {"links.preload", {{"gap", "-2 mm"}, {"law", "hertz"}, {"restitution", ""}}},
    {"ties.rigid", {{"master", "b"}, {"nodes", "[c]"}}},
    {"between.structure", {{"floor", "4"}}}};

/// Keys of a minimal section that contains this key.
inline Keys keys_around(const Section& s, const Key& spec, const std::string& value) {
  Keys keys;
  for (const Key& each : s.keys)
    if (each.need == Need::required) keys[std::string(each.key)] = each.example;
  if (const auto more = beside.find(&s); more != beside.end())
    for (const auto& [key, text] : more->second) keys[key] = text;
  if (spec.need == Need::exactly_one)
    for (const Key& each : s.keys)
      if (each.need == Need::exactly_one) keys.erase(std::string(each.key));
  keys[std::string(spec.key)] = value;
  for (const Need need : {Need::exactly_one, Need::at_least_one}) {
    const auto is_one = [need](const Key& each) { return each.need == need; };
    const auto first = std::ranges::find_if(s.keys, is_one);
    const bool has = std::ranges::any_of(
        s.keys, [&](const Key& each) { return is_one(each) && keys.contains(std::string(each.key)); });
    if (first != s.keys.end() && !has) keys[std::string(first->key)] = first->example;
  }
  if (const auto more = beside_key.find(fmt::format("{}.{}", s.name, spec.key)); more != beside_key.end())
    for (const auto& [key, text] : more->second) {
      if (text.empty())
        keys.erase(key);
      else
        keys[key] = text;
    }
  return keys;
}

/// Keys of a link with this law and one of its parameters.
inline Keys keys_of_law(const laws::Entry& law, const Key& spec) {
  const auto is = [&](const Key& each, laws::Need need) {
    const auto found = std::ranges::find(law.parameters, each.key, &laws::ParameterInfo::name);
    return found != law.parameters.end() && found->need == need;
  };
  const laws::Need needed = is(spec, laws::Need::together) ? laws::Need::together : laws::Need::required;
  const bool asks = needed == laws::Need::required && spec.need != Need::exactly_one;
  Keys keys{{"between", "[left, right]"}, {"gap", "20 mm"}, {"law", std::string(law.name)}};
  for (const Key& each : keys::parameters_of(law).keys)
    if (is(each, needed) || (each.key == "restitution" && asks)) keys[std::string(each.key)] = each.example;
  keys[std::string(spec.key)] = spec.example;
  return keys;
}

inline std::string with_keys(const Section& s, const Keys& keys) {
  std::string text = around(s);
  return text.replace(text.find('@'), 1, map_of(keys)) + "\n";
}

inline std::string with_key(const Section& s, const Key& spec, const std::string& value) {
  if (s.name == "members" && spec.key == "reference")
    return in_space({{"members", "{c1: {between: [a, b], section: " + rectangle + ", reference: " + value + "}, " +
                                     others + "}"}}) +
           "\n";
  if (s.name == "between" && spec.key == "face") {
    std::string text = two_in_space + "links: [{between: [{structure: left, face: " + value +
                       "}, right], law: hertz, stiffness: 1e9}]\n";
    return text.replace(text.find("6.02 m"), 6, "6.5 m");
  }
  return with_keys(s, keys_around(s, spec, value));
}

/// Records that the examples refer to.
inline void write_records(const std::string& folder) {
  std::ofstream(folder + "plain.csv") << "0, 0\n0.1, 1\n0.2, -1\n0.3, 0\n";
  std::ofstream(folder + "values.txt") << "0 1 -1\n0\n";
  std::ofstream(folder + "forces.csv") << "t [s], F [kN]\n0, 0\n0.5, 3\n1, 2\n";
  std::ofstream(folder + "channels_of_force.csv") << "t [s]; a [kN]; b [kN]\n0; 0; 0\n0.5; 3; 1\n1; 2; 4\n";
  std::ofstream(folder + "moved.csv") << "t [s], d [mm]\n0, 0\n0.5, 3\n1, 2\n";
  std::ofstream(folder + "channels.csv") << "t [s]; ns [mm]; ew [mm]\n0; 0; 0\n0,5; 3; 1\n1; 2; 4\n";
  std::string knet =
      "Origin Time       2001/02/03 04:05:00\nLat.              40.0\nLong.             142.5\nDepth. (km)       "
      "30\nMag.              6.2\nStation Code      ABC001\nStation Lat.      41.5000\nStation Long.     "
      "140.9000\nStation Height(m) 39\nRecord Time       2001/02/03 04:05:43\nSampling Freq(Hz) 20Hz\nDuration Time(s) "
      " 1\nDir.              90 deg\nScale Factor      3920(gal)/6182761\nMax. Acc. (gal)   4.954\nLast Correction   "
      "2001/02/03 04:05:43\nMemo.             \n";
  for (int i = 0; i < 20; ++i) knet += fmt::format("{:8d}{}", 13190 + (i % 2 ? -7813 : 7813), i % 8 == 7 ? " \n" : " ");
  for (const char* name : {"knet.txt", "RSN6_IMPVALL.I_I-ELC180.AT2", "EW.AT2", "NS.AT2", "UP.AT2"})
    std::ofstream(folder + name) << knet << "\n";
}

}  // namespace pounding::test
