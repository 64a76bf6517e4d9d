#pragma once
/// Fibres of usual cross-sections from their dimensions. The depth lies along z, the width along y; the origin is in
/// the middle. `layers` is the number of fibres along the depth. With `across` = 0, all fibres are at y = 0: layers for
/// members in the plane; otherwise it is the number of fibres across the width.

#include <cstddef>

#include <pounding/sections/fibre.hpp>

namespace pounding::sections {

/// Bars of one row or side: number and area of each [m^2].
struct Bars {
  int count = 0;
  double area = 0;
};

/// Area of a round bar of a diameter [m].
double bar_area(double diameter);

/// Reinforced-concrete rectangle. The cover reaches to the bar axes, which bound the confined core. The area of
/// concrete that bars displace is not subtracted.
struct RcRectangle {
  double width = 0, depth = 0;                ///< [m]
  double cover = 0;                           ///< from the surface to the bar axes [m]
  std::size_t core = 0, shell = 0, bars = 0;  ///< indices of materials: confined core, cover, bars
  Bars top{}, bottom{};                       ///< rows at z = +-(depth/2 - cover), from corner to corner
  Bars sides{};     ///< between the rows, in both sides together, equally spaced; an even number
  int layers = 24;  ///< of the core
  int cover_layers = 3;
  int across = 0;  ///< of the core
};

/// Fibres of a reinforced-concrete rectangle. Throws std::invalid_argument for invalid dimensions and bars.
Fibres rc_rectangle(const RcRectangle& section);

/// Fibres of a rectangle. Throws std::invalid_argument for invalid dimensions.
Fibres rectangle(double width, double depth, std::size_t material, int layers, int across = 0);

/// Fibres of an I: flanges of at least `layers`/8 and a web of `layers` fibres along the depth. Throws
/// std::invalid_argument for invalid dimensions.
Fibres i_section(double depth, double width, double flange, double web, std::size_t material, int layers,
                 int across = 0);

/// Fibres of a pipe, or of a circle if the thickness is half the diameter: `rings` through the thickness and `around`
/// along the circumference. Throws std::invalid_argument for invalid dimensions.
Fibres pipe(double diameter, double thickness, std::size_t material, int rings, int around);

}  // namespace pounding::sections
