/// Section 5: the proposed damping coefficient, Table 2, and the example behind Fig. 6.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"
#include "reproduce/paper.hpp"

namespace pounding::reproduce::table2 {
namespace {

using namespace paper::example;

struct Named {
  const char *name, *formula;
};
constexpr Named formulas[] = {{"Eq. 12, Lankarani", "lankarani_nikravesh"},
                              {"Eq. 13, Ye 2008", "hu_guo"},
                              {"Eq. 14, Ye 2009", "ye_2009"},
                              {"Eq. 16, proposed", "naderpour_2015"},
                              {"exact", "exact"}};

Asking asking(const Named& f, double e = restitution) { return {"hertz_damped", f.formula, stiffness, e}; }

/// Root mean square of the error of the restitution over Table 2 [%].
double rms_error(double k_over_v) {
  double sum = 0;
  for (const double e : paper::restitutions) sum += std::pow(percent(proposed_restitution(e, k_over_v), e), 2);
  return std::sqrt(sum / paper::restitutions.size());
}

Figure example_figure() {
  Figure figure{
      .name = "table2_example",
      .of_paper = "Fig. 6",
      .caption =
          "The example of section 5, 755.76 kg at 10 m/s with target restitution 0.7. Left: loops for four published "
          "formulas and the exact one. Right: damping coefficient of each formula versus restitution.",
      .panels = {{"loops", "Penetration [mm]", "Contact force [kN]", {}}}};
  for (const Named& f : formulas) {
    const Loop loop = collide(asking(f).settings(), mass, speed);
    figure.plot(f.name, scaled(loop.penetration, 1e3), scaled(loop.force, 1e-3));
  }
  figure.panels.push_back({"damping", "Target restitution [-]", "Damping coefficient [kN s/m^2.5]", {}, false, true});
  std::vector<double> e;
  for (int i = 10; i <= 90; ++i) e.push_back(i / 100.0);
  for (const Named& f : formulas) {
    std::vector<double> c;
    for (const double requested : e) c.push_back(damping_coefficient(asking(f, requested).made(mass), speed) / 1e3);
    figure.plot(f.name, e, c);
  }
  return figure;
}

Figure units_figure(double best) {
  Figure figure{.name = "table2_units",
                .of_paper = "",
                .caption = fmt::format("Root mean square error of the restitution over the nine rows of Table 2, "
                                       "versus the numerical value of $k/v$. Markers show the example of the paper "
                                       "with $k$ in MN, kN and N per m$^{{1.5}}$; the smallest error is at {:.2f}.",
                                       best),
                .panels = {{"", "Number k/v in Eq. 16 [-]", "Error of the restitution, RMS [%]", {}, true, false}}};
  std::vector<double> ratio, error;
  for (int i = -150; i <= 800; ++i) {
    ratio.push_back(std::pow(10.0, i / 100.0));
    error.push_back(rms_error(ratio.back()));
  }
  figure.plot("Eq. 16 with Table 2", ratio, error);
  const double kilonewtons = stiffness / 1e3 / speed;
  for (const auto& [name, factor] : {std::pair{"k in MN", 1e-3}, {"k in kN, as printed", 1.0}, {"k in N", 1e3}})
    figure.plot(name, {kilonewtons * factor}, {rms_error(kilonewtons * factor)}, Curve::Kind::points);
  return figure;
}

double best_k_over_v() {
  double best = 1;
  for (double r = 0.1; r < 100; r *= 1.001)
    if (rms_error(r) < rms_error(best)) best = r;
  return best;
}

}  // namespace

Item make() {
  const double loss = kinetic_loss(mass, speed, restitution) / 1e3, kilonewtons = stiffness / 1e3 / speed;
  Item item{.name = "table2",
            .title = "The proposed damping coefficient and the example of 755.76",
            .sections = "Section 5, Eqs. 15-17, Table 2, Fig. 6",
            .equations = {{"16", R"($c_{imp} = \left(\dfrac{k}{v_{imp}}\right)^{N}\,\dfrac{1-CR^2}{CR^{M}}$)"},
                          {"17, with its dot", R"($F_{imp} = \delta^{1.5}\,(k + c_{imp}\,\dot{\delta})$)"},
                          {"exact", R"($c_{imp} = a\,k/v_{imp},\quad a\,(1+CR) = \ln\dfrac{1+a}{1-a\,CR}$)"}}};
  item.paragraphs = {
      "In a free impact with $F = k\\,\\delta^n(1 + a\\,\\dot{\\delta}/v)$ the restitution depends only on $a = "
      "c\\,v/k$, not on $k$, the mass, the velocity or $n$. The proposed law has $a = (k/v)^{N-1}(1-CR^2)/CR^M$: if "
      "$N$ is not 1, it depends on the numerical value of $k/v$, and so on the units. Near $k/v = 1$ it is "
      "$(1-CR^2)/CR$, the formula of Gonthier et al. (2004).",
      "The paper gives $k = 30000$ without a unit; with $\\delta^{1.5}$ and kN it is kN/m$^{1.5}$. It states a mass of "
      "755.76 kN, but its energies (see the item on section 6) are those of 755.76 kg."};

  Table example{"example",
                "755.76 kg, $k$ = 30000 kN/m$^{1.5}$, $v$ = 10 m/s, target restitution 0.7",
                "formula",
                {{"a", "", 6},
                 {"c_imp", "kN s/m^2.5", 3},
                 {"restitution", "", 5},
                 {"penetration", "m", 6},
                 {"peak force", "kN", 3},
                 {"energy lost", "kJ", 5},
                 {"Eq. 18", "kJ", 5},
                 {"error of energy", "%", 2}},
                {}};
  for (const Named& f : formulas) {
    const laws::AnyLaw law = asking(f).made(mass);
    const ImpactRow row = collide(asking(f).settings(), mass, speed).impact;
    example.rows.push_back(
        {f.name,
         {damping_number(law, speed), damping_coefficient(law, speed) / 1e3, row.restitution, row.peak_penetration,
          row.peak_force / 1e3, row.energy_lost / 1e3, loss, percent(row.energy_lost / 1e3, loss)}});
  }
  Table rows{
      "rows",
      "Table 2: restitution obtained with Eq. 16 by unit of k, and the k/v for which the row is exact",
      "target CR",
      {{"k in MN", "", 4}, {"k in kN", "", 4}, {"k in N", "", 4}, {"error, k in kN", "%", 2}, {"fitting k/v", "", -3}},
      {}};
  for (const double e : paper::restitutions)
    rows.rows.push_back({fmt::format("{:.1f}", e),
                         {proposed_restitution(e, kilonewtons / 1e3), proposed_restitution(e, kilonewtons),
                          proposed_restitution(e, kilonewtons * 1e3), percent(proposed_restitution(e, kilonewtons), e),
                          fitting_k_over_v(e)}});
  const double best = best_k_over_v();
  double minimum = rows.rows[0].values.back(), maximum = minimum;
  for (const Table::Row& row : rows.rows) {
    minimum = std::min(minimum, row.values.back());
    maximum = std::max(maximum, row.values.back());
  }
  item.figures = {example_figure(), units_figure(best)};

  const double c = example.at("Eq. 16, proposed", "c_imp");
  const double unrounded =
      damping_coefficient(Asking{"hertz_damped", "naderpour_2015", 30003.67e3, restitution}.made(mass), 9.976) / 1e3;
  const double as_weight = 0.5 * 755.76 / 9.81 * (1 - 0.25) * 100;
  item.verdicts = {
      {"Section 5, mass", "The mass of the two bodies is 755.76 kN",
       "755.76 kN; energy loss 28.33261 for $v = 10$, $CR = 0.5$",
       fmt::format("755.76 kg gives {:.3f} kJ, 755.76 kN as a weight {:.0f} kJ",
                   kinetic_loss(mass, speed, paper::pair::reference_restitution) / 1e3, as_weight),
       Judgement::disagrees,
       fmt::format(
           "the unit is wrong: the energy in the paper is that of 755.76 kg, within {:.2f} %.",
           percent(kinetic_loss(mass, speed, paper::pair::reference_restitution) / 1e3, paper::pair::reference_loss))},
      {"Section 5, rounding", "30003.67 and 9.976 may be taken as 30000 and 10", "no number",
       fmt::format("$c_{{imp}}$ changes from {:.2f} to {:.2f}, {:.2f} %", unrounded, c, percent(c, unrounded)),
       Judgement::agrees, "the rounding is harmless."},
      {"Eqs. 15, 16", "Eq. 16 calculates the energy dissipation", "confirmed for $CR = 0.7$ (Fig. 6)",
       fmt::format("$c_{{imp}}$ = {:.3f} kN s/m$^{{2.5}}$ dissipates {:.5f} kJ, Eq. 18 requires {:.5f} kJ ({:+.2f} %); "
                   "restitution {:.5f}",
                   c, example.at("Eq. 16, proposed", "energy lost"), loss,
                   example.at("Eq. 16, proposed", "error of energy"), example.at("Eq. 16, proposed", "restitution")),
       Judgement::disagrees,
       fmt::format("Eq. 13 is more accurate: {:.5f} kJ ({:+.2f} %).", example.at("Eq. 13, Ye 2008", "energy lost"),
                   example.at("Eq. 13, Ye 2008", "error of energy"))},
      {"Eq. 16, units", "$c_{imp}$ is a function of $k$, $CR$ and $v_{imp}$", "no units",
       fmt::format("the target 0.7 gives {:.4f} with $k$ in MN, {:.4f} in kN, {:.4f} in N", rows.at("0.7", "k in MN"),
                   rows.at("0.7", "k in kN"), rows.at("0.7", "k in N")),
       Judgement::disagrees,
       "$(k/v)^N$ is dimensionally consistent for $N = 1$ only. The program uses kN, m, s, as printed in the paper."},
      {"Eq. 17", "Impact force", "$\\delta^{1.5}(k + c_{imp}\\,\\delta)$",
       "$\\delta^{1.5}(k + c_{imp}\\,\\dot{\\delta})$", Judgement::disagrees,
       "the dot is missing, possibly only in the copy used here. As printed, the force would be conservative, $CR = "
       "1$."},
      {"Table 2", "$N$ and $M$ make the dissipated energy equal to the kinetic energy loss", "nine rows",
       fmt::format("error of the restitution {:+.1f} % at 0.1 ... {:+.1f} % at 0.8 for the paper's $k/v = 3000$",
                   rows.at("0.1", "error, k in kN"), rows.at("0.8", "error, k in kN")),
       Judgement::disagrees,
       fmt::format("no single $k/v$ makes the rows exact: they require from {:.2g} to {:.1g}. The best is {:.2f}, with "
                   "{:.1f} % RMS, where the law is nearly $(1-CR^2)/CR$ and Table 2 has no effect.",
                   minimum, maximum, best, rms_error(best))},
      {"Fig. 6", "Four formulas compared", "a figure without numbers", "recomputed above", Judgement::cannot_be_checked,
       "the figure is missing in the copy used here, and its motion is not stated."}};
  item.tables = {example, rows};
  return item;
}

}  // namespace pounding::reproduce::table2
