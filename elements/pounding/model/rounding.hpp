#pragma once
/// Round-off of computed displacements.

#include <Eigen/Core>

#include <pounding/model/model.hpp>

namespace pounding {

/// Bound on the round-off in the displacement of the end of a link along `direction` [m], for the unknowns `u` of its
/// structure, computed from the loads at rest.
///
/// A stable solver returns the exact solution for a stiffness that differs from K by a few units in the last place of
/// each entry, k eps |K| with k entries in a row. The displacement r'u then changes by w' (k eps |K|) |u| with K w = r.
/// To first order this is the error, whatever the condition number of K. It scales with the model, not with an absolute
/// constant (Skeel, J. ACM 26 (1979) 494).
double displacement_rounding(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction,
                             const Eigen::VectorXd& u);

}  // namespace pounding
