#pragma once
/// Whether two runs are bitwise identical.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/run/run.hpp>

namespace pounding::test {

/// Every number of the results and of the summary, by name, without run times.
inline std::map<std::string, std::vector<std::uint64_t>> bits_of(Outcome outcome) {
  std::map<std::string, std::vector<std::uint64_t>> all;
  const auto add = [&](const std::string& place, const std::vector<double>& values) {
    for (const double value : values) all[place].push_back(std::bit_cast<std::uint64_t>(value));
  };
  visit_histories(outcome.results, add);
  for (const ImpactRow& row : outcome.results.impacts)
    add("impacts", {static_cast<double>(row.link), row.t_start, row.t_end, row.t_release, row.v_approach,
                    row.v_separation, row.restitution, row.peak_force, row.t_peak, row.peak_penetration, row.impulse,
                    row.energy_lost, row.energy_stored});
  SolverStatistics& solver = outcome.summary.solver;
  solver.wall_seconds = solver.wall_setup = solver.wall_solve = solver.wall_output = 0;
  auto summary = nlohmann::ordered_json::parse(to_json(outcome.summary));
  if (summary.contains("model")) summary["model"].erase("sha256");  // of the text, which a model built by code lacks
  for (const char letter : summary.dump()) all["summary"].push_back(static_cast<unsigned char>(letter));
  return all;
}

inline void expect_same_run(const Outcome& expected, const Outcome& found) {
  EXPECT_EQ(expected.results.resolved_yaml, found.results.resolved_yaml);
  const auto right = bits_of(expected), bits = bits_of(found);
  ASSERT_EQ(right.size(), bits.size());
  for (const auto& [place, values] : right) {
    ASSERT_TRUE(bits.contains(place)) << place;
    EXPECT_TRUE(values == bits.at(place)) << place;
  }
}

}  // namespace pounding::test
