#include <pounding/reduction/flexibility_errors.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/dense_products.hpp>

namespace pounding::petsc {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

// From 1/32 to 4 times the contact frequency.
constexpr int frequencies = 15;
constexpr double lowest = -5, highest = 2;

// A^T D B.
MatrixXcd weighed(const MatrixXd& a, const VectorXcd& d, const MatrixXd& b) {
  MatrixXcd made(a.cols(), b.cols());
  made.real() = transposed_product(a, d.real().asDiagonal() * b);
  made.imag() = transposed_product(a, d.imag().asDiagonal() * b);
  return made;
}

// The modes with the further directions.
struct Joint {
  Eigen::VectorXd squares;
  MatrixXd links;  // [mode, link]
};

Joint joint_modes(const FurtherDirections& of) {
  const Eigen::Index count = of.squares.size(), all = count + of.own.rows();
  MatrixXd stiffness(all, all), links(all, of.links.cols());
  stiffness << MatrixXd(of.squares.asDiagonal()), of.coupling, of.coupling.transpose(), of.own;
  links << of.links, of.further_links;
  const Eigenpairs found = eigenpairs_of(stiffness);
  return {found.values.cwiseMax(0), transposed_product(found.vectors, links)};
}

}  // namespace

FlexibilityErrors flexibility_errors(const FurtherDirections& of, const ShadowModes& shadow,
                                     const ClassicalDamping& damping, double contact) {
  const MatrixXd shadow_links = transposed_product(shadow.in_modes, of.links);
  const std::optional<Joint> joint =
      damping.modal > 0 && of.own.size() > 0 ? std::optional(joint_modes(of)) : std::nullopt;
  FlexibilityErrors errors;
  for (int k = 0; k < frequencies; ++k) {
    const double ratio = std::pow(2.0, lowest + (highest - lowest) * k / (frequencies - 1)), w = contact * ratio;
    const Complex by_stiffness(1, w * damping.by_stiffness), by_mass(-w * w, w * damping.by_mass);
    const Complex modal(0, 2 * w * damping.modal);
    const auto answers = [&](const Eigen::VectorXd& squares) -> VectorXcd {
      if (damping.modal > 0)
        return (squares.cast<Complex>().array() * by_stiffness + squares.cwiseSqrt().cast<Complex>().array() * modal +
                by_mass)
            .inverse();
      return (squares.cast<Complex>().array() * by_stiffness + by_mass).inverse();
    };
    const VectorXcd modes = answers(of.squares);
    MatrixXcd more = MatrixXcd::Zero(of.links.cols(), of.links.cols());
    if (joint) {
      more = weighed(joint->links, answers(joint->squares), joint->links) - weighed(of.links, modes, of.links);
    } else if (of.own.size() > 0) {
      MatrixXcd stiffness = by_stiffness * of.own.cast<Complex>() -
                            by_stiffness * by_stiffness * weighed(of.coupling, modes, of.coupling);
      stiffness.diagonal().array() += by_mass;
      const MatrixXcd load = of.further_links.cast<Complex>() - by_stiffness * weighed(of.coupling, modes, of.links);
      more = load.transpose() * stiffness.partialPivLu().solve(load);
    }
    const MatrixXcd both =
        more + weighed(of.links, modes, of.links) - weighed(shadow_links, answers(shadow.squares), shadow_links);
    const double weight = 1 / (1 + ratio * ratio);
    errors.run = std::max(errors.run, weight * more.cwiseAbs().maxCoeff());
    errors.shadow = std::max(errors.shadow, weight * both.cwiseAbs().maxCoeff());
  }
  return errors;
}

}  // namespace pounding::petsc
