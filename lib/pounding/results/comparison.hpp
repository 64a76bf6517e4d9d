#pragma once
/// Responses with and without links, of `compare: no_pounding`: floors, storeys, members and yielding parts.

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <pounding/results/summary.hpp>

namespace pounding {

/// A peak in both runs, >= 0.
struct WithWithout {
  double with = 0, without = 0;

  /// with / without; NaN if the second is zero or round-off, as the torsion of a symmetric frame without contact.
  double ratio() const {
    constexpr double round_off = 1e-9;
    return without > round_off * with ? with / without : std::numeric_limits<double>::quiet_NaN();
  }
};

/// Largest absolute force component of a member, over both ends.
struct MemberComparison {
  std::string member, component;  ///< "column 1.0", "My"
  WithWithout force;              ///< [N], [N m]
  double demand = 0;              ///< `force.with` divided by the largest of this component in the structure [-]
};

/// A yielding part.
struct PartComparison {
  std::string part;
  bool is_hinge = false;
  WithWithout ductility;  ///< [-]
  WithWithout plastic;    ///< largest absolute plastic deformation [m], [rad]
};

/// Length of the rankings.
inline constexpr std::size_t worst_count = 5;
/// Members with a smaller demand with links are not ranked by ratio: a large ratio of small forces means little.
inline constexpr double min_ranked_demand = 0.1;

/// Force components of all members; those that are zero in both runs, or round-off in the run with links, are omitted.
std::vector<MemberComparison> compare_members(const StructureSummary& with, const StructureSummary& without);
/// All yielding parts.
std::vector<PartComparison> compare_parts(const StructureSummary& with, const StructureSummary& without);

/// The `worst_count` largest ratios in descending order: of forces with at least `min_ranked_demand`, and of the
/// ductility of parts that yield with links.
std::vector<MemberComparison> worst_by_ratio(std::vector<MemberComparison> members);
std::vector<PartComparison> worst_by_ratio(std::vector<PartComparison> parts);
/// The `worst_count` largest demands in descending order: forces relative to the largest of their component, and
/// ductilities.
std::vector<MemberComparison> worst_by_demand(std::vector<MemberComparison> members);
std::vector<PartComparison> worst_by_demand(std::vector<PartComparison> parts);

/// Object by structure for `--json`; ratios are null if a run ended early, and if nothing moved without links.
nlohmann::ordered_json comparison_json(const Summary& summary);

/// Tables for the text report; empty without a comparison run.
std::string comparison_table(const Summary& summary);

}  // namespace pounding
