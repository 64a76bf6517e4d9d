#pragma once
/// Displacements of the nodes of a member as factors of the unknowns of a frame.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include <pounding/frames/beam.hpp>
#include <pounding/frames/frame.hpp>

namespace pounding {

/// The twelve displacements of a member between two nodes. Of a plane frame, only ux, uz and ry are used.
class MemberUnknowns {
 public:
  /// `start` and `end` are nodes of the frame.
  MemberUnknowns(const AssembledFrame& assembled, int start, int end);

  /// Displacements of the nodes from the unknowns q.
  Vector12 displacements(const Eigen::VectorXd& q) const {
    Vector12 u = Vector12::Zero();
    for (const auto& row : rows_) u[row.row()] += row.value() * q[row.col()];
    return u;
  }
  /// Adds forces on the nodes to those on the unknowns.
  void add_force(const Vector12& force, Eigen::VectorXd& sum) const {
    for (const auto& row : rows_) sum[row.col()] += row.value() * force[row.row()];
  }
  /// Entries of a matrix of the member in one of the frame.
  void add_entries(const Matrix12& matrix, std::vector<Eigen::Triplet<double>>& entries) const;

  /// Finds the places of these entries in a compressed matrix of the frame, which contains them.
  void find_places(const Eigen::SparseMatrix<double>& of_frame);
  /// Adds a matrix of the member to the values of a matrix with the same pattern.
  void add_to(double* values, const Matrix12& matrix) const {
    const int* place = places_.data();
    for (const auto& b : rows_)
      for (const auto& a : rows_) values[*place++] += a.value() * matrix(a.row(), b.row()) * b.value();
  }

 private:
  std::vector<Eigen::Triplet<double>> rows_;  // displacement of the member, unknown, factor
  std::vector<int> places_;                   // of each pair of rows, first index fastest
};

}  // namespace pounding
