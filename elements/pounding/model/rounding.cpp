#include <pounding/model/rounding.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>

#include <pounding/model/place_ends.hpp>

namespace pounding {

double displacement_rounding(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction,
                             const Eigen::VectorXd& u) {
  if (u.size() == 0) return 0;
  const Eigen::VectorXd row = motion_along(end, direction, s.size());
  constexpr double eps = std::numeric_limits<double>::epsilon();
  // Round-off of the sum r'u itself.
  const double of_sum = eps * row.cwiseAbs().dot(u.cwiseAbs());
  if (s.at_rest.size() == 0 && s.preload_displacement.size() == 0) return of_sum;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(s.stiffness);
  if (factor.info() != Eigen::Success) return of_sum;
  Eigen::Index max_in_a_row = 0;
  for (Eigen::Index j = 0; j < s.stiffness.outerSize(); ++j)
    max_in_a_row =
        std::max<Eigen::Index>(max_in_a_row, s.stiffness.outerIndexPtr()[j + 1] - s.stiffness.outerIndexPtr()[j]);
  const Eigen::VectorXd answer = factor.solve(row), change = s.stiffness.cwiseAbs() * u.cwiseAbs();
  return of_sum + static_cast<double>(max_in_a_row) * eps * answer.cwiseAbs().dot(change);
}

}  // namespace pounding
