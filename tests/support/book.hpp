#pragma once
/// The verification book: which numbers the tests compare with sources that the program does not share.

#include <source_location>
#include <string>
#include <vector>

namespace pounding::test {

/// The comparisons of one test with one source. Each is a check of its own, at the line that asks for it; all of them
/// are written down when the environment variable POUNDING_BOOK names a folder, from which tests/verification/README.md
/// is made: one JSON object a book, appended as a line.
class Book {
 public:
  /// `subject`: what is verified, in words; tests with the same subject share a section. `source`: closed form,
  /// publication or independent program that the expected numbers come from. `reason`: why the tolerances are what they
  /// are.
  Book(std::string subject, std::string source, std::string reason);
  ~Book();
  Book(const Book&) = delete;
  Book& operator=(const Book&) = delete;

  /// EXPECT_NEAR with a name that ends with the unit: "peak force [N]". Numbers of the same name are cases of one row.
  void near(const std::string& quantity, double obtained, double expected, double tolerance,
            std::source_location at = std::source_location::current());

  /// EXPECT_LT of a difference, or of another number that should be zero.
  void below(const std::string& quantity, double obtained, double limit,
             std::source_location at = std::source_location::current());

  /// EXPECT_EQ: a count, or a number that is met to the last bit.
  void equal(const std::string& quantity, double obtained, double expected,
             std::source_location at = std::source_location::current());

 private:
  struct Case {
    double expected, obtained, tolerance;
  };
  struct Row {
    std::string quantity;
    std::vector<Case> cases;
  };
  void write_down(const std::string& quantity, const Case& found);

  std::string subject_, source_, reason_;
  std::vector<Row> rows_;
};

}  // namespace pounding::test
