#pragma once
/// The words of the input. The reader reads through these tables, and `pounding words`, the page of the site and the
/// JSON schema are made from them: none of them can know a key that the others do not.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <pounding/core/units.hpp>
#include <pounding/input/bounds.hpp>

namespace pounding::keys {

/// Kind of a single value.
enum class Takes : unsigned char {
  nothing,   ///< no single value: a map or a list
  quantity,  ///< a number in SI or with its unit; a ratio has none, and "5 %" is 0.05
  integer,
  boolean,  ///< true or false
  choice,   ///< one of the choices
  text,     ///< any text: a title, a name, a file
  value     ///< a number, a quantity of any dimension or a name
};

/// Arrangement of the values under a key.
enum class Form : unsigned char {
  one,          ///< one value
  one_or_each,  ///< one value for all, or a list with one value for each
  one_or_list,  ///< one value, or a list
  list,         ///< a list of values
  named,        ///< a map from names of the user's choice to values
  named_lists,  ///< a map from names of the user's choice to lists
  by_storey  ///< one value, a list from the ground up, or a map from storeys ("4", "1-3"); in both each may be a list
             ///< by line
};

/// Necessity of a key in its section.
enum class Need : unsigned char {
  optional,
  required,
  exactly_one,  ///< exactly one of the keys of the section with this need is given
  at_least_one  ///< at least one of them is given
};

struct Section;

/// One key: what it takes and what it means.
struct Key {
  std::string_view key;
  Takes takes = Takes::nothing;
  Form form = Form::one;
  int minimum = 0, maximum = 0;        ///< members of a list; 0 for any number of them
  const Section* inside = nullptr;     ///< keys of the map that is taken, instead of the single value or beside it
  Dimension dimension{};               ///< of a quantity
  std::optional<Dimension> turning{};  ///< dimension of a quantity that belongs to a rotation, where it may
  std::string_view unit{};             ///< unit in SI, where the dimension alone does not tell it: "rad/s", "N/m^n"
  Bounds bounds{};                     ///< of a quantity in SI, of an integer
  std::span<const std::string_view> choices{};
  std::span<const std::string_view> instead{};  ///< texts that stand in the place of the whole value: `nodes: all`
  std::string_view
      noun{};  ///< what the choices name, where it is not the key; a quantity, where its dimension does not name it
  Need need = Need::optional;
  std::string_view otherwise{};  ///< value when the key is left out: as it would be typed, or in words; "" for none
  std::string_view since = "0.1.0";
  std::string_view meaning{};  ///< plain sentences, with signs and order
  std::string_view example{};  ///< a value as it is typed

  /// `otherwise` as a number in SI; nothing where it is no quantity.
  std::optional<double> default_quantity() const;
  /// Unit of a quantity in SI: "m/s^2", "N/m or N m"; "" for a pure number.
  std::string unit_text() const;
};

/// The keys of one map of the input.
struct Section {
  std::string_view name;  ///< unique: "links", "grid"
  std::string_view
      place;  ///< "structures.NAME.frame.grid"; names in capitals are the user's, [] is each member of a list
  std::string_view meaning;
  std::span<const Key> keys;

  /// The word with this key, or null.
  const Key* find(std::string_view key) const noexcept;
};

}  // namespace pounding::keys
