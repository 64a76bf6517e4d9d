#include <pounding/stepping/links/link_solver.hpp>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

namespace pounding {
namespace {

// A force is a difference of terms of this magnitude, which determine its round-off.
double terms(const laws::Response& law, const LinkMotion& at) {
  return std::abs(law.by_penetration * at.penetration) + std::abs(law.by_rate * at.rate);
}

// The force of a stiff bar cancels nearly all of the free motion but retains its round-off. Yielding storeys are softer
// than their linear stiffness and have no such term; instead, their force is the difference of two forces of magnitude
// k d.
double terms(const Spring& spring, const laws::Response& law, const LinkMotion& at, const LinkMotion& free) {
  return std::max(std::max(terms(law, at), spring.stiffness() * std::abs(at.penetration)),
                  std::max(law.by_penetration, 0.0) * std::abs(free.penetration) + law.by_rate * std::abs(free.rate));
}

// Motion after the forces have removed these parts of the free motion.
LinkMotion relieved(LinkMotion free, double penetration, double rate) {
  free.penetration -= penetration;
  free.rate -= rate;
  return free;
}

constexpr double solved = 1e-14;  // relative to the terms of a force
constexpr int max_doublings = 60;

}  // namespace

bool LinkSolver::solve(const CondensedLinks& links, Eigen::VectorXd& force) {
  failed_ = -1;
  return links.active.size() == 1 ? solve_one(links, 0, 0.0, 0.0, force[0]) : solve_many(links, force);
}

// Newton's method inside a bracket: the force lies between zero and the force of the law at the free motion; for a
// softening spring the bracket is extended. `others` is G F of the other links, `others_relief` their S F.
bool LinkSolver::solve_one(const CondensedLinks& links, int k, double others, double others_relief, double& force) {
  const int link = links.active[k];
  const double flexibility = links.flexibility(k, k);
  const double at_once = links.relief ? (*links.relief)(k, k) : 0;
  const double relief_u = links.weight * links.by_u * flexibility + at_once,
               relief_v = links.weight * links.by_v * flexibility;
  if (links_.is_held(link)) {
    force = (links.free_acceleration[k] / links.weight - others) / flexibility;
    return true;
  }
  LinkMotion free = relieved(links.free[k], links.weight * links.by_u * others, links.weight * links.by_v * others);
  free.penetration -= others_relief;
  const double unrelieved = links_.law(link, free).force;
  LinkMotion at = free;
  const auto answer_to = [&](double f) {
    at.penetration = free.penetration - relief_u * f;
    at.rate = free.rate - relief_v * f;
    return links_.law(link, at);
  };
  const auto residual_at = [&](double f) { return answer_to(f).force - f; };
  double low = std::min(0.0, unrelieved), high = std::max(0.0, unrelieved);
  if (low == high) {
    force = low;
    return true;
  }
  if (link >= links_.contacts()) {
    double& far = unrelieved > 0 ? high : low;
    for (int doubling = 0; doubling < max_doublings && residual_at(far) * unrelieved > 0; ++doubling) far *= 2;
  }
  double trial = std::clamp(force, low, high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    ++iterations_;
    const laws::Response answer = answer_to(trial);
    const double residual = answer.force - trial;
    const double size = link < links_.contacts() ? terms(answer, at) : terms(links_.spring(link), answer, at, free);
    if (std::abs(residual) <= solved * std::max(std::max(std::abs(trial), std::abs(answer.force)), size)) {
      force = trial;
      return true;
    }
    (residual > 0 ? low : high) = trial;
    if (high - low <= 4e-16 * std::max(std::abs(low), std::abs(high))) {
      force = trial;
      return true;
    }
    const double slope = 1 + relief_u * answer.by_penetration + relief_v * answer.by_rate;
    double next = trial + residual / slope;
    if (!(slope > 0) || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == trial) {
      force = trial;
      return true;
    }
    trial = next;
  }
  failed_ = link;
  return false;
}

void LinkSolver::find_blocks(const CondensedLinks& links) {
  sliders_.clear();
  coupled_.clear();
  scalars_.clear();
  const int count = static_cast<int>(links.active.size());
  for (int k = 0; k < count && links.active[k] < links_.frictions_from(); ++k)
    if (!links_.is_coupled(links.active[k])) scalars_.push_back(k);
  const auto index = [&](int link) {
    return static_cast<int>(std::lower_bound(links.active.begin(), links.active.end(), link) - links.active.begin());
  };
  // The static solve for springs (SpringForces) excludes active contacts.
  for (const Friction& friction : links_.frictions())
    if (std::binary_search(links.active.begin(), links.active.end(), friction.contact))
      sliders_.push_back({&friction, index(friction.contact), index(friction.first)});
  for (const CoupledElement& element : links_.coupled())
    if (std::binary_search(links.active.begin(), links.active.end(), element.first))
      coupled_.push_back({&element, index(element.first)});
}

// Response of an element if the forces reduce the closing accelerations by `relief` times the weight and the
// deformations by `at_once`.
ElementResponse LinkSolver::deform(const CondensedLinks& links, const Coupled& coupled, const Eigen::VectorXd& relief,
                                   const Eigen::VectorXd& at_once) const {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  std::array<LinkMotion, max_deformations> motions;
  for (int j = 0; j < coupled.element->count; ++j) {
    const int k = coupled.first + j;
    motions[j] = relieved(links.free[k], by_u * relief[k] + (links.relief ? at_once[k] : 0), by_v * relief[k]);
  }
  return links_.law(*coupled.element, std::span(motions).first(static_cast<std::size_t>(coupled.element->count)));
}

// Rows of slopes_ for an element, from its last response.
void LinkSolver::find_rows(const CondensedLinks& links, const Coupled& coupled) {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  for (int j = 0; j < coupled.element->count; ++j) {
    auto row = slopes_.row(coupled.first + j);
    row.setZero();
    for (int k = 0; k < coupled.element->count; ++k) {
      const int other = coupled.first + k;
      const double by_deformation = coupled.response.by_deformation[j][k];
      row += (by_u * by_deformation + by_v * coupled.response.by_rate[j][k]) * links.flexibility.row(other);
      if (links.relief) row += by_deformation * links.relief->row(other);
    }
    row[coupled.first + j] += 1;
  }
}

// Response of a friction element if the forces reduce the closing accelerations by `relief` times the weight.
FrictionForce LinkSolver::slide(const CondensedLinks& links, const Slider& slider,
                                const Eigen::VectorXd& relief) const {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  const auto rate = [&](int k) { return links.free[k].rate - by_v * relief[k]; };
  const LinkMotion contact{links.free[slider.contact].penetration - by_u * relief[slider.contact],
                           rate(slider.contact)};
  TangentialMotion along;
  for (int j = 0; j < slider.friction->count; ++j) {
    const int k = slider.first + j;
    along.set(j, relieved(links.free[k], by_u * relief[k], by_v * relief[k]));
  }
  return links_.friction(*slider.friction, contact, links_.law(links.active[slider.contact], contact), along);
}

template <class ForceOf>
bool LinkSolver::solve_block(const CondensedLinks& links, int first, int count, Eigen::VectorXd& forces,
                             ForceOf&& force_of) {
  Eigen::VectorXd relief = links.flexibility * forces, at_once;
  if (links.relief) at_once = *links.relief * forces;
  for (int j = 0; j < count; ++j) {
    const int own = first + j;
    Eigen::VectorXd trial = relief, trial_at_once = at_once;
    const auto residual_at = [&](double f) {
      ++iterations_;
      trial = relief + (f - forces[own]) * links.flexibility.col(own);
      if (links.relief) trial_at_once = at_once + (f - forces[own]) * links.relief->col(own);
      return force_of(j, trial, trial_at_once) - f;
    };
    const double unrelieved = residual_at(0);
    double low = std::min(0.0, unrelieved), high = std::max(0.0, unrelieved);
    double& far = unrelieved > 0 ? high : low;
    for (int doubling = 0; doubling < max_doublings && residual_at(far) * unrelieved > 0; ++doubling) far *= 2;
    while (high - low > 4e-16 * std::max(std::abs(low), std::abs(high))) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (residual_at(middle) > 0 ? low : high) = middle;
    }
    const double found = 0.5 * (low + high);
    if (!std::isfinite(found)) return false;
    residual_at(found);
    relief = trial;
    at_once = trial_at_once;
    forces[own] = found;
  }
  return true;
}

// Norm of the differences between the forces of the laws and the forces x. Sets residual_, terms_ and, if requested,
// the slopes of the laws and the rows of slopes_ for friction.
double LinkSolver::residual(const CondensedLinks& links, const Eigen::VectorXd& x, bool with_slopes) {
  const Eigen::MatrixXd& g = links.flexibility;
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  ++iterations_;
  terms_ = x.norm();
  if (links.blocks)
    links.blocks->multiply(g, x, relief_);
  else
    relief_.noalias() = g * x;
  if (links.relief) relief_at_once_.noalias() = *links.relief * x;
  for (const int i : scalars_) {
    if (links_.is_held(links.active[i])) {
      residual_[i] = (links.free_acceleration[i] / links.weight - relief_[i]) / g(i, i);
      continue;
    }
    const double at_once = links.relief ? relief_at_once_[i] : 0;
    LinkMotion at = relieved(links.free[i], by_u * relief_[i], by_v * relief_[i]);
    at.penetration -= at_once;
    const laws::Response answer = links_.law(links.active[i], at);
    residual_[i] = answer.force - x[i];
    const int link = links.active[i];
    terms_ = std::max(
        terms_, link < links_.contacts() ? terms(answer, at) : terms(links_.spring(link), answer, at, links.free[i]));
    if (!with_slopes) continue;
    by_penetration_[i] = answer.by_penetration;
    by_rate_[i] = answer.by_rate;
  }
  for (Coupled& coupled : coupled_) {
    coupled.response = deform(links, coupled, relief_, relief_at_once_);
    for (int j = 0; j < coupled.element->count; ++j) {
      const int i = coupled.first + j;
      residual_[i] = coupled.response.force[j] - x[i];
      terms_ = std::max(terms_, std::abs(coupled.element->element->stiffness(j) * links.free[i].penetration));
      for (int k = 0; k < coupled.element->count; ++k)
        terms_ = std::max({terms_,
                           std::abs(coupled.response.by_deformation[j][k] * links.free[coupled.first + k].penetration),
                           std::abs(coupled.response.by_rate[j][k] * links.free[coupled.first + k].rate)});
    }
    if (with_slopes) find_rows(links, coupled);
  }
  for (const Slider& slider : sliders_) {
    const FrictionForce answer = slide(links, slider, relief_);
    for (int j = 0; j < slider.friction->count; ++j) {
      const int i = slider.first + j;
      residual_[i] = answer.force[j] - x[i];
      for (int k = 0; k < slider.friction->count; ++k) {
        const int other = slider.first + k;
        terms_ = std::max({terms_,
                           std::abs(answer.by_sliding[j][k]) *
                               std::max(std::abs(links.free[other].rate), std::abs(by_v * relief_[other])),
                           std::abs(answer.by_displacement[j][k]) *
                               std::max(std::abs(links.free[other].penetration), std::abs(by_u * relief_[other]))});
      }
      if (!with_slopes) continue;
      slopes_.row(i) = (by_u * answer.by_penetration[j] + by_v * answer.by_rate[j]) * g.row(slider.contact);
      for (int k = 0; k < slider.friction->count; ++k)
        slopes_.row(i) +=
            (by_u * answer.by_displacement[j][k] + by_v * answer.by_sliding[j][k]) * g.row(slider.first + k);
      slopes_(i, i) += 1;
    }
  }
  return residual_.norm();
}

// Bound on the residual due to round-off of the motion: of the free motion, and of the forces on a light body between
// two heavy ones, which nearly cancel. A dashpot magnifies it. Uses the slopes of the last residual() call that
// computed them.
double LinkSolver::rounding(const CondensedLinks& links, const Eigen::VectorXd& x) {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  if (links.blocks)
    links.blocks->multiply_sizes(links.flexibility, x, sizes_);
  else
    sizes_ = links.flexibility.cwiseAbs() * x.cwiseAbs();
  double largest = 0;
  for (const int i : scalars_)
    largest =
        std::max(largest, std::abs(by_penetration_[i]) * (std::abs(links.free[i].penetration) + by_u * sizes_[i]) +
                              std::abs(by_rate_[i]) * (std::abs(links.free[i].rate) + by_v * sizes_[i]));
  return solved * largest;
}

// One Gauss-Seidel pass with the bracketed scalar solve: slower than Newton's method, but it cannot fail for laws whose
// force increases with penetration and rate.
bool LinkSolver::sweep(const CondensedLinks& links, Eigen::VectorXd& x) {
  const Eigen::MatrixXd& g = links.flexibility;
  for (const int i : scalars_) {
    const double others = g.row(i).dot(x) - g(i, i) * x[i];
    const double relief = links.relief ? links.relief->row(i).dot(x) - (*links.relief)(i, i) * x[i] : 0;
    if (!solve_one(links, i, others, relief, x[i])) return false;
  }
  for (const Coupled& coupled : coupled_)
    if (!solve_block(links, coupled.first, coupled.element->count, x,
                     [&](int j, const auto& relief, const auto& at_once) {
                       return deform(links, coupled, relief, at_once).force[j];
                     }))
      return false;
  for (const Slider& slider : sliders_)
    if (!solve_block(links, slider.first, slider.friction->count, x,
                     [&](int j, const auto& relief, const auto&) { return slide(links, slider, relief).force[j]; }))
      return false;
  return true;
}

bool LinkSolver::solve_many(const CondensedLinks& links, Eigen::VectorXd& f) {
  const int count = static_cast<int>(links.active.size());
  for (Eigen::VectorXd* const room :
       {&residual_, &relief_, &relief_at_once_, &by_penetration_, &by_rate_, &trial_, &direction_, &sizes_})
    room->resize(count);
  by_penetration_.setZero();
  by_rate_.setZero();
  find_blocks(links);
  // The shares of held contacts between the same bodies are indeterminate; the slopes are then singular.
  const auto held =
      std::count_if(links.active.begin(), links.active.end(), [this](int link) { return links_.is_held(link); });
  const bool many =
      count >= LinkBlocks::many && links.blocks && held == 0 && sliders_.empty() && coupled_.empty() && !links.relief;
  if (!many) slopes_.resize(count, count);
  bool descends = false;
  for (int iteration = 0; iteration < 500; ++iteration) {
    const double size = residual(links, f, true);
    if (!std::isfinite(size)) return false;
    if (size <= solved * terms_) return true;
    const double here = terms_;
    const auto rounded = [&] { return size <= std::max(100 * solved * here, rounding(links, f)); };
    if (is_symmetric(links)) {
      if (!soft_springs_.solve(links, by_penetration_, residual_, direction_)) break;
    } else if (!(many && find_direction_by_cholesky(links))) {
      find_slopes(links);
      if (held > 1)
        direction_ = slopes_.completeOrthogonalDecomposition().solve(residual_);
      else if (!eliminates_springs(links))
        direction_ = slopes_.partialPivLu().solve(residual_);
    }
    if (descends && !rounded() && descend(links, f)) continue;
    double length = 1;
    bool better = false;
    for (int halving = 0; halving < 8 && !better; ++halving, length /= 2) {
      trial_ = f + length * direction_;
      better = residual(links, trial_, false) < size;
    }
    if (better)
      f = trial_;
    else if (rounded())  // Newton's method cannot do better
      return true;
    else if (!(descends = descend(links, f)) && !sweep(links, f))
      return false;
  }
  failed_ = links.active.front();
  return false;
}

}  // namespace pounding
