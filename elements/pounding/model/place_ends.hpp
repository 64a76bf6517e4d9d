#pragma once
/// Locates ends of links and devices on their structures.

#include <optional>
#include <vector>

#include <pounding/model/facing.hpp>

namespace pounding {

/// End of a link on this side of its structure; `along` is the position along the edge of a floor in space. Errors
/// refer to `option`.
LinkEnd place_end(const PairEnd& end, const Structure& structure, Side side, double along, ModelOption option);

/// Displacement of an end along a direction as factors of the `size` unknowns of its structure.
Row motion_along(const LinkEnd& end, const Eigen::Vector3d& direction, int size);

/// Throws ModelError for a negative or infinite distance.
void require_face(const Face& face, ModelOption option);

/// Sets the contact face of an end on this side: the given one, otherwise that of the structure. Throws ModelError for
/// columns without a size, and for invalid faces.
void set_face(LinkEnd& end, const Structure& structure, const std::optional<Face>& given, Side side,
              ModelOption option);

/// Positions of the contact points along the common edge of two floors; one unless both are floors in space.
std::vector<double> along_the_edge(std::optional<int> points, const LinkPair& pair, const Structure& a,
                                   const Structure& b, Side side);

/// Throws ModelError for an end that is fixed by a support in the direction of a contact on this side, and for one
/// without mass, whose velocity would be arbitrary.
void require_inertia(const LinkEnd& end, const Structure& structure, Side side, ModelOption option);

}  // namespace pounding
