#include <pounding/input/input.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/yaml_limits.hpp>

namespace pounding {
namespace {

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

// True if the key is the rest of a number with a decimal comma, as in {gap: 20,5 mm}: digits, then possibly a unit.
bool is_after_comma(std::string_view key) {
  const std::size_t digits = std::min(key.find_first_not_of("0123456789"), key.size());
  return digits > 0 && (digits == key.size() || key[digits] == ' ' ||
                        std::isalpha(static_cast<unsigned char>(key[digits])) || key[digits] == '%');
}

// True for the digits before a decimal comma: "0" of [0,5 m].
bool is_whole_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// "a length > 0 such as "20 mm""
std::string allowed_text(const Dimension& dimension, const Bounds& allowed) {
  return fmt::format("{}{} such as \"{}\"", quantity_name(dimension), allowed.text(), quantity_example(dimension));
}

// True if the key of a map is a user-defined name.
bool names_values(keys::Form form, std::string_view key) {
  if (form == keys::Form::by_storey) return !key.empty() && key.front() >= '0' && key.front() <= '9';
  return form == keys::Form::named || form == keys::Form::named_lists;
}

// Corrected text if the value of an unknown key is the name of an allowed key, or of a key inside allowed ones:
// `"spring: {bouc_wen: {yield_force: 150 kN}}"` if "law: bouc_wen" was read. Empty if it is neither.
std::string ways_to_type(const keys::Section& section, std::span<const std::string_view> allowed,
                         const YAML::Node& value) {
  const bool holds_one = value.IsMap() && value.size() == 1;
  if (!value.IsScalar() && !holds_one) return {};
  const std::string& name = (holds_one ? value.begin()->first : value).Scalar();
  const auto typed = [](std::string_view key, std::string_view example) { return fmt::format("{}: {}", key, example); };
  std::string ways;
  for (const std::string_view key : allowed) {
    const keys::Key* const spec = section.find(key);
    if (!spec) continue;
    if (key == name) return fmt::format("\"{}\"", typed(key, spec->example));
    const keys::Key* const inner =
        !holds_one && spec->inside && spec->form == keys::Form::one ? spec->inside->find(name) : nullptr;
    if (inner)
      ways += fmt::format("{}\"{}\"", ways.empty() ? "" : " or ",
                          typed(key, fmt::format("{{{}}}", typed(name, inner->example))));
  }
  return ways;
}

}  // namespace

/// Checks all keys of a tree before it is read: plain names, without duplicates and merge keys.
class Input::WrongKeys {
 public:
  explicit WrongKeys(std::shared_ptr<const Source> source) : source_(std::move(source)) {}

  void refuse(const YAML::Node& node) {
    if (node.IsMap()) refuse_in_map(node);
    if (!node.IsSequence()) return;
    for (std::size_t i = 0; i < node.size(); ++i) {
      path_.push_back(fmt::format("[{}]", i));
      refuse(node[i]);
      path_.pop_back();
    }
  }

 private:
  void refuse_in_map(const YAML::Node& map) {
    std::set<std::string> seen;
    std::pair<std::string, std::string> before;  // key and value of the entry before
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key must be a plain name");
      const std::string& key = entry.first.Scalar();
      if (key == "<<") fail(entry.first, "merge keys (<<) are not supported; repeat the keys");
      if (double number = 0; entry.second.IsNull() && is_after_comma(key) && parse_number(before.second, number))
        fail(entry.first,
             fmt::format(
                 "\"{0},{1}\" is read as two entries, since a comma separates them; type a decimal point: {2}: {0}.{1}",
                 excerpt(before.second), excerpt(key), excerpt(before.first)));
      before = {key, entry.second.IsScalar() ? entry.second.Scalar() : std::string()};
      if (!seen.insert(key).second)
        fail(entry.first, fmt::format("key \"{}\" is given twice; keep one of them", excerpt(key)));
      path_.push_back(key);
      refuse(entry.second);
      path_.pop_back();
    }
  }

  [[noreturn]] void fail(const YAML::Node& key, std::string_view message) const {
    std::string path;
    for (const std::string& part : path_) path = part.starts_with('[') ? path + part : joined(path, part);
    const YAML::Mark mark = key.Mark();
    Input(source_, key, path, {}, {}).fail_at({mark.line + 1, mark.column + 1}, message);
  }

  std::shared_ptr<const Source> source_;
  std::vector<std::string> path_;
};

Input Input::read_file(const std::string& path) {
  if (std::error_code ignored; path.ends_with(".h5") && std::filesystem::exists(path, ignored))
    throw InputError(
        fmt::format("{0}: this is a results file, not a model; type pounding run --resume {0} to resume a run, or "
                    "pounding plot {0} to plot it",
                    excerpt(path)));
  return read_text(read_text_file(path, "YAML file", longest_model), path);
}

Input Input::read_text(std::string text, std::string name, Files files, bool generated) {
  text.erase(0, text.size() - without_mark(text).size());
  auto source = std::make_shared<const Source>(Source{std::move(name), std::move(text), std::move(files), generated});
  check_yaml(source->text, source->name);
  const Input root(source, YAML::Load(source->text), {}, {}, {});
  WrongKeys(source).refuse(root.node_);
  return root;
}

Input::Input(std::shared_ptr<const Source> source, YAML::Node node, std::string path, std::string key,
             Location key_location)
    : source_(std::move(source)),
      node_(std::move(node)),
      path_(std::move(path)),
      key_(std::move(key)),
      location_(key_location),
      key_location_(key_location) {
  // An empty value has no location; its key has one.
  if (const YAML::Mark mark = node_.Mark(); !node_.IsNull() && !mark.is_null())
    location_ = {mark.line + 1, mark.column + 1};
}

std::filesystem::path Input::directory() const { return std::filesystem::path(source_->name).parent_path(); }

const std::string* Input::file_content() const {
  if (!source_->files) return nullptr;
  const auto found = source_->files->find(as_text());
  return found == source_->files->end() ? nullptr : &found->second;
}

Input Input::child(std::string_view key, const YAML::Node& key_node, const YAML::Node& value) const {
  const YAML::Mark mark = key_node.Mark();
  Input made(source_, value, joined(path_, key), std::string(key), Location{mark.line + 1, mark.column + 1});
  const bool is_map_of_names = spec_ && part_ == Part::value && names_values(spec_->form, key);
  if (is_map_of_names) {
    made.spec_ = spec_;
    made.section_ = section_;
    made.part_ = Part::of_name;
  } else if (const keys::Key* known = section_ ? section_->find(key) : nullptr) {
    made.spec_ = known;
    made.section_ = known->inside;
  }
  return made;
}

bool Input::knows(std::string_view key) const { return section_ && section_->find(key); }

Input Input::in(const keys::Section& section) const {
  Input same = *this;
  same.section_ = &section;
  return same;
}

std::string_view Input::kind() const {
  return node_.IsNull() ? "an empty value" : is_map() ? "a map" : is_list() ? "a list" : "a single value";
}

const keys::Key& Input::spec() const {
  if (!spec_) throw std::logic_error(fmt::format("{} is read, but is not a key of the input", path_));
  return *spec_;
}

std::optional<Input> Input::find(std::string_view key) const {
  expect_map();
  if (section_ && !section_->find(key))
    throw std::logic_error(fmt::format("the key {} is read in {}, but is not in its table", key, section_->name));
  for (const auto& entry : node_)
    if (entry.first.Scalar() == key) return child(key, entry.first, entry.second);
  return std::nullopt;
}

Input Input::at(std::string_view key, std::string_view example) const {
  if (auto found = find(key)) return *std::move(found);
  // A key that is not known is often the missing one. Further keys of a link belong to its law.
  if (section_ && section_ != &keys::link) only_keys();
  if (example.empty() && section_) example = section_->find(key)->example;
  fail(fmt::format("key \"{}\" is missing{}", key,
                   example.empty() ? "" : fmt::format("; type \"{}: {}\"", key, example)));
}

void Input::only_keys() const {
  if (!section_) throw std::logic_error(fmt::format("{} has no section of keys", path_));
  std::vector<std::string_view> keys;
  for (const keys::Key& each : section_->keys) keys.push_back(each.key);
  only_keys(keys);
}

void Input::only_keys(std::span<const std::string_view> allowed) const {
  expect_map();
  for (const auto& entry : node_) {
    const std::string& key = entry.first.Scalar();
    bool known = false;
    for (const std::string_view name : allowed) known = known || name == key;
    if (known) continue;
    const YAML::Mark mark = entry.first.Mark();
    const std::string ways = section_ ? ways_to_type(*section_, allowed, entry.second) : std::string();
    fail_at({mark.line + 1, mark.column + 1},
            fmt::format("unknown key \"{}\".{}", excerpt(key),
                        ways.empty() ? suggestion(key, allowed) : fmt::format(" Type {} instead.", ways)));
  }
}

std::string Input::chosen(std::string_view example) const {
  std::vector<const keys::Key*> group;
  std::string given;
  for (const keys::Key& each : section_->keys) {
    if (each.need != keys::Need::exactly_one) continue;
    group.push_back(&each);
    const auto found = find(each.key);
    if (found && !given.empty())
      found->fail_at_key(fmt::format("\"{}\" and \"{}\" are both given; keep one of them", given, each.key));
    if (found) given = each.key;
  }
  if (!given.empty()) return given;
  only_keys();
  const auto typed = [](std::string_view key, std::string_view example) { return fmt::format("{}: {}", key, example); };
  std::vector<std::string_view> names;
  for (const keys::Key* each : group) names.push_back(each->key);
  const bool is_map = spec_ && part_ == Part::value && spec_->example.starts_with('{');
  std::string shown(example);
  if (shown.empty()) shown = is_map ? typed(key_, spec_->example) : typed(group[0]->key, group[0]->example);
  if (example.empty() && group.size() == 2)
    shown = fmt::format("{}, or {}", typed(group[0]->key, group[0]->example), typed(group[1]->key, group[1]->example));
  fail(fmt::format("takes one of {}; type {}", fmt::join(names, ", "), shown));
}

std::vector<std::pair<std::string, Input>> Input::entries() const {
  expect_map();
  std::vector<std::pair<std::string, Input>> children;
  for (const auto& entry : node_)
    children.emplace_back(entry.first.Scalar(), child(entry.first.Scalar(), entry.first, entry.second));
  return children;
}

std::vector<Input> Input::items() const {
  if (!is_list()) fail("takes a list such as [a, b]");
  std::vector<Input> members;
  for (const auto& member : node_) {
    const std::string index = fmt::format("[{}]", members.size());
    Input& made = members.emplace_back(Input(source_, member, path_ + index, key_ + index, location_));
    made.spec_ = spec_;
    made.section_ = section_;
    made.part_ = Part::item;
    made.comma_ = number_with_comma();
  }
  return members;
}

std::string Input::number_with_comma() const {
  const bool takes_quantities = spec_ && spec_->takes == keys::Takes::quantity && part_ != Part::item;
  if (!is_list() || !takes_quantities || node_.size() % 2 != 0 || node_.size() == 0) return {};
  // Two items are rarely one number if the key takes lists of two.
  if (node_.size() == 2 && spec_->minimum == 2) return {};
  for (std::size_t i = 0; i < node_.size(); i += 2)
    if (!node_[i].IsScalar() || !node_[i + 1].IsScalar() || !is_whole_number(node_[i].Scalar()) ||
        !is_after_comma(node_[i + 1].Scalar()))
      return {};
  return node_[0].Scalar() + "," + node_[1].Scalar();
}

std::string Input::as_text() const {
  if (!is_scalar()) fail(fmt::format("takes a text; {} was read", kind()));
  return node_.Scalar();
}

void Input::rewrite(const std::string& text) {
  if (!is_scalar()) fail("cannot be replaced, since it is not a single value");
  static_cast<YAML::Node&>(node_) = text;
}

double Input::as_quantity() const { return as_quantity(spec().dimension, spec().bounds); }

double Input::as_quantity(const Dimension& dimension) const { return as_quantity(dimension, spec().bounds); }

double Input::as_quantity(const Dimension& dimension, const Bounds& allowed) const {
  if (!is_scalar()) fail(fmt::format("takes {}; {} was read", allowed_text(dimension, allowed), kind()));
  double value = 0;
  try {
    value = parse_quantity(node_.Scalar(), dimension);
  } catch (const InputError& error) {
    fail(error.what());
  }
  if (!allowed.contain(value))
    fail(fmt::format("takes {}; \"{}\" is outside", allowed_text(dimension, allowed), excerpt(node_.Scalar())));
  return value;
}

std::vector<double> Input::as_quantities(int count) const { return as_quantities(count, spec().bounds); }

std::vector<double> Input::as_quantities(int count, const Bounds& allowed) const {
  const auto wanted = static_cast<std::size_t>(count);
  if (!is_list()) return std::vector<double>(wanted, as_quantity(spec().dimension, allowed));
  const std::vector<Input> members = items();
  if (members.size() != wanted)
    fail(fmt::format("takes {} or a list of {} from the ground up; a list of {} was read",
                     allowed_text(spec().dimension, allowed), count, members.size()));
  std::vector<double> values;
  for (const Input& member : members) values.push_back(member.as_quantity(spec().dimension, allowed));
  return values;
}

long long Input::as_integer() const { return as_integer(spec().bounds); }

long long Input::as_integer(const Bounds& allowed) const {
  const std::string takes = fmt::format("takes an integer{}; ", allowed.text());
  if (!is_scalar()) fail(fmt::format("{}{} was read", takes, kind()));
  const std::string& text = node_.Scalar();
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("{}\"{}\" is not one", takes, excerpt(text)));
  if (!allowed.contain(static_cast<double>(value))) fail(fmt::format("{}\"{}\" is outside", takes, excerpt(text)));
  return value;
}

bool Input::as_bool() const {
  const std::string text = is_scalar() ? node_.Scalar() : std::string();
  if (text != "true" && text != "false") fail(fmt::format("takes true or false; \"{}\" was read", excerpt(text)));
  return text == "true";
}

std::string Input::as_choice() const {
  const bool in_place_of_all = part_ == Part::value && !spec().instead.empty();
  return as_choice(spec().noun.empty() ? spec().key : spec().noun, in_place_of_all ? spec().instead : spec().choices);
}

std::string Input::as_choice(std::string_view what, std::span<const std::string_view> allowed) const {
  std::string read = as_text();
  for (const std::string_view name : allowed)
    if (name == read) return read;
  fail(fmt::format("unknown {} \"{}\".{}", what, excerpt(read), suggestion(read, allowed)));
}

double Input::quantity(std::string_view key) const {
  const auto found = find(key);
  if (found) return found->as_quantity();
  if (const auto otherwise = section_ ? section_->find(key)->default_quantity() : std::nullopt) return *otherwise;
  return at(key).as_quantity();
}

std::optional<double> Input::find_quantity(std::string_view key) const {
  const auto found = find(key);
  return found ? std::optional(found->as_quantity()) : std::nullopt;
}

void Input::fail(std::string_view message) const {
  const std::string comma = comma_.empty() ? number_with_comma() : comma_;
  if (comma.empty()) fail_at(location_, message);
  std::string point = comma;
  point.replace(point.find(','), 1, ".");
  fail_at(location_, fmt::format("{}; a comma separates the items of a list: for the number {} type {}", message,
                                 excerpt(comma), excerpt(point)));
}

void Input::fail_at_key(std::string_view message) const { fail_at(key_location_, message); }

void Input::fail_at(const Location& location, std::string_view message) const {
  const std::string line = source_->generated ? "" : fmt::format("{}:{}:", location.line, location.column);
  throw InputError(fmt::format("{}:{} {}{}", source_->name, line, path_.empty() ? "" : excerpt(path_) + ": ", message));
}

void Input::expect_map() const {
  if (is_map()) return;
  const bool shown = spec_ && part_ == Part::value && spec_->example.starts_with('{');
  fail(fmt::format("takes keys with values such as {}; {} was read", shown ? spec_->example : "{key: value}", kind()));
}

}  // namespace pounding
