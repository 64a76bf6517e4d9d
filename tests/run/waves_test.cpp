// A travelling wave at structures without a location in plan: walls move with each linked face, structures along x with
// their own faces.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/model/ground_plan.hpp>
#include "support/models.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace waves_test {

std::string moved(const std::string& wave = "velocity: 200 m/s, direction: x") {
  return "ground_motion: {harmonic: {amplitude: 3 m/s^2, period: 0.5, duration: 2}, wave: {" + wave +
         "}}\nstructures:\n";
}

// A frame of 6 m.
std::string frame(const std::string& name, const std::string& origin, const std::string& bays = "1",
                  const std::string& more = "") {
  return fmt::format(
      "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: 2, bays: {}, storey_height: 3 m, "
      "bay_width: 6 m, columns: {{rectangle: [0.4, 0.4]}}, "
      "beams: {{rectangle: [0.3, 0.5]}}, floor_mass: 50 t, rigid_floors: true}}{}}}, damping: 5 %}}\n",
      name, origin, bays, more);
}

std::string link(const std::string& between, const std::string& more = "gap: 20 mm") {
  return "  - {between: " + between + ", " + more + ", law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}\n";
}

const std::string end = "analysis: {duration: 2 s, output_step: 10 ms}\n";

// Delays of the ground motion along x under a structure, from the arrival at the first support overall [s].
std::vector<double> arrivals(const Model& model, int structure) {
  std::vector<double> all;
  for (const Support& support : model.structures[structure].supports)
    all.push_back(support.delay + support.position.dot(model.ground.wave->direction) / model.ground.wave->velocity);
  return all;
}

TEST(Waves, ReachAWallAtTheFaceItIsLinkedTo) {
  const auto impacts = [](double origin) {
    Outcome run = test::run_text(moved() + frame("left", fmt::format("{} m, 0", origin)) +
                                 "  moat: {wall: {}}\nlinks:\n" + link("[left.1, moat]", "gap: 5 mm") + end);
    return run;
  };
  const Outcome at_zero = impacts(0), far = impacts(100), west = impacts(-400);
  ASSERT_GT(at_zero.results.impacts.size(), 0u);
  EXPECT_EQ(far.results.impacts.size(), at_zero.results.impacts.size())
      << "the location of the whole model has no effect";
  EXPECT_EQ(west.results.impacts.size(), at_zero.results.impacts.size());
  EXPECT_NEAR(far.summary.links[0].peak_force, at_zero.summary.links[0].peak_force,
              1e-6 * at_zero.summary.links[0].peak_force);
  const Model model = test::model_of(moved() + frame("left", "100 m, 0") + "  moat: {wall: {}}\nlinks:\n" +
                                     link("[left.1, moat]") + end);
  EXPECT_EQ(arrivals(model, 1), std::vector<double>{106.0 / 200});
}

TEST(Waves, ReachAWallAtEachOfItsFaces) {
  const Model model =
      test::model_of(moved() + frame("left", "100 m, 0", "1", ", face: 0.2 m") + frame("right", "108 m, 0") +
                     "  wall: {wall: {}}\n  far: {wall: {}}\nlinks:\n" + link("[left.1, wall]") +
                     link("[wall, right.1]") + link("[wall, left.2]") + link("[right.2, far]") + end);
  EXPECT_EQ(arrivals(model, 2), (std::vector<double>{106.0 / 200, 108.0 / 200, 100.0 / 200}))
      << "links with a given gap are from face to face";
  EXPECT_EQ(arrivals(model, 3), std::vector<double>{114.0 / 200});
  // Each side moves with the ground there, as two separate walls do.
  const std::string parts = moved() + frame("left", "100 m, 0") + frame("right", "108 m, 0");
  const Outcome one = test::run_text(parts + "  w: {wall: {}}\nlinks:\n" + link("[left.1, w]", "gap: 4 mm") +
                                     link("[w, right.1]", "gap: 4 mm") + end);
  const Outcome two = test::run_text(parts + "  w: {wall: {}}\n  v: {wall: {}}\nlinks:\n" +
                                     link("[left.1, w]", "gap: 4 mm") + link("[v, right.1]", "gap: 4 mm") + end);
  ASSERT_GT(one.summary.links[1].impacts, 0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(one.summary.links[i].impacts, two.summary.links[i].impacts);
    EXPECT_NEAR(one.summary.links[i].peak_force, two.summary.links[i].peak_force,
                1e-9 * two.summary.links[i].peak_force);
  }
}

TEST(Waves, ReachAWallInSpaceObliquely) {
  const Model model =
      test::model_of(moved("velocity: 500 m/s, direction: [0.6, 0.8]") + frame("house", "30 m, 40 m", "[1, 1]") +
                     "  w: {wall: {}, delay: 0.1 s}\nlinks:\n" + link("[house.1, w]") + end);
  const std::vector<double> found = arrivals(model, 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 0.1 + (0.6 * 36 + 0.8 * 43) / 500, 1e-12) << "in the middle of the face";
}

TEST(Waves, ReachStructuresWithoutAPlaceAtTheFaceTheyMeet) {
  const std::string oscillator = ": {oscillator: {mass: 100 t, period: 0.4}, damping: 5 %}\n";
  const Model model =
      test::model_of(moved() + frame("left", "100 m, 0") + "  b" + oscillator + "  c" + oscillator +
                     "  w: {wall: {}}\nlinks:\n" + link("[c, w]") + link("[b, c]") + link("[left.1, b]") + end);
  for (const int structure : {1, 2, 3})
    EXPECT_EQ(arrivals(model, structure), std::vector<double>{106.0 / 200}) << structure;
  test::refused(moved() + frame("left", "0, 0") + "  b" + oscillator + frame("right", "8 m, 0") + "links:\n" +
                    link("[left.1, b]") + link("[b, right.1]") + end,
                test::at("4:6", "structures.b"), test::mentions({"ground_motion", "6 m", "8 m"}));
  const std::string own =
      "  b: {oscillator: {mass: 100 t, period: 0.4}, damping: 5 %, ground_motion: {harmonic: {amplitude: 3, period: "
      "0.5, duration: 2}}}\n";
  EXPECT_NO_THROW(test::model_of(moved() + frame("left", "0, 0") + own + frame("right", "8 m, 0") + "links:\n" +
                                 link("[left.1, b]") + link("[b, right.1]") + end));
}

TEST(Waves, ReachADeviceAtAWallThere) {
  const Model model = test::model_of(
      moved() + frame("left", "100 m, 0") +
      "  w: {wall: {}}\ndevices:\n  d: {between: [left.1, w], damper: {coefficient: 100 kN s/m}}\n" + end);
  EXPECT_EQ(arrivals(model, 1), std::vector<double>{106.0 / 200});
}

}  // namespace waves_test
}  // namespace pounding
