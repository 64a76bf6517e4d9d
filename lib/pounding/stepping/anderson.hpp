#pragma once
/// Anderson acceleration of a fixed-point iteration.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pounding {

/// Solves x = R(x). Each iterate is the combination of the previous ones that would minimize the residual R(x) - x if R
/// were linear (Anderson 1965). The iteration may converge even if R is not a contraction.
///
/// `map(x, image)` sets image = R(x) and returns false on failure. `size(residual)` is the norm of a residual at the x
/// of the last map, relative to the solution. `product(p, q)` is an inner product.
///
/// `x` is the initial guess; `image` becomes R of the last iterate. Returns false if `map` fails or 100 iterations do
/// not converge. Converged means that the error of `image` is below 1e-14, or that it stagnates below 1e-11.
template <class Map, class Size, class Product>
bool solve_fixed_point(Eigen::VectorXd x, Eigen::VectorXd& image, const Map& map, const Size& size,
                       const Product& product) {
  constexpr double solved = 1e-14, nearly_solved = 1e-11;
  constexpr int max_iterations = 100;
  constexpr std::size_t max_secants = 30;
  // Minimum fraction of a difference that is orthogonal to the previous ones; below it, the difference is round-off.
  constexpr double min_new_part = 1e-8;

  struct Secant {
    Eigen::VectorXd step, change;  // of x and of the residual; the changes are orthonormal
  };
  std::vector<Secant> secants;
  Eigen::VectorXd residual, last_x, last_residual;
  double minimum = std::numeric_limits<double>::infinity(), slope = 0;
  int since_minimum = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (!map(x, image)) return false;
    residual = image - x;
    const double error = size(residual);
    if (!std::isfinite(error)) return false;
    // Contraction estimate of R: error(image) <= slope * error(x).
    if (iteration > 0) {
      const Eigen::VectorXd step = x - last_x, answer = step + residual - last_residual;
      slope = std::max(slope, std::sqrt(product(answer, answer) / product(step, step)));
    }
    if (error * (iteration > 0 ? slope : 1) <= solved) return true;
    since_minimum = error < 0.5 * minimum ? 0 : since_minimum + 1;
    minimum = std::min(minimum, error);
    if (since_minimum >= 3 && error <= nearly_solved) return true;
    if (iteration > 0) {
      Secant next{x - last_x, residual - last_residual};
      const double whole = std::sqrt(product(next.change, next.change));
      for (const Secant& s : secants) {
        const double part = product(s.change, next.change);
        next.step -= part * s.step;
        next.change -= part * s.change;
      }
      const double left = std::sqrt(product(next.change, next.change));
      if (left > min_new_part * whole) {
        next.step /= left;
        next.change /= left;
        if (secants.size() == max_secants) secants.erase(secants.begin());
        secants.push_back(std::move(next));
      }
    }
    last_x = x;
    last_residual = residual;
    for (const Secant& s : secants) {
      const double part = product(s.change, residual);
      x -= part * s.step;
      residual -= part * s.change;
    }
    x += residual;
  }
  return false;
}

}  // namespace pounding
