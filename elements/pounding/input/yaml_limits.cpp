#include <pounding/input/yaml_limits.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <fmt/format.h>

#include <pounding/base/excerpt.hpp>
#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>

namespace pounding {
namespace {

/// An error and its location.
struct Refusal {
  YAML::Mark mark;
  std::string text;
};

/// Size of a value with its children.
struct Extent {
  std::size_t values = 0;
  int depth = 0;
};

/// Parser events of one document. Throws a Refusal at a limit, which also ends the recursion of the parser.
class Limits : public YAML::EventHandler {
 public:
  bool is_empty() const { return is_empty_; }
  const YAML::Mark& begin() const { return begin_; }

  void OnDocumentStart(const YAML::Mark& mark) override { begin_ = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (open_.empty()) is_empty_ = true;
    add(mark, anchor, {1, 0});
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string& value) override {
    if (value.size() > longest_value)
      throw Refusal{mark,
                    fmt::format("a value of {} bytes starts here, and the maximum is {}; is a quotation mark missing?",
                                value.size(), longest_value)};
    for (std::string_view rest = value; !rest.empty();) {
      const Character c = first_character(rest);
      if (!c.is_valid || (is_control(c.code) && c.code != '\n' && c.code != '\t'))
        throw Refusal{mark, fmt::format("\"{}\" contains the control character {}; leave it out", excerpt(value),
                                        excerpt(rest.substr(0, c.size)))};
      rest.remove_prefix(c.size);
    }
    add(mark, anchor, {1, 0});
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = anchors_.find(anchor);
    if (known == anchors_.end())
      throw Refusal{mark, "the alias is inside its own anchor; does an alias contain itself? Write the values out"};
    add(mark, 0, known->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin_collection(mark, anchor);
  }
  void OnSequenceEnd() override { end_collection(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin_collection(mark, anchor);
  }
  void OnMapEnd() override { end_collection(); }

 private:
  /// An open map or list.
  struct Open {
    YAML::Mark mark;
    YAML::anchor_t anchor;
    Extent inside;
  };

  void begin_collection(const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({mark, anchor, {}});
    refuse_depth(mark, 0);
  }
  void end_collection() {
    const Open ended = open_.back();
    open_.pop_back();
    add(ended.mark, ended.anchor, {ended.inside.values + 1, ended.inside.depth + 1});
  }
  // Levels are counted when they end, so the count never exceeds the final count of the root.
  void add(const YAML::Mark& mark, YAML::anchor_t anchor, const Extent& extent) {
    refuse_depth(mark, extent.depth);
    if (anchor != 0) anchors_[anchor] = extent;
    if (open_.empty()) return;
    Extent& inside = open_.back().inside;
    inside.values += extent.values;
    inside.depth = std::max(inside.depth, extent.depth);
    read_ = std::max(read_ + 1, inside.values);
    if (read_ > max_values)
      throw Refusal{
          mark, fmt::format("more than {} values up to here, with aliases expanded; this is the maximum for a model",
                            max_values)};
  }
  void refuse_depth(const YAML::Mark& mark, int more) const {
    if (static_cast<int>(open_.size()) + more > deepest)
      throw Refusal{mark, fmt::format("more than {} nested maps and lists", deepest)};
  }

  std::vector<Open> open_;
  std::map<YAML::anchor_t, Extent> anchors_;
  std::size_t read_ = 0;
  YAML::Mark begin_;
  bool is_empty_ = false;
};

[[noreturn]] void fail(const std::string& name, int line, int column, std::string_view what) {
  throw InputError(fmt::format("{}:{}:{}: {}", name, line, column, what));
}

// YAML does not allow tabs for indentation; the parser fails on the same or the next line.
void refuse_tab(const std::string& name, std::string_view text, int last_line) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size() && line <= last_line; ++line) {
    const std::size_t content = std::min(text.find_first_not_of(" \t", begin), text.size());
    if (const std::size_t tab = text.find('\t', begin); tab < content)
      fail(name, line, static_cast<int>(tab - begin) + 1,
           "this line is indented with a tab, and YAML allows spaces only; replace the tab by two spaces");
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  }
}

// Remedy for a message of the parser.
std::string remedy(std::string_view message) {
  constexpr std::pair<std::string_view, const char*> known[] = {
      {"illegal map value", R"(; put a text with a colon in quotes, as in title: "Case 2: soft soil")"},
      {"end of map flow not found", R"(; a "{" lacks its "}")"},
      {"end of sequence flow not found", R"(; a "[" lacks its "]")"},
      {"end of map not found",
       R"(; look for a missing space after "-" or ":", a missing colon, or inconsistent indentation)"},
      {"end of sequence not found", R"(; look for a missing space after "-", or inconsistent indentation)"}};
  for (const auto& [keys, what] : known)
    if (message.starts_with(keys)) return what;
  return "";
}

void check_document(std::string_view text, const std::string& name) {
  std::istringstream stream{std::string(text)};
  YAML::Parser parser(stream);
  Limits first;
  if (!parser.HandleNextDocument(first)) fail(name, 1, 1, "the file is empty");
  if (parser) {
    // The parser continues after the model: at a second document, or at an unmatched comma or bracket.
    Limits second;
    parser.HandleNextDocument(second);
    fail(name, second.begin().line + 1, second.begin().column + 1,
         "a second YAML document, or text after the model; one file contains one model");
  }
  if (first.is_empty()) fail(name, 1, 1, "the file is empty");
}

}  // namespace

void check_yaml(std::string_view text, const std::string& name) {
  if (text.size() > longest_model)
    throw InputError(fmt::format("{}: the file has {} MB, and the maximum for a model is {} MB; is it the right file?",
                                 name, text.size() / 1'000'000, longest_model / 1'000'000));
  if (const auto wrong = wrong_text(text)) fail(name, wrong->line, wrong->column, wrong->what);
  try {
    check_document(text, name);
  } catch (const Refusal& refusal) {
    fail(name, refusal.mark.line + 1, refusal.mark.column + 1, refusal.text);
  } catch (const YAML::Exception& error) {
    refuse_tab(name, text, error.mark.line + 1);
    fail(name, error.mark.line + 1, error.mark.column + 1,
         fmt::format("this is not YAML: {}{}", excerpt(error.msg), remedy(error.msg)));
  }
}

}  // namespace pounding
