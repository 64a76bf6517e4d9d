#include <pounding/linear/link_ends.hpp>

#include <algorithm>

namespace pounding::petsc {

LinkEnds::LinkEnds(const System& system, const SystemMatrices& matrices, const SpringRelief& relief)
    : matrices_(matrices) {
  const int first = matrices.first(), end = first + matrices.rows();
  slots_.resize(system.links());
  for (int i = 0; i < system.links(); ++i)
    for (std::size_t k = 0; k < system.groups.size(); ++k) {
      const Group& group = system.groups[k];
      Part part{.link = i, .slot = slots(), .entries = {}, .push = {}};
      bool joined = false;
      for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it) {
        if (it.value() == 0 || it.row() < group.first || it.row() >= group.first + group.count) continue;
        joined = true;
        if (it.row() >= first && it.row() < end)
          part.entries.emplace_back(static_cast<int>(it.row()) - first, it.value());
      }
      if (!joined) continue;
      slots_[i].push_back(part.slot);
      group_of_.push_back(static_cast<int>(k));
      part.gives_way = relief.push().size() > 0 && is_spring(system, i);
      if (part.gives_way)
        for (SparseMatrix::InnerIterator it(relief.push(), i - system.contact_count()); it; ++it)
          if (it.row() >= first && it.row() < end && it.row() >= group.first && it.row() < group.first + group.count)
            part.push.emplace_back(static_cast<int>(it.row()) - first, it.value());
      if (!part.entries.empty() || !part.push.empty()) parts_.push_back(std::move(part));
    }
  make_batches();
}

bool LinkEnds::joins(int link, int group) const {
  return std::any_of(slots_[link].begin(), slots_[link].end(), [&](int slot) { return group_of_[slot] == group; });
}

// Each link joins the first batch without any of its groups.
void LinkEnds::make_batches() {
  const int groups = group_of_.empty() ? 0 : *std::max_element(group_of_.begin(), group_of_.end()) + 1;
  std::vector<std::vector<bool>> taken;
  batch_of_.resize(slots_.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto is_free = [&](const std::vector<bool>& by) {
      return std::none_of(slots_[i].begin(), slots_[i].end(), [&](int slot) { return by[group_of_[slot]]; });
    };
    const std::size_t to = std::find_if(taken.begin(), taken.end(), is_free) - taken.begin();
    if (to == taken.size()) {
      taken.emplace_back(groups);
      batches_.emplace_back();
    }
    for (const int slot : slots_[i]) taken[to][group_of_[slot]] = true;
    batches_[to].push_back(static_cast<int>(i));
    batch_of_[i] = static_cast<int>(to);
  }
}

Eigen::MatrixXd LinkEnds::by_slot(Eigen::Ref<const Eigen::MatrixXd> x) const {
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(slots(), x.cols());
  for (const Part& part : parts_)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      double sum = 0;
      for (const auto& [row, value] : part.entries) sum += value * x(row, j);
      ends(part.slot, j) = sum;
    }
  matrices_.combine({ends.data(), static_cast<std::size_t>(ends.size())});
  return ends;
}

void LinkEnds::gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const {
  const Eigen::MatrixXd ends = by_slot(x);
  relative.resize(static_cast<Eigen::Index>(slots_.size()), x.cols());
  for (std::size_t i = 0; i < slots_.size(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      double sum = 0;
      for (const int slot : slots_[i]) sum += ends(slot, j);
      relative(static_cast<Eigen::Index>(i), j) = sum;
    }
}

void LinkEnds::add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const {
  for (const Part& part : parts_) {
    const double scale = factor * f[part.link];
    if (scale == 0) continue;
    for (const auto& [row, value] : part.forces()) y[row] += scale * value;
  }
}

void LinkEnds::add_columns(std::span<const int> column_of, int first, Eigen::Ref<Eigen::MatrixXd> b) const {
  for (const Part& part : parts_)
    if (const int at = column_of[part.link]; at >= first)
      for (const auto& [row, value] : part.forces()) b(row, at - first) += value;
}

}  // namespace pounding::petsc
