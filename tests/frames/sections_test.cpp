// Sections against closed forms and tables.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include <pounding/frames/sections.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace sections_test {

void refused(const std::function<void()>& act, const test::Facts& facts,
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal(act), "", facts, line);
}

TEST(Sections, RectangleBendsAboutYByItsDepth) {
  const Section s = rectangle_section(0.3, 0.5);
  EXPECT_DOUBLE_EQ(s.area, 0.15);
  EXPECT_DOUBLE_EQ(s.inertia_y, 0.3 * 0.125 / 12);
  EXPECT_DOUBLE_EQ(s.inertia_z, 0.5 * 0.027 / 12);
  EXPECT_DOUBLE_EQ(s.shear_area_y, 0.125);
  EXPECT_DOUBLE_EQ(s.shear_area_z, 0.125);
}

TEST(Sections, RectangleTwistsAsInTimoshenkosTable) {
  test::Book book("Sections",
                  "Timoshenko & Goodier, Theory of Elasticity, 3rd edition, article 109; of the square to ten digits "
                  "Roark",
                  "half a unit of the last printed digit, one unit for the square");
  book.near("torsion of a square over b^4 [-]", rectangle_section(1, 1).torsion, 0.1405770150, 1e-10);
  book.near("torsion of 1:1.5 over b a^3 [-]", rectangle_section(1, 1.5).torsion / 1.5, 0.196, 5e-4);
  book.near("torsion of 1:2 over b a^3 [-]", rectangle_section(1, 2).torsion / 2, 0.229, 5e-4);
  book.near("torsion of 1:4 over b a^3 [-]", rectangle_section(1, 4).torsion / 4, 0.281, 5e-4);
  book.near("torsion of 1:10 over b a^3 [-]", rectangle_section(1, 10).torsion / 10, 0.312, 5e-4);
  EXPECT_DOUBLE_EQ(rectangle_section(2, 1).torsion, rectangle_section(1, 2).torsion);
}

TEST(Sections, NarrowStripTwistsByItsLengthLessItsEnds) {
  test::Book book("Sections",
                  "narrow strip: a b^3/3 less 0.630249 b^4/3, where 192/pi^5 times the sum of n^-5 over odd n is "
                  "0.63025",
                  "the digits of the sum");
  book.near("torsion of 1:100 [m^4]", rectangle_section(1, 100).torsion, 100.0 / 3 - 0.630249 / 3, 1e-6);
}

TEST(Sections, CircleIsATubeWithoutAHole) {
  test::Book book("Sections", "circle: pi d^2/4, pi d^4/64, Cowper's 6/7", "rounding");
  const Section s = circle_section(0.5);
  book.near("area of a circle [m^2]", s.area, M_PI * 0.0625, 1e-15);
  book.near("inertia of a circle [m^4]", s.inertia_y, M_PI * std::pow(0.5, 4) / 64, 1e-16);
  EXPECT_DOUBLE_EQ(s.inertia_z, s.inertia_y);
  EXPECT_DOUBLE_EQ(s.torsion, 2 * s.inertia_y);
  book.near("shear area of a circle [m^2]", s.shear_area_z, s.area * 6 / 7, 1e-15);
  const Section almost_full = tube_section(0.5, 0.25 - 1e-9);
  EXPECT_NEAR(almost_full.area, s.area, 1e-12);
  EXPECT_NEAR(almost_full.shear_area_y, s.shear_area_y, 1e-12);
}

TEST(Sections, TubeIsADifferenceOfCircles) {
  test::Book book("Sections", "tube: difference of circles; half of a thin one shears", "rounding");
  const Section s = tube_section(0.5, 0.01);
  book.near("area of a tube [m^2]", s.area, M_PI / 4 * (0.25 - 0.2304), 1e-15);
  book.near("inertia of a tube [m^4]", s.inertia_y, M_PI / 64 * (std::pow(0.5, 4) - std::pow(0.48, 4)), 1e-15);
  EXPECT_DOUBLE_EQ(s.torsion, 2 * s.inertia_z);
  book.near("shear area over area of a thin tube [-]",
            tube_section(0.5, 1e-6).shear_area_z / tube_section(0.5, 1e-6).area, 0.5, 1e-5);
}

// Without fillets, the areas of the rectangles sum to 2 x 15 x 1.07 + 27.86 x 0.71.
TEST(Sections, AnISectionIsThreeRectangles) {
  test::Book book(
      "Sections",
      "IPE 300 of the section tables, 53.81 cm^2 with fillets of 15 mm; without them rectangles by "
      "Steiner",
      "the last digit of the table, otherwise round-off; Cowper's shear area is close to that of the web alone");
  const Section s = i_section(0.3, 0.15, 0.0107, 0.0071);
  book.near("area of IPE 300 without fillets [m^2]", s.area, 51.8806e-4, 1e-10);
  const double fillets = (4 - M_PI) * 0.015 * 0.015;
  book.near("area of IPE 300 with fillets [m^2]", s.area + fillets, 53.81e-4, 0.005e-4);
  // Two flanges by the parallel axis theorem, and the web.
  const double flange = 0.15 * std::pow(0.0107, 3) / 12 + 0.15 * 0.0107 * std::pow(0.14465, 2);
  book.near("inertia_y of IPE 300 without fillets [m^4]", s.inertia_y, 2 * flange + 0.0071 * std::pow(0.2786, 3) / 12,
            1e-15);
  book.near("inertia_z of IPE 300 without fillets [m^4]", s.inertia_z,
            2 * 0.0107 * std::pow(0.15, 3) / 12 + 0.2786 * std::pow(0.0071, 3) / 12, 1e-15);
  book.near("torsion of three thin rectangles [m^4]", s.torsion,
            (2 * 0.15 * std::pow(0.0107, 3) + 0.2893 * std::pow(0.0071, 3)) / 3, 1e-18);
  book.near("shear area of the flanges, 5/6 [m^2]", s.shear_area_y, 2 * 0.15 * 0.0107 * 5 / 6, 1e-15);
  // Cowper's factor is close to that of the web alone.
  book.near("shear area, of the web [m^2]", s.shear_area_z, 0.2893 * 0.0071, 0.08 * 0.2893 * 0.0071);
}

// With negligible flanges the factor is that of a rectangle.
TEST(Sections, AnISectionOfAWebOnlyShearsAsARectangle) {
  test::Book book("Sections", "rectangle: 5/6", "of negligible flanges");
  const Section s = i_section(1, 0.01 + 1e-9, 1e-7, 0.01);
  book.near("shear area over area of a web [-]", s.shear_area_z / s.area, 5.0 / 6, 1e-5);
}

TEST(Sections, ShearAndStiffnessAreChosen) {
  const Section s = rectangle_section(0.3, 0.5), stiff = without_shear_deformation(s), cracked = with_stiffness(s, 0.5);
  EXPECT_TRUE(std::isinf(stiff.shear_area_y) && std::isinf(stiff.shear_area_z));
  EXPECT_EQ(stiff.inertia_y, s.inertia_y);
  EXPECT_EQ(cracked.inertia_y, 0.5 * s.inertia_y);
  EXPECT_EQ(cracked.inertia_z, 0.5 * s.inertia_z);
  EXPECT_EQ(cracked.area, s.area);
  EXPECT_EQ(cracked.torsion, s.torsion);
}

TEST(Sections, ImpossibleShapesAreRefused) {
  refused([] { rectangle_section(0, 1); }, {"width"});
  refused([] { rectangle_section(1, -1); }, {"depth"});
  refused([] { circle_section(NAN); }, {"diameter"});
  refused([] { tube_section(0.5, 0.25); }, {"thickness"});
  refused([] { i_section(0.3, 0.15, 0.15, 0.01); }, {"flange"});
  refused([] { i_section(0.3, 0.15, 0.01, 0.2); }, {"web", "width"});
  refused([] { with_stiffness(rectangle_section(1, 1), 0); }, {"stiffness"});
}

}  // namespace sections_test
}  // namespace pounding
