#include <pounding/linear/spring_relief.hpp>

#include <Eigen/SparseCholesky>
#include <stdexcept>
#include <vector>

namespace pounding {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// y += factor A f, reading only the columns with nonzero f.
void add_product(const SparseMatrix& a, double factor, Eigen::Ref<const Eigen::VectorXd> f,
                 Eigen::Ref<Eigen::VectorXd> y) {
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const double scale = factor * f[j];
    if (scale == 0) continue;
    for (SparseMatrix::InnerIterator it(a, j); it; ++it) y[it.row()] += scale * it.value();
  }
}

// Springs that act on a massless degree of freedom of this group.
std::vector<int> springs_without_mass(const SparseMatrix& columns, const std::vector<int>& massless, int first) {
  std::vector<int> springs;
  std::vector<bool> light(static_cast<std::size_t>(columns.rows()), false);
  for (const int i : massless) light[first + i] = true;
  for (int j = 0; j < columns.cols(); ++j)
    for (SparseMatrix::InnerIterator it(columns, j); it; ++it)
      if (it.value() != 0 && light[it.row()]) {
        springs.push_back(j);
        break;
      }
  return springs;
}

}  // namespace

SpringRelief::SpringRelief(const System& system) {
  const int count = system.spring_count();
  if (count == 0 || system.links() < system.contact_count() + count) return;
  const SparseMatrix columns = system.gap_jacobian.middleCols(system.contact_count(), count);
  Triplets way;
  for (const Group& group : system.groups) {
    const std::vector<int> massless = split_by_mass(system.mass, group.first, group.count).massless;
    const std::vector<int> springs = springs_without_mass(columns, massless, group.first);
    if (springs.empty()) continue;
    if (group.elastic || group.tangent)
      throw std::invalid_argument(
          "a spring acts on a massless degree of freedom of a structure whose members have large rotations or fibres");
    const Eigen::SimplicialLDLT<SparseMatrix> factor(submatrix(system.stiffness, massless, massless, group.first));
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0))
      throw std::invalid_argument("a massless degree of freedom has no stiffness");
    std::vector<int> place(static_cast<std::size_t>(system.size()), -1);
    for (std::size_t i = 0; i < massless.size(); ++i) place[group.first + massless[i]] = static_cast<int>(i);
    for (const int spring : springs) {
      Eigen::VectorXd given = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(massless.size()));
      for (SparseMatrix::InnerIterator it(columns, spring); it; ++it)
        if (place[it.row()] >= 0) given[place[it.row()]] = it.value();
      given = factor.solve(given);
      for (std::size_t i = 0; i < massless.size(); ++i)
        if (given[static_cast<Eigen::Index>(i)] != 0)
          way.emplace_back(group.first + massless[i], spring, given[static_cast<Eigen::Index>(i)]);
    }
  }
  flexibility_ = system.spring_flexibility;
  if (way.empty()) return;
  way_.resize(system.size(), count);
  way_.setFromTriplets(way.begin(), way.end());
  // B_s^T W is symmetric up to round-off.
  const SparseMatrix given = columns.transpose() * way_, mirrored = given.transpose();
  const SparseMatrix own = 0.5 * (given + mirrored);
  flexibility_ = system.spring_flexibility.size() > 0 ? SparseMatrix(own + system.spring_flexibility) : own;
  const SparseMatrix pushed = columns - system.stiffness * way_;
  Triplets push;
  for (int j = 0; j < count; ++j)
    for (SparseMatrix::InnerIterator it(pushed, j); it; ++it)
      if (has_mass(system.mass, static_cast<int>(it.row()))) push.emplace_back(it.row(), j, it.value());
  push_.resize(system.size(), count);
  push_.setFromTriplets(push.begin(), push.end());
}

void SpringRelief::add_relief(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::Ref<Eigen::VectorXd> y) const {
  add_product(flexibility_, factor, f, y);
}

void SpringRelief::add_way(double factor, Eigen::Ref<const Eigen::VectorXd> f, Eigen::VectorXd& u) const {
  add_product(way_, factor, f, u);
}

}  // namespace pounding
