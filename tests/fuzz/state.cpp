// The state in a checkpoint: an archive of values, lists and texts. The result is no larger than the bytes allow.

#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/core/archive_eigen.hpp>
#include "fuzz.hpp"

namespace {

struct Row {
  double value = 0;
  std::string name;
  std::vector<double> values;
  Eigen::VectorXd vector;
  Eigen::MatrixXd matrix;

  void archive(pounding::Archive& archive) {
    archive(value);
    archive(name);
    archive(values);
    archive(vector);
    archive(matrix);
  }
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  pounding::Archive read(std::vector<std::byte>(first, first + size));
  Row row;
  std::vector<Row> rows;
  try {
    read(row);
    read(rows);
    read.expect_end();
  } catch (const std::runtime_error& error) {
    pounding::fuzz::require_printable(error);
    return 0;
  }
  pounding::Archive written;
  written(row);
  written(rows);
  pounding::fuzz::require(written.bytes() == read.bytes(), "a state is written as it is read");
  return 0;
}
