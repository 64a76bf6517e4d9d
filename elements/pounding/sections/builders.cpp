#include <pounding/sections/builders.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <pounding/laws/checks.hpp>

namespace pounding::sections {
namespace {

/// Adds a rectangle symmetric about z, from its middle depth; for `across` = 0 at y = 0.
void add_block(Fibres& fibres, std::size_t material, double width, double low, double high, int layers, int across) {
  add_rectangle(fibres, material, {-width / 2, low}, {width / 2, high}, {std::max(across, 1), layers});
}

/// Adds a row of bars across a width at a depth; for `across` = 0 one fibre.
void add_row(Fibres& fibres, std::size_t material, const Bars& bars, double width, double z, int across) {
  if (bars.count == 0) return;
  if (across == 0)
    add_straight_layer(fibres, material, 1, bars.count * bars.area, {0, z}, {0, z});
  else
    add_straight_layer(fibres, material, bars.count, bars.area, {-width / 2, z}, {width / 2, z});
}

}  // namespace

double bar_area(double diameter) {
  laws::require_positive("diameter", diameter);
  return M_PI * diameter * diameter / 4;
}

Fibres rc_rectangle(const RcRectangle& section) {
  const auto& [width, depth, cover, core, shell, bars, top, bottom, sides, layers, cover_layers, across] = section;
  laws::require_positive("width", width);
  laws::require_positive("depth", depth);
  if (!(cover > 0 && 2 * cover < std::min(width, depth)))
    laws::refuse("cover", cover, "positive and less than half the width and the depth");
  if (sides.count < 0 || sides.count % 2 != 0) laws::refuse("sides", sides.count, "an even number of bars");
  if (across < 0) laws::refuse("across", across, "0 or more");
  const double inner_width = width - 2 * cover, z = depth / 2 - cover;
  Fibres fibres;
  add_block(fibres, core, inner_width, -z, z, layers, across);
  if (across == 0) {
    add_block(fibres, shell, 2 * cover, -z, z, layers, 0);
  } else {
    add_rectangle(fibres, shell, {-width / 2, -z}, {-inner_width / 2, z}, {cover_layers, layers});
    add_rectangle(fibres, shell, {inner_width / 2, -z}, {width / 2, z}, {cover_layers, layers});
  }
  add_block(fibres, shell, width, z, depth / 2, cover_layers, across);
  add_block(fibres, shell, width, -depth / 2, -z, cover_layers, across);
  check_area(fibres, width * depth);
  add_row(fibres, bars, top, inner_width, z, across);
  add_row(fibres, bars, bottom, inner_width, -z, across);
  const int rows = sides.count / 2;
  for (int i = 1; i <= rows; ++i)
    add_row(fibres, bars, {2, sides.area}, inner_width, -z + 2 * z * i / (rows + 1), across);
  return fibres;
}

Fibres rectangle(double width, double depth, std::size_t material, int layers, int across) {
  laws::require_positive("width", width);
  laws::require_positive("depth", depth);
  Fibres fibres;
  add_block(fibres, material, width, -depth / 2, depth / 2, layers, across);
  return fibres;
}

Fibres i_section(double depth, double width, double flange, double web, std::size_t material, int layers, int across) {
  laws::require_positive("depth", depth);
  laws::require_positive("width", width);
  laws::require_positive("flange", flange);
  laws::require_positive("web", web);
  if (!(2 * flange < depth)) laws::refuse("flange", flange, "less than half the depth");
  if (!(web <= width)) laws::refuse("web", web, "at most the width of the flanges");
  const double z = depth / 2 - flange;
  const int flange_layers = std::max(1, (layers + 7) / 8);
  Fibres fibres;
  add_block(fibres, material, width, z, depth / 2, flange_layers, across);
  add_block(fibres, material, web, -z, z, layers, std::min(across, 1));
  add_block(fibres, material, width, -depth / 2, -z, flange_layers, across);
  check_area(fibres, 2 * width * flange + web * 2 * z);
  return fibres;
}

Fibres pipe(double diameter, double thickness, std::size_t material, int rings, int around) {
  laws::require_positive("diameter", diameter);
  if (!(thickness > 0 && 2 * thickness <= diameter))
    laws::refuse("thickness", thickness, "positive and at most half the diameter");
  Fibres fibres;
  add_ring(fibres, material, {}, diameter / 2 - thickness, diameter / 2, {rings, around});
  check_area(fibres, M_PI * thickness * (diameter - thickness));
  return fibres;
}

}  // namespace pounding::sections
