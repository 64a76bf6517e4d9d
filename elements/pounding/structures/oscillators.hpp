#pragma once
/// The structures that an input can name, made from numbers. SI units.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// A free mass [kg].
Structure make_body(double mass);

/// One mass on a spring and a dashpot: k = m (2 pi/T)^2, c = 2 ratio sqrt(k m). Mass [kg], stiffness [N/m].
Structure make_oscillator(double mass, double stiffness, double damping_ratio);

/// Storeys on each other, masses and storey stiffnesses from the ground up [kg], [N/m]; no damping yet.
/// Heights [m] may be empty.
Structure make_shear_building(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                              const std::vector<double>& heights = {});

/// Lets every storey of a structure yield bilinearly at the force given for it, from the ground up [N]; its stiffness after
/// that is `hardening` in [0, 1) times the initial one. The damping stays that of the initial stiffness.
/// Throws std::invalid_argument when a number is out of range or the storeys are counted wrong.
void let_storeys_yield(Structure& structure, const std::vector<double>& yield_forces, const std::vector<double>& hardening);

/// Rigid, moves with the ground.
Structure make_wall();

/// What the reader of models may find, one line each.
const Kinds& kinds();

}  // namespace pounding
