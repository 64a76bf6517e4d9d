#pragma once
/// Laws of fibres in `materials:` of a frame.

#include <map>
#include <string>

#include <pounding/frames/section_fibres.hpp>
#include <pounding/input/input.hpp>
#include <pounding/sections/builders.hpp>

namespace pounding {

/// Laws of fibres by name.
using FibreMaterials = std::map<std::string, FibreMaterial>;

/// Reads a number and a diameter in mm: "4 d20". Throws InputError.
sections::Bars read_bars(const Input& node);

/// The law that this text names. Throws InputError, with the nearest name.
const FibreMaterial& find_law(const Input& node, const FibreMaterials& known);

/// Reads a law, or `confined` with an unconfined concrete among `known`. Throws InputError at the wrong parameter.
FibreMaterial read_fibre_material(const std::string& name, const Input& node, const FibreMaterials& known);

}  // namespace pounding
