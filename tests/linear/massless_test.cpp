// Degrees of freedom with and without mass, and submatrices at some of them.

#include <gtest/gtest.h>

#include <vector>

#include <pounding/structures/massless.hpp>

namespace pounding {
namespace massless_test {

using Indices = std::vector<int>;

SparseMatrix matrix_of(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

TEST(MassSplit, TellsDynamicFromMasslessDegreesOfFreedom) {
  SparseMatrix mass = matrix_of(Eigen::Vector4d(2, 0, 3, 1).asDiagonal().toDenseMatrix());
  mass.coeffRef(1, 1) = 0;  // an explicit zero is not a mass
  const MassSplit all = split_by_mass(mass);
  EXPECT_EQ(all.dynamic, (Indices{0, 2, 3}));
  EXPECT_EQ(all.massless, (Indices{1}));
  const MassSplit group = split_by_mass(mass, 1, 2);
  EXPECT_EQ(group.dynamic, (Indices{1})) << "counted in the group";
  EXPECT_EQ(group.massless, (Indices{0}));
}

TEST(MassSplit, CountsMassThatOnlyCouples) {
  Eigen::Matrix2d mass;
  mass << 1, 0.5, 0.5, 0;
  EXPECT_EQ(split_by_mass(matrix_of(mass)).dynamic, (Indices{0, 1})) << "so that a solver rejects the matrix";
}

TEST(Submatrix, TakesRowsAndColumnsInTheirOrder) {
  Eigen::MatrixXd whole(4, 4);
  whole << 11, 12, 13, 14, 21, 22, 23, 24, 31, 32, 33, 34, 41, 42, 43, 44;
  Eigen::MatrixXd expected(2, 3);
  expected << 43, 41, 42, 13, 11, 12;
  const Indices rows{3, 0}, columns{2, 0, 1};
  EXPECT_EQ(Eigen::MatrixXd(submatrix(matrix_of(whole), rows, columns)), expected);
  EXPECT_EQ(dense_submatrix(matrix_of(whole), rows, columns), expected);
}

TEST(Submatrix, CountsFromTheBlockAndLeavesOutWhatStandsAboveIt) {
  Eigen::MatrixXd whole(3, 3);
  whole << 11, 12, 13, 21, 22, 23, 31, 32, 33;
  Eigen::MatrixXd expected(2, 1);
  expected << 33, 23;
  EXPECT_EQ(Eigen::MatrixXd(submatrix(matrix_of(whole), {1, 0}, {1}, 1)), expected);
  EXPECT_EQ(dense_submatrix(matrix_of(whole), {1, 0}, {1}, 1), expected);
}

}  // namespace massless_test
}  // namespace pounding
