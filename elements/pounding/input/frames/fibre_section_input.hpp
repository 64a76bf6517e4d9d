#pragma once
/// Sections of fibres in `sections:` of a frame.

#include <string>

#include <pounding/input/frames/fibre_material_input.hpp>

namespace pounding {

/// Defaults and names that a section of fibres takes from its frame.
struct FibreSectionContext {
  std::string name;  ///< of the section
  int dimension = 2;
  const FibreMaterials& laws;
  double density = 0;  ///< of the material of the frame [kg/m^3]
};

/// True for rc_rectangle, fibres, and shapes with a `material`.
bool has_fibres(const Input& section);

/// Reads a section of fibres whose shape is the key `shape`. Throws InputError with the location.
Section read_fibre_section(const Input& node, const std::string& shape, const FibreSectionContext& context);

}  // namespace pounding
