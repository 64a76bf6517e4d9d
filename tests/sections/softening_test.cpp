/// Softening of sections, which decides whether a force-based member needs a hinge length.

#include <gtest/gtest.h>

#include <pounding/sections/softening.hpp>
#include "sections/reinforced_column.hpp"

namespace pounding::sections {
namespace softening_test {

using materials::AnyMaterial;

// The column of the references, with crushing strengths of core and cover.
FibreSection column(double core_fpcu, double cover_fpcu) {
  std::vector<AnyMaterial> laws = test::column_materials("steel01");
  std::get<materials::Concrete02>(laws[0]).fpcu = core_fpcu;
  std::get<materials::Concrete02>(laws[1]).fpcu = cover_fpcu;
  return {laws, rc_rectangle(test::column_dimensions())};
}

TEST(Softening, OfTheCoreIsFoundWithItsStresses) {
  const auto found = find_softening(column(-28e6, -5.6e6));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->material, 0u);
  EXPECT_EQ(found->strength, -36e6);
  EXPECT_EQ(found->rest, -28e6);
}

TEST(Softening, OfTheCoverAloneDoesNotCount) { EXPECT_FALSE(find_softening(column(-36e6, -5.6e6))); }

TEST(Softening, OfASectionOfOneConcreteCounts) {
  const Fibres square = rectangle(0.4, 0.4, 0, 10);
  EXPECT_TRUE(find_softening({{test::column_materials("steel01")[1]}, square}));
  const AnyMaterial popovics = materials::make_material(
      {.law = "concrete04", .values = {{"fc", -30e6}, {"epsc", -0.002}, {"epscu", -0.01}, {"Ec", 26e9}}});
  EXPECT_EQ(find_softening({{popovics}, square}).value().rest, 0);
  const AnyMaterial constant = materials::make_material(
      {.law = "concrete01", .values = {{"fpc", -30e6}, {"epsc0", -0.002}, {"fpcu", -30e6}, {"epsU", -0.006}}});
  EXPECT_FALSE(find_softening({{constant}, square}));
}

TEST(Softening, SteelDoesNotSoften) {
  const Fibres square = rectangle(0.1, 0.1, 0, 4);
  for (const char* const law : {"steel01", "menegotto_pinto", "steel02"})
    EXPECT_FALSE(find_softening({{test::column_materials(law)[2]}, square})) << law;
}

}  // namespace softening_test
}  // namespace pounding::sections
