#include <pounding/core/archive.hpp>
#include <pounding/core/archive_eigen.hpp>

#include <type_traits>

#include <gtest/gtest.h>

namespace pounding {
namespace archive_test {

// An engine that only counts: its state is the count that it points to.
struct Counter {
  const double* engine;
  int count;
  void archive(Archive& archive) { archive(count); }
};

TEST(Archive, AsksAClassForItsStateThoughItsBytesCouldBeCopied) {
  static_assert(std::is_trivially_copyable_v<Counter>);
  const double first = 1, second = 2;
  Counter written{&first, 7}, read{&second, 0};
  Archive archive;
  archive(written);
  EXPECT_EQ(archive.bytes().size(), sizeof(int));
  archive.rewind_for_reading();
  archive(read);
  EXPECT_EQ(read.count, 7);
  EXPECT_EQ(read.engine, &second);
}

TEST(Archive, AsksTheMembersOfAList) {
  const double first = 1, second = 2;
  std::vector<Counter> written{{&first, 3}, {&first, 4}}, read{{&second, 0}, {&second, 0}};
  Archive archive;
  archive(written);
  archive.rewind_for_reading();
  archive(read);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].count, 4);
  EXPECT_EQ(read[1].engine, &second);
}

TEST(Archive, RefusesBytesThatEndEarly) {
  Archive short_one{std::vector<std::byte>(3)};
  int value = 0;
  EXPECT_THROW(short_one(value), std::runtime_error);
}

// Sizes that another state or a damaged file may contain. Vectors have exactly one column, and eight bytes cannot hold
// a thousand numbers.
TEST(Archive, RefusesSizesThatAMatrixCannotHave) {
  const auto bytes = [](std::size_t rows, std::size_t columns) {
    Archive archive;
    double value = 1;
    archive(rows);
    archive(columns);
    archive(value);
    return Archive(archive.bytes());
  };
  Eigen::VectorXd vector;
  Eigen::MatrixXd matrix;
  for (const std::size_t columns : {0, 2}) {
    Archive archive = bytes(4, columns);
    EXPECT_THROW(archive(vector), std::runtime_error) << columns;
  }
  Archive large = bytes(20, 20), right = bytes(1, 1), empty = bytes(3, 0);
  EXPECT_THROW(large(matrix), std::runtime_error);
  right(vector);
  EXPECT_EQ(vector.size(), 1);
  empty(matrix);
  EXPECT_EQ(matrix.rows(), 3);
}

}  // namespace archive_test
}  // namespace pounding
