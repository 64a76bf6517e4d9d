#pragma once
/// Reads YAML input. Errors contain the location, the text that was read and the text to type.

#include <filesystem>
#include <initializer_list>
#include <map>
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

struct Bounds;

namespace keys {
struct Key;
struct Section;
}  // namespace keys

/// A node of a YAML file with its location. Cheap to copy; the text of the file lives as long as any of its nodes.
///
/// A node with a section of keys (keys/sections.hpp) passes the keys on to its children, which define dimensions,
/// bounds, choices, defaults and examples. Throws std::logic_error for a key that is not in the section, and for a
/// value without a key.
///
/// All reading functions throw InputError with the prefix "file:line:column: key.path: " (counted from 1).
class Input {
 public:
  /// Reads one file. Throws if it is missing, empty, not UTF-8 or not valid YAML, if it contains duplicate keys or
  /// several documents, or if it exceeds the limits of yaml_limits.hpp.
  static Input read_file(const std::string& path);
  /// Reads a text in memory, with or without a byte order mark. `name` is the file name in messages; relative paths
  /// start at its folder. `files` contains files, such as records, by their names in the text; other files are read
  /// from disk.
  /// `generated` is true for a text that the user does not see: messages then have the path of the key without line
  /// and column.
  using Files = std::shared_ptr<const std::map<std::string, std::string>>;
  static Input read_text(std::string text, std::string name, Files files = {}, bool generated = false);

  /// Text of the whole file.
  const std::string& text() const noexcept { return source_->text; }
  /// Name of the file as given by the user.
  const std::string& file() const noexcept { return source_->name; }
  /// Folder of the file, at which relative paths start.
  std::filesystem::path directory() const;
  /// Content of the file that this scalar names; null if it was not passed to read_text().
  const std::string* file_content() const;
  /// Path of this node, "links[0].gap"; empty for the whole file.
  const std::string& path() const noexcept { return path_; }
  /// Last component of path().
  const std::string& key() const noexcept { return key_; }

  /// YAML type of the node.
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// This node with the keys of a section.
  Input in(const keys::Section& section) const;
  /// True if the section of this node has the key.
  bool knows(std::string_view key) const;

  /// The child with this key; `nullopt` if there is none.
  std::optional<Input> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// Like find() for a key that only some sections have; `nullopt` also if this one does not.
  std::optional<Input> find_known(std::string_view key) const { return knows(key) ? find(key) : std::nullopt; }
  /// The child with this key. Throws if there is none: at a key that is not in the section, if there is one; else the
  /// message contains `example`, by default the example of the key: type "gap: 20 mm".
  Input at(std::string_view key, std::string_view example = {}) const;
  /// Throws at the first key that is not in the section, with the nearest allowed key.
  void only_keys() const;
  /// Throws at the first key that is not in this list.
  void only_keys(std::span<const std::string_view> allowed) const;
  void only_keys(std::initializer_list<std::string_view> allowed) const {
    only_keys(std::span(allowed.begin(), allowed.size()));
  }
  /// The one key that is given, of those of which the section allows exactly one. Throws if there is a second, or none:
  /// the message contains `example`, by default an example of the section or of its first key.
  std::string chosen(std::string_view example = {}) const;
  /// Children of a map, in the order of the file.
  std::vector<std::pair<std::string, Input>> entries() const;
  /// Items of a list.
  std::vector<Input> items() const;

  /// Text of a scalar.
  std::string as_text() const;
  /// An integer within the bounds of the key, or within bounds set by the model.
  long long as_integer() const;
  long long as_integer(const Bounds& allowed) const;
  /// true or false.
  bool as_bool() const;
  /// A number in SI units or with a unit; "5 %" is 0.05. `dimension` and `allowed` replace those of the key if the
  /// model sets them.
  double as_quantity() const;
  double as_quantity(const Dimension& dimension) const;
  double as_quantity(const Dimension& dimension, const Bounds& allowed) const;
  /// One quantity for all `count` items, or a list of `count` quantities from the ground up.
  std::vector<double> as_quantities(int count) const;
  std::vector<double> as_quantities(int count, const Bounds& allowed) const;
  /// One of the choices of the key, or one of the texts that replace its whole value.
  std::string as_choice() const;
  /// One of the names; `what` is the noun for the message: unknown law "hertz_damp". Did you mean "hertz_damped"?
  std::string as_choice(std::string_view what, std::span<const std::string_view> allowed) const;

  /// Quantity under a key. Throws if it is missing and has no default.
  double quantity(std::string_view key) const;
  /// Quantity under a key; `nullopt` if it is missing.
  std::optional<double> find_quantity(std::string_view key) const;

  /// Replaces this scalar in the tree that all nodes share; text() does not change. Throws InputError for a map or a
  /// list.
  void rewrite(const std::string& text);

  /// Throws InputError with the location of this node.
  [[noreturn]] void fail(std::string_view message) const;
  /// Throws InputError with the location of the key, for a key that is not allowed.
  [[noreturn]] void fail_at_key(std::string_view message) const;

 private:
  struct Source {
    std::string name, text;
    Files files = {};
    bool generated = false;
  };
  struct Location {
    int line = 1, column = 1;
  };
  /// A node that refers to another one if assigned. YAML::Node would write into the shared tree.
  struct Node : YAML::Node {
    explicit Node(const YAML::Node& node) : YAML::Node(node) {}
    Node(const Node&) = default;
    Node& operator=(const Node& other) {
      reset(other);
      return *this;
    }
  };

  class WrongKeys;

  /// Position of the node in the value of its key.
  enum class Part { value, of_name, item };

  Input(std::shared_ptr<const Source> source, YAML::Node node, std::string path, std::string key,
        Location key_location);
  Input child(std::string_view key, const YAML::Node& key_node, const YAML::Node& value) const;
  const keys::Key& spec() const;
  std::string_view kind() const;  ///< of the node: "a map"
  void expect_map() const;
  /// First number with a decimal comma, "0,5 m", if this list of quantities looks like [0,5 m, 1,0 m]; empty otherwise.
  std::string number_with_comma() const;
  [[noreturn]] void fail_at(const Location& location, std::string_view message) const;

  std::shared_ptr<const Source> source_;
  Node node_;
  std::string path_, key_;
  Location location_, key_location_;
  const keys::Key* spec_ = nullptr;
  const keys::Section* section_ = nullptr;
  Part part_ = Part::value;
  std::string comma_{};  ///< number_with_comma() of the list of this item
};

}  // namespace pounding
