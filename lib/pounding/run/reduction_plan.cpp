#include <pounding/run/reduction_plan.hpp>

#include <petscsys.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/run/reduction_errors.hpp>

namespace pounding {
namespace {

constexpr const char* prefix = "pounding_red_";

bool read(const char* name, int minimum, int maximum, int& value) {
  PetscInt number = value;
  PetscBool given = PETSC_FALSE;
  petsc::check(PetscOptionsGetInt(nullptr, prefix, name, &number, &given));
  if (given && (number < minimum || number > maximum))
    throw InputError(fmt::format("-{}{} {} is not in [{}, {}]; type -{}{} {}", prefix, name + 1,
                                 static_cast<long>(number), minimum, maximum, prefix, name + 1, value));
  value = static_cast<int>(number);
  return given == PETSC_TRUE;
}

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
  throw InputError(
      fmt::format("\"{}\" cannot be reduced: {}. Type -{}auto instead of -{}links and -{}ground to reduce only the "
                  "structures that can be reduced",
                  name, reason, prefix, prefix, prefix));
}

}  // namespace

Reduction reduction_from_options() {
  const LibraryLock lock;
  Reduction how;
  PetscBool automatic = PETSC_FALSE;
  petsc::check(PetscOptionsGetBool(nullptr, prefix, "-auto", &automatic, nullptr));
  const bool links = read("-links", 1, 100, how.links), ground = read("-ground", 0, 500, how.ground);
  if (links || ground)
    how.kind = Reduction::Kind::blocks;
  else if (automatic)
    how.kind = Reduction::Kind::automatic;
  return how;
}

std::string mode_cache_folder() {
  const LibraryLock lock;
  char folder[4096] = "";
  petsc::check(PetscOptionsGetString(nullptr, prefix, "-cache", folder, sizeof folder, nullptr));
  return folder;
}

std::vector<Reduction> requested_reductions(const Model& model) {
  const Reduction by_options = reduction_from_options();
  std::vector<Reduction> requested;
  for (std::size_t i = 0; i < model.structures.size(); ++i)
    if (!model.structures[i].is_rigid())
      requested.push_back(by_options.kind != Reduction::Kind::none ? by_options
                                                                   : reduction_of(model, static_cast<int>(i)));
  return requested;
}

petsc::ReductionPlan reduction_plan(const Model& model, const std::vector<Reduction>& requested,
                                    const Eigen::VectorXd& u, const Eigen::VectorXd& v, double tolerance) {
  petsc::ReductionPlan plan{{}, {}, u, v, tolerance};
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    if (s.is_rigid()) continue;
    if (const std::string reason = why_not_checked(model, static_cast<int>(i)); !reason.empty())
      throw InputError(reason);
    Reduction own = requested[plan.groups.size()];
    const bool reduces = own.kind == Reduction::Kind::automatic || own.is_explicit();
    plan.requested = plan.requested || reduces;
    if (reduces)
      if (const std::string reason = why_not_reduced(model, static_cast<int>(i)); !reason.empty()) {
        if (own.is_explicit() && s.size() > small_structure) fail(s.name, reason);
        own.kind = Reduction::Kind::none;
      }
    plan.names.push_back(s.name);
    plan.groups.push_back(own);
  }
  return plan;
}

bool must_be_deeper(const petsc::ReductionPlan& plan, const std::vector<ReducedStructure>& reduced) {
  return std::ranges::any_of(reduced, [&](const ReducedStructure& s) {
    const Reduction& requested = plan.groups[std::ranges::find(plan.names, s.name) - plan.names.begin()];
    return requested.kind == Reduction::Kind::automatic && exceeds(s, requested, plan.tolerance);
  });
}

std::vector<std::string> reduction_warnings(const petsc::ReductionPlan& plan,
                                            const std::vector<ReducedStructure>& reduced) {
  std::vector<std::string> warnings;
  if (plan.requested && reduced.empty() && plan.deeper > 0)
    warnings.emplace_back(
        "no structure is reduced: the links need too many blocks. All modes were used, or a factorization for "
        "structures with more than 2,500 degrees of freedom with mass. Lightly damped high modes respond up to the "
        "frequency of the contacts, or there are many links; each friction direction counts as one more");
  else if (plan.requested && reduced.empty())
    warnings.emplace_back(
        "no structure is reduced: structures with up to 500 degrees of freedom with mass keep all their modes, as do "
        "those with up to 2,500 and too many links; if one is larger or cannot be reduced, all structures are "
        "factorized");
  for (const ReducedStructure& s : reduced) {
    const Reduction& requested = plan.groups[std::ranges::find(plan.names, s.name) - plan.names.begin()];
    if (std::isnan(s.error_force))
      warnings.push_back(fmt::format(
          "{}. The error of the reduction is not estimated: compare with a run with more blocks, or without reduction",
          s.size_text()));
    else if (exceeds(s, requested, plan.tolerance))
      warnings.push_back(fmt::format(
          "{}. The reduction may exceed 0.3 of the tolerance {:g}: {}; type {} blocks of the links, or reduction: auto",
          s.size_text(), plan.tolerance, s.error_text(), s.link_blocks + 2));
    if (check_exceeds(s, requested, plan.tolerance))
      warnings.push_back(
          fmt::format("{}. The error of the reduction exceeds 0.3 of the tolerance {:g}, or the requested error: {}; "
                      "type {} blocks of the links, or a smaller error",
                      s.size_text(), plan.tolerance, s.check_text(), s.link_blocks + 2));
  }
  return warnings;
}

}  // namespace pounding
