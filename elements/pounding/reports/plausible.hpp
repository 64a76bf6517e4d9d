#pragma once
/// Warnings of what a model can say and seldom means: numbers far from those of buildings, mostly by a unit that is
/// missing.

#include <span>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Warnings about a model, one line each; none of those that it accepts. `tolerance`: of the run, if it is not the
/// model's.
std::vector<std::string> implausible(const Model& model, double tolerance);
std::vector<std::string> implausible(const Model& model);

/// Warnings about a run of it: whether anything moved, and the peak penetrations of its links [m].
std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations);

/// Warnings about the largest drifts of the storeys [structure][storey] in a run [m]. Storeys without heights, and of
/// members that may turn by large angles, are left out.
std::vector<std::string> implausible_drifts(const Model& model, std::span<const std::vector<double>> drifts);

}  // namespace pounding
