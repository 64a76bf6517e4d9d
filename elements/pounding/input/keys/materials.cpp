#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>
#include <pounding/materials/all.hpp>

namespace pounding::keys {
namespace {

constexpr Key elastic_keys[] = {
    {"E", quantity(dimension::stress, bounds::positive), exactly_one, "Young's modulus of an elastic material.",
     "30 GPa"},
    {"G", quantity(dimension::stress, bounds::positive), otherwise("E/(2 (1 + poisson))"),
     "Shear modulus. Give G or poisson, not both.", "12.5 GPa"},
    {"poisson", number(0, 0.5), otherwise("0.2"), "Poisson's ratio. Give G or poisson, not both.", "0.2"},
    {"density", quantity(dimension::density, bounds::non_negative), otherwise("0 kg/m^3"),
     "Density, from which the mass of members follows.", "2500 kg/m^3"},
    {"strength", quantity(dimension::stress, bounds::positive), otherwise("none"),
     "Yield strength of steel, for hinges with strength: material.", "355 MPa", "0.3.0"},
};

constexpr Key confined_keys[] = {
    {"of", text(), required, "Unconfined concrete: a name from materials, with the law concrete01, 02 or 04.", "cover",
     "0.3.0"},
    {"width", quantity(dimension::length, bounds::positive), required,
     "Width of the core between the centre lines of the perimeter hoop.", "330 mm", "0.3.0"},
    {"depth", quantity(dimension::length, bounds::positive), required,
     "Depth of the core between the centre lines of the perimeter hoop.", "330 mm", "0.3.0"},
    {"bars", text(), required, "Number and diameter [mm] of all longitudinal bars.", "10 d20", "0.3.0"},
    {"hoops", quantity(dimension::length, bounds::positive), required, "Diameter of the hoops and cross ties.", "10 mm",
     "0.3.0"},
    {"spacing", quantity(dimension::length, bounds::positive), required,
     "Spacing of the hoops along the member, centre to centre.", "100 mm", "0.3.0"},
    {"fyh", quantity(dimension::stress, bounds::positive), required, "Yield stress of the hoops.", "420 MPa", "0.3.0"},
    {"legs", integer(2, 100).list(2), otherwise("[2, 2]"),
     "Number of hoop legs and cross ties parallel to the width and to the depth. Each holds one bar at both ends.",
     "[2, 4]", "0.3.0"},
    {"esu", number(bounds::positive), otherwise("0.1"), "Strain of the hoops at their tensile strength.", "0.1",
     "0.3.0"},
};

/// Keys of elastic materials and of the laws of fibres.
struct OfMaterials : YieldingKeys {
  std::vector<Key> own{std::begin(elastic_keys), std::end(elastic_keys)};

  template <materials::Material M>
  void add(const M& made) {
    std::vector<Key>& of_law = more_keys();
    Example example;
    for (const auto& parameter : M::parameters) {
      Key& spec = of_law.emplace_back(key_of(parameter, made));
      spec.since = "0.3.0";
      if (parameter.info.unit == "Pa") spec.example = kept(format_quantity(parameter.info.typical, dimension::stress));
      if (spec.need == Need::required) example.add(spec);
    }
    const Section& section = add_section({kept(fmt::format("material_{}", M::name)),
                                          kept(fmt::format("structures.NAME.frame.materials.NAME.{}", M::name)),
                                          kept(fmt::format("{}: {}.", capital(M::summary), M::shape)), of_law});
    own.push_back({M::name, map(section), exactly_one,
                   kept(fmt::format("Law of fibres, in materials only: {}.", M::summary)), kept(example.text()),
                   "0.3.0"});
  }
};

const OfMaterials& laws_of_fibres() {
  static const OfMaterials all = [] {
    OfMaterials made;
    EachLaw<materials::NamedMaterial>::visit([&made](const auto& law) { made.add(law); });
    made.own.push_back(
        {"confined", map(confined), exactly_one,
         "Concrete in the core within hoops, in materials only: strength, strains and crushing strength by Mander, "
         "Priestley & Park (1988), with the law of the unconfined concrete. `pounding check` prints the values.",
         "{of: cover, width: 330 mm, depth: 330 mm, bars: 10 d20, hoops: 10 mm, spacing: 100 mm, fyh: 420 MPa}",
         "0.3.0"});
    return made;
  }();
  return all;
}

}  // namespace

const Section material{"materials", "structures.NAME.frame.materials.NAME",
                       "Linear elastic material, or the law of fibres. The keys of elastic materials also apply to "
                       "frame.material and to the material of a member.",
                       laws_of_fibres().own};
constinit const Section confined{"confined", "structures.NAME.frame.materials.NAME.confined",
                                 "Concrete in the core within hoops.", confined_keys};

std::vector<const Section*> laws_of_materials() { return laws_of_fibres().sections(); }

}  // namespace pounding::keys
