#pragma once
/// Ground motions that are given as displacements.

#include <string>
#include <vector>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// The ground moves as d = D sin(2 pi (t - start)/T + phase) while the harmonic lasts; its `amplitude` is D [m]. At
/// `start` the ground has the velocity 2 pi D/T cos(phase) already, and it keeps the one that it has at the end. Throws
/// std::invalid_argument as GroundMotion(Harmonic), and for a start other than 0.
GroundMotion motion_of_displacement(const Harmonic& displacement);

/// The sum of such displacements; the parts' amplitudes are in metres.
GroundMotion motion_of_displacement(const HarmonicSum& displacement);

/// Displacements [m] at increasing times [s], a clamped cubic spline between them: the acceleration is straight between
/// the times, the velocity begins with `initial_velocity` [m/s], and the acceleration ends with zero. Before the first
/// time the ground has that velocity; after the last one it keeps the one it has. Throws std::invalid_argument as
/// GroundMotion(Samples).
GroundMotion motion_of_displacement(const std::vector<double>& times, const std::vector<double>& displacements,
                                    double initial_velocity = 0, std::string source = {});

/// Accelerations [m/s^2] of that spline at its times. Throws std::invalid_argument for fewer than two samples or times
/// that do not increase. Source: de Boor, A Practical Guide to Splines (1978), chapter 4.
std::vector<double> spline_accelerations(const std::vector<double>& times, const std::vector<double>& displacements,
                                         double initial_velocity);

}  // namespace pounding
