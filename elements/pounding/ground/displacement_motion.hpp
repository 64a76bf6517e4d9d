#pragma once
/// Ground motions given as displacements.

#include <string>
#include <vector>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Ground displacement d = D sin(2 pi (t - start)/T + phase) during the harmonic; its `amplitude` is D [m]. The ground
/// has the velocity 2 pi D/T cos(phase) at `start`, and keeps its final velocity. Throws std::invalid_argument like
/// GroundMotion(Harmonic), and for a nonzero start.
GroundMotion motion_of_displacement(const Harmonic& displacement);

/// Sum of such displacements; the amplitudes of the parts are in metres.
GroundMotion motion_of_displacement(const HarmonicSum& displacement);

/// Clamped cubic spline through displacements [m] at increasing times [s]: the acceleration is piecewise linear, the
/// initial velocity is `initial_velocity` [m/s], and the final acceleration is zero. The velocity is constant before
/// the first and after the last time. Throws std::invalid_argument like GroundMotion(Samples).
GroundMotion motion_of_displacement(const std::vector<double>& times, const std::vector<double>& displacements,
                                    double initial_velocity = 0, std::string source = {});

/// Accelerations [m/s^2] of that spline at its times. Throws std::invalid_argument for fewer than two samples and for
/// times that do not increase. Source: de Boor, A Practical Guide to Splines (1978), chapter 4.
std::vector<double> spline_accelerations(const std::vector<double>& times, const std::vector<double>& displacements,
                                         double initial_velocity);

}  // namespace pounding
