#pragma once
/// Texts about sections of fibres.

#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Area, uncracked stiffness and materials of the sections of fibres of a structure, several lines; empty without.
std::string describe_fibres(const Structure& s);

/// Warnings about moduli of concrete, steel02 and rigid floors over beams that yield along their length.
std::vector<Warning> warnings_about_fibres(const Structure& s);

}  // namespace pounding
