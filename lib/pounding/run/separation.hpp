#pragma once
/// Required gap between structures, from a run without links.

#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// Correlation of the displacements of two oscillators with these periods [s] and damping ratios [-] under the same
/// white noise,
///
///     rho = 8 sqrt(za zb) (zb + za r) r^(3/2) / ((1 - r^2)^2 + 4 za zb r (1 + r^2) + 4 (za^2 + zb^2) r^2),
///     r = period_b / period_a,
///
/// for the double-difference combination, which estimates their maximum relative displacement, sqrt(ua^2 + ub^2 - 2 rho
/// ua ub): V. Jeng, K. Kasai, B. F. Maison, A spectral difference method to estimate building separations to avoid
/// pounding, Earthquake Spectra 8 (1992) 201-223. Periods and ratios must be positive; otherwise NaN.
double double_difference(double period_a, double damping_a, double period_b, double damping_b);

/// Required gaps of all links of a model; `approach` is Results::approach of its run without links. Periods and damping
/// ratios are those of the first modes.
std::vector<LinkSeparation> separations(const Model& model, const Extremes& approach);

}  // namespace pounding
