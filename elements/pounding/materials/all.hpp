#pragma once
/// Registry of materials, read by parser, reports, documentation and contract test. To add a material, write its
/// header, and add its include and its type here.

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <pounding/hysteresis/by_name.hpp>
#include <pounding/materials/concrete01.hpp>
#include <pounding/materials/concrete02.hpp>
#include <pounding/materials/concrete04.hpp>
#include <pounding/materials/elastic.hpp>
#include <pounding/materials/elastic_no_tension.hpp>
#include <pounding/materials/menegotto_pinto.hpp>
#include <pounding/materials/modified.hpp>
#include <pounding/materials/steel01.hpp>
#include <pounding/materials/steel02.hpp>

namespace pounding::materials {

/// The materials of this library by name.
using NamedMaterial =
    std::variant<Elastic, ElasticNoTension, Concrete01, Concrete02, Concrete04, Steel01, MenegottoPinto, Steel02>;

/// The materials of a variant, and those that are modified.
template <class Named>
struct WithModified;
template <class... M>
struct WithModified<std::variant<M...>> {
  using type = std::variant<M..., Modified<std::variant<M...>>>;
};

/// Any material of fibres.
using AnyMaterial = WithModified<NamedMaterial>::type;

/// Settings of a material in an input. SI units.
using Settings = hysteresis::Settings;

/// Catalogue entry of a material, read from the tables of its struct.
struct Entry : hysteresis::Entry {
  bool forgets_small_reversals = true;  ///< false if no error tolerance applies

  /// Entry of a material, from its members.
  template <Material M>
  static constexpr Entry of() {
    return {hysteresis::Entry::of<M>(), M::forgets_small_reversals};
  }
};

/// Message about an unknown material.
inline std::string unknown_law(std::string_view name, std::span<const Entry> catalogue) {
  return "unknown material law \"" + excerpt(name) + "\"." + suggestion(name, laws::names(catalogue));
}

/// The catalogue of all materials.
using Materials = laws::Catalogue<Settings, Entry, NamedMaterial>;

/// Entries of all named materials, in the order of NamedMaterial.
inline std::span<const Entry> catalogue() noexcept { return Materials::entries; }

/// Entry of a material by name. Throws std::invalid_argument, with the nearest known name, if there is none.
inline const Entry& find_material(std::string_view name) { return Materials::find(name); }

/// Creates a validated material. Throws std::invalid_argument for an unknown material or parameter (with the nearest
/// known name), a missing parameter and an invalid value.
inline AnyMaterial make_material(const Settings& settings) {
  return std::visit([](const auto& law) -> AnyMaterial { return law; }, Materials::make(settings));
}

}  // namespace pounding::materials
