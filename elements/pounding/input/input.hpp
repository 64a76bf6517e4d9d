#pragma once
/// Reading a YAML input so that every mistake is reported with its place, what was read and what to type.

#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include <pounding/core/units.hpp>

namespace pounding {

/// The numbers that a key allows.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false, without_high = false;  ///< the end itself is not allowed

  /// Whether the key takes it.
  bool contain(double value) const noexcept;
  /// " > 0", " >= 0", " in (0, 1]", in SI; "" when every number is allowed.
  std::string text() const;
};

namespace bounds {
inline constexpr Bounds any{};
inline constexpr Bounds positive{.low = 0, .without_low = true};
inline constexpr Bounds non_negative{.low = 0};
inline constexpr Bounds from_0_to_1{.low = 0, .high = 1};                            ///< [0, 1]
inline constexpr Bounds above_0_to_1{.low = 0, .high = 1, .without_low = true};      ///< (0, 1]
inline constexpr Bounds from_0_below_1{.low = 0, .high = 1, .without_high = true};   ///< [0, 1)
}  // namespace bounds

/// One node of a YAML file, with its place. Cheap to copy; the file's text lives as long as any of its nodes.
///
/// Every function that reads throws InputError with "file:line:column: key.path: " in front (counted from 1).
class Input {
 public:
  /// The whole file. Throws for a missing file, bad YAML, a key given twice, an empty file and more than one document.
  static Input read_file(const std::string& path);
  /// A text in memory; `name` stands for the file in messages, and its folder is where relative paths start.
  static Input read_text(std::string text, std::string name);

  Input(const Input&) = default;
  /// yaml-cpp's own assignment would write into the tree that both share.
  Input& operator=(const Input& other) {
    source_ = other.source_;
    node_.reset(other.node_);
    path_ = other.path_;
    key_ = other.key_;
    place_ = other.place_;
    key_place_ = other.key_place_;
    return *this;
  }

  /// The whole file as it was read.
  const std::string& text() const noexcept { return source_->text; }
  /// The file as the user named it.
  const std::string& file() const noexcept { return source_->name; }
  /// The folder that relative paths in the file start from.
  std::filesystem::path directory() const;
  /// Where this node is, "links[0].gap"; empty for the whole file.
  const std::string& path() const noexcept { return path_; }
  /// The last part of path().
  const std::string& key() const noexcept { return key_; }

  /// The kind of the node in YAML.
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// The child with this key, or nothing.
  std::optional<Input> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// The child with this key, which must be there. `example` completes the message: type "gap: 20 mm".
  Input at(std::string_view key, std::string_view example = {}) const;
  /// Refuses every other key, at its own place, with the nearest allowed one.
  void only_keys(std::span<const std::string_view> allowed) const;
  void only_keys(std::initializer_list<std::string_view> allowed) const {
    only_keys(std::span(allowed.begin(), allowed.size()));
  }
  /// The children of a map, in the order of the file.
  std::vector<std::pair<std::string, Input>> entries() const;
  /// The members of a list.
  std::vector<Input> items() const;

  /// A scalar as it was written.
  std::string as_text() const;
  /// A pure number; "5 %" is 0.05.
  double as_number(const Bounds& allowed = bounds::any) const;
  long long as_integer(long long low = std::numeric_limits<long long>::min(),
                       long long high = std::numeric_limits<long long>::max()) const;
  /// true or false.
  bool as_bool() const;
  /// A number in SI or with its unit.
  double as_quantity(const Dimension& dimension, const Bounds& allowed = bounds::any) const;
  /// One quantity for all `count` places, or a list of `count` of them from the ground up.
  std::vector<double> as_quantities(int count, const Dimension& dimension, const Bounds& allowed = bounds::any) const;
  /// One of the names; `what` is what they name: unknown law "hertz_damp". Did you mean "hertz_damped"?
  std::string as_choice(std::string_view what, std::span<const std::string_view> allowed) const;
  std::string as_choice(std::string_view what, std::initializer_list<std::string_view> allowed) const {
    return as_choice(what, std::span(allowed.begin(), allowed.size()));
  }

  /// The quantity under a key that must be there.
  double quantity(std::string_view key, const Dimension& dimension, const Bounds& allowed = bounds::any) const;
  /// The quantity under a key, or `otherwise` when the key is absent.
  double quantity_or(std::string_view key, const Dimension& dimension, double otherwise,
                     const Bounds& allowed = bounds::any) const;

  /// Throws InputError with this node's place in front.
  [[noreturn]] void fail(std::string_view message) const;
  /// Throws InputError at the place of the node's key, for a key that should not be there.
  [[noreturn]] void fail_at_key(std::string_view message) const;

 private:
  struct Source {
    std::string name, text;
  };
  struct Place {
    int line = 1, column = 1;
  };

  Input(std::shared_ptr<const Source> source, YAML::Node node, std::string path, std::string key, Place key_place);
  Input child(std::string_view key, const YAML::Node& key_node, const YAML::Node& value) const;
  void expect_map() const;
  void refuse_wrong_keys(int depth = 0) const;
  [[noreturn]] void fail_at(const Place& place, std::string_view message) const;

  std::shared_ptr<const Source> source_;
  YAML::Node node_;
  std::string path_, key_;
  Place place_, key_place_;
};

}  // namespace pounding
