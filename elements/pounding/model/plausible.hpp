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
/// face         a gap between frames that has room for half their columns: they may be drawn by axes
/// joint        a column that is hit closer to a joint than it is deep
/// mass         a floor of a structure on the ground under 1 t
/// section      a member deeper than the highest storey of its frame
/// E            Young's modulus under 1 MPa
/// yield        a storey that yields at less than 0.01 mm of drift, or a hinge at less than 0.02 mrad
/// rotation     an ultimate rotation of a hinge above 0.5 rad
/// pga          a peak acceleration without its unit that would be a usual one in g
/// motion       nothing moved in a run
/// penetration  a contact was pressed by more than 50 mm
/// tolerance    a tolerance above 1e-2
inline constexpr std::array<std::string_view, 13> doubt_names{"period", "gap", "mass", "section", "E", "yield", "rotation", "pga",
                                                                "motion", "penetration", "tolerance", "face", "joint"};

/// Warnings about a model, one line each; none of those that it accepts.
std::vector<std::string> implausible(const Model& model);

/// Warnings about a run of it: whether anything moved, and the peak penetrations of its links [m].
std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations);

}  // namespace pounding
