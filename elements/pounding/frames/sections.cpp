#include <pounding/frames/sections.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

double cubed(double x) { return x * x * x; }

double rectangle_torsion(double one, double other) {
  const double a = std::max(one, other), b = std::min(one, other);
  double sum = 0;
  // The terms decrease at least as n^-5: beyond 1999 they are below the round-off of the sum. Smallest first.
  for (int n = 1999; n >= 1; n -= 2) sum += std::tanh(n * M_PI * a / (2 * b)) / std::pow(n, 5);
  return a * cubed(b) / 3 * (1 - 192 / std::pow(M_PI, 5) * b / a * sum);
}

// `ratio`: inner over outer diameter.
Section ring(double diameter, double ratio) {
  const double solid = M_PI * diameter * diameter / 4, squares = 1 + ratio * ratio;
  Section s;
  s.area = solid * (1 - ratio) * (1 + ratio);
  s.inertia_y = s.inertia_z = s.area * diameter * diameter / 16 * squares;
  s.torsion = 2 * s.inertia_y;
  s.shear_area_y = s.shear_area_z = s.area * 6 * squares * squares / (7 * squares * squares + 20 * ratio * ratio);
  s.width = s.depth = diameter;
  s.is_round = true;
  s.plastic_y = s.plastic_z = cubed(diameter) * (1 - cubed(ratio)) / 6;
  return s;
}

// Thin-walled, with the symbols of the paper: b flange width, h distance between the middles of the flanges.
double cowper_i_factor(double b, double h, double flange, double web) {
  const double m = 2 * b * flange / (h * web), n = b / h;
  return 10 * (1 + 3 * m) * (1 + 3 * m) / (12 + 72 * m + 150 * m * m + 90 * m * m * m + 30 * n * n * (m + m * m));
}

}  // namespace

Section rectangle_section(double width, double depth) {
  laws::require_positive("width", width);
  laws::require_positive("depth", depth);
  const double area = width * depth;
  return {.area = area,
          .inertia_y = width * cubed(depth) / 12,
          .inertia_z = depth * cubed(width) / 12,
          .torsion = rectangle_torsion(width, depth),
          .shear_area_y = area * 5 / 6,
          .shear_area_z = area * 5 / 6,
          .width = width,
          .depth = depth,
          .plastic_y = width * depth * depth / 4,
          .plastic_z = depth * width * width / 4};
}

Section circle_section(double diameter) {
  laws::require_positive("diameter", diameter);
  return ring(diameter, 0);
}

Section tube_section(double diameter, double thickness) {
  laws::require_positive("diameter", diameter);
  laws::require_positive("thickness", thickness);
  if (2 * thickness >= diameter) throw std::invalid_argument("thickness must be less than half the diameter");
  return ring(diameter, (diameter - 2 * thickness) / diameter);
}

Section i_section(double depth, double width, double flange, double web) {
  laws::require_positive("depth", depth);
  laws::require_positive("width", width);
  laws::require_positive("flange", flange);
  laws::require_positive("web", web);
  if (2 * flange >= depth) throw std::invalid_argument("flange must be less than half the depth");
  if (web > width) throw std::invalid_argument("web must not be wider than the flanges (width)");
  const double clear = depth - 2 * flange, between = depth - flange;
  Section s;
  s.area = 2 * width * flange + clear * web;
  s.inertia_y = (width * cubed(depth) - (width - web) * cubed(clear)) / 12;
  s.inertia_z = (2 * flange * cubed(width) + clear * cubed(web)) / 12;
  s.torsion = (2 * width * cubed(flange) + between * cubed(web)) / 3;
  s.shear_area_z = s.area * cowper_i_factor(width, between, flange, web);
  s.shear_area_y = 2 * width * flange * 5 / 6;
  s.width = width;
  s.depth = depth;
  s.plastic_y = width * flange * between + web * clear * clear / 4;
  s.plastic_z = width * width * flange / 2 + clear * web * web / 4;
  return s;
}

Material isotropic(double young, double density, double poisson) {
  laws::require_positive("young", young);
  if (!(poisson >= 0 && poisson <= 0.5)) throw std::invalid_argument("poisson must be in [0, 0.5]");
  laws::require_not_negative("density", density);
  return {.young = young, .shear = young / (2 * (1 + poisson)), .density = density};
}

Section without_shear_deformation(Section section) {
  section.shear_area_y = section.shear_area_z = Section{}.shear_area_y;
  return section;
}

Section turned_section(Section section) {
  std::swap(section.inertia_y, section.inertia_z);
  std::swap(section.shear_area_y, section.shear_area_z);
  std::swap(section.width, section.depth);
  std::swap(section.plastic_y, section.plastic_z);
  return section;
}

double plastic_moment(const Section& section, BendingAxis axis, double strength) {
  laws::require_positive("strength", strength);
  const double modulus = axis == BendingAxis::y ? section.plastic_y : section.plastic_z;
  if (!(modulus > 0))
    throw std::invalid_argument(
        "the plastic modulus of a section given by its properties is unknown; type plastic_modulus_y: 1.2e-3 m^3 in "
        "the "
        "section, or yield_moment: 210 kN m");
  return modulus * strength;
}

Section with_stiffness(Section section, double factor) {
  laws::require_positive("stiffness", factor);
  section.inertia_y *= factor;
  section.inertia_z *= factor;
  return section;
}

double extent(const Section& section, const Eigen::Matrix3d& axes, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d local = axes * direction;
  double width = section.width, depth = section.depth;
  if (!section.has_size()) {
    depth = std::sqrt(12 * section.inertia_y / section.area);
    width = section.inertia_z > 0 ? std::sqrt(12 * section.inertia_z / section.area) : section.area / depth;
  }
  if (section.is_round) return depth * std::hypot(local.y(), local.z());
  return width * std::abs(local.y()) + depth * std::abs(local.z());
}

bool is_upright(const Beam& beam) {
  const Eigen::RowVector3d along = beam.axes().row(0);
  return std::abs(along.z()) > along.head<2>().norm();
}

}  // namespace pounding
