#include <pounding/linear/system_checks.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/linear/spring_relief.hpp>

namespace pounding::petsc {
namespace {

// A pivot below this fraction of its diagonal entry indicates a singular matrix.
constexpr double min_pivot = 1e-12;

// Borders between groups, where the entries of the stiffness matrix come nearest to even parts.
std::vector<int> rows_by_groups(const System& system, int processes) {
  const int groups = static_cast<int>(system.groups.size());
  std::vector<double> entries(groups + 1, 0.0);
  for (int k = 0; k < groups; ++k) {
    const Group& group = system.groups[k];
    entries[k + 1] = entries[k] + 1;
    for (int j = group.first; j < group.first + group.count; ++j)
      for (SparseMatrix::InnerIterator it(system.stiffness, j); it; ++it) entries[k + 1] += 1;
  }
  std::vector<int> first{0};
  int border = 0;
  for (int r = 1; r < processes; ++r) {
    const double even = entries[groups] * r / processes;
    ++border;
    while (border < groups - (processes - r) && std::abs(entries[border + 1] - even) < std::abs(entries[border] - even))
      ++border;
    first.push_back(system.groups[border].first);
  }
  first.push_back(system.size());
  return first;
}

}  // namespace

bool shares_whole_groups(const System& system, int processes) {
  return static_cast<int>(system.groups.size()) >= processes;
}

std::vector<int> first_rows(const System& system, int processes) {
  if (shares_whole_groups(system, processes)) return rows_by_groups(system, processes);
  std::vector<int> first;
  for (int r = 0; r <= processes; ++r)
    first.push_back(static_cast<int>(static_cast<long>(system.size()) * r / processes));
  return first;
}

void require_groups(const System& system) {
  std::vector<int> group_of(system.size(), -1);
  int next = 0;
  for (std::size_t k = 0; k < system.groups.size(); ++k) {
    const Group& group = system.groups[k];
    if (group.first != next || group.count < 1)
      throw std::invalid_argument(
          fmt::format("group {} begins at degree of freedom {}, not at {}", k, group.first, next));
    next += group.count;
    for (int i = group.first; i < std::min(next, system.size()); ++i) group_of[i] = static_cast<int>(k);
  }
  if (next != system.size())
    throw std::invalid_argument(
        fmt::format("the groups contain {} degrees of freedom, the system {}", next, system.size()));
  for (const SparseMatrix* matrix : {&system.mass, &system.damping, &system.stiffness})
    for (int j = 0; j < matrix->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
        if (group_of[it.row()] != group_of[j])
          throw std::invalid_argument(
              fmt::format("a matrix entry couples degrees of freedom {} and {} of different groups", it.row(), j));
}

void require_masses(const System& system, const Eigen::VectorXd& diagonal) {
  const Eigen::VectorXd stiffness = system.stiffness.diagonal();
  const auto has_mass = [&](Eigen::Index i) { return diagonal[i] > 0; };
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (!(diagonal[i] >= 0))
      throw std::invalid_argument(fmt::format("the mass of degree of freedom {} is negative", i));
    if (!has_mass(i) && !(stiffness[i] > 0))
      throw std::invalid_argument(fmt::format("degree of freedom {} has neither mass nor stiffness", i));
  }
  for (int j = 0; j < system.damping.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(system.damping, j); it; ++it)
      if (it.value() != 0 && !(has_mass(j) && has_mass(it.row())))
        throw std::invalid_argument(
            fmt::format("a dashpot acts on massless degree of freedom {}", has_mass(j) ? it.row() : j));
  for (int i = 0; i < system.links(); ++i) {
    if (is_spring(system, i)) continue;
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it)
      if (it.value() != 0 && !has_mass(it.row()))
        throw std::invalid_argument(fmt::format("link {} acts on massless degree of freedom {}", i, it.row()));
  }
}

void fail_singular(const SparseMatrix& matrix, const std::vector<int>& dofs, const char* what) {
  const SparseMatrix part = submatrix(matrix, dofs, dofs);
  const int count = static_cast<int>(dofs.size());
  Eigen::SimplicialLDLT<SparseMatrix> factor(part);
  std::string place;
  if (factor.vectorD().size() == count) {
    const Eigen::VectorXd pivots = factor.permutationPinv() * Eigen::VectorXd(factor.vectorD());
    for (int i = 0; i < count && place.empty(); ++i)
      if (!(pivots[i] > min_pivot * part.coeff(i, i)))
        place = fmt::format(": unknown {} moves without resistance", dofs[i]);
  }
  throw SolverError(fmt::format("{} is singular or not positive definite{}", what, place));
}

}  // namespace pounding::petsc
