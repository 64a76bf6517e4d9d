#pragma once
/// Cross-sections of fibres in a frame. SI units.

#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/beam.hpp>
#include <pounding/materials/mander.hpp>
#include <pounding/sections/fibre_section.hpp>

namespace pounding {

/// A uniaxial material by name.
struct FibreMaterial {
  std::string name;
  materials::AnyMaterial law;
  double concrete_strength = 0;                         ///< without confinement, > 0 [Pa]; 0 for other materials
  std::optional<materials::Confinement> confinement{};  ///< from which the parameters follow
};

/// Strength of an unconfined concrete by its law, > 0 [Pa]; 0 for other materials.
double concrete_strength(const materials::AnyMaterial& law);

/// Initial modulus of a material [Pa].
double initial_modulus(const materials::AnyMaterial& law);

/// Secant modulus of concrete of a strength [Pa]: 22 GPa (f/10 MPa)^0.3, EN 1992-1-1, table 3.1, with the mean
/// strength.
double code_modulus(double strength);

/// Fibres of a section.
struct SectionFibres {
  std::string name;
  std::vector<FibreMaterial> materials;  ///< in the order of the indices of fibres
  sections::FibreSection section;
  /// Elastic material with the initial stiffness of the fibres. It replaces the material of the member.
  Material material;
};

/// Properties of a section of fibres that do not follow from the fibres.
struct FibreSectionOptions {
  std::string name;
  double density = 0;                         ///< [kg/m^3]
  std::optional<double> torsion_stiffness{};  ///< G J [N m^2]; by default that of the shape
};

/// A section with fibres. Area, dimensions, shear areas and plastic moduli are those of `shape`. Modulus and second
/// moments follow from the initial stiffness of the fibres: E = EA/area, and EI about the elastic centroid; in layers
/// at y = 0 about z with the second moment of the shape. G = E/2.4. Throws std::invalid_argument like FibreSection.
Section section_of_fibres(Section shape, std::vector<FibreMaterial> materials, const sections::Fibres& fibres,
                          const FibreSectionOptions& options);

}  // namespace pounding
