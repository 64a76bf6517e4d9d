#pragma once
/// Keys of the input. The reader uses these tables; `pounding words`, the reference page and the JSON schema are
/// generated from them, so that all four contain the same keys.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <pounding/core/units.hpp>
#include <pounding/input/bounds.hpp>

namespace pounding::keys {

/// Kind of a single value.
enum class Takes : unsigned char {
  nothing,   ///< no single value, only a map or a list
  quantity,  ///< a number in SI units or with a unit; a ratio has no unit, and "5 %" is 0.05
  integer,
  boolean,  ///< true or false
  choice,   ///< one of the choices
  text,     ///< any text, such as a title, a name or a file
  value     ///< a number, a quantity of any dimension or a name
};

/// Arrangement of the values under a key.
enum class Form : unsigned char {
  one,          ///< one value
  one_or_each,  ///< one value for all, or a list with one value per item
  one_or_list,  ///< one value, or a list
  list,         ///< a list of values
  lists,        ///< a list of lists
  named,        ///< a map from user-defined names to values
  named_lists,  ///< a map from user-defined names to lists
  by_storey  ///< one value, a list from the ground up, or a map from storeys ("4", "1-3"); items may be lists by line
};

/// Whether a key is required in its section.
enum class Need : unsigned char {
  optional,
  required,
  exactly_one,  ///< exactly one of the keys with this value is given
  at_least_one  ///< at least one of the keys with this value is given
};

struct Section;

/// Type of the value of a key. The functions below create single values and maps; the member functions combine and
/// arrange them: `quantity(dimension::length).or_each()`, `text().or_map(material)`.
struct Value {
  Takes takes = Takes::nothing;
  Form form = Form::one;
  int minimum = 0, maximum = 0;        ///< number of members of a list; a maximum of 0 means any number
  const Section* inside = nullptr;     ///< keys of a map, which replaces the single value or is an alternative to it
  Dimension dimension{};               ///< of a quantity
  std::optional<Dimension> turning{};  ///< dimension of the quantity if it belongs to a rotation
  std::string_view unit{};             ///< SI unit if the dimension does not determine it: "rad/s", "N/m^n"
  Bounds bounds{};                     ///< of a quantity in SI, of an integer
  std::span<const std::string_view> choices{};
  std::span<const std::string_view> instead{};  ///< texts that replace the whole value: `nodes: all`
  std::string_view
      noun{};  ///< noun for the choices if it is not the key, or for a quantity if its dimension is ambiguous

  /// Also allows a map with the keys of this section.
  constexpr Value or_map(const Section& keys) const {
    return with([&](Value& v) { v.inside = &keys; });
  }
  constexpr Value or_one_of(std::span<const std::string_view> texts) const {
    return with([&](Value& v) { v.instead = texts; });
  }
  /// Sets the dimension that applies to rotations.
  constexpr Value or_rotation(const Dimension& of_rotation) const {
    return with([&](Value& v) { v.turning = of_rotation; });
  }
  constexpr Value in(std::string_view si_unit) const {
    return with([&](Value& v) { v.unit = si_unit; });
  }
  constexpr Value called(std::string_view name) const {
    return with([&](Value& v) { v.noun = name; });
  }

  /// Arrangements of the value, see Form; `members`, `from` and `to` are the permitted lengths of a list.
  constexpr Value or_each() const { return as(Form::one_or_each); }
  constexpr Value or_list() const { return as(Form::one_or_list); }
  constexpr Value or_list(int members) const { return as(Form::one_or_list, members, members); }
  constexpr Value list() const { return as(Form::list); }
  constexpr Value list(int members) const { return as(Form::list, members, members); }
  constexpr Value list(int from, int to) const { return as(Form::list, from, to); }
  constexpr Value lists(int from, int to) const { return as(Form::lists, from, to); }
  constexpr Value nonempty_list() const { return as(Form::list, 1); }
  constexpr Value named() const { return as(Form::named); }
  constexpr Value named_lists(int from, int to) const { return as(Form::named_lists, from, to); }
  constexpr Value by_storey() const { return as(Form::by_storey); }

 private:
  template <class Change>
  constexpr Value with(const Change& change) const {
    Value changed = *this;
    change(changed);
    return changed;
  }
  constexpr Value as(Form arrangement, int from = 0, int to = 0) const {
    return with([&](Value& v) { v.form = arrangement, v.minimum = from, v.maximum = to; });
  }
};

/// Kinds of values, see Takes.
constexpr Value quantity(const Dimension& dimension, const Bounds& bounds = {}) {
  return {.takes = Takes::quantity, .dimension = dimension, .bounds = bounds};
}
/// A quantity without a dimension: a ratio, an angle.
constexpr Value number(const Bounds& bounds = {}) { return quantity({}, bounds); }
constexpr Value number(double low, double high) { return number({.low = low, .high = high}); }
constexpr Value integer(const Bounds& bounds = {}) { return {.takes = Takes::integer, .bounds = bounds}; }
constexpr Value integer(double low, double high) { return integer({.low = low, .high = high}); }
constexpr Value boolean() { return {.takes = Takes::boolean}; }
/// `noun` describes the choices if the key does not.
constexpr Value choice(std::span<const std::string_view> choices, std::string_view noun = {}) {
  return {.takes = Takes::choice, .choices = choices, .noun = noun};
}
constexpr Value text() { return {.takes = Takes::text}; }
constexpr Value any_value() { return {.takes = Takes::value}; }
/// A map with the keys of this section.
constexpr Value map(const Section& keys) { return {.inside = &keys}; }

using enum Need;

/// Whether a key is required, and its default.
struct Presence {
  Need need;
  std::string_view otherwise{};
  constexpr Presence(Need necessity) : need(necessity) {}
  constexpr Presence(Need necessity, std::string_view value) : need(necessity), otherwise(value) {}
};
/// Optional, with this default.
constexpr Presence otherwise(std::string_view value) { return {Need::optional, value}; }

/// A key: type, meaning and default.
struct Key : Value {
  std::string_view key{};
  Need need = Need::optional;
  std::string_view otherwise{};  ///< default as typed, or a description of it; empty if none
  std::string_view meaning{};    ///< complete sentences, with sign and order
  std::string_view example{};    ///< value as typed
  std::string_view since = "0.1.0";

  constexpr Key() = default;
  constexpr Key(std::string_view name, const Value& value, const Presence& presence = Need::optional,
                std::string_view description = {}, std::string_view typed = {}, std::string_view version = "0.1.0")
      : Value(value),
        key(name),
        need(presence.need),
        otherwise(presence.otherwise),
        meaning(description),
        example(typed),
        since(version) {}

  /// `otherwise` as a number in SI; `nullopt` if it is not a quantity.
  std::optional<double> default_quantity() const;
  /// SI unit of a quantity: "m/s^2", "N/m or N m"; empty for a pure number.
  std::string unit_text() const;
};

/// Keys of a map in the input.
struct Section {
  std::string_view name;   ///< unique: "links", "grid"
  std::string_view place;  ///< "structures.NAME.frame.grid"; capitals are user-defined names, [] is any item of a list
  std::string_view meaning;
  std::span<const Key> keys;

  /// The key with this name; null if there is none.
  const Key* find(std::string_view key) const noexcept;
};

}  // namespace pounding::keys
