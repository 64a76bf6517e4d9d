#pragma once
/// Round-off of displacements that were solved for.

#include <Eigen/Core>

#include <pounding/model/model.hpp>

namespace pounding {

/// Bound of the round-off in the displacement of the end of a link along `direction` [m], where the unknowns of its
/// structure are `u` and the loads at rest were solved for them.
///
/// A stable solver returns the exact answer of a stiffness K that differs from the true one by a few units in the last
/// place of each entry, k eps |K| with k entries in a row. The displacement r'u moves by w' (k eps |K|) |u| then, with
/// K w = r: to first order this is the error, however badly K is conditioned, and it has the scale of the model instead
/// of one of its own (Skeel, J. ACM 26 (1979) 494).
double displacement_rounding(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction,
                             const Eigen::VectorXd& u);

}  // namespace pounding
