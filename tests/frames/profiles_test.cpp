// Standard steel sections against published tables.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <pounding/frames/profiles/profiles.hpp>
#include <pounding/frames/sections.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace profiles_test {

using test::mentions;

constexpr double cm = 1e-2;

// Published values: area, inertias, torsion, plastic moduli in powers of cm, with half a unit of their last digit.
struct Published {
  const char* name;
  double area, inertia_y, inertia_z, torsion, plastic_y, plastic_z;
  double digits;  // relative
};

TEST(Profiles, EuropeanSectionsAreThoseOfTheTables) {
  test::Book book("Sections", "ArcelorMittal, Sections and Merchant Bars: A, Iy, Iz, IT, Wpl.y, Wpl.z",
                  "half a unit of the fourth printed digit");
  for (const Published& row : {Published{"HEB400", 197.8, 57680, 10820, 355.7, 3232, 1104, 6e-4},
                               Published{"IPE300", 53.81, 8356, 603.8, 20.12, 628.4, 125.2, 6e-4},
                               Published{"HEA200", 53.83, 3692, 1336, 20.98, 429.5, 203.8, 6e-4}}) {
    const Section s = find_profile(row.name).value();
    book.near("area [cm^2]", s.area / cm / cm, row.area, row.digits * row.area);
    book.near("inertia, strong axis [cm^4]", s.inertia_y / std::pow(cm, 4), row.inertia_y, row.digits * row.inertia_y);
    book.near("inertia, weak axis [cm^4]", s.inertia_z / std::pow(cm, 4), row.inertia_z, row.digits * row.inertia_z);
    book.near("torsion [cm^4]", s.torsion / std::pow(cm, 4), row.torsion, 2 * row.digits * row.torsion);
    book.near("plastic modulus, strong axis [cm^3]", s.plastic_y / std::pow(cm, 3), row.plastic_y,
              row.digits * row.plastic_y);
    book.near("plastic modulus, weak axis [cm^3]", s.plastic_z / std::pow(cm, 3), row.plastic_z,
              row.digits * row.plastic_z);
  }
}

TEST(Profiles, BritishSectionsAreThoseOfTheTables) {
  // SCI P363: UB 457x191x67 has A = 85.5, Iy = 29400, Iz = 1450, IT = 37.1, Wpl.y = 1470, Wpl.z = 237, radius 10.2 mm.
  const Section s = find_profile("UB 457x191x67").value();
  EXPECT_NEAR(s.area, 85.5e-4, 0.1e-4);
  EXPECT_NEAR(s.inertia_y, 29400e-8, 50e-8);
  EXPECT_NEAR(s.inertia_z, 1450e-8, 5e-8);
  // SCI computes the junctions of web and flanges by another formula than the European tables.
  EXPECT_NEAR(s.torsion, 37.1e-8, 0.01 * 37.1e-8);
  EXPECT_NEAR(s.plastic_y, 1470e-6, 5e-6);
  EXPECT_NEAR(s.plastic_z, 237e-6, 0.5e-6);
}

TEST(Profiles, AmericanSectionsAreThoseOfTheManual) {
  // AISC Steel Construction Manual: W14x90 has A = 26.5 in^2, Ix = 999, Iy = 362, J = 4.06 in^4, Zx = 157, Zy = 75.6.
  constexpr double in = 0.0254;
  const Section w = find_profile("W14x90").value();
  EXPECT_NEAR(w.area, 26.5 * in * in, 1e-12);
  EXPECT_NEAR(w.inertia_y, 999 * std::pow(in, 4), 1e-12);
  EXPECT_NEAR(w.inertia_z, 362 * std::pow(in, 4), 1e-12);
  EXPECT_NEAR(w.torsion, 4.06 * std::pow(in, 4), 1e-12);
  EXPECT_NEAR(w.plastic_y, 157 * std::pow(in, 3), 1e-12);
  EXPECT_NEAR(w.plastic_z, 75.6 * std::pow(in, 3), 1e-12);
  EXPECT_NEAR(w.depth, 14.0 * in, 1e-12);
  // HSS8x8x1/2: A = 13.5 in^2, I = 125 in^4, Z = 37.5 in^3.
  const Section box = find_profile("HSS8x8x1/2").value();
  EXPECT_NEAR(box.area, 13.5 * in * in, 1e-12);
  EXPECT_NEAR(box.inertia_y, 125 * std::pow(in, 4), 1e-12);
  EXPECT_NEAR(box.plastic_y, 37.5 * std::pow(in, 3), 1e-12);
  EXPECT_TRUE(find_profile("HSS6.625x0.250").value().is_round);
  EXPECT_TRUE(find_profile("Pipe 8 STD").has_value());
}

TEST(Profiles, HollowSectionsAreThoseOfEn10210) {
  const Section square = find_profile("SHS 200x200x8").value();  // A 60.8, I 3709, IT 5778, Wpl 436
  EXPECT_NEAR(square.area, 60.8e-4, 0.05e-4);
  EXPECT_NEAR(square.inertia_y, 3709e-8, 1e-8);
  EXPECT_NEAR(square.torsion, 5778e-8, 1e-8);
  EXPECT_NEAR(square.plastic_y, 436e-6, 0.5e-6);
  const Section box = find_profile("RHS300x200x10").value();  // A 94.9, I 11819 and 6278, IT 12908, Wpl 956 and 721
  EXPECT_NEAR(box.area, 94.9e-4, 0.05e-4);
  EXPECT_NEAR(box.inertia_y, 11819e-8, 1e-8);
  EXPECT_NEAR(box.inertia_z, 6278e-8, 1e-8);
  EXPECT_NEAR(box.torsion, 12908e-8, 1e-8);
  EXPECT_NEAR(box.plastic_y, 956e-6, 0.5e-6);
  EXPECT_NEAR(box.plastic_z, 721e-6, 0.5e-6);
  const Section round = find_profile("CHS 219.1x8").value();  // A 53.1, I 2960, IT 5919, Wpl 357
  EXPECT_NEAR(round.area, 53.1e-4, 0.05e-4);
  EXPECT_NEAR(round.inertia_y, 2960e-8, 1e-8);
  EXPECT_NEAR(round.plastic_y, 357e-6, 0.5e-6);
  EXPECT_THROW(find_profile("SHS 20x10"), std::invalid_argument);
}

TEST(Profiles, NamesAreFoundRegardlessOfCaseBlanksAndSeparators) {
  const double area = find_profile("HEB400")->area;
  for (const char* same : {"heb400", "HEB 400", "HE 400 B", "he400b"}) EXPECT_EQ(find_profile(same).value().area, area);
  EXPECT_EQ(find_profile("w 14 X 90").value().area, find_profile("W14x90").value().area);
  EXPECT_FALSE(find_profile("HEB410"));
  EXPECT_TRUE(mentions(nearest_profiles("HEB410"), {"HEB400", "HEB450"}));
  EXPECT_TRUE(mentions(nearest_profiles("beam"), {"HEB400", "W14x90"}));
}

TEST(Profiles, PlasticModuliOfShapesHaveClosedForms) {
  EXPECT_DOUBLE_EQ(rectangle_section(0.3, 0.5).plastic_y, 0.3 * 0.25 / 4);
  EXPECT_DOUBLE_EQ(rectangle_section(0.3, 0.5).plastic_z, 0.5 * 0.09 / 4);
  EXPECT_DOUBLE_EQ(circle_section(0.6).plastic_y, 0.216 / 6);
  EXPECT_NEAR(tube_section(0.5, 0.01).plastic_y, (0.125 - std::pow(0.48, 3)) / 6, 1e-15);
  const Section i = i_section(0.3, 0.15, 0.0107, 0.0071);
  EXPECT_NEAR(i.plastic_y, 0.15 * 0.09 / 4 - (0.15 - 0.0071) * std::pow(0.2786, 2) / 4, 1e-15);
  const Section weak = turned_section(i);
  EXPECT_EQ(weak.plastic_y, i.plastic_z);
  EXPECT_EQ(weak.inertia_z, i.inertia_y);
  EXPECT_EQ(weak.depth, i.width);
}

TEST(Profiles, GradesHaveTheirStrength) {
  const Material steel = find_steel("S355").value();
  EXPECT_EQ(steel.strength, 355e6);
  EXPECT_EQ(steel.young, 210e9);
  EXPECT_NEAR(steel.shear, 80.769e9, 1e6);
  EXPECT_FALSE(find_steel("S3555"));
}

}  // namespace profiles_test
}  // namespace pounding
