#include <pounding/frames/profiles/profiles.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/frames/sections.hpp>
#include <pounding/sections/builders.hpp>

namespace pounding {
namespace {

constexpr double mm = 1e-3, inch = 0.0254;

struct European {
  std::string_view name;
  double height, width, web, flange, radius;  // [mm]
};
struct AmericanI {
  std::string_view name;
  double area, depth, width, web, flange, inertia_x, inertia_y, torsion, plastic_x, plastic_y;  // [in]
};
struct AmericanHollow {
  std::string_view name;
  double area, depth, width, wall, inertia_x, inertia_y, torsion, plastic_x, plastic_y;  // [in]
};
struct AmericanRound {
  std::string_view name;
  double area, diameter, wall, inertia, torsion, plastic;  // [in]
};

constexpr European european_i[] = {
#include <pounding/frames/profiles/european_i.inc>
};
constexpr AmericanI aisc_i[] = {
#include <pounding/frames/profiles/aisc_i.inc>
};
constexpr AmericanHollow aisc_hss[] = {
#include <pounding/frames/profiles/aisc_hss.inc>
};
constexpr AmericanRound aisc_round[] = {
#include <pounding/frames/profiles/aisc_round.inc>
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Name without blanks and in capitals; every separator is a point: "HEB 400", "HE 400 B" and "heb400" are equal.
std::string profile_key(std::string_view name) {
  std::string key;
  for (const char c : name) {
    if (c == ' ' || c == '\t') continue;
    const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    key += upper == '/' || upper == '-' || upper == '_' ? '.' : upper;
  }
  const std::size_t suffix = key.find_last_of("0123456789") + 1;
  if (key.starts_with("HE") && key.size() > 2 && is_digit(key[2]) && suffix < key.size())
    key = "HE" + key.substr(suffix) + key.substr(2, suffix - 2);
  return key;
}

std::string family_of(std::string_view key) {
  return std::string(key.substr(0, std::min(key.find_first_of("0123456789"), key.size())));
}

// Numbers of a key in their order: {457, 191, 67}.
std::vector<double> numbers_of(std::string_view key) {
  std::vector<double> numbers;
  const char *at = key.data(), *const end = at + key.size();
  while (at != end) {
    double number = 0;
    const auto [after, error] = std::from_chars(at, end, number, std::chars_format::fixed);
    if (is_digit(*at) && error == std::errc{}) {
      numbers.push_back(number);
      at = after;
    } else {
      ++at;
    }
  }
  return numbers;
}

// Calls for every row of all tables until one returns true.
template <class Act>
bool visit_profiles(const Act& act) {
  const auto any = [&](const auto& rows) { return std::ranges::any_of(rows, act); };
  return any(european_i) || any(aisc_i) || any(aisc_hss) || any(aisc_round);
}

Section section_of(const European& row) {
  return rolled_i_section(row.height * mm, row.width * mm, row.flange * mm, row.web * mm, row.radius * mm);
}

// A section from its table in inches, with the shear areas of thin walls; both webs of a box count as
// one.
template <class American>
Section american_section(const American& row, const Section& sharp) {
  return {.area = row.area * inch * inch,
          .inertia_y = row.inertia_x * std::pow(inch, 4),
          .inertia_z = row.inertia_y * std::pow(inch, 4),
          .torsion = row.torsion * std::pow(inch, 4),
          .shear_area_y = sharp.shear_area_y,
          .shear_area_z = sharp.shear_area_z,
          .width = row.width * inch,
          .depth = row.depth * inch,
          .plastic_y = row.plastic_x * std::pow(inch, 3),
          .plastic_z = row.plastic_y * std::pow(inch, 3)};
}

Section section_of(const AmericanI& row) {
  return american_section(row, i_section(row.depth * inch, row.width * inch, row.flange * inch, row.web * inch));
}

Section section_of(const AmericanHollow& row) {
  return american_section(row, hollow_section(row.depth * inch, row.width * inch, row.wall * inch));
}

Section section_of(const AmericanRound& row) {
  Section s = tube_section(row.diameter * inch, row.wall * inch);
  s.area = row.area * inch * inch;
  s.inertia_y = s.inertia_z = row.inertia * std::pow(inch, 4);
  s.torsion = row.torsion * std::pow(inch, 4);
  s.plastic_y = s.plastic_z = row.plastic * std::pow(inch, 3);
  return s;
}

// Properties of the corner between a square of side r and its inscribed quarter circle.
struct Corner {
  double area, distance, inertia;  // distance of the centroid from the sharp edge, inertia about the centroid
};
Corner corner_of(double r) {
  return {(1 - M_PI / 4) * r * r, (10 - 3 * M_PI) / (12 - 3 * M_PI) * r,
          (1.0 / 3 - M_PI / 16 - 1 / (3 * (12 - 3 * M_PI))) * std::pow(r, 4)};
}

// Adds an area in equal fibres at +-y and +-z; for members in the plane (across = 0) at y = 0.
void add_symmetric(sections::Fibres& fibres, double area, double y, double z, int across) {
  if (!(area > 0)) return;
  for (const double at : {-z, z}) {
    if (across == 0) fibres.push_back({0, at, area / 2, 0});
    if (across > 0) sections::add_straight_layer(fibres, 0, 2, area / 4, {-y, at}, {y, at});
  }
}

// An I whose root radii are the area beyond the three rectangles.
sections::Fibres fibres_of_i(const Section& s, double flange, double web, int layers, int across) {
  sections::Fibres fibres = sections::i_section(s.depth, s.width, flange, web, 0, layers, across);
  const double rest = s.area - sections::area(fibres), corner = corner_of(1).area;
  const double inwards = corner_of(std::sqrt(std::max(rest, 0.0) / (4 * corner))).distance;
  add_symmetric(fibres, rest, web / 2 + inwards, s.depth / 2 - flange - inwards, across);
  return fibres;
}

// Four plates, and corners with the outer radius 1.5 t whose area is the rest.
sections::Fibres fibres_of_box(const Section& s, double wall, int layers, int across) {
  const double y = s.width / 2 - 1.5 * wall, z = s.depth / 2 - 1.5 * wall, inwards = 0.863 * wall;
  sections::Fibres fibres;
  const int cells = std::max(across, 1);
  for (const double side : {-1.0, 1.0}) {
    const double outer = side * s.depth / 2, inner = outer - side * wall;
    sections::add_rectangle(fibres, 0, {-y, std::min(outer, inner)}, {y, std::max(outer, inner)}, {cells, 2});
    const double left = across == 0 ? -wall / 2 : side * (s.width - wall) / 2 - wall / 2;
    sections::add_rectangle(fibres, 0, {left, -z}, {left + wall, z}, {1, layers});
  }
  add_symmetric(fibres, s.area - sections::area(fibres), s.width / 2 - inwards, s.depth / 2 - inwards, across);
  return fibres;
}

sections::Fibres fibres_of(const European& row, int layers, int across) {
  return fibres_of_i(section_of(row), row.flange * mm, row.web * mm, layers, across);
}
sections::Fibres fibres_of(const AmericanI& row, int layers, int across) {
  return fibres_of_i(section_of(row), row.flange * inch, row.web * inch, layers, across);
}
sections::Fibres fibres_of(const AmericanHollow& row, int layers, int across) {
  return fibres_of_box(section_of(row), row.wall * inch, layers, across);
}
sections::Fibres fibres_of(const AmericanRound& row, int layers, int) {
  return sections::pipe(row.diameter * inch, row.wall * inch, 0, 2, 2 * layers);
}

// SHS, RHS and CHS by their dimensions.
std::optional<Section> hollow_by_dimensions(std::string_view key) {
  const std::string family = family_of(key);
  const std::vector<double> sizes = numbers_of(key);
  if (family == "CHS" && sizes.size() == 2) return tube_section(sizes[0] * mm, sizes[1] * mm);
  if (family == "SHS" && sizes.size() == 2) return hollow_section(sizes[0] * mm, sizes[0] * mm, sizes[1] * mm);
  if (sizes.size() == 3 && (family == "RHS" || (family == "SHS" && sizes[0] == sizes[1])))
    return hollow_section(sizes[0] * mm, sizes[1] * mm, sizes[2] * mm);
  return std::nullopt;
}

std::optional<sections::Fibres> hollow_fibres(std::string_view key, int layers, int across) {
  const std::optional<Section> section = hollow_by_dimensions(key);
  const std::vector<double> sizes = numbers_of(key);
  if (!section) return std::nullopt;
  return section->is_round ? sections::pipe(sizes[0] * mm, sizes[1] * mm, 0, 2, 2 * layers)
                           : fibres_of_box(*section, sizes.back() * mm, layers, across);
}

}  // namespace

Section rolled_i_section(double depth, double width, double flange, double web, double radius) {
  Section s = i_section(depth, width, flange, web);
  if (!(radius >= 0 && 2 * (flange + radius) <= depth && 2 * radius + web <= width))
    throw std::invalid_argument("the root radius must be between 0 and half the clear depth and outstand");
  const Corner corner = corner_of(radius);
  const double y = depth / 2 - flange - corner.distance, z = web / 2 + corner.distance;
  s.area += 4 * corner.area;
  s.inertia_y += 4 * (corner.inertia + corner.area * y * y);
  s.inertia_z += 4 * (corner.inertia + corner.area * z * z);
  s.plastic_y += 4 * corner.area * y;
  s.plastic_z += 4 * corner.area * z;
  const double inscribed =
      (std::pow(radius + web / 2, 2) + std::pow(radius + flange, 2) - radius * radius) / (2 * radius + flange);
  const double junction = web / flange * (0.145 + 0.1 * radius / flange) * std::pow(inscribed, 4);
  s.torsion = 2.0 / 3 * (width - 0.63 * flange) * std::pow(flange, 3) + (depth - 2 * flange) * std::pow(web, 3) / 3 +
              2 * junction;
  return s;
}

Section hollow_section(double depth, double width, double thickness) {
  const double outer = 1.5 * thickness, inner = thickness;
  if (!(thickness > 0 && std::isfinite(depth) && std::isfinite(width)))
    throw std::invalid_argument("the dimensions of a hollow section must be positive and finite");
  if (!(2 * outer <= std::min(depth, width)))
    throw std::invalid_argument("the wall of a hollow section must be at most a third of its smaller side");
  const double clear_depth = depth - 2 * thickness, clear_width = width - 2 * thickness;
  const Corner out = corner_of(outer), in = corner_of(inner);
  const auto inertia = [&](double b, double h, double clear_b, double clear_h) {
    const double of_outer = out.inertia + out.area * std::pow(h / 2 - out.distance, 2);
    const double of_inner = in.inertia + in.area * std::pow(clear_h / 2 - in.distance, 2);
    return (b * h * h * h - clear_b * clear_h * clear_h * clear_h) / 12 - 4 * of_outer + 4 * of_inner;
  };
  const auto plastic = [&](double b, double h, double clear_b, double clear_h) {
    return (b * h * h - clear_b * clear_h * clear_h) / 4 - 4 * out.area * (h / 2 - out.distance) +
           4 * in.area * (clear_h / 2 - in.distance);
  };
  // Mean line, as in EN 10210-2.
  const double mean = (outer + inner) / 2, round = 4 - M_PI;
  const double line = 2 * (depth + width - 2 * thickness) - 2 * mean * round;
  const double enclosed = (depth - thickness) * (width - thickness) - mean * mean * round;
  // As an I-section with both webs, for the shear area along its depth.
  const auto shear = [&](double b, double h) { return i_section(h, b, thickness, 2 * thickness).shear_area_z; };
  Section s;
  s.area = depth * width - clear_depth * clear_width - 4 * out.area + 4 * in.area;
  s.inertia_y = inertia(width, depth, clear_width, clear_depth);
  s.inertia_z = inertia(depth, width, clear_depth, clear_width);
  s.torsion = std::pow(thickness, 3) * line / 3 + 4 * enclosed * enclosed * thickness / line;
  s.shear_area_z = shear(width, depth);
  s.shear_area_y = shear(depth, width);
  s.width = width;
  s.depth = depth;
  s.plastic_y = plastic(width, depth, clear_width, clear_depth);
  s.plastic_z = plastic(depth, width, clear_depth, clear_width);
  return s;
}

std::optional<Section> find_profile(std::string_view name) {
  const std::string key = profile_key(name);
  std::optional<Section> found;
  visit_profiles([&](const auto& row) {
    if (profile_key(row.name) != key) return false;
    found = section_of(row);
    return true;
  });
  return found ? found : hollow_by_dimensions(key);
}

std::optional<sections::Fibres> profile_fibres(std::string_view name, int layers, int across) {
  const std::string key = profile_key(name);
  std::optional<sections::Fibres> found;
  visit_profiles([&](const auto& row) {
    if (profile_key(row.name) != key) return false;
    found = fibres_of(row, layers, across);
    return true;
  });
  return found ? found : hollow_fibres(key, layers, across);
}

std::string nearest_profiles(std::string_view name) {
  const std::string key = profile_key(name), family = family_of(key);
  const std::vector<double> size = numbers_of(key);
  std::vector<std::pair<std::vector<double>, std::string_view>> sizes;
  visit_profiles([&](const auto& row) {
    const std::string other = profile_key(row.name);
    if (family_of(other) == family) sizes.emplace_back(numbers_of(other), row.name);
    return false;
  });
  if (sizes.empty() || size.empty())
    return "standard sections are IPE300, HEA400, HEB400, HEM400, HD, UB 457x191x67, UC, UBP, W14x90, M, S, HP, "
           "HSS8x8x1/2, PIPE8STD, SHS 200x8, RHS 300x200x10 and CHS 219.1x8";
  std::ranges::sort(sizes);
  const auto above = std::ranges::lower_bound(sizes, size, {}, [](const auto& each) { return each.first; });
  if (above == sizes.end()) return fmt::format("the nearest standard section is {}", std::prev(above)->second);
  if (above == sizes.begin()) return fmt::format("the nearest standard section is {}", above->second);
  return fmt::format("the nearest standard sections are {} and {}", std::prev(above)->second, above->second);
}

std::optional<Material> find_steel(std::string_view grade) {
  struct Steel {
    std::string_view name;
    double strength, young, poisson, density;
  };
  constexpr Steel grades[] = {{"S235", 235e6, 210e9, 0.3, 7850},     {"S275", 275e6, 210e9, 0.3, 7850},
                              {"S355", 355e6, 210e9, 0.3, 7850},     {"S420", 420e6, 210e9, 0.3, 7850},
                              {"S460", 460e6, 210e9, 0.3, 7850},     {"A36", 248.2e6, 199.95e9, 0.3, 7850},
                              {"A992", 344.7e6, 199.95e9, 0.3, 7850}};
  const auto found = std::ranges::find(grades, grade, &Steel::name);
  if (found == std::end(grades)) return std::nullopt;
  Material material = isotropic(found->young, found->density, found->poisson);
  material.strength = found->strength;
  return material;
}

}  // namespace pounding
