#pragma once
/// Checks of messages by their location and their facts, independent of their wording.

#include <gtest/gtest.h>

#include <cctype>
#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pounding::test {

/// Names, numbers with units, keys and options that a message must contain.
using Facts = std::vector<std::string_view>;

inline Facts mentions(Facts facts) { return facts; }

/// True if the text contains each fact, not as a substring of a longer name or number.
inline testing::AssertionResult mentions(std::string_view text, const Facts& facts) {
  const auto joined = [](char a, char b) {
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    return in_word(a) && in_word(b);
  };
  for (const std::string_view fact : facts) {
    bool found = fact.empty();
    for (std::size_t i = text.find(fact); !found && i != text.npos; i = text.find(fact, i + 1)) {
      const std::size_t end = i + fact.size();
      found = (i == 0 || !joined(text[i - 1], fact.front())) && (end == text.size() || !joined(fact.back(), text[end]));
    }
    if (!found) return testing::AssertionFailure() << "no \"" << fact << "\" in\n" << text;
  }
  return testing::AssertionSuccess();
}

/// Start of a message: `at("5:16", "links[0].between[0]")` is "5:16: links[0].between[0]: ".
inline std::string at(const std::string& position, const std::string& key = "") {
  return position + ": " + (key.empty() ? key : key + ": ");
}

/// The text of the exception of this kind thrown by the call; "taken" if it throws none.
template <class Error = std::invalid_argument, class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

/// The only one of several texts.
inline std::string only(const std::vector<std::string>& texts) {
  EXPECT_EQ(texts.size(), 1u) << testing::PrintToString(texts);
  return texts.empty() ? "" : texts.front();
}

/// Checks that a message starts with `place` and contains the facts.
inline void expect_message(const std::string& text, const std::string& place, const Facts& facts,
                           const std::source_location& line = std::source_location::current()) {
  if (!text.starts_with(place) || !mentions(text, facts))
    ADD_FAILURE_AT(line.file_name(), static_cast<int>(line.line()))
        << text << "\nexpected at " << place << testing::PrintToString(facts);
}

}  // namespace pounding::test
