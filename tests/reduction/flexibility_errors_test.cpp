// Errors of the flexibility of links with few modes against dense complex matrices of all unknowns.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include <pounding/reduction/flexibility_errors.hpp>

namespace pounding {
namespace flexibility_errors_test {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using petsc::ClassicalDamping;

// A cantilever of eight unit masses with springs that stiffen towards the ground; links at the top and at mid-height.
struct Chain {
  static constexpr int size = 8;
  MatrixXd stiffness = MatrixXd::Zero(size, size), links = MatrixXd::Zero(size, 2);

  Chain() {
    for (int i = 0; i < size; ++i) {
      stiffness(i, i) += 100.0 * (size - i);
      if (i == 0) continue;
      stiffness(i - 1, i - 1) += 100.0 * (size - i);
      stiffness(i, i - 1) = stiffness(i - 1, i) = -100.0 * (size - i);
    }
    links(size - 1, 0) = 1;
    links(size / 2, 1) = -1;
  }
  // In an orthonormal basis.
  MatrixXcd flexibility(const MatrixXd& basis, const ClassicalDamping& damping, double w) const {
    const MatrixXd k = basis.transpose() * stiffness * basis, b = basis.transpose() * links;
    const std::complex<double> by_k(1, w * damping.by_stiffness), by_m(-w * w, w * damping.by_mass);
    MatrixXcd a = by_k * k.cast<std::complex<double>>();
    if (damping.modal > 0)
      a += std::complex<double>(0, 2 * damping.modal * w) *
           Eigen::SelfAdjointEigenSolver<MatrixXd>(k).operatorSqrt().cast<std::complex<double>>();
    a.diagonal().array() += by_m;
    return b.transpose() * a.fullPivLu().solve(b.cast<std::complex<double>>());
  }
};

struct Case {
  Chain chain;
  MatrixXd run, rest, less;  // orthonormal bases of the run, of its complement, and of its shadow
  petsc::FurtherDirections further;
  ShadowModes shadow;

  // `count` modes on the static responses and their successors.
  explicit Case(int count) {
    MatrixXd vectors(Chain::size, Chain::size);
    vectors.leftCols(2) = chain.stiffness.inverse() * chain.links;
    for (int j = 2; j < Chain::size; ++j) vectors.col(j) = chain.stiffness.inverse() * vectors.col(j - 2);
    const MatrixXd all = vectors.householderQr().householderQ();
    const auto ritz = [&](const MatrixXd& basis) {
      return Eigen::SelfAdjointEigenSolver<MatrixXd>(basis.transpose() * chain.stiffness * basis);
    };
    const auto of_run = ritz(all.leftCols(count)), of_less = ritz(all.leftCols(count - 2));
    run = all.leftCols(count) * of_run.eigenvectors();
    less = all.leftCols(count - 2) * of_less.eigenvectors();
    rest = all.rightCols(Chain::size - count);
    further = {of_run.eigenvalues(), run.transpose() * chain.links, run.transpose() * chain.stiffness * rest,
               rest.transpose() * chain.stiffness * rest, rest.transpose() * chain.links};
    shadow = {run.transpose() * less, of_less.eigenvalues()};
  }
};

TEST(FlexibilityErrors, AreThoseOfDenseMatricesWhereTheDirectionsAreAllThatIsLeft) {
  const double contact = 12;
  for (const ClassicalDamping damping : {ClassicalDamping{0.3, 0.02}, ClassicalDamping{0, 1e-3},
                                         ClassicalDamping{0, 0, 0.1}, ClassicalDamping{0.1, 0.01, 0.05}}) {
    const Case of(4);
    double run = 0, shadow = 0;
    for (int k = 0; k < 15; ++k) {
      const double ratio = std::pow(2.0, -5 + 0.5 * k), w = contact * ratio, weight = 1 / (1 + ratio * ratio);
      const MatrixXcd exact = of.chain.flexibility(MatrixXd::Identity(Chain::size, Chain::size), damping, w);
      run = std::max(run, weight * (exact - of.chain.flexibility(of.run, damping, w)).cwiseAbs().maxCoeff());
      shadow = std::max(shadow, weight * (exact - of.chain.flexibility(of.less, damping, w)).cwiseAbs().maxCoeff());
    }
    const petsc::FlexibilityErrors found = petsc::flexibility_errors(of.further, of.shadow, damping, contact);
    EXPECT_NEAR(found.run, run, 1e-12 * shadow);
    EXPECT_NEAR(found.shadow, shadow, 1e-12 * shadow);
    EXPECT_GT(run, 1e-6);
  }
}

// Strong damping increases the change from one block to the next; weak damping leaves the errors similar.
TEST(FlexibilityErrors, AreAlikeWhereResonancesAreMissing) {
  const Case of(4);
  const auto ratio = [&](const ClassicalDamping& damping) {
    const petsc::FlexibilityErrors found = petsc::flexibility_errors(of.further, of.shadow, damping, 12);
    return found.run / found.shadow;
  };
  EXPECT_GT(ratio({0, 1e-4}), 3 * ratio({0, 0.5}));
}

TEST(FlexibilityErrors, AreNothingWhereNoDirectionIsLeft) {
  const Case of(4);
  petsc::FurtherDirections none = of.further;
  none.coupling = none.own = none.further_links = {};
  const petsc::FlexibilityErrors found = petsc::flexibility_errors(none, of.shadow, {0, 0.02}, 12);
  EXPECT_EQ(found.run, 0);
  EXPECT_GT(found.shadow, 0);
}

}  // namespace flexibility_errors_test
}  // namespace pounding
