/// Section 5.1: hysteresis loops, energy loss and the error of the calculated restitution for 0.1 ... 0.9.

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "reproduce/impacts.hpp"
#include "reproduce/items.hpp"
#include "reproduce/paper.hpp"

namespace pounding::reproduce::section5 {
namespace {

using namespace paper::accuracy;

struct Named {
  const char *name, *law, *formula;
};

/// The laws compared in the paper, and the published law that almost equals the proposed one.
constexpr Named compared[] = {{"Eq. 12, Lankarani", "hertz_damped", "lankarani_nikravesh"},
                              {"Eq. 13, Ye 2008", "hertz_damped", "hu_guo"},
                              {"Eq. 14, Ye 2009", "hertz_damped", "ye_2009"},
                              {"Eq. 16, proposed", "hertz_damped", "naderpour_2015"},
                              {"Gonthier 2004: a = (1-CR^2)/CR", "hertz_damped", "gonthier"},
                              {"exact", "hertz_damped", "exact"}};
constexpr Named others[] = {{"Hunt & Crossley 1975", "hertz_damped", "hunt_crossley"},
                            {"Herbert & McWhannell 1977", "hertz_damped", "herbert_mcwhannell"},
                            {"Lee & Wang 1983", "hertz_damped", "lee_wang"},
                            {"Zhiying & Qishao 2006", "hertz_damped", "zhiying_qishao"},
                            {"Gharib & Hurmuzlu 2012", "hertz_damped", "gharib_hurmuzlu"},
                            {"Eq. 7, Kelvin-Voigt", "kelvin_voigt", "anagnostopoulos"},
                            {"Eq. 7, Kelvin-Voigt without tension", "kelvin_voigt_no_tension", "anagnostopoulos"},
                            {"Eq. 10, Jankowski 2005", "jankowski", "jankowski_2005"},
                            {"Jankowski 2006", "jankowski", "jankowski_2006"},
                            {"Jankowski's law, exact", "jankowski", "exact"},
                            {"Table 4, Mahmoud", "modified_linear_viscoelastic", "simple"},
                            {"Mahmoud & Jankowski 2011", "modified_linear_viscoelastic", "mahmoud_jankowski_2011"},
                            {"Eq. 38, linear spring", "modified_linear_viscoelastic", "naderpour_2015_eq38"}};

Asking asking(const Named& f, double e) { return {f.law, f.formula, stiffness, e}; }
double obtained(const Named& f, double e) { return asking(f, e).free_impact(mass, speed).restitution; }

Table error_table() {
  Table table{"errors", "Error of the calculated restitution, as in Table 3", "formula \\ target CR", {}, {}};
  for (const double e : paper::restitutions) table.headings.push_back({fmt::format("{:.1f}", e), "%", 2});
  const auto add = [&](const Named& f) {
    Table::Row row{f.name, {}};
    for (const double e : paper::restitutions) row.values.push_back(percent(obtained(f, e), e));
    table.rows.push_back(row);
  };
  for (const Named& f : compared) add(f);
  for (const Named& f : others) add(f);
  return table;
}

Figure error_figure() {
  Figure figure{.name = "section5_errors",
                .of_paper = "Fig. 8",
                .caption = fmt::format("Obtained versus target restitution of a free impact. Right: the errors without "
                                       "Eq. 12, whose error at 0.1 is {:+.0f} %.",
                                       percent(obtained(compared[0], 0.1), 0.1)),
                .panels = {{"obtained", "Target restitution [-]", "Obtained restitution [-]", {}},
                           {"error", "Target restitution [-]", "Error of the restitution [%]", {}}}};
  std::vector<double> e;
  for (int i = 10; i <= 90; ++i) e.push_back(i / 100.0);
  figure.add("CR asked", "", e);
  for (const Named& f : compared) {
    std::vector<double> value, error;
    for (const double requested : e) {
      value.push_back(obtained(f, requested));
      error.push_back(percent(value.back(), requested));
    }
    const Curve::Kind kind = std::string_view(f.formula) == "exact" ? Curve::Kind::dashed : Curve::Kind::line;
    const std::string name = f.name;
    figure.panels[0].curves.push_back({name, "CR asked", figure.add(name + ", obtained", "", value), kind});
    figure.add(name + ", error", "%", error);
    if (std::string_view(f.formula) != "lankarani_nikravesh")
      figure.panels[1].curves.push_back({name, "CR asked", name + ", error", kind});
  }
  return figure;
}

}  // namespace

Item make() {
  Item item{.name = "section5",
            .title = "The accuracy of the proposed law",
            .sections = "Section 5.1, Eq. 18, Table 3, Figs. 7 and 8",
            .equations = {{"18, with its dot",
                           R"($\Delta E = \dfrac{1}{2}\,\dfrac{m_1 m_2}{m_1+m_2}\,(1-CR^2)\,\dot{\delta}_{imp}^2$)"}}};
  const laws::FreeImpact elastic = Asking{"hertz", "", stiffness}.free_impact(mass, speed);
  item.paragraphs = {
      fmt::format("Bodies of 100 t and 150 t, $k$ = 22000 kN/m$^{{1.5}}$, $v$ = 15 m/s. Floors that collide in "
                  "earthquakes close at 0.1 to 2 m/s, and concrete has about 2.75 million kN/m$^{{1.5}}$: without "
                  "damping the penetration here would be {:.3f} m and the force {:.1f} kN. The restitution does not "
                  "depend on these values, so the comparison is valid.",
                  elastic.peak_penetration, elastic.peak_force / 1e3),
      "Each loop below is a time integration with the proposed law; its area is compared with Eq. 18, and its "
      "restitution with the target. The paper evaluates its loops for \"a reference lateral displacement\" with its "
      "derivative as velocity, but does not state that displacement; a free impact needs no such assumption."};

  Figure loops{.name = "section5_loops",
               .of_paper = "Fig. 7",
               .caption =
                   "Loops of the proposed law (left) and of the same law with the exact calibration (right) for target "
                   "restitutions of 0.1 to 0.9."};
  Figure energy{.name = "section5_energy",
                .of_paper = "Fig. 8",
                .caption =
                    "Energy of the loops compared with Eq. 18 (left), and its error (right). Near 1, where little "
                    "energy is lost, a small error of the restitution causes a large error of the energy.",
                .panels = {{"loop area", "Target restitution [-]", "Energy lost [kJ]", {}},
                           {"error from Eq. 18", "Target restitution [-]", "Error of the energy lost [%]", {}}}};
  Table runs{"runs",
             "Loops by time integration, 60 t at 15 m/s",
             "target CR, formula",
             {{"damping", "", 5},
              {"restitution", "", 5},
              {"penetration", "m", 6},
              {"peak force", "kN", 2},
              {"contact time", "s", 6},
              {"energy lost", "kJ", 3},
              {"Eq. 18", "kJ", 3},
              {"impulse", "kN s", 3}},
             {}};
  const auto run_row = [&](const Named& f, double e) {
    const Loop loop = collide(asking(f, e).settings(), mass, speed);
    const ImpactRow& r = loop.impact;
    runs.rows.push_back(
        {fmt::format("{:.1f}, {}", e, f.name),
         {damping_number(asking(f, e).made(mass), speed), r.restitution, r.peak_penetration, r.peak_force / 1e3,
          r.t_release - r.t_start, r.energy_lost / 1e3, kinetic_loss(mass, speed, e) / 1e3, r.impulse / 1e3}});
    return loop;
  };
  const std::vector<double> requested(paper::restitutions.begin(), paper::restitutions.end());
  std::vector<double> wanted;
  double worst_balance = 0;
  for (const double e : requested) wanted.push_back(kinetic_loss(mass, speed, e) / 1e3);
  energy.add("CR asked", "", requested);
  energy.panels[0].curves.push_back({"Eq. 18", "CR asked", energy.add("Eq. 18", "kJ", wanted), Curve::Kind::dashed});
  for (const Named& f : compared) {
    const bool drawn = std::string_view(f.formula) == "naderpour_2015" || std::string_view(f.formula) == "exact";
    if (drawn) loops.panels.push_back({f.name, "Penetration [m]", "Contact force [MN]", {}});
    std::vector<double> lost, miss;
    for (const double e : requested) {
      const Loop loop = run_row(f, e);
      lost.push_back(loop.impact.energy_lost / 1e3);
      miss.push_back(percent(loop.impact.energy_lost, kinetic_loss(mass, speed, e)));
      const double by_velocities = kinetic_loss(mass, speed, loop.impact.restitution);
      worst_balance = std::max(worst_balance, std::abs(loop.impact.energy_lost / by_velocities - 1));
      if (drawn) loops.plot(fmt::format("CR = {:.1f}", e), loop.penetration, scaled(loop.force, 1e-6));
    }
    const std::string name = f.name;
    energy.panels[0].curves.push_back({name, "CR asked", energy.add(name + ", energy", "kJ", lost), Curve::Kind::line});
    energy.panels[1].curves.push_back({name, "CR asked", energy.add(name + ", error", "%", miss), Curve::Kind::line});
  }
  for (const double e : {0.3, 0.5, 0.7, 0.9})
    for (const Named& f : {Named{"Eq. 10, Jankowski 2005", "jankowski", "jankowski_2005"},
                           {"Jankowski's law, exact", "jankowski", "exact"}})
      run_row(f, e);
  const Table errors = error_table();

  int worse_than_13 = 0, worse_than_14 = 0;
  for (const Table::Heading& h : errors.headings) {
    const double ours = std::abs(errors.at("Eq. 16, proposed", h.name));
    worse_than_13 += ours > std::abs(errors.at("Eq. 13, Ye 2008", h.name));
    worse_than_14 += ours > std::abs(errors.at("Eq. 14, Ye 2009", h.name));
  }
  const double k_over_v = stiffness / 1e3 / speed;
  const auto share = [&](double e) { return proposed_factor(e, k_over_v) / (1 - e * e); };
  item.verdicts = {
      {"Eq. 18", "The kinetic energy loss is the dissipated energy", "$(\\delta_{imp})^2$",
       fmt::format(
           "with $\\dot{{\\delta}}_{{imp}}^2$ and the obtained restitution, loop areas agree within {:.0e} in {} runs",
           worst_balance, 9 * std::size(compared)),
       Judgement::agrees, "for any law; the dot is missing in print."},
      {"Table 3", "Error of the calculated restitution", "numbers missing in the copy used here",
       "the table of errors below", Judgement::cannot_be_checked, "the printed numbers are missing."},
      {"Section 5.1, Fig. 8", "Good accuracy of the proposed law in comparison with other formulas", "good",
       fmt::format("errors from {:+.2f} % at 0.1 to {:+.2f} % at 0.8; larger than those of Eq. 13 at {} of 9 "
                   "restitutions, and than those of Eq. 14 at {} of 9",
                   errors.at("Eq. 16, proposed", "0.1"), errors.at("Eq. 16, proposed", "0.8"), worse_than_13,
                   worse_than_14),
       Judgement::disagrees,
       "probably because Table 2 was derived from an imposed motion, not from a collision; see the next row."},
      {"Section 5.1, reference displacement", "Loops on a reference lateral displacement and its derivative",
       "not stated",
       fmt::format("for any imposed motion the loop area is proportional to $c_{{imp}}$; its ratio to Eq. 18 would "
                   "increase {:.0f}-fold from 0.9 to 0.1",
                   share(0.1) / share(0.9)),
       Judgement::cannot_be_checked,
       "a motion for which all rows of Table 2 are correct must depend on $CR$; the paper does not give it."},
      {"Fig. 7", "Loops for nine restitutions", "a figure without numbers", "recomputed below",
       Judgement::cannot_be_checked, "the figure is missing in the copy used here."}};
  item.figures = {loops, error_figure(), energy};
  item.tables = {errors, runs};
  return item;
}

}  // namespace pounding::reproduce::section5
