/// Section 6: the cyclic process, restitution versus velocity, and the pair of energies.

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <pounding/laws/cyclic_calibration.hpp>
#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"
#include "reproduce/paper.hpp"

namespace pounding::reproduce::cyclic {
namespace {

using namespace paper::pair;
using paper::example::mass, paper::example::stiffness;

double eq19(double e) {
  double v = 0;
  for (const double coefficient : paper::velocity_curve) v = v * e + coefficient;
  return v;
}

std::vector<double> roots_of_eq19() {
  std::vector<double> roots;
  constexpr int parts = 1000;
  for (int i = 0; i < parts; ++i) {
    const double a = static_cast<double>(i) / parts, b = static_cast<double>(i + 1) / parts;
    if (eq19(a) * eq19(b) < 0) roots.push_back(find_root(eq19, a, eq19(a), b, eq19(b)));
  }
  return roots;
}

laws::AnyLaw proposed(double e) { return Asking{"hertz_damped", "naderpour_2015", stiffness, e}.made(mass); }
double c_imp(double v, double e) { return damping_coefficient(proposed(e), v); }

/// Velocity for which Eq. 16 gives the damping of the reference at this restitution; at equal approach velocities both
/// have the same loop.
double equal_loop_velocity(double e) {
  const double wanted = c_imp(reference_speed, reference_restitution);
  const auto miss = [&](double v) { return c_imp(v, e) / wanted - 1; };
  return find_root(miss, 1e-3, miss(1e-3), 1e4, miss(1e4));
}

/// Same for Eq. 16 without Table 2, N = M = 1.
double equal_loop_velocity_simple(double e) {
  const auto share = [](double x) { return (1 - x * x) / x; };
  return reference_speed * share(e) / share(reference_restitution);
}

/// Velocity at which the kinetic energy loss equals that of the reference.
double equal_loss_velocity(double e) {
  return reference_speed * std::sqrt((1 - reference_restitution * reference_restitution) / (1 - e * e));
}

/// Quartic fitted to sampled values, highest power first.
Eigen::VectorXd quartic(const std::function<double(double)>& curve, int first_tenth, int last_tenth) {
  const int count = last_tenth - first_tenth + 1;
  Eigen::MatrixXd powers(count, 5);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const double e = (first_tenth + i) / 10.0;
    for (int p = 0; p < 5; ++p) powers(i, p) = std::pow(e, 4 - p);
    values[i] = curve(e);
  }
  return powers.colPivHouseholderQr().solve(values);
}

struct Pair {
  Figure figure;
  Table table;
};

/// Loops of a law with the damping of (v, CR) at a given approach velocity.
Pair pair_of_loops() {
  Pair pair{
      {.name = "cyclic_pair",
       .of_paper = "Fig. 10",
       .caption = "The reference and the second model. At the same impact speed of 10 m/s their loops nearly coincide; "
                  "at 11 m/s the second loop is much larger.",
       .panels = {{"", "Penetration [mm]", "Contact force [kN]", {}}}},
      {"pair",
       "The two models, 755.76 kg, $k$ = 30000 kN/m$^{1.5}$",
       "damping for; impact speed",
       {{"c_imp", "kN s/m^2.5", 2}, {"restitution", "", 4}, {"loop area", "kJ", 4}, {"Eq. 18, target CR", "kJ", 4}},
       {}}};
  const struct {
    double design_speed, e, speed;
  } models[] = {{reference_speed, reference_restitution, reference_speed},
                {second_speed, second_restitution, reference_speed},
                {second_speed, second_restitution, second_speed}};
  for (const auto& m : models) {
    const std::string name = fmt::format("v = {}, CR = {}; {} m/s", m.design_speed, m.e, m.speed);
    laws::Settings law = Asking{"hertz_damped", "naderpour_2015", stiffness, m.e}.settings();
    law.impact_velocity = m.design_speed;
    const Loop loop = collide(law, mass, m.speed);
    pair.figure.plot(name, scaled(loop.penetration, 1e3), scaled(loop.force, 1e-3));
    pair.table.rows.push_back({name,
                               {c_imp(m.design_speed, m.e) / 1e3, loop.impact.restitution,
                                loop.impact.energy_lost / 1e3, kinetic_loss(mass, m.speed, m.e) / 1e3}});
  }
  return pair;
}

/// The cyclic process for the reference.
struct Process {
  Table analyses{"process",
                 "The cyclic process for Eq. 16 at v = 10 m/s, target CR = 0.5",
                 "analysis",
                 {{"CR assumed", "", 8},
                  {"loop area", "kJ", 6},
                  {"Eq. 18", "kJ", 6},
                  {"difference", "%", -3},
                  {"CR obtained", "", 8}},
                 {}};
  Figure figure{
      .name = "cyclic_process",
      .of_paper = "Fig. 9",
      .caption = fmt::format(
          "Restitution to insert in a formula so that the loop dissipates the energy of the target restitution: the "
          "converged cyclic process at 10 m/s. Lankarani's formula reaches no restitution below {:.2f}.",
          laws::restitution_of_factor(laws::lankarani_nikravesh({.restitution = 0}))),
      .panels = {{"", "Target restitution [-]", "Restitution to assume [-]", {}}}};
  double damping = 0, exact_damping = 0;  ///< a at convergence, and of the exact calibration
  double worst = 0;                       ///< largest relative difference of the two over all restitutions and formulas
};

Process process() {
  Process result;
  laws::Settings settings{.law = "hertz_damped", .formula = "naderpour_2015", .values = {{"stiffness", stiffness}}};
  const laws::CyclicCalibration reference =
      laws::calibrate_cyclically(settings, reference_restitution, mass, reference_speed);
  for (const laws::CyclicAnalysis& a : reference.analyses)
    result.analyses.rows.push_back({fmt::format("{}", result.analyses.rows.size() + 1),
                                    {a.assumed, a.loop_area / 1e3, reference.kinetic_loss / 1e3,
                                     percent(a.loop_area, reference.kinetic_loss), a.restitution}});
  result.damping = damping_number(proposed(reference.assumed()), reference_speed);
  result.exact_damping = laws::exact_factor({.restitution = reference_restitution});

  for (const auto& [name, formula] : {std::pair{"Eq. 12, Lankarani", "lankarani_nikravesh"},
                                      {"Eq. 13, Ye 2008", "hu_guo"},
                                      {"Eq. 14, Ye 2009", "ye_2009"},
                                      {"Eq. 16, proposed", "naderpour_2015"}}) {
    settings.formula = formula;
    std::vector<double> requested, assumed;
    for (int i = 10; i <= 95; ++i) {
      const double e = i / 100.0;
      try {
        assumed.push_back(laws::calibrate_cyclically(settings, e, mass, reference_speed).assumed());
      } catch (const std::invalid_argument&) {
        continue;  // out of reach of the formula: the curve has a gap
      }
      requested.push_back(e);
      const double a =
          damping_number(Asking{"hertz_damped", formula, stiffness, assumed.back()}.made(mass), reference_speed);
      result.worst = std::max(result.worst, std::abs(a / laws::exact_factor({.restitution = e}) - 1));
    }
    result.figure.plot(name, requested, assumed);
  }
  result.figure.plot("no correction", {0.1, 0.95}, {0.1, 0.95}, Curve::Kind::dashed);
  return result;
}

Figure velocity_figure(const Eigen::VectorXd& fit) {
  Figure figure{.name = "cyclic_velocity",
                .of_paper = "Fig. 11",
                .caption =
                    "Velocity versus restitution. Eq. 19 resembles the curve of constant damping, and hence of equal "
                    "loops at one speed; a quartic fitted to that curve at 0.1, 0.2 ... 1.0 is shown for comparison. "
                    "Equal kinetic energy losses would require an increasing velocity. Right: the same near the axis.",
                .panels = {{"all", "Restitution CR [-]", "Velocity [m/s]", {}},
                           {"below 20 m/s", "Restitution CR [-]", "Velocity [m/s]", {}}}};
  const std::function<double(double)> fitted = [&](double e) {
    double v = 0;
    for (const double coefficient : fit) v = v * e + coefficient;
    return v;
  };
  const struct {
    const char* name;
    std::function<double(double)> curve;
    double last;
    Curve::Kind kind;
  } curves[] = {{"Eq. 19", eq19, 1, Curve::Kind::line},
                {"equal loops, Eq. 16 with Table 2", equal_loop_velocity, 0.9, Curve::Kind::line},
                {"equal loops, N = M = 1", equal_loop_velocity_simple, 1, Curve::Kind::line},
                {"quartic through the line above", fitted, 1, Curve::Kind::dashed},
                {"equal kinetic energy losses", equal_loss_velocity, 0.95, Curve::Kind::thin}};
  for (const auto& c : curves) {
    std::vector<double> e, v, e_low, v_low;
    for (double x = 0.1; x < c.last + 1e-9; x += 0.01) {
      e.push_back(std::min(x, c.last));
      v.push_back(c.curve(e.back()));
      if (v.back() > 20) continue;
      e_low.push_back(e.back());
      v_low.push_back(v.back());
    }
    const std::string name = c.name;
    const std::string x = figure.add(name + ", CR", "", e), y = figure.add(name + ", velocity", "m/s", v);
    figure.panels[0].curves.push_back({name, x, y, c.kind});
    const std::string near_x = figure.add(name + ", below 20 m/s, CR", "", e_low);
    const std::string near_y = figure.add(name + ", below 20 m/s, velocity", "m/s", v_low);
    figure.panels[1].curves.push_back({name, near_x, near_y, c.kind});
  }
  const std::string x = figure.add("the pair, CR", "", {reference_restitution, second_restitution});
  const std::string y = figure.add("the pair, velocity", "m/s", {reference_speed, second_speed});
  figure.panels[1].curves.push_back({"(0.5, 10) and (0.45, 11)", x, y, Curve::Kind::points});
  return figure;
}

Table velocity_table() {
  Table table{"velocities",
              "Velocity versus restitution, by Eq. 19 and by three interpretations of the text",
              "CR",
              {{"Eq. 19", "m/s", 3},
               {"equal loops, Table 2", "m/s", 3},
               {"equal loops, N = M = 1", "m/s", 3},
               {"equal losses", "m/s", 3},
               {"Eq. 18 = own loop", "m/s", -3}},
              {}};
  for (const double e : {0.1, 0.2, 0.3, 0.4, 0.45, 0.5, 0.6, 0.7, 0.8, 0.9})
    table.rows.push_back({fmt::format("{}", e),
                          {eq19(e), equal_loop_velocity(e), equal_loop_velocity_simple(e), equal_loss_velocity(e),
                           stiffness / 1e3 / fitting_k_over_v(e)}});
  return table;
}

}  // namespace

Item make() {
  const Process run = process();
  const Pair pair = pair_of_loops();
  const Eigen::VectorXd fit = quartic(equal_loop_velocity_simple, 1, 10);
  const std::vector<double> roots = roots_of_eq19();
  double lowest = 0, where = 0;
  for (double e = 0; e < 1; e += 1e-4)
    if (eq19(e) < lowest) lowest = eq19(e), where = e;

  Item item{.name = "cyclic",
            .title = "The cyclic process, and velocity versus restitution",
            .sections = "Section 6, Eq. 19, Figs. 9-11",
            .equations = {{"19", R"($v_{imp} = 494.32\,CR^4 - 1299\,CR^3 + 1285\,CR^2 - 595.9\,CR + 116.67$)"}},
            .figures = {run.figure, pair.figure, velocity_figure(fit)},
            .tables = {run.analyses, pair.table, velocity_table()}};
  item.paragraphs = {
      "The process of Fig. 9: choose a velocity, assume a restitution, analyse the impact, compare the area of its "
      "loop with the kinetic energy loss of Eq. 18, change the restitution, repeat. `pounding calibrate --cyclic` "
      "implements it. Eq. 18 always uses the target restitution; only the restitution in the formula is changed.",
      "The process converges to the exact calibration, from every formula that can reach it. It is a sound method, and "
      "it makes formulas unnecessary. But the balance then holds at every velocity: it relates velocity to restitution "
      "only under a further condition. If Eq. 18 and the loop use the same $v$ and $CR$, Table 2 balances at absurd "
      "velocities (last column of the table). With equal kinetic energy losses the velocity increases with the "
      "restitution. With equal loops at one speed, that is equal $c_{imp}$, the velocity decreases much like Eq. 19: "
      "this is probably how the curve was obtained."};

  const double first_loss = kinetic_loss(mass, reference_speed, reference_restitution) / 1e3;
  const double second_eq18 = kinetic_loss(mass, second_speed, second_restitution) / 1e3;
  const double implied = std::sqrt(1 - second_loss / (0.5 * mass * reference_speed * reference_speed / 1e3));
  const double area_1 = pair.table.rows[0].values[2], area_2 = pair.table.rows[1].values[2];
  double distance = 0;
  for (int i = 1; i <= 9; ++i)
    distance = std::max(distance, std::abs(eq19(i / 10.0) - equal_loop_velocity_simple(i / 10.0)));
  item.verdicts = {
      {"Fig. 9", "The process leads to the optimum", "a flow chart",
       fmt::format("{} analyses from $CR$ = 0.5 to an assumed {:.6f}; $a$ = {:.9f}, by the exact calibration {:.9f}",
                   run.analyses.rows.size(), run.analyses.rows.back().values[0], run.damping, run.exact_damping),
       Judgement::agrees,
       fmt::format("it converges to the exact calibration, within {:.0e} over all restitutions and four formulas.",
                   run.worst)},
      {"Section 6, 28.33261", "Kinetic energy loss of the reference, $v = 10$, $CR = 0.5$",
       fmt::format("{}", reference_loss),
       fmt::format("{:.5f} kJ ({:+.2f} %)", first_loss, percent(first_loss, reference_loss)), Judgement::agrees,
       "with the mass of 755.76 kg; the small difference is due to a rounded input."},
      {"Section 6, 28.64157", "Kinetic energy loss of the second model, $v = 11$, $CR = 0.45$",
       fmt::format("{}", second_loss), fmt::format("{:.5f} kJ by Eq. 18", second_eq18), Judgement::disagrees,
       fmt::format("it is the loss at $v = 10$ with $CR$ = {:.4f}; the loop of the second model at 10 m/s has {:.2f} "
                   "kJ, which does not match either.",
                   implied, area_2)},
      {"Section 6, Fig. 10", "The loops of both models are approximately equal",
       fmt::format("{} and {}, {:.1f} % apart", reference_loss, second_loss, percent(second_loss, reference_loss)),
       fmt::format("{:.3f} kJ and {:.3f} kJ at 10 m/s, {:.1f} % apart", area_1, area_2, percent(area_2, area_1)),
       Judgement::agrees,
       fmt::format("approximately. Equal loops require {:.2f} m/s at 0.45.", equal_loop_velocity(second_restitution))},
      {"Eq. 19", "The curve passes through the pair", "10 at 0.5, 11 at 0.45",
       fmt::format("{:.3f} at 0.5, {:.3f} at 0.45", eq19(0.5), eq19(0.45)), Judgement::disagrees,
       fmt::format(
           "{:+.0f} % and {:+.0f} %, probably because a polynomial of degree four cannot follow a curve like $1/CR$.",
           percent(eq19(reference_restitution), reference_speed), percent(eq19(second_restitution), second_speed))},
      {"Eq. 19, range", "Velocity for every restitution", "no range given",
       fmt::format("negative for {:.4f} < $CR$ < {:.4f}, {:.3f} m/s at {:.3f}; {:.2f} m/s at $CR = 1$", roots.at(0),
                   roots.at(1), lowest, where, eq19(1)),
       Judgement::disagrees, "the polynomial oscillates around zero and has no meaning there."},
      {"Fig. 11", "Eq. 19 simulates the data precisely", "data not given",
       fmt::format("the equal-loop curve with $N = M = 1$ is within {:.1f} m/s of Eq. 19; its quartic has {:.0f}, "
                   "{:.0f}, {:.0f}, {:.1f}, {:.1f}",
                   distance, fit[0], fit[1], fit[2], fit[3], fit[4]),
       Judgement::cannot_be_checked,
       "the fitted points are missing. The resemblance is our interpretation, not that of the paper."},
      {"Section 6, trend", "The velocity decreases as the restitution increases, as Jankowski confirmed", "confirmed",
       fmt::format("for equal kinetic energy losses it increases: {:.2f} m/s at 0.1, {:.2f} m/s at 0.9",
                   equal_loss_velocity(0.1), equal_loss_velocity(0.9)),
       Judgement::cannot_be_checked,
       "the paper gives no measurements. Materials do lose more energy in faster impacts, but this does not follow "
       "from the balance: the curve here results from constant damping."}};
  return item;
}

}  // namespace pounding::reproduce::cyclic
