#pragma once
/// Hinges on a cyclic path, written by tests/verification/axial_moment_paths.py.

#include <array>

namespace pounding::test {

struct AxialMomentPath {
  std::array<std::array<double, 2>, 9> points;
};
/// Elongations and rotations, divided by capacity/stiffness.
inline constexpr AxialMomentPath axial_moment_path{
    {{{0.5, 0.2}, {2, 3}, {-4, 2}, {-3, -5}, {1, -1}, {8, 0.5}, {7, -6}, {0, 0.1}, {-9, 0}}}};
// Forces N [N] and moments M [N m] there.
/// Doubt 2.4e-04.
inline constexpr AxialMomentPath parabola_forces{{{{500000, 30000},
                                                   {562921.78, 119887.064},
                                                   {-1090000, 9000},
                                                   {32006.2443, -165698.115},
                                                   {927029.238, 16567.8163},
                                                   {1210000, 2250},
                                                   {79390.9686, -169862.054},
                                                   {-970000, 450},
                                                   {-1240000, 1.9264465e-12}}}};
/// Doubt 5.2e-04.
inline constexpr AxialMomentPath ellipse_forces{{{{500000, 30000},
                                                  {734692.226, 118037.237},
                                                  {-1085786.99, -4546.15958},
                                                  {122317.043, -164471.769},
                                                  {876467.959, 66555.0481},
                                                  {1203029.15, 19662.1825},
                                                  {-6194.09646, -168840.06},
                                                  {-870994.845, 64489.2812},
                                                  {-1239981.06, -909.348918}}}};
/// Doubt 5.2e-04.
inline constexpr AxialMomentPath offset_forces{{{{500000, 30000},
                                                 {455602.101, 116277.648},
                                                 {-1376786.95, -4546.23049},
                                                 {-168682.949, -164471.769},
                                                 {585467.959, 66555.0481},
                                                 {912029.154, 19662.1825},
                                                 {-297194.096, -168840.06},
                                                 {-1161994.85, 64489.2812},
                                                 {-1530981.06, -909.348918}}}};

}  // namespace pounding::test
