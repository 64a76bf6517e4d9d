#pragma once
/// Which floors and which sides of two structures face each other.

#include <optional>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// One end of a pair, found on its structure.
struct PairEnd {
  int structure = 0;
  std::optional<int> floor{};         ///< from 0
  bool is_numbered = false;           ///< the name of the link tells the floor
  std::optional<double> elevation{};  ///< [m]
  std::string node{};
};

/// Two ends that a link joins.
struct LinkPair {
  PairEnd left, right;
};

/// The pairs that a link stands for: one, or with `floors` those of all floors that face each other, from the ground
/// up. Throws ModelError for structures, floors and choices that cannot be.
std::vector<LinkPair> pairs_of(const Model& model, const ContactLocation& left, const ContactLocation& right,
                               std::optional<FacingFloors> floors, std::optional<double> level_within = {});

/// Largest difference in elevation of two floors that are level [m], see LinkOptions::level_within.
double level_of(const Floor& first, const Floor& second, std::optional<double> level_within);

/// The side of the first structure that faces the second one, by where they stand in plan; plus_x for those without a
/// place. Throws ModelError for structures in space that stand on each other, or apart along x and along y, and where
/// the second one stands on the left, which is where x is less.
Side facing_side(const Structure& first, const Structure& second);

/// Throws std::invalid_argument unless the structure has the floor with this number, from 1; `text` is how the user
/// named it.
void require_floor(const Structure& structure, int number, const std::string& text);

}  // namespace pounding
