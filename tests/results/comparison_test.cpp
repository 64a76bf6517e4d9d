/// Rankings of members and yielding parts with and without links, from numbers chosen by hand.

#include <pounding/results/comparison.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pounding {
namespace comparison_test {

// A frame with two members of a shear and a moment at both ends; one force per member and component.
StructureSummary frame(const std::vector<double>& forces) {
  StructureSummary s;
  s.name = "a";
  s.directions = {"x"};
  s.peak_displacement = s.peak_drift = {0.01};
  s.peak_acceleration = {2};
  s.envelope.members = {"beam", "column"};
  s.envelope.components = {"start Vz", "start My", "end Vz", "end My"};
  s.envelope.member_force = Extremes(forces.size());
  for (std::size_t i = 0; i < forces.size(); ++i) s.envelope.member_force.update(i, 0.1, forces[i]);
  return s;
}

SpringSummary hinge(const std::string& name, double ductility, double plastic) {
  SpringSummary s;
  s.name = name;
  s.is_hinge = true;
  s.ductility = ductility;
  s.plastic = plastic;
  return s;
}

TEST(ComparedMembers, AreTheLargerOfBothEnds) {
  const auto rows =
      compare_members(frame({1, -20, -5, 10, 100, 200, 50, -400}), frame({2, 5, -1, -10, 50, 100, 25, 100}));
  ASSERT_EQ(rows.size(), 4);
  EXPECT_EQ(rows[0].member + rows[0].component, "beamVz");
  EXPECT_EQ(rows[0].force.with, 5);
  EXPECT_EQ(rows[0].force.without, 2);
  EXPECT_EQ(rows[0].force.ratio(), 2.5);
  EXPECT_EQ(rows[0].demand, 0.05);  // of 100 in the column
  EXPECT_EQ(rows[3].member + rows[3].component, "columnMy");
  EXPECT_EQ(rows[3].force.ratio(), 4);
  EXPECT_EQ(rows[3].demand, 1);
}

TEST(ComparedMembers, AreRankedByRatioOnlyIfTheirForceCounts) {
  // The beam has the largest ratio of shears, 1000, and 0.2 % of the shear of the column.
  const auto rows = compare_members(frame({0.2, 100, 0, 0, 100, 400, 0, 0}), frame({0.0002, 10, 0, 0, 50, 400, 0, 0}));
  const auto by_ratio = worst_by_ratio(rows);
  ASSERT_EQ(by_ratio.size(), 3);
  EXPECT_EQ(by_ratio[0].member + by_ratio[0].component, "beamMy");
  EXPECT_EQ(by_ratio[0].force.ratio(), 10);
  EXPECT_EQ(by_ratio[1].force.ratio(), 2);
  EXPECT_EQ(by_ratio[2].force.ratio(), 1);
  const auto by_demand = worst_by_demand(rows);
  EXPECT_EQ(by_demand[0].member + by_demand[1].member, "columncolumn");
  EXPECT_EQ(by_demand[3].demand, 0.002);
}

TEST(ComparedMembers, HaveNoRatioToRoundOff) {
  const auto rows = compare_members(frame({1, 1, 0, 0, 1, 1, 0, 0}), frame({1e-13, 0, 0, 0, 1, 1, 0, 0}));
  EXPECT_TRUE(std::isnan(rows[0].force.ratio()));
  EXPECT_TRUE(std::isnan(rows[1].force.ratio()));
  EXPECT_EQ(worst_by_ratio(rows).size(), 2);
}

TEST(ComparedParts, AreRankedByDuctility) {
  StructureSummary with = frame({}), without = frame({});
  for (int i = 0; i < 7; ++i) {
    with.springs.push_back(hinge("h" + std::to_string(i), 1.0 + i, 1e-3 * i));
    without.springs.push_back(hinge("h" + std::to_string(i), i == 1 ? 0.5 : 0.9 + i, 0));
  }
  const auto rows = compare_parts(with, without);
  ASSERT_EQ(rows.size(), 7);
  const auto by_ratio = worst_by_ratio(rows);
  ASSERT_EQ(by_ratio.size(), worst_count);
  EXPECT_EQ(by_ratio[0].part, "h1");
  EXPECT_EQ(by_ratio[0].ductility.ratio(), 4);
  EXPECT_EQ(by_ratio[1].part, "h2");  // h0 does not yield with links
  const auto by_demand = worst_by_demand(rows);
  EXPECT_EQ(by_demand[0].part, "h6");
  EXPECT_EQ(by_demand[0].plastic.with, 6e-3);
}

TEST(Comparison, HasNullRatiosIfARunEndedEarly) {
  Summary summary;
  summary.structures = {frame({1, 2, 3, 4, 5, 6, 7, 8})};
  summary.without_pounding = {frame({1, 1, 1, 1, 1, 1, 1, 1})};
  summary.status = summary.without_links_status = "done";
  EXPECT_EQ(comparison_json(summary)["a"]["members"]["by_ratio"][0]["ratio"], 8);
  EXPECT_EQ(comparison_json(summary)["a"]["acceleration"][0]["ratio"], 1);
  EXPECT_NE(comparison_table(summary).find("8.000"), std::string::npos);
  summary.without_links_status = "done: collapse of a";
  EXPECT_TRUE(comparison_json(summary)["a"]["members"]["by_demand"][0]["ratio"].is_null());
  EXPECT_TRUE(comparison_json(summary)["a"]["drift"][0]["ratio"].is_null());
  EXPECT_EQ(comparison_table(summary).find("largest ratios"), std::string::npos);
  EXPECT_EQ(comparison_table({}), "");
}

}  // namespace comparison_test
}  // namespace pounding
