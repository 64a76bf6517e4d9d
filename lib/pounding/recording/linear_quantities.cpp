#include <pounding/recording/linear_quantities.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <pounding/linear/wide_vectors.hpp>

namespace pounding {
namespace {

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

void add_row(std::vector<Eigen::Triplet<double>>& entries, int row, const Row& from, double factor, int first) {
  for (Row::InnerIterator it(from); it; ++it)
    entries.emplace_back(row, first + static_cast<int>(it.index()), factor * it.value());
}

// Everything that defines a quantity: columns and factors of its row, at_rest, by_ground. If the first factor is
// negative, all signs are reversed and the flag is true.
std::pair<std::vector<double>, bool> with_positive_front(const RowMajor& rows, int row, double at_rest,
                                                         const Eigen::RowVectorXd& by_ground) {
  std::vector<double> columns, factors;
  for (RowMajor::InnerIterator it(rows, row); it; ++it) {
    columns.push_back(static_cast<double>(it.col()));
    factors.push_back(it.value());
  }
  factors.push_back(at_rest);
  factors.insert(factors.end(), by_ground.begin(), by_ground.end());
  const bool turned = factors.front() < 0;
  for (double& factor : factors) factor = turned ? -factor : factor;
  columns.insert(columns.end(), factors.begin(), factors.end());
  return {std::move(columns), turned};
}

// Rows in compressed form, and the constants added to the first half of the sums of each row.
struct SparseRows {
  const int *begins, *columns;
  const double *factors, *at_rest;
  int count;
};

// Computes `numbers` sums of each row over the columns of `of`, which has `numbers` rows; the sums of a row are
// contiguous.
template <int numbers>
POUNDING_INLINE void sum_rows(const SparseRows& rows, const double* of, double* sums) {
  for (int row = 0; row < rows.count; ++row, sums += numbers) {
    double sum[numbers];  // in registers
    for (int k = 0; k < numbers; ++k) sum[k] = k < numbers / 2 ? rows.at_rest[row] : 0;
    for (int i = rows.begins[row]; i < rows.begins[row + 1]; ++i) {
      const double* const column = of + static_cast<std::ptrdiff_t>(numbers) * rows.columns[i];
      for (int k = 0; k < numbers; ++k) sum[k] += rows.factors[i] * column[k];
    }
    std::copy_n(sum, numbers, sums);
  }
}

template <int numbers>
POUNDING_WIDE void sum_rows_by_wide_vectors(const SparseRows& rows, const double* of, double* sums) {
  sum_rows<numbers>(rows, of, sums);
}

}  // namespace

LinearQuantities::LinearQuantities(const RowMajor& rows, int unknowns, int first, const Eigen::VectorXd& at_rest,
                                   const Eigen::MatrixXd& by_ground, const Choice& chosen, bool merge)
    : first_(first) {
  std::map<std::vector<double>, Place> known;
  std::vector<int> kept;
  for (int row = 0; row < rows.rows(); ++row) {
    if (!chosen(row)) {
      places_.push_back({-1, false});
      continue;
    }
    const Place next{static_cast<int>(kept.size()), false};
    if (merge) {
      auto [all, turned] = with_positive_front(rows, row, at_rest[row], by_ground.row(row));
      const auto [found, is_new] = known.try_emplace(std::move(all), Place{next.at, turned});
      if (!is_new) {
        places_.push_back({found->second.at, found->second.opposite != turned});
        continue;
      }
    }
    places_.push_back(next);
    kept.push_back(row);
  }
  std::vector<Eigen::Triplet<double>> entries, by_yielding;
  at_rest_.resize(static_cast<int>(kept.size()));
  by_ground_.resize(at_rest_.size(), by_ground.cols());
  for (int i = 0; i < size(); ++i) {
    for (RowMajor::InnerIterator it(rows, kept[i]); it; ++it) {
      const int column = static_cast<int>(it.col());
      if (column < unknowns)
        entries.emplace_back(i, column, it.value());
      else
        by_yielding.emplace_back(i, column - unknowns, it.value());
    }
    at_rest_[i] = at_rest[kept[i]];
    by_ground_.row(i) = by_ground.row(kept[i]);
  }
  rows_.resize(size(), unknowns);
  rows_.setFromTriplets(entries.begin(), entries.end());
  by_yielding_.resize(size(), rows.cols() - unknowns);
  by_yielding_.setFromTriplets(by_yielding.begin(), by_yielding.end());
  if (by_ground_.isZero(0)) by_ground_.resize(0, 0);
}

template <int instants>
void LinearQuantities::evaluate(const Instants<instants>& motions, std::span<const double> times,
                                std::span<const GroundMotion> grounds, Instants<instants>& quantities) const {
  quantities.resize(2 * instants, size());
  const SparseRows rows{rows_.outerIndexPtr(), rows_.innerIndexPtr(), rows_.valuePtr(), at_rest_.data(), size()};
  const double* const from = motions.data() + static_cast<std::ptrdiff_t>(2 * instants) * first_;
  if (has_wide_vectors())
    sum_rows_by_wide_vectors<2 * instants>(rows, from, quantities.data());
  else
    sum_rows<2 * instants>(rows, from, quantities.data());
  if (by_ground_.size() == 0) return;
  for (std::size_t g = 0; g < grounds.size(); ++g)
    for (std::size_t t = 0; t < times.size(); ++t) {
      const int at = static_cast<int>(t);
      quantities.row(at) += grounds[g].displacement(times[t]) * by_ground_.col(static_cast<int>(g)).transpose();
      quantities.row(instants + at) += grounds[g].velocity(times[t]) * by_ground_.col(static_cast<int>(g)).transpose();
    }
}

template void LinearQuantities::evaluate<1>(const Instants<1>&, std::span<const double>, std::span<const GroundMotion>,
                                            Instants<1>&) const;
template void LinearQuantities::evaluate<LinearQuantities::batch>(const Instants<batch>&, std::span<const double>,
                                                                  std::span<const GroundMotion>,
                                                                  Instants<batch>&) const;

void add_member_forces(std::vector<Eigen::Triplet<double>>& entries, const Structure& s, int first_row) {
  const auto add = [&](const RowMajor& from, int first_column) {
    for (int row = 0; row < from.outerSize(); ++row)
      for (RowMajor::InnerIterator it(from, row); it; ++it)
        if (it.value() != 0)
          entries.emplace_back(first_row + row, first_column + static_cast<int>(it.col()), it.value());
  };
  add(s.forces.rows, 0);
  add(s.forces.by_yielding, s.size());
}

LinearQuantities internal_forces(const Model& model, int structure, const GroundPlan& plan,
                                 const LinearQuantities::Choice& chosen, bool merge) {
  const Structure& s = model.structures[structure];
  std::vector<Eigen::Triplet<double>> entries;
  int shears = 0;
  for (const Floor& floor : s.floors)
    for (std::size_t j = 0; j < floor.storey_shear.size(); ++j, ++shears) {
      add_row(entries, shears, floor.storey_shear[j], 1, 0);
      if (!floor.storey_shear_by_yielding.empty())
        add_row(entries, shears, floor.storey_shear_by_yielding[j], 1, s.size());
    }
  add_member_forces(entries, s, shears);
  const int count = shears + static_cast<int>(s.forces.rows.rows());
  RowMajor rows(count, s.size() + static_cast<int>(s.yielding.size()));
  rows.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(count);
  at_rest.tail(s.forces.at_rest.size()) = s.forces.at_rest;
  if (s.at_rest.size() > 0) at_rest += rows.leftCols(s.size()) * s.at_rest;

  Eigen::MatrixXd by_ground = Eigen::MatrixXd::Zero(count, static_cast<int>(plan.motions.size()));
  if (s.supports.size() > 1) {
    std::vector<Eigen::MatrixX3d> influences;
    for (const Support& support : s.supports) {
      Eigen::MatrixX3d influence = rows.leftCols(s.size()) * support.influence;
      influence.topRows(shears) += support.shears;
      influence.bottomRows(count - shears) += support.forces;
      influences.push_back(std::move(influence));
    }
    for (int row = 0; row < count; ++row)
      plan.supports[structure].project([&](std::size_t q, int axis) { return influences[q](row, axis); },
                                       by_ground.row(row));
  }
  return {rows, s.size(), offsets(model)[structure], at_rest, by_ground, chosen, merge};
}

LinearQuantities approaches(const Model& model, const GroundPlan& plan) {
  const std::vector<int> first = offsets(model);
  const int count = 3 * static_cast<int>(model.links.size());
  int unknowns = 0;
  for (const Structure& s : model.structures) unknowns += s.size();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd by_ground = Eigen::MatrixXd::Zero(count, static_cast<int>(plan.motions.size()));
  for (int l = 0; l < static_cast<int>(model.links.size()); ++l) {
    const Link& link = model.links[l];
    const int relative = 3 * l + 2;
    for (const auto& [end, own, sign] :
         {std::tuple(&link.left, 3 * l, 1.0), std::tuple(&link.right, 3 * l + 1, -1.0)}) {
      const Structure& s = model.structures[end->structure];
      const SupportMotion& ground = plan.supports[end->structure];
      for (int i = 0; i < 3; ++i) {
        const double along = link.direction[i];
        if (along == 0) continue;
        add_row(entries, own, end->point.motion[i], along, first[end->structure]);
        add_row(entries, relative, end->point.motion[i], sign * along, first[end->structure]);
        if (s.at_rest.size() > 0) {
          const double moved = along * end->point.motion[i].dot(s.at_rest);
          at_rest[own] += moved;
          at_rest[relative] += sign * moved;
        }
        const auto influence = [&, end = end](std::size_t q, int axis) {
          double moved = end->point.motion[i].dot(s.supports[q].influence.col(axis));
          if (end->point.supported[i].nonZeros() > 0)
            moved += end->point.supported[i].dot(s.supports[q].enforced.col(axis));
          return along * moved;
        };
        Eigen::RowVectorXd by_difference = Eigen::RowVectorXd::Zero(by_ground.cols());
        ground.project(influence, by_difference);
        by_ground.row(own) += by_difference;
        by_ground.row(relative) += sign * by_difference;
        if (ground.at_first(i) >= 0) by_ground(relative, ground.at_first(i)) += sign * along;
      }
    }
  }
  RowMajor rows(count, unknowns);
  rows.setFromTriplets(entries.begin(), entries.end());
  return {rows, unknowns, 0, at_rest, by_ground, [](int) { return true; }, false};
}

}  // namespace pounding
