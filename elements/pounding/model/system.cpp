#include <pounding/model/system.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pounding {

bool System::has_modal_matrix(const Group& group) const {
  if (modal_damping.size() == 0) return false;
  for (int j = group.first; j < group.first + group.count; ++j)
    if (SparseMatrix::InnerIterator(modal_damping, j)) return true;
  return false;
}

int System::spring_count() const {
  int count = 0;
  for (const Element* element : elements) count += element->deformations();
  return count;
}

void System::check() const {
  const Eigen::Index ground_count = static_cast<Eigen::Index>(grounds.size());
  const int frictions_from = contact_count() + spring_count();
  if (load.cols() != ground_count) throw std::invalid_argument("System::load needs one column per ground motion");
  if (gap_by_ground.size() > 0 && (gap_by_ground.rows() != links() || gap_by_ground.cols() != ground_count))
    throw std::invalid_argument("System::gap_by_ground needs one row per link and one column per ground motion");
  if (gravity_offset.size() > 0 && gravity_offset.size() != links())
    throw std::invalid_argument("System::gravity_offset needs one value per link");
  if (frictions_from > links())
    throw std::invalid_argument("System::gap_jacobian needs one column per contact and per spring");
  if (spring_flexibility.size() > 0 && (spring_flexibility.rows() != frictions_from - contact_count() ||
                                        spring_flexibility.cols() != spring_flexibility.rows()))
    throw std::invalid_argument("System::spring_flexibility needs one row and one column per spring");
  std::vector<bool> taken(static_cast<std::size_t>(links() - frictions_from),
                          false);  // by column after those of the springs
  for (const Friction& friction : frictions) {
    if (!(friction.coefficient >= 0 && std::isfinite(friction.coefficient)))
      throw std::invalid_argument("the coefficient of a friction must not be negative");
    if (friction.stiffness < 0 || friction.ratio < 0 || (friction.stiffness > 0 && friction.ratio > 0) ||
        !std::isfinite(friction.stiffness + friction.ratio))
      throw std::invalid_argument("a friction has at most one tangential stiffness, constant or as a ratio");
    if (friction.static_coefficient != 0 &&
        !(friction.is_compliant() && friction.static_coefficient >= friction.coefficient && friction.stribeck > 0 &&
          std::isfinite(friction.static_coefficient / friction.stribeck)))
      throw std::invalid_argument(
          "a static friction coefficient must not be below the sliding one, and needs a tangential stiffness and a "
          "Stribeck velocity");
    if (!friction.is_compliant() && !(friction.sliding > 0 && std::isfinite(friction.sliding)))
      throw std::invalid_argument("the sliding velocity of a friction must be positive");
    if (friction.contact < 0 || friction.contact >= contact_count())
      throw std::invalid_argument("a friction belongs to a contact that does not exist");
    if (contacts[friction.contact]->is_rigid())
      throw std::invalid_argument("a rigid contact cannot have friction: its force during an impact is unknown");
    if (friction.count < 1 || friction.count > 2 || friction.first < frictions_from ||
        friction.first + friction.count > links())
      throw std::invalid_argument(
          "a friction needs one or two columns of System::gap_jacobian after those of the springs");
    for (int i = friction.first; i < friction.first + friction.count; ++i) {
      if (taken[i - frictions_from])
        throw std::invalid_argument("two frictions share a column of System::gap_jacobian");
      taken[i - frictions_from] = true;
    }
  }
  if (std::find(taken.begin(), taken.end(), false) != taken.end())
    throw std::invalid_argument("a column of System::gap_jacobian belongs to no contact, spring or friction");
}

}  // namespace pounding
