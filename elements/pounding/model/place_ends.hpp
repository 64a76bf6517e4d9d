#pragma once
/// Ends of links and devices: where they meet their structures.

#include <optional>
#include <vector>

#include <pounding/model/facing.hpp>

namespace pounding {

/// One end of a link on this side of its structure, `along` its edge where it is a floor in space. Errors concern
/// `option`.
LinkEnd place_end(const PairEnd& end, const Structure& structure, Side side, double along, ModelOption option);

/// Throws ModelError for a distance that is negative or infinite.
void require_face(const Face& face, ModelOption option);

/// Finds the face at which a link hits an end on this side: the given one, else that of the structure. Throws
/// ModelError for columns without a size, and for faces that cannot be.
void set_face(LinkEnd& end, const Structure& structure, const std::optional<Face>& given, Side side,
              ModelOption option);

/// Positions of the contact points along the common edge of two floors; one where the two are not both floors in space.
std::vector<double> along_the_edge(std::optional<int> points, const LinkPair& pair, const Structure& a,
                                   const Structure& b, Side side);

/// Throws ModelError for an end that its support holds in the way of a contact on this side, and for one without mass:
/// it could be given any velocity at once.
void require_inertia(const LinkEnd& end, const Structure& structure, Side side, ModelOption option);

}  // namespace pounding
