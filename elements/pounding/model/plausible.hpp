#pragma once
/// Warnings of what a model can say and seldom means: numbers far from those of buildings, mostly by a unit that is missing.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// The doubts by name, as Model::accept takes them:
/// period       the first period of a structure on the ground lies outside 0.02 s to 20 s
/// gap          a gap above 2 m
/// mass         a floor of a structure on the ground under 1 t
/// section      a member deeper than the highest storey of its frame
/// E            Young's modulus under 1 MPa
/// yield        a storey that yields at less than 0.01 mm of drift, or a hinge at less than 0.02 mrad
/// rotation     an ultimate rotation of a hinge above 0.5 rad
/// pga          a peak acceleration without its unit that would be a usual one in g
/// record       a record with a peak outside 0.005 g to 3 g, a step above 0.1 s, a displacement above 5 m, or times that count its samples
/// motion       nothing moved in a run
/// penetration  a contact was pressed by more than 50 mm
/// tolerance    a tolerance above 1e-2
/// duration     analysis.duration cuts more than 5 % of the Arias intensity of a record
/// hardening    the hardening of a hinge with a law, which version 0.2.0 took as the ratio of the bare spring
inline constexpr std::array<std::string_view, 14> doubt_names{
    "period", "gap", "mass", "section", "E", "yield", "rotation", "pga", "record", "motion", "penetration", "tolerance", "duration", "hardening"};

/// Warnings about a model, one line each; none of those that it accepts.
std::vector<std::string> implausible(const Model& model);

/// Warnings about a run of it: whether anything moved, and the peak penetrations of its links [m].
std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations);

}  // namespace pounding
