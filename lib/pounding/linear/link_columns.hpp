#pragma once
/// Columns of the gap Jacobian B, or of the outputs, in coordinates of independently solved blocks.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include <pounding/linear/column_sums.hpp>

namespace pounding {

/// Dense columns by block; only links with an end in a block have a column there. Each result is one sum over the
/// coordinates in order, block by block, so it is bitwise independent of the set of links requested.
class LinkColumns {
 public:
  /// Number of links of the system.
  explicit LinkColumns(int links = 0) : count_(links) {}

  /// Adds the ends of these links in the coordinates from `first` on; links ascending, columns [coordinate, link].
  /// Blocks are added in ascending order.
  void add_block(int first, std::vector<int> links, Eigen::MatrixXd columns);

  /// B^T x for all links [links x columns of x].
  void gather(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const;
  /// y += factor B f; f has one force per link.
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const;

  /// Selects the links, ascending, for the functions below. True if the selection changed.
  bool choose(std::span<const int> links);
  /// As gather(), for the selected links [selected links x columns of x].
  void gather_chosen(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const;
  /// G = B^T D B with a diagonal D, one number per coordinate.
  void flexibility(const Eigen::VectorXd& d, Eigen::MatrixXd& g) const;
  /// G = B^T A^-1 B; `solve` replaces the given column, in the coordinates from `first` on, by A^-1 times it.
  using Solve = std::function<void(int first, Eigen::VectorXd& column)>;
  void flexibility(const Solve& solve, Eigen::MatrixXd& g) const;
  /// y += factor D B f; f has one force per selected link.
  void add_response(double factor, const Eigen::VectorXd& f, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> y) const;
  /// y += factor A^-1 B f, with the same conventions.
  void add_response(double factor, const Eigen::VectorXd& f, const Solve& solve, Eigen::Ref<Eigen::VectorXd> y) const;

 private:
  struct Entry {
    int coordinate = 0, link = 0;
    double value = 0;
  };
  struct Block {
    int first = 0;
    std::vector<int> links;   // in a selection: positions within it
    Eigen::MatrixXd by_link;  // [coordinate, link]
    Eigen::MatrixXd by_coordinate;
    // entries of this small block and of the adjacent small blocks after it, which then have none; sorted by link
    std::vector<Entry> entries;
    // true for the first block if its entries cover all links: their sums start here
    bool begins = false;

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

  static void gather(const std::vector<Block>& blocks, int count, const Eigen::Ref<const Eigen::MatrixXd>& x,
                     Eigen::MatrixXd& relative);
  static void add(const std::vector<Block>& blocks, double factor, const Eigen::VectorXd& f, const double* d,
                  double* y);

  int count_ = 0;
  std::vector<Block> blocks_, chosen_blocks_;
  std::vector<int> chosen_;
};

}  // namespace pounding
