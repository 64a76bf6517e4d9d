#pragma once
/// The columns of the gap Jacobian B, or of the outputs, in the coordinates of blocks that are solved each by itself.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include <pounding/linear/column_sums.hpp>

namespace pounding {

/// Dense columns, block by block: only links with an end in a block have one there. Every number is one sum over the
/// coordinates in their order, one block after the other, so that its bits do not depend on which links are asked for
/// together.
class LinkColumns {
 public:
  /// Number of links of the system.
  explicit LinkColumns(int links = 0) : count_(links) {}

  /// The ends of these links in the coordinates from `first` on; links ascending, columns [coordinate, link]. Blocks
  /// come in ascending order.
  void add_block(int first, std::vector<int> links, Eigen::MatrixXd columns);

  /// B^T x for all links [links x columns of x].
  void gather(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const;
  /// y += factor B f, on coordinates from `from` on; f has one force a link.
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y, int from = 0) const;

  /// The links, ascending, that the functions below are for. True if they are others than before.
  bool choose(std::span<const int> links);
  /// As gather(), for these links [chosen links x columns of x].
  void gather_chosen(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const;
  /// G = B^T D B with a diagonal D, one number a coordinate.
  void flexibility(const Eigen::VectorXd& d, Eigen::MatrixXd& g) const;
  /// G = B^T A^-1 B; `solve` replaces a column, in the coordinates from `first` on, by A^-1 times it.
  using Solve = std::function<void(int first, Eigen::VectorXd& column)>;
  void flexibility(const Solve& solve, Eigen::MatrixXd& g) const;
  /// y += factor D B f, on coordinates from `from` on; f has one force a chosen link.
  void add_response(double factor, const Eigen::VectorXd& f, const Eigen::VectorXd& d, Eigen::Ref<Eigen::VectorXd> y,
                    int from = 0) const;
  /// y += factor A^-1 B f likewise.
  void add_response(double factor, const Eigen::VectorXd& f, const Solve& solve, Eigen::Ref<Eigen::VectorXd> y,
                    int from = 0) const;

 private:
  struct Entry {
    int coordinate = 0, link = 0;
    double value = 0;
  };
  struct Block {
    int first = 0;
    std::vector<int> links;   // or, where they are chosen, their places among the chosen ones
    Eigen::MatrixXd by_link;  // [coordinate, link]
    Eigen::MatrixXd by_coordinate;
    std::vector<Entry>
        entries;          // of this small block and of the small ones right behind it, which then have none; by link
    bool begins = false;  // it is the first one, and these entries are of all links: their sums begin here

    Eigen::Index size() const { return by_link.rows(); }
    bool is_small() const;
  };

  static void find_entries(std::vector<Block>& blocks, int count);
  template <int columns, bool begins>
  static void add_closing(const std::vector<Entry>& entries, const double* x, Eigen::Index x_stride, double* relative,
                          Eigen::Index stride);
  template <bool begins>
  static void add_closing(const std::vector<Entry>& entries, const Eigen::Ref<const Eigen::MatrixXd>& x,
                          Eigen::MatrixXd& relative);

  void gather(const std::vector<Block>& blocks, int count, const Eigen::Ref<const Eigen::MatrixXd>& x,
              Eigen::MatrixXd& relative) const;
  void add(const std::vector<Block>& blocks, double factor, const Eigen::VectorXd& f, const double* d, double* y,
           int from) const;

  int count_ = 0;
  std::vector<Block> blocks_, chosen_blocks_;
  std::vector<int> chosen_;
  // Room to work in.
  mutable Eigen::MatrixXd weighed_, sums_;
  mutable Eigen::VectorXd solved_;
  mutable std::vector<ScaledColumn> scaled_;
};

}  // namespace pounding
