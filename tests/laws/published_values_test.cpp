/// Damping values and the restitution they give, against reference tables computed by an independent script (closed forms
/// confirmed by an 8th-order Runge-Kutta integration to 1e-11) and printed to four to six digits: hence the tolerances of
/// half a unit of the last digit printed.

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>

namespace pounding::laws {
namespace {

using Row = std::array<double, 9>;  // restitution 0.1 ... 0.9

constexpr double asked(std::size_t i) { return 0.1 * static_cast<double>(i + 1); }

struct FormulaRow {
  std::string_view law, formula;
  Row values;
};

// Table of exact damping (six digits).
const std::vector<FormulaRow> exact_damping{
    {"hertz_damped", "exact", {9.998159, 4.919167, 3.087082, 2.082498, 1.432751, 0.974872, 0.634828, 0.373146, 0.166482}},
    {"modified_kelvin", "exact", {9.998159, 4.919167, 3.087082, 2.082498, 1.432751, 0.974872, 0.634828, 0.373146, 0.166482}},
    {"kelvin_voigt", "exact", {0.591155, 0.455950, 0.357857, 0.279998, 0.215454, 0.160493, 0.112808, 0.070850, 0.033518}},
    {"kelvin_voigt", "anagnostopoulos",
     {0.591155, 0.455950, 0.357857, 0.279998, 0.215454, 0.160493, 0.112808, 0.070850, 0.033518}},
    {"kelvin_voigt_no_tension", "exact",
     {1.243188, 0.731247, 0.497239, 0.354508, 0.255276, 0.180858, 0.122215, 0.074355, 0.034265}},
    {"komodromos", "exact", {1.243188, 0.731247, 0.497239, 0.354508, 0.255276, 0.180858, 0.122215, 0.074355, 0.034265}},
    {"modified_linear_viscoelastic", "exact",
     {4.806942, 2.223955, 1.336027, 0.879039, 0.597342, 0.404744, 0.263878, 0.155848, 0.070035}},
    {"jankowski", "exact", {5.374324, 2.486457, 1.493724, 0.982795, 0.667849, 0.452518, 0.295025, 0.174243, 0.078302}}};

// Table of the values of the published formulas (five digits).
const std::vector<FormulaRow> published_damping{
    {"hertz_damped", "hunt_crossley", {1.35, 1.2, 1.05, 0.9, 0.75, 0.6, 0.45, 0.3, 0.15}},
    {"hertz_damped", "herbert_mcwhannell", {1.48352, 1.42857, 1.32911, 1.18421, 1, 0.78947, 0.56962, 0.35714, 0.16484}},
    {"hertz_damped", "lee_wang", {0.675, 0.6, 0.525, 0.45, 0.375, 0.3, 0.225, 0.15, 0.075}},
    {"hertz_damped", "lankarani_nikravesh", {0.7425, 0.72, 0.6825, 0.63, 0.5625, 0.48, 0.3825, 0.27, 0.1425}},
    {"hertz_damped", "gonthier", {9.9, 4.8, 3.03333, 2.1, 1.5, 1.06667, 0.72857, 0.45, 0.21111}},
    {"hertz_damped", "zhiying_qishao", {4.49186, 3.56618, 2.76767, 2.09167, 1.52903, 1.06826, 0.69696, 0.40279, 0.17405}},
    {"hertz_damped", "ye_2009", {14.4, 6.4, 3.73333, 2.4, 1.6, 1.06667, 0.68571, 0.4, 0.17778}},
    {"hertz_damped", "hu_guo", {13.5, 6, 3.5, 2.25, 1.5, 1, 0.64286, 0.375, 0.16667}},
    {"modified_kelvin", "ye_2009_linear", {13.5, 6, 3.5, 2.25, 1.5, 1, 0.64286, 0.375, 0.16667}},
    {"hertz_damped", "gharib_hurmuzlu", {10, 5, 3.33333, 2.5, 2, 1.66667, 1.42857, 1.25, 1.11111}},
    {"modified_linear_viscoelastic", "simple",
     {3.15127, 1.52789, 0.96554, 0.66845, 0.47746, 0.33953, 0.23191, 0.14324, 0.06720}},
    {"modified_linear_viscoelastic", "mahmoud_jankowski_2011",
     {4.68271, 2.15409, 1.29493, 0.85483, 0.58348, 0.39728, 0.26029, 0.15447, 0.06973}},
    {"modified_linear_viscoelastic", "naderpour_2015_eq38",
     {124.79021, 29.33544, 11.71522, 5.61499, 2.86479, 1.44866, 0.67586, 0.25783, 0.05675}},
    {"jankowski", "naderpour_2015_eq38",
     {124.79021, 29.33544, 11.71522, 5.61499, 2.86479, 1.44866, 0.67586, 0.25783, 0.05675}},
    {"jankowski", "jankowski_2005", {3.52322, 1.70823, 1.07951, 0.74735, 0.53382, 0.37961, 0.25928, 0.16015, 0.07513}},
    {"jankowski", "jankowski_2006", {5.78245, 2.61715, 1.55075, 1.01057, 0.68182, 0.45938, 0.29811, 0.17537, 0.07854}}};

// Table of the restitution really obtained (four digits).
const std::vector<FormulaRow> obtained_restitution{
    {"hertz_damped", "hunt_crossley", {0.5158, 0.5469, 0.5813, 0.6197, 0.6630, 0.7120, 0.7680, 0.8329, 0.9090}},
    {"hertz_damped", "herbert_mcwhannell", {0.4907, 0.5008, 0.5200, 0.5503, 0.5936, 0.6511, 0.7227, 0.8070, 0.9009}},
    {"hertz_damped", "lee_wang", {0.6867, 0.7120, 0.7390, 0.7680, 0.7992, 0.8329, 0.8693, 0.9090, 0.9524}},
    {"hertz_damped", "lankarani_nikravesh", {0.6653, 0.6723, 0.6842, 0.7016, 0.7252, 0.7561, 0.7960, 0.8471, 0.9132}},
    {"hertz_damped", "gonthier", {0.1010, 0.2046, 0.3042, 0.3978, 0.4877, 0.5773, 0.6696, 0.7680, 0.8764}},
    {"hertz_damped", "zhiying_qishao", {0.2175, 0.2664, 0.3267, 0.3988, 0.4826, 0.5769, 0.6796, 0.7874, 0.8959}},
    {"hertz_damped", "ye_2009", {0.0694, 0.1555, 0.2562, 0.3629, 0.4704, 0.5773, 0.6832, 0.7885, 0.8939}},
    {"hertz_damped", "hu_guo", {0.0741, 0.1656, 0.2707, 0.3796, 0.4877, 0.5936, 0.6973, 0.7992, 0.8999}},
    {"modified_kelvin", "ye_2009_linear", {0.0741, 0.1656, 0.2707, 0.3796, 0.4877, 0.5936, 0.6973, 0.7992, 0.8999}},
    {"hertz_damped", "gharib_hurmuzlu", {0.1000, 0.1970, 0.2819, 0.3524, 0.4107, 0.4595, 0.5008, 0.5362, 0.5668}},
    {"modified_linear_viscoelastic", "simple",
     {0.1475, 0.2711, 0.3765, 0.4706, 0.5582, 0.6428, 0.7271, 0.8134, 0.9037}},
    {"modified_linear_viscoelastic", "mahmoud_jankowski_2011",
     {0.1025, 0.2055, 0.3070, 0.4071, 0.5061, 0.6046, 0.7030, 0.8014, 0.9004}},
    {"modified_linear_viscoelastic", "naderpour_2015_eq38",
     {0.0040, 0.0170, 0.0423, 0.0863, 0.1606, 0.2823, 0.4677, 0.7050, 0.9175}},
    {"jankowski", "jankowski_2005", {0.1475, 0.2711, 0.3765, 0.4706, 0.5582, 0.6428, 0.7271, 0.8134, 0.9037}},
    {"jankowski", "jankowski_2006", {0.0933, 0.1915, 0.2917, 0.3930, 0.4946, 0.5962, 0.6977, 0.7989, 0.8997}},
    {"kelvin_voigt", "anagnostopoulos", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}},
    {"kelvin_voigt_no_tension", "anagnostopoulos",
     {0.2527, 0.3249, 0.3971, 0.4720, 0.5503, 0.6323, 0.7182, 0.8081, 0.9020}},
    {"komodromos", "anagnostopoulos", {0.2527, 0.3249, 0.3971, 0.4720, 0.5503, 0.6323, 0.7182, 0.8081, 0.9020}},
    {"viscous_hertz", "antypov_elliott", {0.2527, 0.3249, 0.3971, 0.4720, 0.5503, 0.6323, 0.7182, 0.8081, 0.9020}}};

AnyLaw law_with(std::string_view law, std::string_view formula, double restitution) {
  Settings s = typical_settings(find_law(law));
  s.formula = formula;
  s.restitution = restitution;
  return make_law(s);
}

double damping_number(const AnyLaw& law) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (has_damping<std::decay_t<decltype(chosen)>>) return chosen.damping_number(1);
        return 0.0;
      },
      law);
}

TEST(PublishedValues, ExactDampingAgreesWithTheReference) {
  for (const FormulaRow& row : exact_damping)
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(damping_number(law_with(row.law, row.formula, asked(i))), row.values[i], 0.51e-6) << row.law << asked(i);
}

TEST(PublishedValues, EveryPublishedFormulaGivesItsValues) {
  for (const FormulaRow& row : published_damping)
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(damping_number(law_with(row.law, row.formula, asked(i))), row.values[i], 0.51e-5)
          << row.law << ' ' << row.formula << ' ' << asked(i);
}

TEST(PublishedValues, ObtainedRestitutionIsThatOfTheReference) {
  for (const FormulaRow& row : obtained_restitution)
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(free_impact(law_with(row.law, row.formula, asked(i)), typical_reduced_mass, 0.7).restitution, row.values[i],
                  0.51e-4)
          << row.law << ' ' << row.formula << ' ' << asked(i);
}

// Error in percent of the asked restitution, the quantity of Table 3 of Naderpour, Barros & Khatami 2015 (two digits).
TEST(PublishedValues, ErrorInPercentIsThatOfTheReference) {
  const std::vector<FormulaRow> percent{
      {"hertz_damped", "lankarani_nikravesh", {565.27, 236.13, 128.07, 75.41, 45.05, 26.02, 13.71, 5.89, 1.46}},
      {"hertz_damped", "ye_2009", {-30.56, -22.23, -14.60, -9.28, -5.91, -3.79, -2.40, -1.43, -0.68}},
      {"hertz_damped", "hu_guo", {-25.93, -17.20, -9.78, -5.09, -2.45, -1.06, -0.39, -0.10, -0.01}},
      {"jankowski", "jankowski_2006", {-6.68, -4.26, -2.75, -1.76, -1.08, -0.63, -0.32, -0.13, -0.03}},
      {"kelvin_voigt_no_tension", "anagnostopoulos", {152.73, 62.43, 32.38, 18.00, 10.06, 5.38, 2.60, 1.01, 0.23}}};
  for (const FormulaRow& row : percent)
    for (std::size_t i = 0; i < 9; ++i) {
      const double e = free_impact(law_with(row.law, row.formula, asked(i)), typical_reduced_mass, 0.7).restitution;
      EXPECT_NEAR(100 * (e / asked(i) - 1), row.values[i], 0.0051) << row.formula << ' ' << asked(i);
    }
}

// k/v in kN, m, s: 22000/15 and 30000/10 are the paper's own examples; the SI stiffness is a thousand times larger.
TEST(PublishedValues, NaderpourFormulaUsesKilonewtons) {
  const Row a_22000_15{14.48809, 6.44292, 3.80263, 2.45296, 1.61566, 1.03281, 0.61106, 0.30978, 0.11162};
  const Row e_22000_15{0.0690, 0.1545, 0.2522, 0.3572, 0.4678, 0.5855, 0.7081, 0.8283, 0.9307};
  const Row a_30000_10{15.03136, 6.63001, 3.88771, 2.49188, 1.62901, 1.03082, 0.60130, 0.29892, 0.10491};
  const Row a_22_15{10.15527, 4.88745, 3.07132, 2.10712, 1.49228, 1.05226, 0.71382, 0.43709, 0.20317};
  const auto law = [](double k, double e) { return HertzDamped{.stiffness = k, .restitution = e, .formula = naderpour_2015}; };
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(law(2.2e7, asked(i)).damping_number(15), a_22000_15[i], 0.51e-5);
    EXPECT_NEAR(free_impact(law(2.2e7, asked(i)), 6e4, 15).restitution, e_22000_15[i], 0.51e-4);
    EXPECT_NEAR(law(3e7, asked(i)).damping_number(10), a_30000_10[i], 0.51e-5);
    EXPECT_NEAR(law(2.2e4, asked(i)).damping_number(15), a_22_15[i], 0.51e-5);
  }
  // Between two rows of its Table 2 both exponents are straight lines.
  const double e = 0.65, N = 0.5 * (0.9973 + 0.9775), M = 0.5 * (0.9754 + 0.9668);
  EXPECT_NEAR(law(3e7, e).damping_number(10), std::pow(3000, N - 1) * (1 - e * e) / std::pow(e, M), 1e-13);
}

TEST(PublishedValues, NaderpourFormulaIsRefusedOutsideItsTable) {
  for (const double e : {0.099, 0.901, 1.0}) {
    const HertzDamped law{.stiffness = 3e7, .restitution = e, .formula = naderpour_2015};
    EXPECT_THROW(law.check(), std::invalid_argument) << e;
  }
}

// Design parameters of the bilinear law for k = d_m = 1, n = 1.5, a_y = 0.1 (six digits), and the restitution when d_m is
// reached exactly: sqrt(1 - dE/energy under the loading curve).
TEST(PublishedValues, BilinearCurveAgreesWithTheReference) {
  struct Design {
    double e, loss, k1, k2, energy, obtained;
  };
  for (const Design& d : {Design{0.4, 0.336, 4.36, 0.626667, 0.668, 0.704987}, Design{0.5, 0.3, 4, 0.666667, 0.65, 0.733799},
                          Design{0.6, 0.256, 3.56, 0.715556, 0.628, 0.769647}, Design{0.7, 0.204, 3.04, 0.773333, 0.602, 0.813099},
                          Design{0.8, 0.144, 2.44, 0.84, 0.572, 0.865015}, Design{0.9, 0.076, 1.76, 0.915556, 0.538, 0.926680}}) {
    // A unit Hertz spring reaches d_m = 1 from v = 1 with m = 0.8.
    const BilinearHertz law{.stiffness = 1, .restitution = d.e, .impact_velocity = 1, .reduced_mass = 0.8,
                            .formula = muthukumar_desroches};
    const auto curve = law.curve(touch(law, 1));
    EXPECT_NEAR(law.damping_number(1) / 2.5, d.loss, 1e-12);
    EXPECT_NEAR(curve.k1, d.k1, 0.51e-6);
    EXPECT_NEAR(curve.k2, d.k2, 0.51e-6);
    EXPECT_NEAR(curve.yield, 0.1, 1e-12);
    const double reaching_dm = std::sqrt(2 * d.energy / law.reduced_mass);
    const FreeImpact r = free_impact(law, law.reduced_mass, reaching_dm);
    EXPECT_NEAR(r.peak_penetration, 1, 1e-5);
    EXPECT_NEAR(r.energy_lost, d.loss, 1e-5);
    EXPECT_NEAR(r.restitution, d.obtained, 1e-6);
  }
}

}  // namespace
}  // namespace pounding::laws
