// Paths of pushed structures against closed forms, limit analysis and curves of other programs.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/model/push_path.hpp>
#include <pounding/structures/oscillators.hpp>
#include "support/book.hpp"
#include "support/refusal.hpp"
#include "yielding_frames.hpp"

namespace pounding {
namespace {

using test::Book;
using test::HandMadeFrame;
using test::HingedFrame;
using test::TestHinge;
using test::unit_row;

constexpr double rigid = std::numeric_limits<double>::infinity();

PushOptions at(int control, const Eigen::VectorXd& load, std::vector<double> targets) {
  return {.load = load, .control = unit_row(static_cast<int>(load.size()), control), .targets = std::move(targets)};
}

std::set<std::string> yields_at(const Structure& s, const PushPath& path, int point) {
  std::set<std::string> names;
  for (const PushEvent& event : path.events)
    if (event.point == point && event.kind == PushEvent::Kind::yields) names.insert(s.yielding[event.part].name);
  return names;
}

void expect_curve_of_the_frame(const std::string& how, const Structure& s) {
  const HingedFrame frame;
  const PushPath path = push(s, at(frame.roof(), frame.triangular(s.size()), {0.25}));
  ASSERT_EQ(path.points.size(), 6u);
  const double roof[] = {22.21674, 27.09875, 40.13070, 71.95633, 250}, shear[] = {154.1540, 173.3743, 200.2638, 224.0691, 281.0893};
  Book book("pushover of a frame with hinges, " + how, "event to event on another assembly of the stiffness, in Python (numpy)",
            "half a unit of the last digit that was printed");
  for (int i = 0; i < 5; ++i) {
    book.near("displacement of the roof [mm]", 1e3 * path.points[i + 1].displacement, roof[i], 5.1e-6);
    book.near("base shear [kN]", path.points[i + 1].factor / 1e3, shear[i], 5.1e-5);
  }
  EXPECT_EQ(yields_at(s, path, 1), (std::set<std::string>{"beam 1 left", "beam 1 right"}));
  EXPECT_EQ(yields_at(s, path, 2), (std::set<std::string>{"beam 2 left", "beam 2 right"}));
  EXPECT_EQ(yields_at(s, path, 3), (std::set<std::string>{"foot 0", "foot 1"}));
  EXPECT_EQ(yields_at(s, path, 4), (std::set<std::string>{"beam 3 left", "beam 3 right"}));
  EXPECT_EQ(path.mechanism, 4);
  EXPECT_EQ(path.mechanism_parts.size(), 8u);
  EXPECT_EQ(path.collapse, "");
}

TEST(PushPath, MeetsTheCurveOfAFrameWithSpringsAtItsHinges) { expect_curve_of_the_frame("springs beside joints", HingedFrame().with_springs()); }

TEST(PushPath, MeetsTheCurveOfAFrameWithHingesInSeries) { expect_curve_of_the_frame("hinges in series", HingedFrame().in_series()); }

}  // namespace
}  // namespace pounding
