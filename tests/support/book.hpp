#pragma once
/// The verification book: numbers that the tests compare with independent sources.

#include <source_location>
#include <string>
#include <vector>

namespace pounding::test {

/// The comparisons of one test with one source. Each is a separate check at the line of its call. If the environment
/// variable POUNDING_BOOK names a folder, all are written to it as one JSON object per book and line;
/// tests/verification/README.md is generated from them.
class Book {
 public:
  /// `subject`: the verified subject; tests with the same subject share a section. `source`: closed form, publication
  /// or independent program of the expected numbers. `reason`: justification of the tolerances.
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

  /// EXPECT_EQ: a count, or a number that is bitwise identical.
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
