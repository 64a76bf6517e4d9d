#pragma once
/// Section of the references: reinforced concrete, 0.4 x 0.4 m.

#include <string>
#include <vector>

#include <pounding/sections/builders.hpp>
#include <pounding/sections/fibre_section.hpp>

namespace pounding::test {

/// Core, cover, and reinforcement of a law.
inline std::vector<materials::AnyMaterial> column_materials(const std::string& steel) {
  const auto concrete = [](double fpc, double epsc0, double fpcu, double epsU) {
    return materials::make_material({.law = "concrete02",
                                     .values = {{"fpc", fpc},
                                                {"epsc0", epsc0},
                                                {"fpcu", fpcu},
                                                {"epsU", epsU},
                                                {"lambda", 0.1},
                                                {"ft", 2.5e6},
                                                {"Ets", 1.5e9}}});
  };
  return {concrete(-36e6, -0.004, -28e6, -0.03), concrete(-28e6, -0.002, -5.6e6, -0.006),
          materials::make_material(
              {.law = steel, .values = {{"Fy", 460e6}, {steel == "steel01" ? "E0" : "E", 200e9}, {"b", 0.01}}})};
}

/// In layers, for bending about y.
inline sections::RcRectangle column_dimensions() {
  sections::RcRectangle column{.width = 0.4, .depth = 0.4, .cover = 0.04, .core = 0, .shell = 1, .bars = 2};
  column.top = column.bottom = {4, 3e-4};
  column.sides = {2, 4e-4};
  return column;
}

inline sections::FibreSection reinforced_column(const std::string& steel) {
  return {column_materials(steel), sections::rc_rectangle(column_dimensions())};
}

}  // namespace pounding::test
