#pragma once
/// Limits on sizes, all of them in this place. Each lies far above a model of buildings and below one that would take
/// the memory or the days of a machine before it fails; a model beyond one is refused before anything is allocated.

#include <string>

namespace pounding::limits {

/// Samples of a synthetic motion, which take some 0.5 GB while it is made.
inline constexpr double samples = 1e7;
/// Nodes of the grid of a frame.
inline constexpr double grid_nodes = 2e5;
/// Memory that a square grid in the plane takes for each of its unknowns until its first modes are known, measured
/// [bytes].
inline constexpr double bytes_of_unknown = 8e3;
/// Links of a model.
inline constexpr double links = 1e5;
/// Output times of a run.
inline constexpr double outputs = 1e7;
/// Steps of a run unless analysis: {most_steps: ...} says otherwise, and the largest number that it may say: PETSc
/// counts steps in 32 bits.
inline constexpr long usual_steps = 100'000'000, max_steps = 2'000'000'000;
/// Steps that integrate the oscillators of all periods of a response spectrum: some minutes.
inline constexpr double spectrum_steps = 2e10;

/// Memory that this process may have: that of the machine, or less where `ulimit -v` says so [bytes].
double memory();

/// "3.2 GB"
std::string text_of_bytes(double bytes);

}  // namespace pounding::limits
