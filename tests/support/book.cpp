#include "support/book.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pounding::test {
namespace {

// A failure reports the line of the test.
testing::ScopedTrace trace(const std::source_location& at, const std::string& quantity) {
  return {at.file_name(), static_cast<int>(at.line()), quantity};
}

// Index of a test among all tests of its program, including those that do not run.
int place_of(const testing::TestInfo& test) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  int place = 0;
  for (int i = 0; i < all.total_test_suite_count(); ++i)
    for (int j = 0; j < all.GetTestSuite(i)->total_test_count(); ++j, ++place)
      if (all.GetTestSuite(i)->GetTestInfo(j) == &test) return place;
  return place;
}

}  // namespace

Book::Book(std::string subject, std::string source, std::string reason)
    : subject_(std::move(subject)), source_(std::move(source)), reason_(std::move(reason)) {}

void Book::near(const std::string& quantity, double obtained, double expected, double tolerance,
                std::source_location at) {
  const auto here = trace(at, quantity);
  EXPECT_NEAR(obtained, expected, tolerance);
  write_down(quantity, {expected, obtained, tolerance});
}

void Book::below(const std::string& quantity, double obtained, double limit, std::source_location at) {
  const auto here = trace(at, quantity);
  EXPECT_LT(obtained, limit);
  write_down(quantity, {0, obtained, limit});
}

void Book::equal(const std::string& quantity, double obtained, double expected, std::source_location at) {
  const auto here = trace(at, quantity);
  EXPECT_EQ(obtained, expected);
  write_down(quantity, {expected, obtained, 0});
}

void Book::write_down(const std::string& quantity, const Case& found) {
  const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& one) { return one.quantity == quantity; });
  if (row == rows_.end())
    rows_.push_back({quantity, {found}});
  else
    row->cases.push_back(found);
}

Book::~Book() {
  const char* folder = std::getenv("POUNDING_BOOK");
  if (!folder) return;
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  static std::map<const testing::TestInfo*, int> books;
  const int number = books[test]++;
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  nlohmann::json entry{{"subject", subject_},  {"source", source_}, {"reason", reason_},
                       {"file", test->file()}, {"test", name},      {"order", {place_of(*test), number}}};
  for (const Row& row : rows_) {
    nlohmann::json cases;
    for (const Case& one : row.cases) cases.push_back({one.expected, one.obtained, one.tolerance});
    entry["rows"].push_back({{"quantity", row.quantity}, {"cases", cases}});
  }
  std::replace(name.begin(), name.end(), '/', '-');
  std::ofstream(std::string(folder) + '/' + name + '.' + std::to_string(number) + ".json") << entry.dump() << '\n';
}

}  // namespace pounding::test
