#pragma once
/// Reading a YAML input so that every mistake is reported with its place, what was read and what to type.

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
#include <pounding/input/bounds.hpp>
#include <pounding/input/keys/key.hpp>

namespace pounding {

/// One node of a YAML file, with its place. Cheap to copy; the file's text lives as long as any of its nodes.
///
/// A node that is read by a section of the catalogue (words/sections.hpp) knows the words of its keys, and so do its
/// children: their dimensions, bounds, choices, defaults and examples are those of the words. A key that is asked for
/// and is not in the section is a std::logic_error, and so is a value that is asked for without a word.
///
/// Every function that reads throws InputError with "file:line:column: key.path: " in front (counted from 1).
class Input {
 public:
  /// The whole file. Throws for a missing file, a text that is not UTF-8, bad YAML, a key given twice, an empty file,
  /// more than one document, and for what goes beyond the limits of yaml_limits.hpp.
  static Input read_file(const std::string& path);
  /// A text in memory, with or without the mark of UTF-8 in front; `name` stands for the file in messages, and its
  /// folder is where relative paths start. `files` holds contents of files by the names that the text gives them, such
  /// as those of records; other files are read from disk.
  using Files = std::shared_ptr<const std::map<std::string, std::string>>;
  static Input read_text(std::string text, std::string name, Files files = {});

  Input(const Input&) = default;
  /// yaml-cpp's own assignment would write into the tree that both share.
  Input& operator=(const Input& other) {
    source_ = other.source_;
    node_.reset(other.node_);
    path_ = other.path_;
    key_ = other.key_;
    location_ = other.location_;
    key_location_ = other.key_location_;
    spec_ = other.spec_;
    section_ = other.section_;
    part_ = other.part_;
    return *this;
  }

  /// The whole file as it was read.
  const std::string& text() const noexcept { return source_->text; }
  /// The file as the user named it.
  const std::string& file() const noexcept { return source_->name; }
  /// The folder that relative paths in the file start from.
  std::filesystem::path directory() const;
  /// Content of the file that this scalar names; null unless read_text() was given it.
  const std::string* file_content() const;
  /// Where this node is, "links[0].gap"; empty for the whole file.
  const std::string& path() const noexcept { return path_; }
  /// The last part of path().
  const std::string& key() const noexcept { return key_; }

  /// The kind of the node in YAML.
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// This node, whose keys are those of this section from here on.
  Input in(const keys::Section& section) const;
  /// Whether the section of this node has the key at all.
  bool knows(std::string_view key) const { return section_ && section_->find(key); }

  /// The child with this key, or nothing.
  std::optional<Input> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// The child with this key, which must be there. `example` completes the message, by default that of the word: type
  /// "gap: 20 mm".
  Input at(std::string_view key, std::string_view example = {}) const;
  /// Refuses every key that is not in the section, at its own place, with the nearest allowed one.
  void only_keys() const;
  /// Refuses every other key, some of those of the section.
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
  /// An integer in the bounds of the word, or in other ones that the model sets.
  long long as_integer() const;
  long long as_integer(long long low, long long high) const;
  /// true or false.
  bool as_bool() const;
  /// A number in SI or with its unit, as the word says; "5 %" is 0.05. `dimension` and `allowed` are given where the
  /// model sets them.
  double as_quantity() const;
  double as_quantity(const Dimension& dimension) const;
  double as_quantity(const Dimension& dimension, const Bounds& allowed) const;
  /// One quantity for all `count` places, or a list of `count` of them from the ground up.
  std::vector<double> as_quantities(int count) const;
  std::vector<double> as_quantities(int count, const Bounds& allowed) const;
  /// One of the choices of the word, of a whole value one of those that stand in its place.
  std::string as_choice() const;
  /// One of the names; `what` is what they name: unknown law "hertz_damp". Did you mean "hertz_damped"?
  std::string as_choice(std::string_view what, std::span<const std::string_view> allowed) const;

  /// The quantity under a key, which must be there unless its word has a default.
  double quantity(std::string_view key) const;
  /// The quantity under a key, or nothing when the key is absent.
  std::optional<double> find_quantity(std::string_view key) const;

  /// Puts another text in the place of this scalar: all nodes of the tree read it from now on. text() stays as it was
  /// read. Throws InputError for a map or a list.
  void rewrite(const std::string& text);

  /// Throws InputError with this node's place in front.
  [[noreturn]] void fail(std::string_view message) const;
  /// Throws InputError at the place of the node's key, for a key that should not be there.
  [[noreturn]] void fail_at_key(std::string_view message) const;

 private:
  struct Source {
    std::string name, text;
    Files files = {};
  };
  struct Location {
    int line = 1, column = 1;
  };

  class WrongKeys;

  /// Part of what stands under the key of the word.
  enum class Part { value, of_name, item };

  Input(std::shared_ptr<const Source> source, YAML::Node node, std::string path, std::string key,
        Location key_location);
  Input child(std::string_view key, const YAML::Node& key_node, const YAML::Node& value) const;
  const keys::Key& spec() const;
  void expect_map() const;
  [[noreturn]] void fail_at(const Location& location, std::string_view message) const;

  std::shared_ptr<const Source> source_;
  YAML::Node node_;
  std::string path_, key_;
  Location location_, key_location_;
  const keys::Key* spec_ = nullptr;
  const keys::Section* section_ = nullptr;
  Part part_ = Part::value;
};

}  // namespace pounding
