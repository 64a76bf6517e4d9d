#pragma once
/// The columns B of the links by process and by the structures that they join.

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include <pounding/linear/system_matrices.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// A slot is the part of a link's column in one group; slots count over all links and processes.
///
/// Links that share no group form a bundle: A^-1 keeps their columns of B apart, so that one solve serves them all.
class LinkEnds {
 public:
  /// Both must outlive this.
  LinkEnds(const System& system, const SystemMatrices& matrices);

  /// How many slots there are, those of a link, and where a slot belongs.
  int slots() const { return static_cast<int>(group_of_.size()); }
  std::span<const int> slots_of(int link) const { return slots_[link]; }
  int group_of(int slot) const { return group_of_[slot]; }
  bool joins(int link, int group) const;

  /// How many bundles there are, the links of one, and the one of a link.
  int bundles() const { return static_cast<int>(bundles_.size()); }
  const std::vector<int>& bundle(int number) const { return bundles_[number]; }
  int bundle_of(int link) const { return bundle_of_[link]; }

  /// Columns of B^T x by slot, the same on every process; collective. Valid until the next call.
  Eigen::Map<const Eigen::MatrixXd> by_slot(Eigen::Ref<const Eigen::MatrixXd> x) const;
  /// Columns of B^T x by link; collective.
  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const;
  /// y += factor B f on the rows of this process.
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const;
  /// Adds B of each link to column place[link] - first of b, where that is not negative.
  void add_columns(std::span<const int> place, int first, Eigen::Ref<Eigen::MatrixXd> b) const;

 private:
  struct Part {
    int link = 0, slot = 0;
    std::vector<std::pair<int, double>> entries;  // on this process
  };

  void bundle();

  const SystemMatrices& matrices_;
  std::vector<Part> parts_;
  std::vector<std::vector<int>> slots_;  // of each link
  std::vector<int> group_of_;            // each slot
  std::vector<std::vector<int>> bundles_;
  std::vector<int> bundle_of_;  // each link
  mutable std::vector<double> ends_;
};

}  // namespace pounding::petsc
