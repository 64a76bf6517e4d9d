#include <pounding/frames/section_fibres.hpp>

#include <cmath>
#include <memory>
#include <utility>
#include <variant>

namespace pounding {

double concrete_strength(const materials::AnyMaterial& law) {
  return std::visit(
      [](const auto& of) -> double {
        if constexpr (requires { of.fpc; }) return -of.fpc;
        if constexpr (requires { of.fc; }) return -of.fc;
        return 0;
      },
      law);
}

double initial_modulus(const materials::AnyMaterial& law) {
  return std::visit([](const auto& of) { return of.stiffness(); }, law);
}

double code_modulus(double strength) { return 22e9 * std::pow(strength / 10e6, 0.3); }

Section section_of_fibres(Section shape, std::vector<FibreMaterial> materials, const sections::Fibres& fibres,
                          const FibreSectionOptions& options) {
  double ea = 0, ey = 0, ez = 0, eyy = 0, ezz = 0;  // moments of the modulus over the area
  for (const sections::Fibre& fibre : fibres) {
    const double rigidity = initial_modulus(materials.at(fibre.material).law) * fibre.area;
    ea += rigidity;
    ey += rigidity * fibre.y;
    ez += rigidity * fibre.z;
    eyy += rigidity * fibre.y * fibre.y;
    ezz += rigidity * fibre.z * fibre.z;
  }
  const double young = ea / shape.area, shear = young / 2.4;
  shape.inertia_y = (ezz - ez * ez / ea) / young;
  if (const double about_z = (eyy - ey * ey / ea) / young; about_z > 0) shape.inertia_z = about_z;
  if (options.torsion_stiffness) shape.torsion = *options.torsion_stiffness / shear;
  std::vector<materials::AnyMaterial> laws;
  for (const FibreMaterial& each : materials) laws.push_back(each.law);
  shape.fibres = std::make_shared<const SectionFibres>(
      SectionFibres{.name = options.name,
                    .materials = std::move(materials),
                    .section = sections::FibreSection(std::move(laws), fibres),
                    .material = {.young = young, .shear = shear, .density = options.density}});
  return shape;
}

}  // namespace pounding
