#pragma once
/// Plane frames with hinges, assembled by hand: explicit springs between a joint and the end of a member, or hinges in
/// series condensed into the structure.

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <pounding/structures/structure.hpp>

#include "support/bilinear_spring.hpp"

namespace pounding::test {

/// Stiffness of a straight plane beam without shear deformation: x, z, rotation at each end.
inline Eigen::Matrix<double, 6, 6> plane_beam(double e, double a, double i, const Eigen::Vector2d& from,
                                              const Eigen::Vector2d& to) {
  const double length = (to - from).norm(), c = (to - from).x() / length, s = (to - from).y() / length;
  const double q = e * i / (length * length * length), l = length;
  Eigen::Matrix<double, 6, 6> k = Eigen::Matrix<double, 6, 6>::Zero(), r = k;
  const double n = e * a / l;
  k(0, 0) = k(3, 3) = n, k(0, 3) = k(3, 0) = -n;
  const int at[] = {1, 2, 4, 5};
  const double bend[4][4] = {{12, 6 * l, -12, 6 * l},
                             {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                             {-12, -6 * l, 12, -6 * l},
                             {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  for (int m = 0; m < 4; ++m)
    for (int o = 0; o < 4; ++o) k(at[m], at[o]) = q * bend[m][o];
  Eigen::Matrix3d turn;
  turn << c, s, 0, -s, c, 0, 0, 0, 1;
  r.topLeftCorner<3, 3>() = r.bottomRightCorner<3, 3>() = turn;
  return r.transpose() * k * r;
}

/// A hinge with its bilinear law.
struct TestHinge {
  std::string name;
  double yield = 0;      ///< [N m]
  double hardening = 0;  ///< ratio of the slopes after and before yield, of the law
  double stiffness = 0;  ///< of the spring [N m/rad]; infinite for a rigid-plastic hinge
};

/// Collects members, hinged or not, over unknowns numbered by hand; -1 is fixed.
class HandMadeFrame {
 public:
  explicit HandMadeFrame(int unknowns) : stiffness_(Eigen::MatrixXd::Zero(unknowns, unknowns)) {}

  void member(const Eigen::Matrix<double, 6, 6>& k, const std::array<int, 6>& at) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        if (at[i] >= 0 && at[j] >= 0) stiffness_(at[i], at[j]) += k(i, j);
  }

  /// A spring between two rotations that are both unknowns, or one of them fixed.
  void spring(const TestHinge& hinge, int inner, int outer) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(stiffness_.rows());
    row[inner] = 1;
    if (outer >= 0) row[outer] -= 1;
    stiffness_ += hinge.stiffness * row * row.transpose();
    add(hinge, row, hinge.stiffness, hinge.hardening);
  }

  /// A member with hinges in series at its ends, whose rotations are not unknowns. The k of a rigid-plastic hinge is
  /// the moment of the member per unit rotation. `hinges` are those at the start and at the end, null if absent.
  void hinged_member(Eigen::Matrix<double, 6, 6> k, const std::array<int, 6>& at, const TestHinge* start,
                     const TestHinge* end) {
    const std::array<const TestHinge*, 2> ends{start, end};
    const std::array<int, 2> turns{2, 5};
    // Springs of finite stiffness are condensed into the member.
    for (int e = 0; e < 2; ++e)
      if (ends[e] && std::isfinite(ends[e]->stiffness)) {
        const Eigen::Matrix<double, 6, 1> column = k.col(turns[e]);
        k -= column * column.transpose() / (k(turns[e], turns[e]) + ends[e]->stiffness);
      }
    member(k, at);
    std::vector<int> here;
    std::vector<double> stiffnesses;
    for (int e = 0; e < 2; ++e) {
      if (!ends[e]) continue;
      const double d = k(turns[e], turns[e]), own = std::isfinite(ends[e]->stiffness) ? ends[e]->stiffness : d;
      Eigen::VectorXd row = Eigen::VectorXd::Zero(stiffness_.rows());
      for (int i = 0; i < 6; ++i)
        if (at[i] >= 0) row[at[i]] = k(turns[e], i) / own;
      here.push_back(static_cast<int>(parts_.size()));
      stiffnesses.push_back(own);
      add(*ends[e], row, own, ends[e]->hardening);
      relief_.emplace_back(here.back(), here.back(), 1 / own - d / (own * own));
    }
    if (here.size() == 2) {
      const double both = -k(2, 5) / (stiffnesses[0] * stiffnesses[1]);
      relief_.emplace_back(here[0], here[1], both);
      relief_.emplace_back(here[1], here[0], both);
    }
  }

  /// Deformation of this hinge under gravity.
  void strain(int hinge, double deformation) { parts_[hinge].at_rest = deformation; }

  Structure structure() {
    Structure s;
    s.name = "frame";
    s.stiffness = stiffness_.sparseView();
    s.mass = SparseMatrix(s.stiffness.rows(), s.stiffness.cols());
    s.yielding = std::move(parts_);
    s.yielding_flexibility.resize(static_cast<int>(s.yielding.size()), static_cast<int>(s.yielding.size()));
    s.yielding_flexibility.setFromTriplets(relief_.begin(), relief_.end());
    return s;
  }

 private:
  void add(const TestHinge& hinge, const Eigen::VectorXd& row, double stiffness, double hardening) {
    parts_.emplace_back(hinge.name, Row(row.sparseView()), "bilinear", std::vector<YieldingPart::Parameter>{},
                        std::make_unique<BilinearSpring>(BilinearSpring::Parameters{
                            .stiffness = stiffness, .yield_force = hinge.yield, .hardening = hardening}));
  }

  Eigen::MatrixXd stiffness_;
  std::vector<YieldingPart> parts_;
  std::vector<Eigen::Triplet<double>> relief_;
};

/// A row with one nonzero entry.
inline Row unit_row(int size, int at) {
  Row row(size);
  row.insert(at) = 1;
  return row;
}

/// Storeys of 3.2 m, one bay of 6 m, E 30 GPa, columns 0.4 x 0.4 m, beams 0.3 x 0.5 m; springs of 10 times 6 E I/L with
/// a hardening of 0.003 at the feet (250 kN m) and the ends of the beams (180 kN m). Unknowns of storey s (from 0),
/// node i: x, z, rotation, from index 6 s + 3 i.
struct HingedFrame {
  int storeys = 3;
  double foot_moment = 250e3, beam_moment = 180e3, hardening = 0.003;

  static constexpr double height = 3.2, bay = 6, young = 30e9;

  /// Rotations of feet and beam ends are unknowns after those of the nodes.
  Structure with_springs() const {
    HandMadeFrame frame(6 * storeys + 2 + 2 * storeys);
    int next = 6 * storeys;
    for (int i = 0; i < 2; ++i) {
      for (int s = 0; s < storeys; ++s)
        frame.member(column(),
                     s == 0 ? std::array{-1, -1, next + i, node(0, i), node(0, i) + 1, node(0, i) + 2} : joints(s, i));
      frame.spring(foot(i), next + i, -1);
    }
    next += 2;
    for (int s = 0; s < storeys; ++s, next += 2) {
      frame.member(beam(), {node(s, 0), node(s, 0) + 1, next, node(s, 1), node(s, 1) + 1, next + 1});
      for (int i = 0; i < 2; ++i) frame.spring(beam_end(s, i), next + i, node(s, i) + 2);
    }
    return frame.structure();
  }

  /// The springs in series, condensed into their members.
  Structure in_series() const {
    HandMadeFrame frame(6 * storeys);
    for (int i = 0; i < 2; ++i)
      for (int s = 0; s < storeys; ++s) {
        const TestHinge hinge = foot(i);
        if (s == 0)
          frame.hinged_member(column(), {-1, -1, -1, node(0, i), node(0, i) + 1, node(0, i) + 2}, &hinge, nullptr);
        else
          frame.member(column(), joints(s, i));
      }
    for (int s = 0; s < storeys; ++s) {
      const TestHinge left = beam_end(s, 0), right = beam_end(s, 1);
      frame.hinged_member(beam(),
                          {node(s, 0), node(s, 0) + 1, node(s, 0) + 2, node(s, 1), node(s, 1) + 1, node(s, 1) + 2},
                          &left, &right);
    }
    return frame.structure();
  }

  /// Forces 1:2:3 ... on the floors, half on each node, with a sum of one.
  Eigen::VectorXd triangular(int unknowns) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
    const double whole = 0.5 * storeys * (storeys + 1);
    for (int s = 0; s < storeys; ++s)
      for (int i = 0; i < 2; ++i) load[node(s, i)] = 0.5 * (s + 1) / whole;
    return load;
  }
  int roof() const { return node(storeys - 1, 0); }

 private:
  static int node(int storey, int i) { return 6 * storey + 3 * i; }
  static std::array<int, 6> joints(int s, int i) {
    const int low = node(s - 1, i), high = node(s, i);
    return {low, low + 1, low + 2, high, high + 1, high + 2};
  }
  static double column_inertia() { return std::pow(0.4, 4) / 12; }
  static double beam_inertia() { return 0.3 * std::pow(0.5, 3) / 12; }
  static Eigen::Matrix<double, 6, 6> column() { return plane_beam(young, 0.16, column_inertia(), {0, 0}, {0, height}); }
  static Eigen::Matrix<double, 6, 6> beam() { return plane_beam(young, 0.15, beam_inertia(), {0, 0}, {bay, 0}); }
  TestHinge foot(int i) const {
    return {"foot " + std::to_string(i), foot_moment, hardening, 60 * young * column_inertia() / height};
  }
  TestHinge beam_end(int s, int i) const {
    return {"beam " + std::to_string(s + 1) + (i == 0 ? " left" : " right"), beam_moment, hardening,
            60 * young * beam_inertia() / bay};
  }
};

}  // namespace pounding::test
