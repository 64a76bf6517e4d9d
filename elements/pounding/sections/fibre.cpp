#include <pounding/sections/fibre.hpp>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include <pounding/laws/checks.hpp>

namespace pounding::sections {
namespace {

void require_count(const char* name, int count) {
  if (count < 1) laws::refuse(name, count, "at least 1");
}

Point between(const Point& a, const Point& b, double fraction) {
  return {a.y + fraction * (b.y - a.y), a.z + fraction * (b.z - a.z)};
}

/// Twice the signed area of a triangle [m^2].
double cross(const Point& a, const Point& b, const Point& c) {
  return (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
}

}  // namespace

void add_quadrilateral(Fibres& fibres, std::size_t material, const std::array<Point, 4>& corners, Cells cells) {
  require_count("cells", cells.first);
  require_count("cells", cells.second);
  const double sense = cross(corners[0], corners[1], corners[2]);
  for (std::size_t i = 0; i < 4; ++i)
    if (!(cross(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]) * sense > 0))
      throw std::invalid_argument("the quadrilateral is not convex; type its four corners in order around it");
  const auto at = [&](int i, int j) {
    const double along = static_cast<double>(i) / cells.first, across = static_cast<double>(j) / cells.second;
    return between(between(corners[0], corners[1], along), between(corners[3], corners[2], along), across);
  };
  for (int i = 0; i < cells.first; ++i)
    for (int j = 0; j < cells.second; ++j) {
      const Point a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      // Two triangles, each with its centroid.
      const double first = 0.5 * std::abs(cross(a, b, c)), second = 0.5 * std::abs(cross(a, c, d)),
                   all = first + second;
      fibres.push_back({(first * (a.y + b.y + c.y) + second * (a.y + c.y + d.y)) / (3 * all),
                        (first * (a.z + b.z + c.z) + second * (a.z + c.z + d.z)) / (3 * all), all, material});
    }
}

void add_rectangle(Fibres& fibres, std::size_t material, Point low, Point high, Cells cells) {
  add_quadrilateral(fibres, material, {low, Point{high.y, low.z}, high, Point{low.y, high.z}}, cells);
}

void add_ring(Fibres& fibres, std::size_t material, Point centre, double inner, double outer, Cells cells, double from,
              double to) {
  require_count("cells", cells.first);
  require_count("cells", cells.second);
  laws::require_not_negative("inner radius", inner);
  if (!(std::isfinite(outer) && outer > inner)) laws::refuse("outer radius", outer, "above the inner radius");
  if (!(to > from && to - from <= 2 * M_PI * (1 + 1e-12)))
    laws::refuse("angle", to, "above the first angle, by at most one turn");
  const double step = (outer - inner) / cells.first, angle = (to - from) / cells.second;
  for (int i = 0; i < cells.first; ++i) {
    const double a = inner + i * step, b = a + step, sector = 0.5 * angle * (b - a) * (b + a);
    const double radius = 4 * std::sin(angle / 2) * (b * b + b * a + a * a) / (3 * angle * (b + a));
    for (int j = 0; j < cells.second; ++j) {
      const double middle = from + (j + 0.5) * angle;
      fibres.push_back({centre.y + radius * std::cos(middle), centre.z + radius * std::sin(middle), sector, material});
    }
  }
}

void add_straight_layer(Fibres& fibres, std::size_t material, int bars, double area, Point from, Point to) {
  require_count("bars", bars);
  laws::require_positive("area of a bar", area);
  for (int i = 0; i < bars; ++i) {
    const Point at = between(from, to, bars == 1 ? 0.5 : static_cast<double>(i) / (bars - 1));
    fibres.push_back({at.y, at.z, area, material});
  }
}

void add_circular_layer(Fibres& fibres, std::size_t material, int bars, double area, Point centre, double radius) {
  require_count("bars", bars);
  laws::require_positive("area of a bar", area);
  laws::require_positive("radius", radius);
  for (int i = 0; i < bars; ++i) {
    const double angle = 2 * M_PI * i / bars;
    fibres.push_back({centre.y + radius * std::cos(angle), centre.z + radius * std::sin(angle), area, material});
  }
}

double area(std::span<const Fibre> fibres) noexcept {
  return std::accumulate(fibres.begin(), fibres.end(), 0.0,
                         [](double sum, const Fibre& fibre) { return sum + fibre.area; });
}

void check_area(std::span<const Fibre> fibres, double expected) {
  if (const double covered = area(fibres); !(std::abs(covered - expected) <= 0.01 * expected))
    throw std::invalid_argument("the fibres cover " + laws::short_text(covered) +
                                " m^2, but the area of the section is " + laws::short_text(expected) +
                                " m^2; type patches that cover it, or the area " + laws::short_text(covered) + " m^2");
}

}  // namespace pounding::sections
