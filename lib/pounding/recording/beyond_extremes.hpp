#pragma once
/// Which quantities may go beyond their extremes between a knot and a batch of knots after it.

#include <Eigen/Core>
#include <vector>

#include <pounding/recording/linear_quantities.hpp>
#include <pounding/results/envelope.hpp>

namespace pounding {

/// How far quantities may go. Between two knots a cubic stays within a third of their distance times the rates from the
/// values.
struct Reach {
  const LinearQuantities::Instants<LinearQuantities::batch>&
      evaluated;                                                  ///< values, then rates, at the knots of the batch
  const Eigen::VectorXd &values, &rates;                          ///< at the knot before
  const Eigen::Array<double, LinearQuantities::batch, 1>& third;  ///< of the longer time from a knot to a neighbour [s]
  double third_begin;  ///< of the time from the knot before to the first one [s]
};

/// The quantities of which a value, or a value and what its rate adds, lies beyond the extremes so far, in their order.
void find_beyond(const Reach& reach, const Extremes& extremes, std::vector<int>& found);

}  // namespace pounding
