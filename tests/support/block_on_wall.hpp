#pragma once
/// A block with friction on a wall.

#include <Eigen/Core>
#include <vector>

#include <pounding/links/gap_link.hpp>
#include <pounding/model/system.hpp>
#include "support/direct.hpp"

namespace pounding::test {

/// A block that a spring presses on a wall with a constant force and that slides along it in one or two directions. The
/// wall may also move along itself.
struct Block {
  static constexpr double mass = 2e3, held_by = 1e7, stiffness = 4e7, closed = 1e-3, coefficient = 0.3;
  static constexpr double pressed = stiffness * held_by * closed / (held_by + stiffness);  // 8 kN
  GapContact<laws::LinearSpring> link{laws::LinearSpring{.stiffness = stiffness}, 0.0};
  System system;
  Eigen::VectorXd u;

  explicit Block(double sliding, int directions = 1) {
    const int n = 1 + directions;
    std::vector<double> masses(n, mass), stiffnesses(n, 0.0);
    stiffnesses[0] = held_by;
    system.mass = diagonal(masses);
    system.stiffness = diagonal(stiffnesses);
    system.damping = SparseMatrix(n, n);
    system.gap_jacobian = diagonal(std::vector<double>(n, 1.0));
    system.contacts = {&link};
    system.frictions = {
        {.contact = 0, .first = 1, .count = directions, .coefficient = coefficient, .sliding = sliding}};
    for (int i = 0; i < n; ++i) system.groups.push_back({i, 1, 1e-4, 1e-2});
    system.gravity_offset = closed * Eigen::VectorXd::Unit(n, 0);
    u = -stiffness * closed / (held_by + stiffness) * Eigen::VectorXd::Unit(n, 0);
  }
};

}  // namespace pounding::test
