#include <pounding/reduction/reduce.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/linear/equal_groups.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/linear/spring_relief.hpp>
#include <pounding/reduction/cached_modes.hpp>
#include <pounding/reduction/flexibility_errors.hpp>
#include <pounding/reduction/reduced_modes.hpp>

namespace pounding::petsc {
namespace {

using Kind = Reduction::Kind;

// Blocks of the links with which contacts usually stay below 0.3 of a tolerance; fewer are tried if these are too many.
constexpr int max_start = 6, min_start = 4;
// Blocks of yielding parts: one contains their static response, and the shadow has one less.
constexpr int min_parts = 2;

ReducedDepth automatic_depth(double tolerance, int deeper) {
  return {.links = (tolerance >= 1e-2 ? min_start : max_start) + deeper,
          .ground = 20 + deeper,
          .parts = min_parts + deeper / 2};
}

bool inside(const Group& group, Eigen::Index unknown) {
  return unknown >= group.first && unknown < group.first + group.count;
}

SparseMatrix part(const SparseMatrix& whole, const Group& group) {
  return whole.block(group.first, group.first, group.count, group.count);
}

ClassicalDamping damping_of(const Group& group) {
  return {.by_mass = group.by_mass, .by_stiffness = group.by_stiffness, .modal = group.modal_ratio};
}

// Indices of the columns that are nonzero in a group.
std::vector<int> used_columns(const SparseMatrix& matrix, const Group& group) {
  std::vector<int> used;
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      if (inside(group, it.row()) && it.value() != 0) {
        used.push_back(j);
        break;
      }
  return used;
}

// Rows of these columns in a group.
Eigen::MatrixXd columns_of(const SparseMatrix& matrix, const Group& group, const std::vector<int>& used) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(group.count, static_cast<Eigen::Index>(used.size()));
  for (std::size_t j = 0; j < used.size(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, used[j]); it; ++it)
      if (inside(group, it.row())) columns(it.row() - group.first, static_cast<Eigen::Index>(j)) = it.value();
  return columns;
}

// True if a link represents a yielding part of a structure.
bool is_part(const System& system, int link) {
  return is_spring(system, link) && !system.is_part.empty() &&
         system.is_part[static_cast<std::size_t>(link - system.contact_count())];
}

void count_links(const System& system, const Group& group, ReducedStructure& made) {
  const int frictions_from = system.contact_count() + system.spring_count();
  for (const int column : used_columns(system.gap_jacobian, group)) {
    made.frictions += column >= frictions_from ? 1 : 0;
    made.devices += is_spring(system, column) && !is_part(system, column) ? 1 : 0;
  }
}

ReducedInputs inputs_of(const System& system, const Group& group, const ReductionPlan& plan) {
  ReducedInputs inputs;
  std::vector<int> parts, others = used_columns(system.gap_jacobian, group);
  std::erase_if(others, [&](int link) {
    if (is_part(system, link)) parts.push_back(link);
    return is_part(system, link);
  });
  const Group alone{.count = group.count};
  const SparseMatrix damping = part(system.damping, group);
  const Eigen::MatrixXd links = columns_of(system.gap_jacobian, group, others),
                        dashpots = columns_of(damping, alone, used_columns(damping, alone));
  inputs.parts = columns_of(system.gap_jacobian, group, parts);
  inputs.links.resize(group.count, links.cols() + dashpots.cols());
  inputs.links << links, dashpots;
  inputs.ground.resize(group.count, 0);
  for (const auto load : system.load.colwise())
    if (const Eigen::VectorXd own = load.segment(group.first, group.count); !own.isZero(0)) {
      inputs.ground.conservativeResize(Eigen::NoChange, inputs.ground.cols() + 1);
      inputs.ground.rightCols(1) = own;
    }
  inputs.starts.resize(group.count, 2);
  inputs.starts << plan.u.segment(group.first, group.count), plan.v.segment(group.first, group.count);
  inputs.shift = contact_shift(system, group);
  return inputs;
}

// Penetration of a 1 m/s impact of this mass: the work of the force is m v^2 / 2, up to a factor that is irrelevant
// here.
double impact_penetration(const Contact& contact, double mass) {
  double low = 1e-12, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (contact.first_loading(middle).force * middle < mass ? low : high) = middle;
  }
  return high;
}

// Number of ground blocks that the shadow omits.
constexpr int ground_less = 5;

// Number of link blocks of the shadow: one less than in the run, or fewer if the rest of the basis already spans most
// of the last block. Otherwise the shadow would be as accurate as the run and could not estimate its error.
int shadow_links(ReducedModes& basis, const ReducedDepth& depth, int links) {
  const int all = basis.count(depth), new_ones = (links + 1) / 2;
  int blocks = depth.links - 1;
  while (blocks > 1 &&
         all - basis.count(depth, {.links = blocks, .ground = depth.ground, .parts = depth.parts}) < new_ones)
    --blocks;
  return blocks;
}

// Structures with equal matrices share results.
struct Alike {
  struct Made {
    Reduction how;
    ReducedInputs inputs;
    ClassicalDamping damping;
    std::optional<ReducedGroup> group;
  };
  int left = 0;  // number still to be reduced
  std::unique_ptr<ReducedModes> modes;
  std::vector<Made> made;

  ReducedModes& driven(const ModesOrigin& origin) {
    if (modes)
      modes->drive(origin.inputs);
    else
      modes = std::make_unique<ReducedModes>(origin.mass, origin.stiffness, origin.inputs);
    return *modes;
  }
};

ReducedGroup group_of(ReducedModes& basis, const ModesOrigin& origin) {
  const ReducedDepth& depth = origin.depth;
  const ReducedInputs& inputs = origin.inputs;
  ReducedGroup made{.modes = std::make_shared<const GroupModes>(basis.modes(depth))};
  if (!origin.shadow) return made;
  const int links = static_cast<int>(inputs.links.cols());
  made.shadow =
      std::make_shared<const ShadowModes>(basis.shadow(depth, {.links = shadow_links(basis, depth, links),
                                                               .ground = std::max(depth.ground - ground_less, 0),
                                                               .parts = depth.parts - 1}));
  // A short ground chain may have larger errors than the links.
  if (!(inputs.shift > 0) || (inputs.ground.cols() > 0 && depth.ground <= 2 * ground_less)) return made;
  const FlexibilityErrors errors =
      flexibility_errors(basis.further(depth), *made.shadow, origin.damping, std::sqrt(inputs.shift));
  made.made.flexibility_error = errors.run;
  made.made.shadow_flexibility_error = errors.shadow;
  return made;
}

// nullopt if the basis would not pay off.
std::optional<ReducedGroup> reduce(const System& system, const Group& group, const Reduction& how,
                                   const std::string& name, const ReductionPlan& plan, int dynamic,
                                   ReducedInputs inputs, Alike& alike) {
  ReducedDepth depth = how.kind == Kind::blocks
                           ? ReducedDepth{.links = how.links, .ground = how.ground, .parts = min_parts}
                           : automatic_depth(how.error > 0 ? how.error : plan.tolerance, plan.deeper);
  const int links = static_cast<int>(inputs.links.cols()), parts = static_cast<int>(inputs.parts.cols()),
            grounds = static_cast<int>(inputs.ground.cols());
  if (how.kind == Kind::lowest) {
    depth = {.links = 1, .ground = 1, .parts = 1};
    if (how.modes < dynamic) {
      const Eigenmodes lowest = lowest_modes(part(system.mass, group), part(system.stiffness, group), how.modes);
      Eigen::MatrixXd starts(group.count, inputs.starts.cols() + lowest.shapes.cols());
      starts << inputs.starts, lowest.shapes;
      inputs.starts = starts;
    }
  }
  const auto largest = [&] {
    return links * (depth.links + 1) + parts * depth.parts + grounds * depth.ground +
           static_cast<int>(inputs.starts.cols());
  };
  while (how.kind == Kind::automatic && depth.links > min_start + plan.deeper && 2 * largest() > dynamic) --depth.links;
  const int maximum = largest();
  // Repeating a run with a third of all modes costs more than one run with all of them, which needs no repetition.
  const bool again = how.kind == Kind::automatic && plan.deeper > 0 && dynamic <= max_modes_instead;
  if ((again ? 3 : 2) * maximum > dynamic) {
    if (!how.is_explicit() || dynamic <= small_structure) return std::nullopt;
    throw InputError(
        fmt::format("reduction {} of \"{}\" would need up to {} coordinates for {} degrees of freedom with mass, more "
                    "than half of them; type fewer blocks, or do not reduce it",
                    how.text(), name, maximum, dynamic));
  }
  const double frequency = std::sqrt(inputs.shift) / (2 * M_PI);
  const bool shadow = how.kind != Kind::lowest && depth.links > 1;
  const ModesOrigin origin{
      part(system.mass, group), part(system.stiffness, group), damping_of(group), std::move(inputs), depth, shadow};
  const std::optional<CachedModes> kept =
      plan.cache_folder.empty() ? std::nullopt : std::optional<CachedModes>(plan.cache_folder);
  const std::vector<std::byte> bytes = kept ? origin.bytes() : std::vector<std::byte>{};
  std::optional<ReducedGroup> found = kept ? kept->find(bytes) : std::nullopt;
  ReducedGroup made = found ? std::move(*found) : group_of(alike.driven(origin), origin);
  if (kept && !found) kept->keep(bytes, made);
  made.made = {.name = name,
               .coordinates = static_cast<int>(made.modes->squares.size()),
               .unknowns = group.count,
               .link_blocks = depth.links,
               .links = links,
               .part_blocks = parts > 0 ? depth.parts : 0,
               .parts = parts,
               .ground_blocks = depth.ground,
               .grounds = grounds,
               .modes = how.kind == Kind::lowest ? how.modes : 0,
               .frequency = frequency,
               .flexibility_error = made.made.flexibility_error,
               .shadow_flexibility_error = made.made.shadow_flexibility_error};
  count_links(system, group, made.made);
  return made;
}

// As reduce(), but reuses the modes of an earlier structure with equal matrices, options and inputs.
std::optional<ReducedGroup> reduce_or_share(const System& system, const Group& group, const Reduction& how,
                                            const std::string& name, const ReductionPlan& plan, int dynamic,
                                            Alike& alike) {
  ReducedInputs inputs = inputs_of(system, group, plan);
  for (const Alike::Made& before : alike.made)
    if (before.how == how && before.damping == damping_of(group) && before.inputs == inputs) {
      std::optional<ReducedGroup> made = before.group;
      if (made) made->made.name = name;
      return made;
    }
  std::optional<ReducedGroup> made = reduce(system, group, how, name, plan, dynamic, inputs, alike);
  if (alike.left > 0) alike.made.push_back({how, std::move(inputs), damping_of(group), made});
  return made;
}

}  // namespace

double contact_shift(const System& system, const Group& group) {
  double largest = 0;
  for (int i = 0; i < system.contact_count(); ++i) {
    double inverse_mass = 0;
    bool own = false;
    for (SparseMatrix::InnerIterator it(system.gap_jacobian, i); it; ++it) {
      const double mass = system.mass.coeff(it.row(), it.row());
      if (mass > 0) inverse_mass += it.value() * it.value() / mass;
      own = own || inside(group, it.row());
    }
    if (!own || !(inverse_mass > 0)) continue;
    const Contact& contact = *system.contacts[i];
    const double slope = contact.first_loading(impact_penetration(contact, 1 / inverse_mass)).by_penetration;
    if (std::isfinite(slope)) largest = std::max(largest, slope * inverse_mass);
  }
  return largest > 0 ? std::pow(4.0, std::round(std::log(largest) / std::log(4.0))) : 0;
}

std::optional<ReducedGroups> reduced_groups(const System& system, const ReductionPlan& plan) {
  ReducedGroups made(system.groups.size());
  const std::vector<int> equals = first_equal_groups(system);
  std::vector<Alike> alike(system.groups.size());
  for (const int first : equals) ++alike[static_cast<std::size_t>(first)].left;
  const bool any_explicit = std::ranges::any_of(plan.groups, &Reduction::is_explicit);
  for (std::size_t k = 0; k < system.groups.size(); ++k) {
    const Group& group = system.groups[k];
    const Reduction& how = plan.groups[k];
    Alike& same = alike[static_cast<std::size_t>(equals[k])];
    --same.left;
    const int dynamic = static_cast<int>(split_by_mass(system.mass, group.first, group.count).dynamic.size());
    const bool small = dynamic <= small_structure;
    if (how.kind == Kind::all_modes || (how.kind == Kind::none && any_explicit)) {
      if (dynamic > max_natural_modes)
        throw InputError(
            fmt::format("\"{}\" has {} degrees of freedom with mass, which exceeds the limit for all of its modes; "
                        "reduce it, or use sparse factors",
                        plan.names[k], dynamic));
      continue;
    }
    if (how.kind != Kind::none && !(how.kind == Kind::automatic && small))
      made[k] = reduce_or_share(system, group, how, plan.names[k], plan, dynamic, same);
    if (same.left == 0) same = {};
    const int max_modes = how.kind == Kind::automatic ? max_modes_instead : small_structure;
    if (!made[k] && dynamic > max_modes) return std::nullopt;
  }
  return made;
}

}  // namespace pounding::petsc
