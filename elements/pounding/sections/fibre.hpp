#pragma once
/// Fibres of a cross-section: patches, layers and points.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pounding::sections {

/// Part of a cross-section with one strain. Local axes y and z; the depth of a member in the plane lies along z.
struct Fibre {
  double y = 0, z = 0;       ///< centroid [m]
  double area = 0;           ///< [m^2]
  std::size_t material = 0;  ///< index in the materials of the section
};

/// Fibres of a cross-section, in any order.
using Fibres = std::vector<Fibre>;

/// Point of a cross-section [m].
struct Point {
  double y = 0, z = 0;
};

/// Number of fibres along the two directions of a patch, each at least 1.
struct Cells {
  int first = 1, second = 1;
};

/// Adds a quadrilateral with corners in order around it: cells along the sides 0-1 and 1-2. Throws
/// std::invalid_argument if it is not convex, and for fewer than one cell.
void add_quadrilateral(Fibres& fibres, std::size_t material, const std::array<Point, 4>& corners, Cells cells);

/// Adds a rectangle with sides along y and z; cells along y and z. Throws like add_quadrilateral().
void add_rectangle(Fibres& fibres, std::size_t material, Point low, Point high, Cells cells);

/// Adds a sector of a ring, or of a circle if the inner radius is 0 [m], between two angles [rad] from y towards z;
/// cells along the radius and around. Throws std::invalid_argument for a radius or angle out of range.
void add_ring(Fibres& fibres, std::size_t material, Point centre, double inner, double outer, Cells cells,
              double from = 0, double to = 6.283185307179586);

/// Adds bars of an area [m^2] each, equally spaced from one point to another; a single bar in the middle. Throws
/// std::invalid_argument for fewer than one bar or an area that is not positive.
void add_straight_layer(Fibres& fibres, std::size_t material, int bars, double area, Point from, Point to);

/// Adds bars of an area [m^2] each, equally spaced around a circle, the first one on the y axis. Throws like
/// add_straight_layer().
void add_circular_layer(Fibres& fibres, std::size_t material, int bars, double area, Point centre, double radius);

/// Total area of the fibres [m^2].
double area(std::span<const Fibre> fibres) noexcept;

/// Throws std::invalid_argument, with both numbers, if the fibres do not cover an area [m^2] to within 1 %.
void check_area(std::span<const Fibre> fibres, double expected);

}  // namespace pounding::sections
