#include <pounding/stepping/links/link_blocks.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

using Eigen::Index;

// Calls act(first, count, offset) for each block, where offset is the position of its first entry in contiguous storage
// of the blocks. Stops if a call returns false.
template <class Act>
bool each_block(const std::vector<Index>& ends, const Act& act) {
  Index first = 0, place = 0;
  for (const Index end : ends) {
    const Index count = end - first;
    if (!act(first, count, place)) return false;
    first = end;
    place += count * count;
  }
  return true;
}

// y = G x, where `term` combines entries of G and x. Terms are summed in the order of the links.
template <class Term>
void multiply_blocks(const std::vector<Index>& ends, const Eigen::MatrixXd& g, const Eigen::VectorXd& x,
                     Eigen::VectorXd& y, const Term& term) {
  y.setZero();
  each_block(ends, [&](Index first, Index count, Index) {
    for (Index j = first; j < first + count; ++j)
      for (Index i = first; i < first + count; ++i) y[i] += term(g(i, j), x[j]);
    return true;
  });
}

}  // namespace

void LinkBlocks::find(const Eigen::MatrixXd& flexibility) {
  const Index count = flexibility.rows();
  ends_.clear();
  block_.clear();
  if (count < many) {
    ends_.push_back(count);
    return;
  }
  reach_.resize(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) reach_[i] = i;
  for (Index j = 0; j < count; ++j) {
    const double* const column = flexibility.col(j).data();
    Index first = 0, last = count - 1;
    while (first < j && column[first] == 0) ++first;
    while (last > j && column[last] == 0) --last;
    reach_[first] = std::max(reach_[first], last);
  }
  for (Index i = 0, last = 0; i < count; ++i) {
    last = std::max(last, reach_[i]);
    block_.push_back(static_cast<Index>(ends_.size()));
    if (last == i) ends_.push_back(i + 1);
  }
}

std::pair<Index, Index> LinkBlocks::range(Index link) const {
  if (ends_.size() == 1) return {0, ends_.front()};
  const auto block = static_cast<std::size_t>(block_[link]);
  return {block == 0 ? 0 : ends_[block - 1], ends_[block]};
}

void LinkBlocks::multiply(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  if (ends_.size() == 1)
    y.noalias() = flexibility * x;
  else
    multiply_blocks(ends_, flexibility, x, y, [](double g, double f) { return g * f; });
}

void LinkBlocks::multiply_sizes(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x,
                                Eigen::VectorXd& y) const {
  y.resize(x.size());
  if (ends_.size() == 1)
    y.noalias() = flexibility.cwiseAbs() * x.cwiseAbs();
  else
    multiply_blocks(ends_, flexibility, x, y, [](double g, double f) { return std::abs(g) * std::abs(f); });
}

bool BlockFactors::stays(const LinkBlocks& blocks, const Eigen::MatrixXd& flexibility,
                         const Eigen::VectorXd& roots) const {
  if (blocks.ends() != ends_ || roots.size() != roots_.size() || roots != roots_) return false;
  return each_block(ends_, [&](Index first, Index count, Index place) {
    return Eigen::Map<const Eigen::MatrixXd>(flexibility_.data() + place, count, count) ==
           flexibility.block(first, first, count, count);
  });
}

bool BlockFactors::factorize(const LinkBlocks& blocks, const Eigen::MatrixXd& flexibility,
                             const Eigen::VectorXd& roots) {
  if (stays(blocks, flexibility, roots)) return true;
  ends_ = blocks.ends();
  Index numbers = 0;
  each_block(ends_, [&](Index, Index count, Index place) {
    numbers = place + count * count;
    return true;
  });
  flexibility_.resize(numbers);
  factors_.resize(numbers);
  roots_ = roots;
  const bool definite = each_block(ends_, [&](Index first, Index count, Index place) {
    Eigen::Map<Eigen::MatrixXd> g(flexibility_.data() + place, count, count),
        factor(factors_.data() + place, count, count);
    const auto r = roots.segment(first, count);
    g = flexibility.block(first, first, count, count);
    factor = r.asDiagonal() * g * r.asDiagonal();
    factor.diagonal().array() += 1;
    Eigen::Ref<Eigen::MatrixXd> in_place(factor);
    return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(in_place).info() == Eigen::Success;
  });
  if (!definite) roots_.resize(0);
  return definite;
}

void BlockFactors::solve(Eigen::VectorXd& x) const {
  each_block(ends_, [&](Index first, Index count, Index place) {
    const auto lower =
        Eigen::Map<const Eigen::MatrixXd>(factors_.data() + place, count, count).triangularView<Eigen::Lower>();
    auto part = x.segment(first, count);
    lower.solveInPlace(part);
    lower.adjoint().solveInPlace(part);
    return true;
  });
}

}  // namespace pounding
