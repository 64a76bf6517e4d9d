#pragma once
/// The structures that an input can name, made from numbers. SI units.

#include <vector>

#include <pounding/model.hpp>

namespace pounding {

/// A free mass [kg].
Structure make_body(double mass);

/// One mass on a spring and a dashpot: k = m (2 pi/T)^2, c = 2 ratio sqrt(k m). Mass [kg], stiffness [N/m].
Structure make_oscillator(double mass, double stiffness, double damping_ratio);

/// Storeys on each other, masses and storey stiffnesses from the ground up [kg], [N/m]; no damping yet.
/// Heights [m] may be empty.
Structure make_shear_building(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                              const std::vector<double>& heights = {});

/// Rigid, moves with the ground.
Structure make_wall();

/// What the reader of models may find, one line each.
const Kinds& kinds();

}  // namespace pounding
