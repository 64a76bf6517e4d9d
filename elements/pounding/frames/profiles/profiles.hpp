#pragma once
/// Standard steel sections by name: IPE300, HEB400, UB 457x191x67, W14x90, HSS8x8x1/2, CHS 219.1x8. SI units.
///
/// European I-sections (IPE, HEA, HEB, HEM, HD, HP, UB, UC, UBP) follow from their dimensions, including the root
/// radii; American sections (W, M, S, HP, HSS, PIPE) have the published properties of the AISC Shapes Database. Square,
/// rectangular and circular hollow sections (SHS 200x8, RHS 300x200x10, CHS 219.1x8, in mm) of any size are hot
/// finished, with the outer radius 1.5 t and the inner radius t of EN 10210-2. The depth is along local z: bending
/// about local y is about the strong axis. Shear areas are those of sections.hpp, without root radii.

#include <optional>
#include <string>
#include <string_view>

#include <pounding/frames/beam.hpp>
#include <pounding/sections/fibre.hpp>

namespace pounding {

/// Section with this name, regardless of case, blanks and separators; `nullopt` if there is none. Throws
/// std::invalid_argument for dimensions of a hollow section that are not possible.
std::optional<Section> find_profile(std::string_view name);

/// Fibres of a standard section: `layers` along the depth, and `across` as in sections/builders.hpp. Root radii and
/// round corners of boxes are fibres at their centroids, with the rest of the area of the section. `nullopt` and
/// exceptions as of find_profile().
std::optional<sections::Fibres> profile_fibres(std::string_view name, int layers, int across);

/// Suggestion for a name that does not exist: the nearest sizes of its family, or the families.
std::string nearest_profiles(std::string_view name);

/// Doubly symmetric I-section with root radii between web and flanges [m]. Torsion constant by the formula of European
/// tables; British tables use another one for the junctions, with values lower by about 1 %.
Section rolled_i_section(double depth, double width, double flange, double web, double radius);

/// Hot-finished rectangular hollow section [m].
Section hollow_section(double depth, double width, double thickness);

/// Yield strength and elastic constants of a steel grade: S235, S275, S355, S420, S460 (EN 1993-1-1, 40 mm at most),
/// A36 and A992 (ASTM); `nullopt` for another name.
std::optional<Material> find_steel(std::string_view grade);

}  // namespace pounding
