// Text from users: what is accepted, what is rejected, and how messages quote it.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/base/excerpt.hpp>
#include <pounding/core/error.hpp>
#include <pounding/core/names.hpp>
#include <pounding/core/text.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace text_test {

using namespace std::string_view_literals;

std::string place_in(std::string_view text) {
  const auto wrong = wrong_text(text);
  return wrong ? std::to_string(wrong->line) + ":" + std::to_string(wrong->column) + ": " + wrong->what : "";
}

TEST(Excerpt, ShowsAtMostTwoHundredCharacters) {
  EXPECT_EQ(excerpt("20 mm"), "20 mm");
  EXPECT_EQ(excerpt(std::string(200, 'x')), std::string(200, 'x'));
  EXPECT_EQ(excerpt(std::string(201, 'x')), std::string(200, 'x') + "...");
  std::string letters;
  for (int i = 0; i < 201; ++i) letters += "\u00e4";
  EXPECT_EQ(excerpt(letters), letters.substr(0, 400) + "...") << "a two-byte letter is one character and is not split";
}

TEST(Excerpt, EscapesWhatActsOnATerminalAndWhatIsNoUtf8) {
  EXPECT_EQ(excerpt("a\0b\x1b[31m\n\t\r\x7f"sv), R"(a\x00b\x1b[31m\n\t\r\x7f)");
  EXPECT_EQ(excerpt("Z\xfcrich"), R"(Z\xfcrich)");
  EXPECT_EQ(excerpt("\xc0\x80 \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x82"),
            R"(\xc0\x80 \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x82)")
      << "overlong, surrogate, out of range, truncated";
  EXPECT_EQ(excerpt("\u202e \u009b \u2028 \ufeff"), R"(\u202e \x9b \u2028 \ufeff)");
  EXPECT_EQ(excerpt("Z\u00fcrich \u6771\u4eac \U0001F3E0"), "Z\u00fcrich \u6771\u4eac \U0001F3E0");
}

TEST(Excerpt, OfAWholeMessageKeepsLines) {
  EXPECT_STREQ(InputError("m.yaml:1:1: first\nsecond \x1b").what(), "m.yaml:1:1: first\nsecond \\x1b");
  EXPECT_EQ(std::string(InputError(std::string(1'000'000, 'x')).what()).size(), longest_message + 3);
}

TEST(WrongText, IsFoundAtItsLineAndColumn) {
  EXPECT_EQ(place_in("a\tb\r\nZ\u00fcrich\n"), "");
  EXPECT_TRUE(test::mentions(place_in("a: 1\n# \u00e4\xe4\n").substr(0, 32), {"2:4", "E4", "UTF-8"}));
  EXPECT_TRUE(test::mentions(place_in("a\rb\n").substr(0, 31), {"1:2"}));
  EXPECT_TRUE(test::mentions(place_in("a\n\0b"sv), {"2:1", "x00"}));
  EXPECT_TRUE(test::mentions(place_in("\xff\xfe"
                                      "a\0"sv),
                             {"1:1", "UTF-16", "UTF-8"}));
  EXPECT_TRUE(test::mentions(place_in("\0a\0b"sv), {"1:1", "UTF-16", "UTF-8"}));
  EXPECT_TRUE(test::mentions(place_in("\xff\xfe\0\0a\0\0\0"sv), {"1:1", "UTF-32", "UTF-8"}));
}

TEST(ShownLine, TakesOtherBytesAsLatin1) {
  EXPECT_EQ(shown_line("Z\xfcrich \x1b[31m \u00fc"), "Z\u00fcrich  [31m \u00fc");
}

TEST(Parts, LieBetweenSeparatorsAndAreNotEmpty) {
  using Parts = std::vector<std::string_view>;
  EXPECT_EQ(parts_between("", " "), Parts{});
  EXPECT_EQ(parts_between("\n\n", "\n"), Parts{});
  EXPECT_EQ(parts_between("-a 1\n-b", "\n"), (Parts{"-a 1", "-b"}));
  EXPECT_EQ(parts_between(" \t-a  1\t", " \t"), (Parts{"-a", "1"}));
}

TEST(Names, AreShortAndWithoutControlCharacters) {
  EXPECT_EQ(wrong_name("Hochhaus \u00e4"), "");
  EXPECT_TRUE(test::mentions(wrong_name("a\nb"), {"a\\nb"}));
  EXPECT_TRUE(test::mentions(wrong_name("\xe4"), {"\\xe4", "UTF-8"}));
  EXPECT_NE(wrong_name(std::string(201, 'n')), "");
}

TEST(NearestName, LooksForSlipsInShortNamesOnly) {
  const std::string huge(20'000'000, 'h');
  const std::array<std::string_view, 2> allowed{"hertz", huge};
  EXPECT_EQ(nearest_name("hert", allowed), "hertz");
  EXPECT_EQ(nearest_name(huge.substr(1), allowed), "");
  EXPECT_EQ(unknown_name("node", huge, {"b1"}), "unknown node \"" + std::string(200, 'h') + "...\". Allowed: b1.");
}

}  // namespace text_test
}  // namespace pounding
