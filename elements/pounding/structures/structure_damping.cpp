#include <pounding/structures/structure_damping.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pounding/structures/isolators.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

using To = ProportionalDamping::To;

struct TwoFrequencies {
  double first, second;  // [rad/s]
  std::string note;
};

constexpr std::string_view without_isolators = ", proportional to the stiffness without the isolators";
constexpr std::string_view with_isolators = ", with the initial stiffness of the isolators";

void check_ratio(double ratio) {
  if (!(ratio >= 0 && ratio < 1))
    throw std::invalid_argument(fmt::format("the damping ratio must be in [0, 1), but is {}", ratio));
}

// Part of a structure to which a damping model applies.
enum class Damped { all, above_isolators };

Damped damped_part(const Structure& s, const std::optional<DampedStiffness>& of) {
  const bool isolated = is_isolated(s);
  if (of == DampedStiffness::superstructure && !isolated)
    throw std::invalid_argument("of: superstructure applies above isolators, and there are none; remove of");
  return isolated && of != DampedStiffness::initial ? Damped::above_isolators : Damped::all;
}

// Damping by the mass also damps rigid-body motions, and the motion on isolators.
void refuse_by_mass(const Structure& s, Damped part, std::string_view what) {
  if (s.rigid_motions > 0)
    throw std::invalid_argument(
        fmt::format("without supports, {} damping would damp the rigid-body motion; type damping: 5 %, or damping: "
                    "{{modal: {{ratio: 5 %}}}}",
                    what));
  if (part == Damped::above_isolators)
    throw std::invalid_argument(fmt::format(
        "on isolators, {} damping would damp their motion; type damping: 2 %, which is proportional to the "
        "stiffness above them, damping: {{modal: {{ratio: 2 %}}}}, or of: initial to damp the isolators as well",
        what));
}

std::string_view note_of_part(const Structure& s, Damped part) {
  if (part == Damped::above_isolators) return without_isolators;
  return is_isolated(s) ? with_isolators : std::string_view();
}

// Proportional to the stiffness of a part of the structure, in addition to the mass.
void damp_by_stiffness(Structure& s, double beta, Damped part) {
  s.by_stiffness = beta;
  if (part == Damped::above_isolators) s.damping -= beta * stiffness_of_isolators(s);
}

void require_mode(int mode, int count) {
  if (mode < 1 || mode > count)
    throw std::invalid_argument(fmt::format("mode {} of the damping must be in 1 to {}", mode, count));
}

double frequency_of_mode(const Structure& s, int mode, const ModeSolver& solver) {
  require_mode(mode, count_of_modes(s) - s.rigid_motions);
  if (mode <= s.frequencies.size()) return s.frequencies[mode - 1];
  return solver(s.mass, s.stiffness, mode + s.rigid_motions).frequencies[mode + s.rigid_motions - 1];
}

double frequency_on_fixed_base(const Structure& s, int mode, const ModeSolver& solver) {
  const SparseMatrix base = motions_on_fixed_base(s);
  const SparseMatrix mass = base.transpose() * s.mass * base, stiffness = base.transpose() * s.stiffness * base;
  require_mode(mode, static_cast<int>(split_by_mass(mass).dynamic.size()));
  return solver(mass, stiffness, mode).frequencies[mode - 1];
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
  s.damping_note = fmt::format("Rayleigh, {:.4g} % in {}{}", 100 * ratio, points.note, note_of_part(s, Damped::all));
}

// b K without the contribution of the isolators, with the ratio in the first mode on a fixed base.
void damp_above_isolators(Structure& s, double ratio, const ModeSolver& solver) {
  s.damping_note = "none";
  if (ratio == 0) return;
  const double w = frequency_on_fixed_base(s, 1, solver);
  damp_by_stiffness(s, 2 * ratio / w, Damped::above_isolators);
  s.damping_note = fmt::format("{:.4g} % in the first mode on a fixed base, period {:.6g} s{}", 100 * ratio,
                               2 * M_PI / w, without_isolators);
}

void damp(Structure& s, double ratio, Damped part, const ModeSolver& solver) {
  check_ratio(ratio);
  if (part == Damped::above_isolators) return damp_above_isolators(s, ratio, solver);
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

void damp(Structure& s, const RayleighDamping& rayleigh, Damped part, const ModeSolver& solver) {
  check_ratio(rayleigh.ratio);
  refuse_by_mass(s, part, "Rayleigh");
  use_rayleigh(s, rayleigh.ratio, points_of(rayleigh, s, solver));
}

void damp(Structure& s, const RayleighFactors& factors, Damped part, const ModeSolver&) {
  for (const double factor : {factors.alpha, factors.beta})
    if (!(factor >= 0 && std::isfinite(factor)))
      throw std::invalid_argument(
          fmt::format("the factors of the damping must be finite and not negative; {} was given", factor));
  if (factors.alpha > 0) refuse_by_mass(s, part, "mass-proportional");
  s.by_mass = factors.alpha;
  damp_by_stiffness(s, factors.beta, part);
  s.damping_note =
      fmt::format("Rayleigh, alpha {:.6g} 1/s and beta {:.6g} s{}", factors.alpha, factors.beta, note_of_part(s, part));
}

void damp(Structure& s, const ProportionalDamping& one, Damped part, const ModeSolver& solver) {
  check_ratio(one.ratio);
  if (one.mode && one.period) throw std::invalid_argument("give the mode or the period of the damping, not both");
  if (one.period && !(*one.period > 0)) throw std::invalid_argument("the period of the damping must be positive");
  const bool by_mass = one.to == To::mass;
  if (by_mass) refuse_by_mass(s, part, "mass-proportional");
  const int mode = one.mode.value_or(1);
  const double w = one.period                        ? 2 * M_PI / *one.period
                   : part == Damped::above_isolators ? frequency_on_fixed_base(s, mode, solver)
                                                     : frequency_of_mode(s, mode, solver);
  if (by_mass)
    s.by_mass = 2 * one.ratio * w;
  else
    damp_by_stiffness(s, 2 * one.ratio / w, part);
  const std::string at = one.period                        ? fmt::format("at a period of {:.6g} s", *one.period)
                         : part == Damped::above_isolators ? fmt::format("in mode {} on a fixed base", mode)
                                                           : fmt::format("in mode {}", mode);
  s.damping_note = fmt::format("{}-proportional, {:.4g} % {}{}", by_mass ? "mass" : "stiffness", 100 * one.ratio, at,
                               note_of_part(s, part));
}

// Adds damping of single modes on top of a ratio for all modes: the difference of the ratios.
void add_single_modes(Structure& s, const SparseMatrix& stiffness, const ModalDamping& modal) {
  const int count = count_of_modes(s);
  require_modal_matrix(count);
  const Eigenmodes all = dense_modes(s.mass, stiffness, count);
  const auto rigid = static_cast<int>((all.frequencies.array() == 0).count());
  const auto listed = static_cast<int>(modal.ratios.size());
  if (listed > count - rigid)
    throw std::invalid_argument(
        fmt::format("{} ratios of modal damping were given, but there are {} modes", listed, count - rigid));
  const Eigen::VectorXd w = all.frequencies.segment(rigid, listed);
  const Eigen::VectorXd ratios = Eigen::Map<const Eigen::VectorXd>(modal.ratios.data(), listed);
  const Eigen::MatrixXd shapes = Eigen::MatrixXd(s.mass) * all.shapes.middleCols(rigid, listed);
  const Eigen::VectorXd difference = 2 * w.array() * (ratios.array() - modal.ratio);
  s.damping += SparseMatrix((shapes * difference.asDiagonal() * shapes.transpose()).sparseView());
}

std::string note_of(const ModalDamping& modal) {
  if (modal.ratios.empty()) return fmt::format("modal, {:.4g} % in every mode", 100 * modal.ratio);
  std::string list;
  for (const double ratio : modal.ratios) list += fmt::format("{}{:.4g}", list.empty() ? "" : ", ", 100 * ratio);
  const std::size_t count = modal.ratios.size();
  return fmt::format("modal, {} % in mode{}, {:.4g} % in all others", list,
                     count == 1 ? std::string(" 1") : fmt::format("s 1 to {}", count), 100 * modal.ratio);
}

void damp(Structure& s, const ModalDamping& modal, Damped part, const ModeSolver&) {
  check_ratio(modal.ratio);
  for (const double ratio : modal.ratios) check_ratio(ratio);
  const bool above = part == Damped::above_isolators;
  const SparseMatrix stiffness = above ? SparseMatrix(s.stiffness - stiffness_of_isolators(s)) : s.stiffness;
  if (!modal.ratios.empty()) add_single_modes(s, stiffness, modal);
  if (above)
    s.damping += modal_damping_matrix(s.mass, stiffness, modal.ratio);
  else
    s.modal_ratio = modal.ratio;
  s.damping_note =
      fmt::format("{}{}", note_of(modal), above ? " of the structure without its isolators" : note_of_part(s, part));
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
  const Damped part = damped_part(s, damping.of());
  std::visit([&](const auto& how) { damp(s, how, part, modes); }, damping.how());
}

}  // namespace pounding
