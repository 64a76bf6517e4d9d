#include <pounding/input/keys/studies.hpp>

// Keys of study.separation: inputs of the rules of codes.
namespace pounding::keys::study_tables {

constexpr std::string_view properties[] = {"same", "line"};
constexpr std::string_view displacements[] = {"nonlinear", "elastic", "reduced"};
constexpr std::string_view floors[] = {"aligned", "offset"};
constexpr Key separation_keys[] = {
    {"codes", text().or_list(), otherwise("all codes"),
     "Codes whose rules are applied; the start of a name is sufficient.", "[EN 1998-1, TBDY 2018]", since},
    {"property", choice(properties, "property"), otherwise("same"),
     "same: both structures on one property, whose displacements are combined. line: a property line between them, "
     "from "
     "which each is set back.",
     "line", since},
    {"displacements", choice(displacements, "kind of displacements"), otherwise("nonlinear"),
     "Displacements that the model computes. Those of nonlinear and of elastic structures under unreduced motions are "
     "not "
     "multiplied by a behaviour factor; reduced ones, from motions divided by it, are.",
     "reduced", since},
    {"floors", choice(floors, "position of floors"), otherwise("from the elevations of the floors"),
     "Position of the floors of neighbours, if the model has no elevations.", "aligned", since},
    {"similar", boolean(), otherwise("false"),
     "Neighbours of similar structure and height, for which some codes reduce the gap if the floors are aligned.",
     "true", since},
    {"behaviour", map(behaviour), otherwise("none"), "Factors of the codes for all structures.",
     "{q: 3, importance: 1}", since},
    {"structures", map(behaviour).named(), otherwise("none"), "Factors of single structures, by name.",
     "{left: {R: 8}, right: {R: 5}}", since},
};

constexpr std::string_view zones[] = {"I", "II", "III"};
constexpr std::string_view systems[] = {"frame", "frame_wall", "wall"};
constexpr Key factor_key(std::string_view key, std::string_view meaning, std::string_view example) {
  return Key(key, number(bounds::positive), optional, meaning, example, since);
}
constexpr Key behaviour_keys[] = {
    factor_key("q", "Behaviour factor of displacements q_d: EN 1998-1.", "3"),
    factor_key("R", "Response reduction factor: TBDY 2018, IS 1893-1, NSR-10.", "8"),
    factor_key("Cd", "Deflection amplification factor: ASCE 7, Iranian Standard 2800.", "5.5"),
    factor_key("Rd", "Ductility-related force modification factor: NBCC.", "4"),
    factor_key("Ro", "Overstrength-related force modification factor: NBCC.", "1.7"),
    factor_key("Q", "Seismic behaviour factor: NTC-Sismo.", "2"),
    factor_key("mu", "Structural ductility factor: NZS 1170.5.", "4"),
    factor_key("mu_d", "Displacement ductility: NTC 2018.", "3"),
    factor_key("drift_modification", "Drift modification factor: NZS 1170.5.", "1.2"),
    factor_key("amplification", "Ratio of inelastic to reduced displacements: E.030.", "6"),
    factor_key("importance", "Importance factor: ASCE 7, TBDY 2018, NBCC.", "1"),
    factor_key("Z", "Zone factor, in g: E.030.", "0.45"),
    factor_key("S", "Soil factor: E.030, NTC 2018.", "1.05"),
    {"ag", quantity(dimension::acceleration, bounds::positive), optional, "Peak ground acceleration on rock: NTC 2018.",
     "0.25 g", since},
    {"intensity", integer(6, 9), optional, "Intensity of design: GB 50011.", "8", since},
    {"zone", choice(zones, "zone"), optional, "Zone of the city: NTC-Sismo.", "III", since},
    {"system", choice(systems, "structural system"), optional, "Structural system: GB 50011.", "frame", since},
    {"steel", boolean(), otherwise("false"), "Steel structure: GB 50011.", "true", since},
};

constinit const Section separation{"separation", "study.separation", "Gaps by the rules of codes: pounding separation.",
                                   separation_keys};
constinit const Section behaviour{"behaviour", "study.separation.behaviour", "Factors of codes.", behaviour_keys};

}  // namespace pounding::keys::study_tables
