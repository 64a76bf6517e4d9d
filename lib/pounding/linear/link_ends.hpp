#pragma once
/// Columns of the gap Jacobian B by process and structure.

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include <pounding/linear/spring_relief.hpp>
#include <pounding/linear/system_matrices.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// A slot is the section of a link's column of B that lies in one group. Slots are numbered over all links, equally on
/// every process.
///
/// Links without a common structure are batched: A is block-diagonal, so one right-hand side serves the whole batch.
class LinkEnds {
 public:
  /// `relief` belongs to the springs of the system; the other arguments must outlive this.
  LinkEnds(const System& system, const SystemMatrices& matrices, const SpringRelief& relief);

  /// Number of slots, the slots of a link, and the group of a slot.
  int slots() const { return static_cast<int>(group_of_.size()); }
  std::span<const int> slots_of(int link) const { return slots_[link]; }
  int group_of(int slot) const { return group_of_[slot]; }
  /// True if a link has an end in a group.
  bool joins(int link, int group) const;

  /// Number of batches, the links of a batch, and the batch of a link.
  int batches() const { return static_cast<int>(batches_.size()); }
  const std::vector<int>& batch(int number) const { return batches_[number]; }
  int batch_of(int link) const { return batch_of_[link]; }

  /// B^T x by slot [slots x columns of x], identical on every process, for x without spring relief. Collective.
  Eigen::MatrixXd by_slot(Eigen::Ref<const Eigen::MatrixXd> x) const;
  /// B^T x by link [links x columns of x], identical on every process. Collective.
  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const;
  /// y += factor B f, with B_e for springs and one force per link, on the rows of this process.
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const;
  /// Adds the column of B (B_e for springs) of each link to column column_of[link] - first of b, unless that index is
  /// negative.
  void add_columns(std::span<const int> column_of, int first, Eigen::Ref<Eigen::MatrixXd> b) const;

 private:
  struct Part {
    int link = 0, slot = 0;
    std::vector<std::pair<int, double>> entries;  // row on this process, value
    std::vector<std::pair<int, double>> push;     // same for B_e, if different
    bool gives_way = false;
    const std::vector<std::pair<int, double>>& forces() const { return gives_way ? push : entries; }
  };

  void make_batches();

  const SystemMatrices& matrices_;
  std::vector<Part> parts_;
  std::vector<std::vector<int>> slots_;  // of each link
  std::vector<int> group_of_;            // of each slot
  std::vector<std::vector<int>> batches_;
  std::vector<int> batch_of_;  // of each link
};

}  // namespace pounding::petsc
