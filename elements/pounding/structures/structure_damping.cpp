#include <pounding/structures/structure_damping.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <pounding/structures/isolators.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

struct TwoFrequencies {
  double first, second;  // [rad/s]
  std::string note;
};

void check_ratio(double ratio) {
  if (!(ratio >= 0 && ratio < 1))
    throw std::invalid_argument(fmt::format("the damping ratio must be in [0, 1), but is {}", ratio));
}

TwoFrequencies points_of(const RayleighDamping& rayleigh, const Structure& s, const ModeSolver& solver) {
  if (rayleigh.modes && rayleigh.periods)
    throw std::invalid_argument("give either modes or periods of the damping, not both");
  if (rayleigh.periods) {
    const auto [t1, t2] = *rayleigh.periods;
    if (!(t1 > 0 && t2 > 0)) throw std::invalid_argument("the periods of the damping must be positive");
    return {2 * M_PI / t1, 2 * M_PI / t2, fmt::format("periods {:.6g} s and {:.6g} s", t1, t2)};
  }
  const int count = count_of_modes(s);
  const auto [first, second] = rayleigh.modes.value_or(std::array{1, std::min(2, count)});
  if (std::min(first, second) < 1 || std::max(first, second) > count)
    throw std::invalid_argument(fmt::format("modes {} and {} of the damping must be in 1 to {}", first, second, count));
  const int highest = std::max(first, second);
  const Eigen::VectorXd w =
      highest <= s.frequencies.size() ? s.frequencies : solver(s.mass, s.stiffness, highest).frequencies;
  return {w[first - 1], w[second - 1], fmt::format("modes {} and {}", first, second)};
}

void use_rayleigh(Structure& s, double ratio, const TwoFrequencies& points) {
  const Rayleigh factors = rayleigh_damping(ratio, points.first, points.second);
  s.by_mass = factors.by_mass;
  s.by_stiffness = factors.by_stiffness;
  s.damping_note = fmt::format("Rayleigh, {:.4g} % in {}", 100 * ratio, points.note);
}

// b K without the contribution of the isolators, with the ratio in the first mode on a fixed base. Mass-proportional
// damping would damp the isolators.
void damp_above_isolators(Structure& s, double ratio, const ModeSolver& solver) {
  s.damping_note = "none";
  if (ratio == 0) return;
  const SparseMatrix base = motions_on_fixed_base(s);
  const SparseMatrix mass = base.transpose() * s.mass * base, stiffness = base.transpose() * s.stiffness * base;
  const double w = solver(mass, stiffness, 1).frequencies[0];
  s.by_stiffness = 2 * ratio / w;
  s.damping -= s.by_stiffness * stiffness_of_isolators(s);
  s.damping_note = fmt::format(
      "{:.4g} % in the first mode on a fixed base, period {:.6g} s, proportional to the stiffness without the "
      "isolators",
      100 * ratio, 2 * M_PI / w);
}

void damp(Structure& s, double ratio, const ModeSolver& solver) {
  check_ratio(ratio);
  if (is_isolated(s)) return damp_above_isolators(s, ratio, solver);
  if (s.rigid_motions > 0) {
    s.by_stiffness = 2 * ratio / s.frequencies[0];
    s.damping_note = fmt::format("{:.4g} % in the first bending mode, proportional to the stiffness", 100 * ratio);
    return;
  }
  if (count_of_modes(s) == 1 && s.size() == 1) {
    s.damping.coeffRef(0, 0) += 2 * ratio * s.frequencies[0] * s.mass.coeff(0, 0);
    s.damping_note = fmt::format("{:.4g} % of critical", 100 * ratio);
    return;
  }
  if (count_of_modes(s) == 1) return use_rayleigh(s, ratio, {s.frequencies[0], s.frequencies[0], "its only mode"});
  use_rayleigh(s, ratio, {s.frequencies[0], s.frequencies[1], "modes 1 and 2"});
}

void damp(Structure& s, const RayleighDamping& rayleigh, const ModeSolver& solver) {
  check_ratio(rayleigh.ratio);
  if (s.rigid_motions > 0)
    throw std::invalid_argument(
        "without supports, Rayleigh damping would damp the rigid-body motion; type damping: 5 %, or damping: "
        "{modal: {ratio: 5 %}}");
  if (is_isolated(s))
    throw std::invalid_argument(
        "on isolators, Rayleigh damping would damp their motion; type damping: 2 %, which is proportional to the "
        "stiffness above them, or damping: {modal: {ratio: 2 %}}");
  use_rayleigh(s, rayleigh.ratio, points_of(rayleigh, s, solver));
}

void damp(Structure& s, const ModalDamping& modal, const ModeSolver&) {
  check_ratio(modal.ratio);
  const bool isolated = is_isolated(s);
  if (isolated)
    s.damping += modal_damping_matrix(s.mass, s.stiffness - stiffness_of_isolators(s), modal.ratio);
  else
    s.modal_ratio = modal.ratio;
  s.damping_note = fmt::format("modal, {:.4g} % in every mode{}", 100 * modal.ratio,
                               isolated ? " of the structure without its isolators" : "");
}

}  // namespace

int count_of_modes(const Structure& s) { return static_cast<int>(split_by_mass(s.mass).dynamic.size()); }

void set_frequencies(Structure& s, const ModeSolver& modes) {
  if (s.is_free) {
    s.frequencies = Eigen::VectorXd::Zero(1);
    return;
  }
  const int rigid = s.rigid_motions, count = std::min(modes_of_a_structure + rigid, count_of_modes(s));
  s.frequencies = modes(s.mass, s.stiffness, count).frequencies;
  if (rigid == 0) return;
  if (count <= rigid)
    throw std::invalid_argument("without supports and without a bending mode, use a body, or give mass to more nodes");
  if (!(s.frequencies[rigid] > 0))
    throw std::invalid_argument(
        "without supports, the parts must not move relative to each other as rigid bodies; connect or brace them");
  s.frequencies = s.frequencies.tail(count - rigid).eval();
}

void set_damping(Structure& s, const Damping& damping, const ModeSolver& modes) {
  if (s.frequencies.size() == 0)
    throw std::logic_error("the frequencies of a structure must be set before its damping");
  if (s.damping.size() == 0) s.damping.resize(s.size(), s.size());
  std::visit([&](const auto& how) { damp(s, how, modes); }, damping.how());
}

}  // namespace pounding
