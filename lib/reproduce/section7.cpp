/// Section 7: the damping ratio of Eq. 38, its derivation, and comparison of its results with two others.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"
#include "reproduce/paper.hpp"

namespace pounding::reproduce::section7 {
namespace {

// The paper gives no numbers for Figs. 13 and 14.
constexpr double mass = 60e3, stiffness = 9.35e7, speed = 0.5;

struct Ratio {
  const char* name;
  laws::DampingFormula formula;
};
constexpr Ratio jankowski{"Jankowski", &laws::jankowski_2005}, mahmoud{"Mahmoud", &laws::simple_approach},
    eq38{"Eq. 38, proposed", &laws::naderpour_2015_eq38}, exact{"exact", &laws::exact_approach_ratio};
constexpr Ratio ratios[] = {eq38, jankowski, mahmoud, exact};

double value(const Ratio& r, double e) { return r.formula({.restitution = e}); }

/// For a linear spring with a dashpot in the approach phase, the model of the paper's derivation and of Mahmoud's.
double obtained(const Ratio& r, double e) { return laws::restitution_of_approach(value(r, e)); }

Loop impact(const Ratio& r, double e) {
  const laws::Settings law{.law = "modified_linear_viscoelastic",
                           .formula = {},
                           .values = {{"stiffness", stiffness}, {"damping_ratio", value(r, e)}}};
  return collide(law, mass, speed);
}

/// Restitution e at which (1-e^2)/e has this value.
double restitution_of_share(double share) { return 0.5 * (std::sqrt(share * share + 4) - share); }

Figure ratio_figure() {
  Figure figure{.name = "section7_ratios",
                .of_paper = "Fig. 12",
                .caption =
                    "Damping ratios by the three formulas of Table 4 and the exact one (left), and the restitution "
                    "that each obtains with a linear spring and a dashpot in the approach phase (right).",
                .panels = {{"ratio", "Target restitution [-]", "Damping ratio [-]", {}, false, true},
                           {"obtained", "Target restitution [-]", "Obtained restitution [-]", {}}}};
  std::vector<double> e;
  for (int i = 100; i <= 950; i += 5) e.push_back(i / 1000.0);
  figure.add("CR asked", "", e);
  for (const Ratio& r : ratios) {
    std::vector<double> zeta, given;
    for (const double requested : e) {
      zeta.push_back(value(r, requested));
      given.push_back(obtained(r, requested));
    }
    const std::string name = r.name;
    const Curve::Kind kind = name == "exact" ? Curve::Kind::dashed : Curve::Kind::line;
    figure.panels[0].curves.push_back({name, "CR asked", figure.add(name + ", ratio", "", zeta), kind});
    figure.panels[1].curves.push_back({name, "CR asked", figure.add(name + ", restitution", "", given), kind});
  }
  return figure;
}

struct Forces {
  Figure figure{.name = "section7_forces",
                .of_paper = "Figs. 13 and 14",
                .caption =
                    "Impact force, 60 t at 0.5 m/s on 93.5 MN/m. Left: three ratios and the exact one for a target of "
                    "0.5. Middle: Eq. 38 for three restitutions. Right: the exact ratio for the same three. The "
                    "legends show the obtained restitution."};
  Table table{"forces",
              "Impacts of Figs. 13 and 14",
              "ratio, target CR",
              {{"zeta", "", 5},
               {"restitution", "", 4},
               {"peak force", "kN", 1},
               {"penetration", "mm", 3},
               {"contact time", "ms", 3}},
              {}};

  void add(const Ratio& r, double e, const std::string& label) {
    const Loop loop = impact(r, e);
    figure.plot(fmt::format("{} ({:.3f})", label, loop.impact.restitution), scaled(loop.time, 1e3),
                scaled(loop.force, 1e-3));
    const std::string row = fmt::format("{}, {}", r.name, e);
    if (std::ranges::find(table.rows, row, &Table::Row::name) != table.rows.end()) return;
    table.rows.push_back({row,
                          {value(r, e), loop.impact.restitution, loop.impact.peak_force / 1e3,
                           1e3 * loop.impact.peak_penetration, 1e3 * (loop.impact.t_release - loop.impact.t_start)}});
  }
};

Forces forces() {
  Forces result;
  const std::string x = "Time since the touch [ms]", y = "Contact force [kN]";
  result.figure.panels.push_back({"target 0.5", x, y, {}});
  for (const Ratio& r : ratios) result.add(r, 0.5, r.name);
  for (const auto& [title, ratio] : {std::pair{"Eq. 38", &eq38}, {"exact", &exact}}) {
    result.figure.panels.push_back({title, x, y, {}});
    for (const double e : {0.4, 0.6, 0.9}) result.add(*ratio, e, fmt::format("CR = {}", e));
  }
  return result;
}

/// The rebound as the derivation assumes it, compared with the rebound of the impact.
Table derivation_table() {
  Table table{"derivation",
              "Eq. 24 compared with the actual impact, with the ratio of Eq. 38",
              "target CR",
              {{"zeta", "", 5},
               {"Eq. 24, penetration", "mm", 4},
               {"penetration", "mm", 4},
               {"Eq. 34, energy lost", "kJ", 4},
               {"energy lost", "kJ", 4},
               {"obtained", "", 4}},
              {}};
  for (const double e : paper::restitutions) {
    const double zeta = value(eq38, e);
    const double depth = std::sqrt(mass / (4 * std::numbers::pi * zeta * stiffness)) * e * speed;
    const double lost =
        4 * stiffness * std::pow(zeta, 1.5) / e * std::sqrt(std::numbers::pi) * 0.25 * depth * depth * std::numbers::pi;
    const laws::FreeImpact really =
        Asking{"modified_linear_viscoelastic", "naderpour_2015_eq38", stiffness, e}.free_impact(mass, speed);
    table.rows.push_back(
        {fmt::format("{:.1f}", e),
         {zeta, 1e3 * depth, 1e3 * really.peak_penetration, lost / 1e3, really.energy_lost / 1e3, really.restitution}});
  }
  return table;
}

Table ratio_table() {
  Table table{"ratios", "Damping ratios and the restitutions obtained", "target CR", {}, {}};
  for (const Ratio& r : ratios) table.headings.push_back({r.name, "", 5});
  for (const Ratio& r : ratios) table.headings.push_back({std::string(r.name) + ", obtained", "", 4});
  for (const double e : paper::restitutions) {
    Table::Row row{fmt::format("{:.1f}", e), {}};
    for (const Ratio& r : ratios) row.values.push_back(value(r, e));
    for (const Ratio& r : ratios) row.values.push_back(obtained(r, e));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

Item make() {
  const Forces run = forces();
  const Table table = ratio_table(), derivation = derivation_table();
  Item item{
      .name = "section7",
      .title = "The damping ratio of Eq. 38",
      .sections = "Section 7, Eqs. 20-38, Table 4, Figs. 12-14",
      .equations = {{"22", R"($\Delta E = 2\pi\,\zeta\,\dfrac{\omega}{\omega_n}\,k\,\delta^2$)"},
                    {"24", R"($\delta_{max} = \sqrt{\dfrac{m}{4\pi\,\zeta\,k}}\ \dot{\delta}_{final}$)"},
                    {"34", R"($\Delta E = 4k\,\dfrac{\zeta^{1.5}}{CR}\,\sqrt{\pi}\,(0.25\,\delta_{max}^2\,\pi)$)"},
                    {"37, with its dots",
                     R"($(1-CR^2)\,\dot{\delta}_{imp}^2 = \dfrac{\sqrt{\zeta\,\pi}}{2\,CR}\,\dot{\delta}_{final}^2$)"},
                    {"38", R"($\zeta = \left(\dfrac{2}{CR\,\sqrt{\pi}}\,(1-CR^2)\right)^2$)"},
                    {"Table 4, Jankowski", R"($\zeta = \dfrac{\sqrt{5}}{2\pi}\,\dfrac{1-CR^2}{CR}$)"},
                    {"Table 4, Mahmoud", R"($\zeta = \dfrac{1}{\pi}\,\dfrac{1-CR^2}{CR}$)"}},
      .figures = {ratio_figure(), run.figure},
      .tables = {table, run.table, derivation}};

  // Eq. 24 is the rebound of an undamped spring if 4 pi zeta = 1.
  const double consistent = restitution_of_share(0.25);
  const double upper = restitution_of_share(std::sqrt(5.0) / 8), lower = consistent;
  const auto miss = [](double e) { return value(eq38, e) - value(exact, e); };
  const double right = find_root(miss, 0.5, miss(0.5), 0.99, miss(0.99));
  const auto at_start = [](double start) { return restitution_of_share(std::sqrt(start * std::numbers::pi / 4)); };
  item.paragraphs = {
      "The derivation equates the loss of a damper over a full cycle of steady harmonic motion (Eq. 22) with the "
      "kinetic energy of the rebound (Eq. 23), and derives the largest penetration (Eq. 24). A collision is half a "
      "cycle of transient motion; its rebound is driven by the spring, $k\\,\\delta_{max}^2 = "
      "m\\,\\dot{\\delta}_{final}^2$.",
      fmt::format("The two agree if $4\\pi\\zeta = 1$, which holds for Eq. 38 at $CR$ = {:.4f}. Only near this value "
                  "is Eq. 38 accurate: it obtains the target at {:.4f}.",
                  consistent, right),
      "All ratios are applied to the model of the derivation, a linear spring with a dashpot in the approach phase. "
      "Jankowski's formula was derived for a Hertz spring, whose ratio is larger by a factor of $\\sqrt{5}/2$; with "
      "that spring it obtains the same restitution as Mahmoud's here. Section 7 begins \"As noted in Eq. (19)\"; it "
      "means Eq. 18."};

  const double start_38 = table.at("0.1", eq38.name), start_j = table.at("0.1", jankowski.name),
               start_m = table.at("0.1", mahmoud.name);
  const auto excess = [&](const char* e) { return table.at(e, eq38.name) / table.at(e, jankowski.name); };
  const double f4 = run.table.at("Eq. 38, proposed, 0.4", "peak force"),
               f6 = run.table.at("Eq. 38, proposed, 0.6", "peak force"),
               f9 = run.table.at("Eq. 38, proposed, 0.9", "peak force");
  item.verdicts = {
      {"Eqs. 23-38", "Eq. 38 follows from Eqs. 23-37", "derived",
       fmt::format("Eq. 34 with Eqs. 24 and 38 gives the loss of Eq. 18, {:.4f} kJ at 0.5",
                   derivation.at("0.5", "Eq. 34, energy lost")),
       Judgement::agrees,
       "algebraically, with $\\dot{\\delta}_{final} = CR\\,\\dot{\\delta}_{imp}$. Eq. 27 lacks its =, Eqs. 35-37 the "
       "dots of the impact velocity."},
      {"Eqs. 22-24", "The energy of the damper is that of a harmonic motion", "$\\delta_{max}$ from the loss per cycle",
       fmt::format(
           "at 0.5 Eq. 24 gives {:.3f} mm, the impact {:.3f} mm; the energy lost is {:.3f} kJ instead of {:.3f} kJ",
           derivation.at("0.5", "Eq. 24, penetration"), derivation.at("0.5", "penetration"),
           derivation.at("0.5", "energy lost"), derivation.at("0.5", "Eq. 34, energy lost")),
       Judgement::disagrees,
       "a collision is not a steady vibration. Eq. 22 calls $\\omega_n$ the damped frequency, but it is the natural "
       "one."},
      {"Eq. 38", "Damping ratio from $CR$", "from $CR$",
       fmt::format("the target 0.5 gives {:.4f}, 0.7 gives {:.4f}, 0.9 gives {:.4f}",
                   table.at("0.5", "Eq. 38, proposed, obtained"), table.at("0.7", "Eq. 38, proposed, obtained"),
                   table.at("0.9", "Eq. 38, proposed, obtained")),
       Judgement::disagrees, fmt::format("usable only near $CR$ = {:.2f}, see above.", right)},
      {"Fig. 12, Jankowski", "The curve of Jankowski's ratio starts at", fmt::format("{}", paper::start_jankowski),
       fmt::format("{:.3f} at $CR$ = 0.1", start_j), Judgement::agrees,
       "to the digits printed; the axis begins at 0.1."},
      {"Fig. 12, Mahmoud", "The curve of Seyed Mahmoud's ratio starts at", fmt::format("{}", paper::start_mahmoud),
       fmt::format("{:.3f} at $CR$ = 0.1", start_m), Judgement::agrees,
       fmt::format("within {:.1f} %.", std::abs(percent(start_m, paper::start_mahmoud)))},
      {"Fig. 12, Eq. 38", "The curve of Eq. 38 starts at", fmt::format("{}", paper::start_eq38),
       fmt::format("{:.2f} at $CR$ = 0.1", start_38), Judgement::disagrees,
       fmt::format("{} is the value at {:.3f}. With $\\sqrt{{2}}$ instead of 2 the formula would start at {:.1f}.",
                   paper::start_eq38, at_start(paper::start_eq38), start_38 / 2)},
      {"Section 7, between", "Eq. 38 is an acceptable curve between the two others", "between",
       fmt::format("above both for $CR$ < {:.3f}, between them up to {:.3f}, below both beyond", upper, lower),
       Judgement::disagrees, fmt::format("the intermediate range is {:.3f} wide.", lower - upper)},
      {"Section 7, 0.4 to 0.9", "The results are close to each other from $CR$ = 0.4 to 0.9", "close",
       fmt::format("Eq. 38 over Jankowski: {:.1f} at 0.4, {:.1f} at 0.5, {:.1f} at 0.7, {:.2f} at 0.9", excess("0.4"),
                   excess("0.5"), excess("0.7"), excess("0.9")),
       Judgement::disagrees, "they appear close on an axis that extends to 61 or more."},
      {"Figs. 13, 14", "Similar impact forces for $CR$ from 0.4 to 0.9", "similar; figures without numbers",
       fmt::format("peak forces by Eq. 38 for one impact: {:.0f}, {:.0f}, {:.0f} kN for 0.4, 0.6, 0.9", f4, f6, f9),
       Judgement::disagrees,
       "$k$, mass and velocity of the figures are not given, so the curves cannot be compared; but above $\\zeta = "
       "0.5$ the largest force is $c\\,v$ at the touch, proportional to $\\zeta$."}};
  return item;
}

}  // namespace pounding::reproduce::section7
