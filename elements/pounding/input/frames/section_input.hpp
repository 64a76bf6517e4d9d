#pragma once
/// The materials and cross-sections of a frame's input, by name or in place.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// {E, G or poisson (0.2 unless given), density (0 unless given)}. Throws InputError at what is wrong.
Material read_material(const Input& node);

/// One of rectangle, i_section, tube, circle, or area and inertias; with shear: false without shear deformation and
/// with stiffness: 0.5 both inertias by this factor. In space inertia_z and torsion must be given. Throws InputError.
Section read_section(const Input& node, int dimension);

/// The materials and sections that `materials:`, `sections:` and `material:` of a frame name.
class SectionLibrary {
 public:
  SectionLibrary(const Input& frame, int dimension);

  /// The node holds a name or a map.
  Section section(const Input& node) const;
  Material material(const Input& node) const;
  /// The sections of the columns or the beams of a grid: one, a list from the ground up, or a map from storeys such as
  /// 1-3; the one of a storey may be a list by line.
  GridSections sections_of_grid(const Input& node, int storeys, int lines) const;
  /// The material of all members without one; `member` is the place of the error when there is none.
  Material default_material(const Input& member) const;

 private:
  std::vector<Section> of_storey(const Input& node, int lines) const;

  int dimension_;
  std::map<std::string, Section> sections_;
  std::map<std::string, Material> materials_;
  std::optional<Material> default_;
};

}  // namespace pounding
