/// Section 4: all force laws at the same impact, Eqs. 3-14 and Table 1.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"

namespace pounding::reproduce::force_laws {
namespace {

constexpr double mass = 60e3, speed = 0.5, requested = 0.5;

struct Case {
  std::string name;  ///< of its row and curve
  Asking law;
  bool linear = true;  ///< spring
};

/// The laws as printed in the paper.
const std::vector<Case>& published() {
  static const std::vector<Case> cases{
      {"linear spring, Eq. 3", {"linear_spring", "", 9.35e7, requested}},
      {"Kelvin-Voigt, Eqs. 5-7", {"kelvin_voigt", "anagnostopoulos", 9.35e7, requested}},
      {"Kelvin-Voigt without tension, Eqs. 5-7", {"kelvin_voigt_no_tension", "anagnostopoulos", 9.35e7, requested}},
      {"modified Kelvin, Eq. 13", {"modified_kelvin", "ye_2009_linear", 9.35e7, requested}},
      {"Jankowski, Eqs. 8-10", {"jankowski", "jankowski_2005", 2.75e9, requested}, false},
      {"Hertz damped, Eqs. 11, 12", {"hertz_damped", "lankarani_nikravesh", 2.75e9, requested}, false},
      {"Hertz damped, Eqs. 11, 13", {"hertz_damped", "hu_guo", 2.75e9, requested}, false},
      {"Hertz damped, Eqs. 11, 14", {"hertz_damped", "ye_2009", 2.75e9, requested}, false}};
  return cases;
}

/// Every law of the catalogue with its exact calibration.
std::vector<Case> exact() {
  std::vector<Case> cases;
  for (const laws::Entry& entry : laws::catalogue()) {
    const auto k = std::ranges::find(entry.parameters, "stiffness", &laws::ParameterInfo::name);
    cases.push_back({std::string(entry.name),
                     {std::string(entry.name), entry.formulas.empty() ? "" : "exact", 0, requested},
                     k != entry.parameters.end() && k->unit == "N/m"});
  }
  return cases;
}

Table table_of(const char* name, const char* title) {
  return {name,
          title,
          "law",
          {{"restitution", "", 4},
           {"error", "%", 2},
           {"energy lost", "kJ", 4},
           {"peak force", "kN", 1},
           {"force at touch", "kN", 1},
           {"largest pull", "kN", 1},
           {"penetration", "mm", 3},
           {"duration", "ms", 3}},
          {}};
}

void run_cases(const std::vector<Case>& cases, Table& table, Figure& figure) {
  const std::string x = "Penetration [mm]", y = "Contact force [kN]";
  figure.panels = {{"linear springs", x, y, {}}, {"Hertz springs", x, y, {}}};
  for (const Case& c : cases) {
    const Loop loop = collide(c.law.settings(), mass, speed);
    const ImpactRow& row = loop.impact;
    const bool lossless = laws::find_law(c.law.law).number.name.empty() && !laws::find_law(c.law.law).takes_restitution;
    double at_touch = not_a_number, pull = not_a_number;
    if (!laws::find_law(c.law.law).instantaneous) {
      at_touch = std::visit([](const auto& law) { return law.contact(0, speed, laws::touch(law, speed)).force; },
                            c.law.made(mass));
      const double minimum = *std::ranges::min_element(loop.force);
      pull = minimum < -1e-9 * row.peak_force ? -minimum : 0;
      Panel& panel = figure.panels[c.linear ? 0 : 1];
      panel.curves.push_back({c.name, figure.add(c.name + ", penetration", "mm", scaled(loop.penetration, 1e3)),
                              figure.add(c.name + ", force", "kN", scaled(loop.force, 1e-3)), Curve::Kind::line});
    }
    table.rows.push_back({c.name,
                          {row.restitution, lossless ? not_a_number : percent(row.restitution, requested),
                           row.energy_lost / 1e3, row.peak_force / 1e3, at_touch / 1e3, pull / 1e3,
                           1e3 * row.peak_penetration, 1e3 * (row.t_release - row.t_start)}});
  }
}

Verdict obtained(const Table& table, const char* place, const char* row, const char* claim, const char* printed,
                 const char* reason) {
  const double e = table.at(row, "restitution");
  const bool right = std::abs(e - requested) < 1e-4;
  return {place,
          claim,
          printed,
          fmt::format("target {:.4f}, obtained {:.4f} ({:+.2f} %)", requested, e, percent(e, requested)),
          right ? Judgement::agrees : Judgement::disagrees,
          reason};
}

}  // namespace

Item make() {
  Item item{.name = "laws",
            .title = "Every force law at the same impact",
            .sections = "Section 4, Eqs. 3-14, Table 1, Figs. 4 and 5"};
  item.paragraphs = {
      fmt::format("A reduced mass of 60 t (bodies of 100 t and 150 t) closes at {} m/s; the target restitution is {} "
                  "for every law. Linear springs have $k_k = 93.5$ MN/m, Hertz springs $k_h = 2750$ MN/m$^{{1.5}}$. "
                  "The advantages and disadvantages in Table 1 are quantified here: tension at the end, force at first "
                  "contact, energy lost, and obtained restitution.",
                  speed, requested),
      "The paper uses $\\zeta$ with two meanings: a dimensionless ratio in Eqs. 6, 7, 10 and 38, and a coefficient "
      "with the unit N s/m$^{n+1}$ in Eqs. 12-14, used as $c = \\zeta\\,\\delta^n$ in Eq. 11. Table 1 writes $k_h$ for "
      "the spring of the Kelvin-Voigt model; it should be the linear $k_k$."};
  item.equations = {
      {"3", R"($F_c = k_k\,\delta$)"},
      {"4, corrected", R"($0 < CR = v_{after}/v_{before} < 1$)"},
      {"5", R"($F_c = k_k\,\delta + c\,\dot{\delta}$)"},
      {"6, 7", R"($c = 2\zeta\sqrt{k_k\,m},\quad \zeta = -\ln CR\,/\sqrt{\pi^2 + (\ln CR)^2}$)"},
      {"8-10",
       R"($F_c = k_h\,\delta^{1.5} + c_h\,\dot{\delta}\ \ (\dot{\delta}>0),\quad c_h = 2\zeta\sqrt{k_h\sqrt{\delta}\,m},\quad \zeta = \dfrac{\sqrt{5}}{2\pi}\,\dfrac{1-CR^2}{CR}$)"},
      {"11", R"($F_c = k_h\,\delta^n + \zeta\,\delta^n\,\dot{\delta}$)"},
      {"12", R"($\zeta = \dfrac{3\,k_h\,(1-CR^2)}{4\,v_{imp}}$)"},
      {"13", R"($\zeta = \dfrac{3\,k_k\,(1-CR)}{2\,CR\,v_{imp}}$)"},
      {"14", R"($\zeta = \dfrac{8\,k_h\,(1-CR)}{5\,CR\,v_{imp}}$)"}};

  Table published_table = table_of("published", "The laws of the paper with its formulas, target restitution 0.5");
  Figure published_loops{
      .name = "laws_published",
      .of_paper = "Table 1",
      .caption =
          "Loops of the paper's laws at the same impact, each with its published damping formula. The area of a loop "
          "is the energy lost; it should be the same for all laws except the linear spring."};
  run_cases(published(), published_table, published_loops);
  Table exact_table = table_of("exact", "Every law of the program, calibrated exactly, target restitution 0.5");
  Figure exact_loops{.name = "laws_exact",
                     .of_paper = "",
                     .caption =
                         "One impact for every law of the program with its exact calibration: loops of equal area but "
                         "very different shape, except for the two elastic springs. The curve of komodromos hides that "
                         "of kelvin_voigt_no_tension: they differ in the residual gap only."};
  run_cases(exact(), exact_table, exact_loops);

  const Table& t = published_table;
  const double xi = laws::jankowski_2005({.restitution = requested});
  const double pull = t.at("Kelvin-Voigt, Eqs. 5-7", "largest pull"),
               push = t.at("Kelvin-Voigt, Eqs. 5-7", "peak force");
  const double free_loss = kinetic_loss(mass, speed, requested) / 1e3;
  double worst = 0;
  for (const Table::Row& row : exact_table.rows)
    if (std::isfinite(row.values[1])) worst = std::max(worst, std::abs(row.values[1]));
  item.verdicts = {
      {"Eq. 3, Table 1", "A linear spring cannot model dissipated energy", "none",
       fmt::format("{:.1e} kJ lost, restitution {:.6f}", std::abs(t.at("linear spring, Eq. 3", "energy lost")),
                   t.at("linear spring, Eq. 3", "restitution")),
       Judgement::agrees, "within the tolerance of the time integration."},
      {"Eq. 4", "$CR$ is the velocity before over the velocity after the impact", "$v_{before}/v_{after} < 1$",
       "$v_{after}/v_{before}$", Judgement::disagrees,
       "inverted in print: the ratio would exceed 1 for every impact that loses energy. Eqs. 18 and 28 use it "
       "correctly."},
      {"Eq. 5", "Kelvin-Voigt force", "$k_k\\,\\delta + c\\,\\delta$", "$k_k\\,\\delta + c\\,\\dot{\\delta}$",
       Judgement::disagrees,
       "a dot is missing, possibly only in the copy used here; Table 1 has it. Without it the model would dissipate no "
       "energy."},
      obtained(t, "Eqs. 6, 7", "Kelvin-Voigt, Eqs. 5-7", "The damping ratio follows from $CR$", "exact",
               "to the digits shown, provided that the bodies stay in contact until $\\delta = 0$, with tension at the "
               "end. Reference [2] dates from 1988, not 1998."),
      {"Eqs. 5-7, Table 1", "The viscous element stays active while the bodies separate", "a disadvantage",
       fmt::format("tension of {:.0f} kN, {:.0f} % of the peak force; and a jump to {:.0f} kN at the touch", pull,
                   100 * pull / push, t.at("Kelvin-Voigt, Eqs. 5-7", "force at touch")),
       Judgement::agrees,
       fmt::format("Without the tension the calibration no longer holds: {:.4f} is obtained.",
                   t.at("Kelvin-Voigt without tension, Eqs. 5-7", "restitution"))},
      {"Eq. 8", "Nonlinear viscoelastic force", "$k_h\\,\\delta + c_h\\,\\dot{\\delta}$ in both phases",
       fmt::format("$k_h\\,\\delta^{{1.5}}$, dashpot in the approach phase only. With the exponent, but the dashpot in "
                   "both phases, the target {} gives {:.4f}",
                   requested, laws::restitution_to_zero_penetration(2 * xi / std::sqrt(5.0))),
       Judgement::disagrees,
       "compared with Jankowski 2005, exponent and switch are missing; the formula for $\\zeta$ assumes both."},
      {"Eq. 9", "Nested root in $c_h$", "$2\\zeta\\sqrt{k_h\\sqrt{\\delta}\\,m}$", "identical", Judgement::agrees,
       "with Jankowski 2005 and the OpenSees documentation."},
      obtained(
          t, "Eq. 10", "Jankowski, Eqs. 8-10", "Damping ratio of the nonlinear viscoelastic model", "from $CR$",
          fmt::format(
              "this is Jankowski's first, approximate formula; that of 2006, not cited in the paper, gives {:.4f}.",
              Asking{"jankowski", "jankowski_2006", 2.75e9, requested}.free_impact(mass, speed).restitution)
              .c_str()),
      obtained(t, "Eq. 12", "Hertz damped, Eqs. 11, 12", "Damping of the Hertz model (Lankarani)", "from $CR$",
               "derived for restitutions near 1. The source is Lankarani & Nikravesh 1990; reference [17] is "
               "Muthukumar & DesRoches 2006."),
      obtained(t, "Eq. 13", "Hertz damped, Eqs. 11, 13", "Damping by Ye 2008", "from $CR$",
               "accurate to second order near 1. It belongs to the linear spring of reference [18], but the "
               "restitution does not depend on the exponent; references [16] and [18] are interchanged."),
      obtained(t, "Eq. 14", "Hertz damped, Eqs. 11, 14", "Ye 2009 is more accurate than Eq. 13", "from $CR$",
               fmt::format("Eq. 13 gives {:.4f} and is more accurate at every $CR$.",
                           t.at("Hertz damped, Eqs. 11, 13", "restitution"))
                   .c_str()),
      {"Table 1", "The constant of the dashpot determines the energy dissipated", "an advantage",
       fmt::format("every law can be calibrated: largest error {:.0e} % over the catalogue, {:.4f} kJ lost by all",
                   worst, free_loss),
       Judgement::agrees, "with the exact calibration, not with the formulas above."}};
  item.tables = {published_table, exact_table};
  item.figures = {published_loops, exact_loops};
  return item;
}

}  // namespace pounding::reproduce::force_laws
