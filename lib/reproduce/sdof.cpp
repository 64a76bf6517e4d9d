/// Section 3: one equivalent oscillator (Eq. 1) and the two oscillators with their link (Eq. 2).

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include <pounding/elements.hpp>
#include <pounding/model/system.hpp>
#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"

namespace pounding::reproduce::sdof {
namespace {

using Eigen::Matrix2d, Eigen::Matrix4d, Eigen::Vector2d, Eigen::Vector4d;

// The paper gives no numbers here. Masses of 100 t and 150 t, periods of 0.8 s and 0.4 s, and a stiffness from the
// literature.
constexpr double m1 = 100e3, m2 = 150e3, reduced = m1 * m2 / (m1 + m2), stiffness = 9.35e7, speed = 0.5,
                 requested = 0.65;

/// M, C and K of the pair in contact.
struct Touching {
  Matrix2d mass, damping, stiffness;
};

const Asking law{"kelvin_voigt", "anagnostopoulos", stiffness, requested};

/// Two free bodies, or the two oscillators; the left one moves towards the right one, which it touches.
Model touching_pair(bool is_free) {
  Model model;
  const auto add = [&](const char* name, double mass, double period, double velocity) {
    return model.add(
        name,
        is_free ? make_body({.mass = mass}) : make_oscillator({.mass = mass, .period = period, .damping_ratio = 0.05}),
        {.initial_velocity = velocity});
  };
  const StructureHandle left = add("left", m1, 0.8, speed), right = add("right", m2, 0.4, 0);
  model.link(left, right, {.gap = 0.0}, law.settings());
  model.analysis = {.duration = 0.3, .tolerance = 1e-8, .scheme = {.kind = Scheme::Kind::esdirk4}};
  model.complete();
  return model;
}

/// The program's own matrices of the two oscillators, with the link added.
Touching assembled(double c) {
  const Model model = touching_pair(false);
  const System system = assemble(model);
  const Vector2d closing = Eigen::MatrixXd(system.gap_jacobian).col(0);
  Touching t{Matrix2d(system.mass), Matrix2d(system.damping), Matrix2d(system.stiffness)};
  for (int i = 0; i < 2; ++i) {
    const Group& group = system.groups.at(static_cast<std::size_t>(i));
    t.damping(i, i) += group.by_mass * t.mass(i, i) + group.by_stiffness * t.stiffness(i, i);
  }
  t.damping += c * closing * closing.transpose();
  t.stiffness += stiffness * closing * closing.transpose();
  return t;
}

/// Eq. 2 exactly as printed: link terms in the first row and off the diagonal, none on the diagonal of the second body.
Touching as_printed(Touching t, double c) {
  t.damping(1, 1) -= c;
  t.stiffness(1, 1) -= stiffness;
  return t;
}

Matrix4d first_order(const Touching& t) {
  Matrix4d a = Matrix4d::Zero();
  a.topRightCorner<2, 2>().setIdentity();
  a.bottomLeftCorner<2, 2>() = -t.mass.inverse() * t.stiffness;
  a.bottomRightCorner<2, 2>() = -t.mass.inverse() * t.damping;
  return a;
}

/// Link force at these times after the touch, by the matrix exponential [N].
std::vector<double> forces(const Touching& t, double c, const std::vector<double>& times) {
  const Matrix4d a = first_order(t);
  std::vector<double> result;
  for (const double time : times) {
    const Vector4d state = Matrix4d(a * time).exp() * Vector4d(0, 0, speed, 0);
    result.push_back(stiffness * (state[0] - state[1]) + c * (state[2] - state[3]));
  }
  return result;
}

/// Compares samples in contact only; before the touch and after the separation the force is zero.
double largest_difference(const std::vector<double>& a, const std::vector<double>& measured) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (measured[i] != 0) largest = std::max(largest, std::abs(a[i] - measured[i]));
  return largest;
}

std::vector<std::vector<double>> rows_of(const Matrix2d& m, double unit) {
  return {{m(0, 0) / unit, m(0, 1) / unit}, {m(1, 0) / unit, m(1, 1) / unit}};
}

}  // namespace

Item make() {
  const double c = damping_coefficient(law.made(reduced), speed);

  const Loop one = collide(law.settings(), reduced, speed);
  const Outcome free_run = run(touching_pair(true)), sprung_run = run(touching_pair(false));
  const Loop two = loop_of(free_run.results.links[0], free_run.results.impacts.at(0));
  const Loop sprung = loop_of(sprung_run.results.links[0], sprung_run.results.impacts.at(0));

  const Touching ours = assembled(c), printed = as_printed(ours, c);
  const double peak = sprung.impact.peak_force;
  const std::vector<double> by_ours = forces(ours, c, sprung.time), by_printed = forces(printed, c, sprung.time);
  const double error = largest_difference(by_ours, sprung.force) / peak;
  const double printed_error = largest_difference(by_printed, sprung.force) / peak;

  // The link is the only force on bodies without springs and dashpots, so their momentum must be constant.
  Touching bare{ours.mass, Matrix2d::Zero(), Matrix2d::Zero()};
  const Vector2d closing(1, -1);
  bare.damping = c * closing * closing.transpose();
  bare.stiffness = stiffness * closing * closing.transpose();
  const auto momentum = [&](const Touching& t) {
    const Vector4d end =
        Matrix4d(first_order(t) * (one.impact.t_end - one.impact.t_start)).exp() * Vector4d(0, 0, speed, 0);
    return (m1 * end[2] + m2 * end[3]) / (m1 * speed);
  };
  const double kept = momentum(bare), kept_printed = momentum(as_printed(bare, c));

  Item item{.name = "sdof",
            .title = "The equivalent oscillator and the two oscillators",
            .sections = "Section 3, Eqs. 1 and 2, Figs. 1-3"};
  item.paragraphs = {
      fmt::format("The paper gives no numbers in this section. The reproduction uses floors of 100 t and 150 t (from "
                  "section 5.1), oscillators of 0.8 s and 0.4 s with 5 % damping, and a Kelvin-Voigt link of $s = "
                  "93.5$ MN/m and $CR = {}$ by Eq. 7, hence $c = {:.1f}$ kN s/m. The impact speed is {} m/s.",
                  requested, c / 1e3, speed),
      "Eq. 1 has one mass. It is exact in contact only if the bodies are free: the relative motion of two free bodies "
      "is that of one body with the reduced mass $m_1 m_2/(m_1+m_2)$. Bodies with springs are two oscillators, which "
      "require Eq. 2.",
      "In the copy used here, Eq. 2 lacks $+c$ and $+s$ at the second body. Such a link would pull body 1 without "
      "pushing body 2 by the same force. If this is not a printing error, a program that implements the printed "
      "equation creates momentum."};
  item.equations = {
      {"1", R"($m\ddot{u} + c\dot{u} + ku = f(t)$)"},
      {"2, first row", R"($m_1\ddot{u}_1 + (c_1+c)\dot{u}_1 - c\,\dot{u}_2 + (k_1+s)u_1 - s\,u_2 = f_1$)"},
      {"2, second row as printed", R"($m_2\ddot{u}_2 - c\,\dot{u}_1 + c_2\dot{u}_2 - s\,u_1 + k_2 u_2 = f_2$)"},
      {"2, second row corrected", R"($m_2\ddot{u}_2 - c\,\dot{u}_1 + (c_2+c)\dot{u}_2 - s\,u_1 + (k_2+s) u_2 = f_2$)"}};
  item.matrices = {{"mass", "t", rows_of(ours.mass, 1e3)},
                   {"damping, assembled by the program", "kN s/m", rows_of(ours.damping, 1e3)},
                   {"damping, as printed", "kN s/m", rows_of(printed.damping, 1e3)},
                   {"stiffness, assembled by the program", "MN/m", rows_of(ours.stiffness, 1e6)},
                   {"stiffness, as printed", "MN/m", rows_of(printed.stiffness, 1e6)}};

  Figure figure{.name = "sdof_contact",
                .of_paper = "Figs. 1-3",
                .caption =
                    "One contact. Left: the reduced mass on a wall and two free bodies have the same motion; the "
                    "springs of the oscillators change it. Right: Eq. 2 by the matrix exponential, as printed and with "
                    "the link at both bodies, compared with the time integration."};
  figure.panels.push_back({"Eq. 1", "Time since the touch [ms]", "Contact force [kN]", {}});
  figure.plot("one body, reduced mass", scaled(one.time, 1e3), scaled(one.force, 1e-3));
  figure.plot("two free bodies", scaled(two.time, 1e3), scaled(two.force, 1e-3), Curve::Kind::dashed);
  figure.plot("two oscillators", scaled(sprung.time, 1e3), scaled(sprung.force, 1e-3));
  figure.panels.push_back({"Eq. 2", "Time since the touch [ms]", "Contact force [kN]", {}});
  figure.plot("time integration", scaled(sprung.time, 1e3), scaled(sprung.force, 1e-3));
  figure.plot("Eq. 2, link at both bodies", scaled(sprung.time, 1e3), scaled(by_ours, 1e-3), Curve::Kind::dashed);
  figure.plot("Eq. 2 as printed", scaled(sprung.time, 1e3), scaled(by_printed, 1e-3));
  item.figures.push_back(figure);

  item.tables.push_back(
      {"contacts",
       "One contact at 0.5 m/s, target restitution 0.65",
       "model",
       {{"restitution", "", 6}, {"peak force", "kN", 3}, {"duration", "ms", 4}, {"energy lost", "kJ", 5}},
       {}});
  for (const auto& [name, loop] :
       {std::pair{"one body, reduced mass", &one}, {"two free bodies", &two}, {"two oscillators", &sprung}}) {
    const ImpactRow& row = loop->impact;
    item.tables[0].rows.push_back(
        {name, {row.restitution, row.peak_force / 1e3, 1e3 * (row.t_end - row.t_start), row.energy_lost / 1e3}});
  }

  const double same = std::abs(two.impact.peak_force / one.impact.peak_force - 1);
  item.verdicts = {{"Eq. 1", "Two colliding bodies are equivalent to one oscillator", "equivalent",
                    fmt::format("peak forces of two free bodies and of the reduced mass differ by a relative {:.0e}; "
                                "with the springs of the oscillators the restitution is {:.4f} instead of {:.4f}",
                                same, sprung.impact.restitution, one.impact.restitution),
                    Judgement::agrees,
                    "for free bodies. In a structure the springs act during contact, so the restitution of an impact "
                    "differs from the target for every law."},
                   {"Eq. 2", "Equations of two oscillators in contact", "second row with $c_2$ and $k_2$ only",
                    fmt::format("$c_2+c$ and $k_2+s$. With them Eq. 2 and the time integration agree to {:.0e} of the "
                                "peak force; as printed they differ by {:.0f} %. The momentum of two free bodies after "
                                "the contact is {:.6f} of its initial value; as printed it is {:.2f}",
                                error, 100 * printed_error, kept, kept_printed),
                    Judgement::disagrees,
                    "the second diagonal terms lack the link, possibly a printing error or one of the copy used here."},
                   {"Eq. 1, spring constants", "They follow from the stiffness of the colliding buildings",
                    "no formula", "none", Judgement::cannot_be_checked, "the paper does not state how."}};
  return item;
}

}  // namespace pounding::reproduce::sdof
