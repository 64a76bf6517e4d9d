#include <pounding/model/reducible.hpp>

#include <fmt/format.h>

#include <pounding/structures/damping.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

// Maximum number of columns of a damping matrix, in addition to Rayleigh and modal damping, that are dashpots; modal
// damping above isolators fills all columns.
constexpr int max_dashpots = 64;

int columns_in_use(const SparseMatrix& matrix) {
  int count = 0;
  for (int j = 0; j < matrix.outerSize(); ++j) {
    bool any = false;
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) any = any || it.value() != 0;
    count += any ? 1 : 0;
  }
  return count;
}

}  // namespace

Reduction reduction_of(const Model& model, int structure) {
  const auto own = model.analysis.reductions.find(model.structures[structure].name);
  return own == model.analysis.reductions.end() ? model.analysis.reduction : own->second;
}

std::string why_not_reduced(const Model& model, int structure) {
  const Structure& s = model.structures[structure];
  if (s.is_rigid()) return "a wall has no modes";
  if (const std::string why = s.why_stiffness_changes(); !why.empty()) return why + ", so its stiffness changes";
  if (s.is_free || s.rigid_motions > 0) return "it has no supports, so it has no static responses";
  if (columns_in_use(s.damping) > max_dashpots)
    return "its damping is a full matrix, due to modal damping above isolators; type damping: 5 %, proportional to the "
           "stiffness above them";
  for (const Link& link : model.links) {
    if (link.left.structure != structure && link.right.structure != structure) continue;
    if (link.contact->is_rigid())
      return fmt::format(
          "link \"{}\" hits it without a stiffness, by a velocity jump that few modes cannot represent; type a law "
          "with a "
          "stiffness",
          link.name);
  }
  return {};
}

std::string why_not_checked(const Model& model, int structure) {
  const Structure& s = model.structures[structure];
  if (!reduction_of(model, structure).check || s.is_rigid() || !(s.modal_ratio > 0)) return {};
  const auto modes = split_by_mass(s.mass).dynamic.size();
  if (modes <= static_cast<std::size_t>(max_for_modal_damping)) return {};
  return fmt::format(
      "the modal damping of \"{}\" would fill a matrix of {} x {} modes in the equations of all its unknowns; type "
      "damping: 5 %, or "
      "check: false",
      s.name, modes, modes);
}

}  // namespace pounding
