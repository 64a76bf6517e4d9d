// Memory that ends while the resolved model is written: the whole text, or none.

#include <gtest/gtest.h>

#include <string>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include "support/models.hpp"
#include "support/short_memory.hpp"

namespace pounding {
namespace short_memory_test {

// Names, words and numbers of more letters than a std::string holds without asking for memory.
constexpr const char* model =
    "title: two buildings whose names are long\n"
    "ground_motion: {harmonic: {amplitude: 1, period: 0.3, duration: 1}}\n"
    "structures:\n"
    "  building_on_isolators:\n"
    "    shear_building: {storeys: 2, mass: 123456.78901234567, stiffness: 300 MN/m,\n"
    "      isolator: {lead_rubber: {strength: 375.12345678901234 kN, yield_displacement: 12 mm, post_yield_stiffness: "
    "3.5 MN/m}, capacity: 300 mm}}\n"
    "    damping: 2 %\n"
    "  building_that_yields:\n"
    "    shear_building: {storeys: 2, mass: 200 t, stiffness: 60 MN/m, yield_force: 0.9 MN, hardening: 0.05}\n"
    "    damping: 3 %\n"
    "links: [{between: [building_on_isolators, building_that_yields], floors: all, gap: 20 mm, law: hertz_damped, "
    "stiffness: 1e9, restitution: 0.65}]\n"
    "analysis: {duration: 1.2345678901234567}\n";

TEST(ShortMemory, LeavesNoResolvedModelCut) {
  const Model read = test::model_of(model);
  ASSERT_NE(resolved_yaml(read).find("123456.78901234567"), std::string::npos) << resolved_yaml(read);
  test::expect_right_answers_in_short_memory([&] { return resolved_yaml(read); });
}

}  // namespace short_memory_test
}  // namespace pounding
