#pragma once
/// Names of all plausibility warnings.

#include <array>
#include <string_view>

namespace pounding {

/// Plausibility warnings that Model::accept suppresses:
/// - period: the first period of a structure on the ground is outside 0.02 s to 20 s
/// - gap: a gap above 2 m, or open by less than 0.05 mm
/// - face: a gap between frames with room for half their columns, which may be drawn at their axes
/// - joint: a contact on a column closer to a joint than the column depth
/// - mass: a floor of a structure on the ground, or a floor_mass, below 1 t
/// - section: a member deeper than the highest storey of its frame, or thinner than 2 mm
/// - E: Young's modulus below 100 MPa
/// - E0: a concrete of fibres whose initial modulus differs from that of EN 1992-1-1 by more than 25 %
/// - steel02: fibres with this law, to which no tolerance applies
/// - diaphragm: a rigid floor whose axial restraint raises the moment of beams of fibres by more than 5 %
/// - yield: a storey that yields at less than 0.01 mm of drift, or a hinge at less than 0.02 mrad
/// - rotation: an ultimate rotation of a hinge above 0.5 rad
/// - Lambda: an energy capacity Lambda of a deteriorating spring above 20, which may be lambda
/// - superseded: a hysteretic law that its authors have replaced
/// - pga: a peak acceleration or amplitude without unit that would be typical in g
/// - record: a record with a peak outside 0.005 g to 3 g, a step above 0.1 s, a displacement above 5 m, or times that
///   are sample numbers
/// - scale: a ground motion with a peak above 10 g
/// - density: a density outside 100 kg/m^3 to 15 t/m^3
/// - stiffness: a factor on the second moments of area of a section outside 0.02 to 2
/// - damping: a damping ratio outside 0.1 % to 40 %
/// - isolator: a capacity, radius or coefficient atypical of isolators, or isolators that start to move outside 0.2 %
///   to 100 % of the weight on them
/// - height: a storey outside 0.3 m to 50 m, or a bay outside 0.3 m to 300 m
/// - friction: a coefficient of friction above 2
/// - amplitude: a displacement of the ground above 5 m
/// - initial: an initial displacement above 2 m or an initial velocity above 10 m/s of a structure on the ground
/// - drift: a storey drift above a tenth of the storey height in a run
/// - motion: no motion in a run
/// - penetration: a contact penetration above 50 mm
/// - seat: a joint that opens beyond the seat of its link in a run
/// - tolerance: a tolerance above 1e-2
/// - duration: analysis.duration omits more than 5 % of the Arias intensity of a record
/// - hardening: the hardening of a hinge with a law, which version 0.2.0 interpreted as the ratio of the bare spring
inline constexpr auto warning_names = std::to_array<std::string_view>(
    {"period",   "gap",     "face",      "joint",   "mass",        "section",   "E",        "yield",
     "rotation", "pga",     "record",    "motion",  "penetration", "tolerance", "duration", "hardening",
     "scale",    "density", "stiffness", "damping", "isolator",    "height",    "friction", "amplitude",
     "initial",  "drift",   "seat",      "Lambda",  "superseded",  "E0",        "steel02",  "diaphragm"});

}  // namespace pounding
