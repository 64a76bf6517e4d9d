#include <pounding/run/reduction_plan.hpp>

#include <petscsys.h>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/petsc/environment.hpp>

namespace pounding {
namespace {

constexpr const char* prefix = "pounding_red_";

bool read(const char* name, int least, int most, int& value) {
  PetscInt number = value;
  PetscBool given = PETSC_FALSE;
  petsc::check(PetscOptionsGetInt(nullptr, prefix, name, &number, &given));
  if (given && (number < least || number > most))
    throw InputError(fmt::format("-{}{} {} is not in [{}, {}]; type -{}{} {}", prefix, name + 1, static_cast<long>(number), least, most, prefix,
                                 name + 1, value));
  value = static_cast<int>(number);
  return given == PETSC_TRUE;
}

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
  throw InputError(fmt::format("\"{}\" cannot be reduced: {}. Type -{}auto instead of -{}links and -{}ground to reduce what can be", name, reason, prefix,
                               prefix, prefix));
}

}  // namespace

Reduction reduction_from_options() {
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

petsc::ReductionPlan reduction_plan(const Model& model, const Reduction& how, const Eigen::VectorXd& u, const Eigen::VectorXd& v, double tolerance) {
  petsc::ReductionPlan plan{{}, {}, u, v, tolerance};
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    if (s.is_rigid()) continue;
    Reduction own = how;
    if (how.kind != Reduction::Kind::none)
      if (const std::string reason = why_not_reduced(model, static_cast<int>(i)); !reason.empty()) {
        if (how.is_explicit() && s.size() > petsc::small_structure) fail(s.name, reason);
        own.kind = Reduction::Kind::none;
      }
    plan.names.push_back(s.name);
    plan.groups.push_back(own);
  }
  return plan;
}

std::string reduction_note(const Reduction& how, const std::string& description) {
  if (how.kind == Reduction::Kind::none) return {};
  if (description.find("coordinates for") == std::string::npos)
    return "no structure is reduced: those of up to 500 unknowns with mass keep all their modes, and a larger one that cannot be reduced, or whose "
           "links are too many, leaves all of them to factors";
  return fmt::format("{}. The error of the reduction is not estimated: compare with a deeper one, or with none", description);
}

}  // namespace pounding
