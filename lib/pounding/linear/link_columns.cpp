#include <pounding/linear/link_columns.hpp>

#include <algorithm>
#include <utility>

namespace pounding {

using Eigen::Index;

// The sums of one link (one per column) are kept in registers over its contiguous entries; otherwise each addition
// would wait for the previous store.
template <int columns, bool begins>
void LinkColumns::add_closing(const std::vector<Entry>& entries, const double* x, Index x_stride, double* relative,
                              Index stride) {
  const Entry *entry = entries.data(), *const end = entry + entries.size();
  while (entry != end) {
    double* const to = relative + entry->link;
    double sums[columns];
    for (int c = 0; c < columns; ++c) sums[c] = begins ? 0 : to[c * stride];
    const int link = entry->link;
    do {
      for (int c = 0; c < columns; ++c) sums[c] += entry->value * x[entry->coordinate + c * x_stride];
    } while (++entry != end && entry->link == link);
    for (int c = 0; c < columns; ++c) to[c * stride] = sums[c];
  }
}

template <bool begins>
void LinkColumns::add_closing(const std::vector<Entry>& entries, const Eigen::Ref<const Eigen::MatrixXd>& x,
                              Eigen::MatrixXd& relative) {
  const Index columns = x.cols(), x_stride = x.outerStride(), stride = relative.rows();
  const double* of = x.data();
  double* to = relative.data();
  Index c = 0;
  for (; c + 3 <= columns; c += 3, of += 3 * x_stride, to += 3 * stride)
    add_closing<3, begins>(entries, of, x_stride, to, stride);
  for (; c < columns; ++c, of += x_stride, to += stride) add_closing<1, begins>(entries, of, x_stride, to, stride);
}

bool LinkColumns::Block::is_small() const { return by_link.size() <= few_entries; }

void LinkColumns::add_block(int first, std::vector<int> links, Eigen::MatrixXd columns) {
  if (links.empty()) return;
  Block& block = blocks_.emplace_back();
  block.first = first;
  block.links = std::move(links);
  block.by_link = std::move(columns);
  block.by_coordinate = block.by_link.transpose();
  find_entries(blocks_, count_);
}

void LinkColumns::find_entries(std::vector<Block>& blocks, int count) {
  Block* first = nullptr;
  const auto sort = [&] {
    if (!first) return;
    std::ranges::stable_sort(first->entries, {}, &Entry::link);
    int links = 0, last = -1;
    for (const Entry& entry : first->entries) links += std::exchange(last, entry.link) != entry.link;
    first->begins = first == blocks.data() && links == count;
  };
  for (Block& block : blocks) {
    block.entries.clear();
    block.begins = false;
    if (!block.is_small()) {
      sort();
      first = nullptr;
      continue;
    }
    if (!first) first = &block;
    for (std::size_t i = 0; i < block.links.size(); ++i)
      for (int k = 0; k < block.size(); ++k)
        first->entries.push_back({block.first + k, block.links[i], block.by_link(k, static_cast<Index>(i))});
  }
  sort();
}

void LinkColumns::gather(const std::vector<Block>& blocks, int count, const Eigen::Ref<const Eigen::MatrixXd>& x,
                         Eigen::MatrixXd& relative) {
  const Index columns = x.cols();
  relative.resize(count, columns);
  const bool begins = !blocks.empty() && blocks.front().begins;
  if (begins)
    add_closing<true>(blocks.front().entries, x, relative);
  else
    std::fill_n(relative.data(), relative.size(), 0.0);
  Eigen::MatrixXd room;
  for (const Block& block : blocks) {
    if (block.is_small()) {
      if (!block.begins && !block.entries.empty()) add_closing<false>(block.entries, x, relative);
      continue;
    }
    const Index ends = block.by_link.cols();
    add_products({block.by_coordinate.data(), ends, block.size(), ends},
                 {x.data() + block.first, block.size(), columns, x.outerStride()}, block.links, relative, room);
  }
}

void LinkColumns::gather(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const {
  gather(blocks_, count_, x, relative);
}
void LinkColumns::gather_chosen(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::MatrixXd& relative) const {
  gather(chosen_blocks_, static_cast<int>(chosen_.size()), x, relative);
}

void LinkColumns::add(const std::vector<Block>& blocks, double factor, const Eigen::VectorXd& f, const double* d,
                      double* y) {
  std::vector<ScaledColumn> scaled;
  for (const Block& block : blocks) {
    if (block.is_small()) {
      for (const Entry& entry : block.entries) {
        const double scale = factor * f[entry.link];
        if (scale != 0) y[entry.coordinate] += (d ? scale * d[entry.coordinate] : scale) * entry.value;
      }
      continue;
    }
    scaled.clear();
    for (std::size_t i = 0; i < block.links.size(); ++i)
      if (const double scale = factor * f[block.links[i]]; scale != 0)
        scaled.push_back({block.by_link.col(static_cast<Index>(i)).data(), scale});
    if (!scaled.empty()) add_scaled(scaled, block.size(), d ? d + block.first : nullptr, y + block.first);
  }
}

void LinkColumns::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  add(blocks_, factor, f, nullptr, y.data());
}

bool LinkColumns::choose(std::span<const int> links) {
  if (std::ranges::equal(links, chosen_)) return false;
  chosen_.assign(links.begin(), links.end());
  std::size_t used = 0;
  for (const Block& block : blocks_) {
    std::vector<int> places;
    std::vector<Index> own;
    auto it = block.links.begin();
    // Usually a block has none of the selected links; this skips them without a scan.
    const auto first = std::lower_bound(chosen_.begin(), chosen_.end(), block.links.front());
    for (auto place = static_cast<std::size_t>(first - chosen_.begin()); place < chosen_.size(); ++place) {
      it = std::lower_bound(it, block.links.end(), chosen_[place]);
      if (it == block.links.end()) break;
      if (*it != chosen_[place]) continue;
      places.push_back(static_cast<int>(place));
      own.push_back(it - block.links.begin());
    }
    if (places.empty()) continue;
    if (used == chosen_blocks_.size()) chosen_blocks_.emplace_back();
    Block& made = chosen_blocks_[used++];
    made.first = block.first;
    made.links = std::move(places);
    made.by_link.resize(block.size(), static_cast<Index>(own.size()));
    for (std::size_t i = 0; i < own.size(); ++i) made.by_link.col(static_cast<Index>(i)) = block.by_link.col(own[i]);
    made.by_coordinate = made.by_link.transpose();
  }
  chosen_blocks_.resize(used);
  find_entries(chosen_blocks_, static_cast<int>(chosen_.size()));
  return true;
}

// Computes the rows of the links up to the diagonal, three at a time; entries beyond the diagonal are discarded.
void LinkColumns::flexibility(const Eigen::VectorXd& d, Eigen::MatrixXd& g) const {
  g.setZero(static_cast<Index>(chosen_.size()), static_cast<Index>(chosen_.size()));
  Eigen::MatrixXd weighed, sums;
  for (const Block& block : chosen_blocks_) {
    const Index ends = block.by_link.cols(), size = block.size();
    const auto enter = [&](Index i, Index j, double sum) {
      const int row = block.links[static_cast<std::size_t>(i)], column = block.links[static_cast<std::size_t>(j)];
      g(row, column) += sum;
      if (row != column) g(column, row) += sum;
    };
    if (block.is_small()) {
      for (Index j = 0; j < ends; ++j)
        for (Index i = 0; i <= j; ++i) {
          double sum = 0;
          for (Index k = 0; k < size; ++k) sum += block.by_link(k, i) * d[block.first + k] * block.by_link(k, j);
          enter(i, j, sum);
        }
      continue;
    }
    weighed.resize(ends, size);
    for (Index k = 0; k < size; ++k)
      for (Index i = 0; i < ends; ++i) weighed(i, k) = block.by_coordinate(i, k) * d[block.first + k];
    constexpr Index together = 3;
    for (Index j = 0; j < ends; j += together) {
      const Index columns = std::min(together, ends - j), rows = j + columns;
      sums.setZero(rows, columns);
      add_products({weighed.data(), rows, size, ends}, {block.by_link.col(j).data(), size, columns, size}, sums.data(),
                   rows);
      for (Index c = 0; c < columns; ++c)
        for (Index i = 0; i <= j + c; ++i) enter(i, j + c, sums(i, c));
    }
  }
}

void LinkColumns::flexibility(const Solve& solve, Eigen::MatrixXd& g) const {
  g.setZero(static_cast<Index>(chosen_.size()), static_cast<Index>(chosen_.size()));
  Eigen::VectorXd solved;
  for (const Block& block : chosen_blocks_)
    for (std::size_t j = 0; j < block.links.size(); ++j) {
      solved = block.by_link.col(static_cast<Index>(j));
      solve(block.first, solved);
      for (std::size_t i = 0; i <= j; ++i) {
        const double sum = block.by_link.col(static_cast<Index>(i)).dot(solved);
        g(block.links[i], block.links[j]) += sum;
        if (i != j) g(block.links[j], block.links[i]) += sum;
      }
    }
}

void LinkColumns::add_response(double factor, const Eigen::VectorXd& f, const Eigen::VectorXd& d,
                               Eigen::Ref<Eigen::VectorXd> y) const {
  add(chosen_blocks_, factor, f, d.data(), y.data());
}

void LinkColumns::add_response(double factor, const Eigen::VectorXd& f, const Solve& solve,
                               Eigen::Ref<Eigen::VectorXd> y) const {
  Eigen::VectorXd solved;
  for (const Block& block : chosen_blocks_) {
    for (std::size_t j = 0; j < block.links.size(); ++j) {
      solved = block.by_link.col(static_cast<Index>(j));
      solve(block.first, solved);
      y.segment(block.first, block.size()) += factor * f[block.links[j]] * solved;
    }
  }
}

}  // namespace pounding
