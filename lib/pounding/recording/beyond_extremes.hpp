#pragma once
/// Quantities that may exceed their extremes between a knot and the following batch of knots.

#include <Eigen/Core>
#include <vector>

#include <pounding/recording/linear_quantities.hpp>
#include <pounding/results/envelope.hpp>

namespace pounding {

/// Bounds on quantities. Between two knots a cubic deviates from the values by at most a third of the interval times
/// the rates.
struct Reach {
  /// values, then rates, at the knots of the batch
  const LinearQuantities::Instants<LinearQuantities::batch>& evaluated;
  const Eigen::VectorXd &values, &rates;  ///< at the previous knot
  const Eigen::Array<double, LinearQuantities::batch, 1>&
      third;           ///< of the longer interval between a knot and a neighbour [s]
  double third_begin;  ///< of the interval from the previous knot to the first one [s]
};

/// Quantities of which a value, or a value plus its rate contribution, exceeds the current extremes; ascending.
void find_beyond(const Reach& reach, const Extremes& extremes, std::vector<int>& found);

}  // namespace pounding
