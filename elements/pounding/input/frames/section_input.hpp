#pragma once
/// Materials and cross-sections of a frame, by name or as a map.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/input/frames/fibre_material_input.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// Elastic section of one of profile, rectangle, i_section, tube and circle. Throws InputError with the location.
Section read_shape(const Input& node, std::string_view shape);

/// Materials and sections in `materials:`, `sections:` and `material:` of a frame. All functions throw InputError.
class SectionLibrary {
 public:
  SectionLibrary(const Input& frame, int dimension);

  /// `node` is a map or a name: of the input, of a standard section, or of a steel grade.
  Section section(const Input& node) const;
  Material material(const Input& node) const;
  /// Sections of the columns or beams of a grid: one, a list from the ground up, or a map from storeys such as 1-3. The
  /// entry of a storey may be a list by line.
  GridSections sections_of_grid(const Input& node, int storeys, int lines) const;
  /// Default material of members; `member` is the location of the error if there is none.
  Material default_material(const Input& member) const;
  /// The sections of `sections:` by name.
  const std::map<std::string, Section>& sections() const { return sections_; }

 private:
  /// Reads one of profile, rectangle, i_section, tube, circle, rc_rectangle, fibres, or area and second moments of
  /// area. shear: false neglects shear deformation; stiffness is a factor on both second moments.
  Section read(const Input& node, const std::string& name) const;

  int dimension_;
  std::map<std::string, Section> sections_;
  std::map<std::string, Material> materials_;
  FibreMaterials fibre_materials_;
  std::optional<Material> default_;
};

/// A section of fibres in `sections:` of a structure.
struct NamedSection {
  std::string structure;
  Section section;

  std::string name() const;  ///< "old.column"
};

/// The sections of fibres of all frames of a file, without the rest of the model. Throws InputError, also if there are
/// none.
std::vector<NamedSection> read_fibre_sections(const Input& file);

}  // namespace pounding
