#pragma once
/// Facing floors and facing sides of two structures.

#include <optional>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// One end of a pair, located on its structure.
struct PairEnd {
  int structure = 0;
  std::optional<int> floor{};         ///< from 0
  bool is_numbered = false;           ///< true if the name of the link contains the floor
  std::optional<double> elevation{};  ///< [m]
  std::string node{};
};

/// Two ends joined by a link.
struct LinkPair {
  PairEnd left, right;
};

/// Pairs defined by a link: one, or with `floors` those of all facing floors, from the ground up. Throws ModelError for
/// invalid structures, floors and choices.
std::vector<LinkPair> pairs_of(const Model& model, const ContactLocation& left, const ContactLocation& right,
                               std::optional<FacingFloors> floors, std::optional<double> level_within = {});

/// Maximum difference in elevation of two level floors [m], see LinkOptions::level_within.
double level_of(const Floor& first, const Floor& second, std::optional<double> level_within);

/// Side of the first structure that faces the second one, from their positions in plan; plus_x for those without a
/// position. Throws ModelError for structures in space that overlap in plan or are apart along both x and y, and if the
/// second one is on the left, at smaller x.
Side facing_side(const Structure& first, const Structure& second);

/// Throws std::invalid_argument unless the structure has the floor with this number, from 1; `text` is the name as the
/// user typed it.
void require_floor(const Structure& structure, int number, const std::string& text);

}  // namespace pounding
