#pragma once
/// Limits on sizes. Each is far above any building model and below one that would exhaust the memory or take days; a
/// larger model is rejected before anything is allocated.

#include <string>

namespace pounding::limits {

/// Samples of a synthetic motion; generating it takes about 0.5 GB.
inline constexpr double samples = 1e7;
/// Nodes of the grid of a frame.
inline constexpr double grid_nodes = 2e5;
/// Memory per unknown of a square plane grid until its first modes are known, measured [bytes].
inline constexpr double bytes_of_unknown = 8e3;
/// Links of a model.
inline constexpr double links = 1e5;
/// Output times of a run.
inline constexpr double outputs = 1e7;
/// Steps that integrate the oscillators of all periods of a response spectrum: a few minutes.
inline constexpr double spectrum_steps = 2e10;

/// Memory available to this process: that of the machine, or the limit of `ulimit -v` [bytes].
double memory();

/// "3.2 GB"
std::string text_of_bytes(double bytes);

}  // namespace pounding::limits
