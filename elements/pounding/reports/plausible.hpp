#pragma once
/// Plausibility warnings: valid numbers that are atypical of buildings, usually because of a missing unit.

#include <span>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Warnings about a model, one line each, except those that it accepts. `tolerance`: that of the run, if different from
/// the model's.
std::vector<std::string> implausible(const Model& model, double tolerance);
std::vector<std::string> implausible(const Model& model);

/// Warnings about a run: no motion, and the peak penetrations of its links [m].
std::vector<std::string> implausible(const Model& model, bool moved, std::span<const double> penetrations);

/// Warnings about the maximum storey drifts [structure][storey] in a run [m]. Storeys without heights, and with members
/// in large rotations, are skipped.
std::vector<std::string> implausible_drifts(const Model& model, std::span<const std::vector<double>> drifts);

}  // namespace pounding
