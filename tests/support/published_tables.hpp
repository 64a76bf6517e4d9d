#pragma once
/// Reference tables for the laws (tests/laws) and the time integration (tests/verification).
///
/// Source: an independent script, 8th-order Runge-Kutta (DOP853, rtol 1e-12) confirmed by closed forms to 1e-11, for
/// the formulas and examples of Naderpour, Barros & Khatami 2015 ("the paper") and the laws it builds on. All printed
/// digits are given here; a value is accurate to half a unit of its last digit.

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <pounding/laws/damping_formulas.hpp>

namespace pounding::reference {

/// Half a unit of the last of this number of decimals, plus a trace for values that end in a five.
inline double half_unit(int decimals) { return 0.5000001 * std::pow(10.0, -decimals); }

using Nine = std::array<double, 9>;  ///< asked restitution 0.1, 0.2 ... 0.9

constexpr double requested(std::size_t i) { return static_cast<double>(i + 1) / 10; }

/// Settings of this program for a row.
struct Asking {
  std::string_view law, formula{};
  double stiffness = 0;                  ///< [N/m^n]; 0: the law's typical value, if it does not matter
  double speed = 0.8;                    ///< closing speed [m/s]
  laws::DampingFormula ratio = nullptr;  ///< gives the damping_ratio if the law does not offer the formula
};

/// A published formula and its actual result.
struct FormulaRow {
  std::string_view name;
  std::vector<Asking> askings;  ///< all of them give this row
  Nine obtained;                ///< restitution of a free impact, four decimals
  Nine percent;                 ///< 100 (obtained - target)/target, two decimals: the quantity of the paper's Table 3
  std::optional<Nine> damping;  ///< a, zeta or xi, five decimals
};

/// The formula of the paper's Eq. 16 uses k/v in the printed unit of k; the program uses kN, so another unit of k is
/// another stiffness: 22 (MN) is given as 22 kN/m^1.5, 2.2e7 (N) as 2.2e7 kN/m^1.5.
inline const std::vector<FormulaRow> formulas{
    {"Hunt-Crossley 1975: 3(1-e)/2",
     {{"hertz_damped", "hunt_crossley"}},
     {0.5158, 0.5469, 0.5813, 0.6197, 0.6630, 0.7120, 0.7680, 0.8329, 0.9090},
     {415.83, 173.43, 93.76, 54.93, 32.59, 18.66, 9.71, 4.11, 1.00},
     Nine{1.35000, 1.20000, 1.05000, 0.90000, 0.75000, 0.60000, 0.45000, 0.30000, 0.15000}},
    {"Herbert-McWhannell 1977: 6(1-e)/[(2e-1)^2+3]",
     {{"hertz_damped", "herbert_mcwhannell"}},
     {0.4907, 0.5008, 0.5200, 0.5503, 0.5936, 0.6511, 0.7227, 0.8070, 0.9009},
     {390.70, 150.39, 73.32, 37.58, 18.72, 8.51, 3.24, 0.87, 0.10},
     Nine{1.48352, 1.42857, 1.32911, 1.18421, 1.00000, 0.78947, 0.56962, 0.35714, 0.16484}},
    {"Lee-Wang 1983: 3(1-e)/4",
     {{"hertz_damped", "lee_wang"}},
     {0.6867, 0.7120, 0.7390, 0.7680, 0.7992, 0.8329, 0.8693, 0.9090, 0.9524},
     {586.66, 255.98, 146.33, 92.00, 59.84, 38.81, 24.19, 13.63, 5.82},
     Nine{0.67500, 0.60000, 0.52500, 0.45000, 0.37500, 0.30000, 0.22500, 0.15000, 0.07500}},
    {"Lankarani-Nikravesh 1990 = Muthukumar-DesRoches: 3(1-e^2)/4 [paper Eq. 12]",
     {{"hertz_damped", "lankarani_nikravesh"}},
     {0.6653, 0.6723, 0.6842, 0.7016, 0.7252, 0.7561, 0.7960, 0.8471, 0.9132},
     {565.27, 236.13, 128.07, 75.41, 45.05, 26.02, 13.71, 5.89, 1.46},
     Nine{0.74250, 0.72000, 0.68250, 0.63000, 0.56250, 0.48000, 0.38250, 0.27000, 0.14250}},
    {"Gonthier 2004: (1-e^2)/e",
     {{"hertz_damped", "gonthier"}},
     {0.1010, 0.2046, 0.3042, 0.3978, 0.4877, 0.5773, 0.6696, 0.7680, 0.8764},
     {0.99, 2.30, 1.41, -0.55, -2.45, -3.79, -4.35, -4.00, -2.62},
     Nine{9.90000, 4.80000, 3.03333, 2.10000, 1.50000, 1.06667, 0.72857, 0.45000, 0.21111}},
    {"Zhiying-Qishao 2006: 3(1-e^2)exp(2(1-e))/4",
     {{"hertz_damped", "zhiying_qishao"}},
     {0.2175, 0.2664, 0.3267, 0.3988, 0.4826, 0.5769, 0.6796, 0.7874, 0.8959},
     {117.47, 33.21, 8.90, -0.29, -3.48, -3.85, -2.92, -1.58, -0.45},
     Nine{4.49186, 3.56618, 2.76767, 2.09167, 1.52903, 1.06826, 0.69696, 0.40279, 0.17405}},
    {"Ye et al. EESD 2009 = Flores 2011: 8(1-e)/(5e) [paper Eq. 14]",
     {{"hertz_damped", "ye_2009"}},
     {0.0694, 0.1555, 0.2562, 0.3629, 0.4704, 0.5773, 0.6832, 0.7885, 0.8939},
     {-30.56, -22.23, -14.60, -9.28, -5.91, -3.79, -2.40, -1.43, -0.68},
     Nine{14.40000, 6.40000, 3.73333, 2.40000, 1.60000, 1.06667, 0.68571, 0.40000, 0.17778}},
    {"Ye et al. EEEV 2009 (n=1) = Hu-Guo 2015 (n=3/2): 3(1-e)/(2e) [paper Eq. 13]",
     {{"hertz_damped", "hu_guo"}, {"modified_kelvin", "ye_2009_linear"}},
     {0.0741, 0.1656, 0.2707, 0.3796, 0.4877, 0.5936, 0.6973, 0.7992, 0.8999},
     {-25.93, -17.20, -9.78, -5.09, -2.45, -1.06, -0.39, -0.10, -0.01},
     Nine{13.50000, 6.00000, 3.50000, 2.25000, 1.50000, 1.00000, 0.64286, 0.37500, 0.16667}},
    {"Gharib-Hurmuzlu 2012: 1/e",
     {{"hertz_damped", "gharib_hurmuzlu"}},
     {0.1000, 0.1970, 0.2819, 0.3524, 0.4107, 0.4595, 0.5008, 0.5362, 0.5668},
     {-0.02, -1.51, -6.04, -11.91, -17.86, -23.42, -28.46, -32.98, -37.02},
     Nine{10.00000, 5.00000, 3.33333, 2.50000, 2.00000, 1.66667, 1.42857, 1.25000, 1.11111}},
    {"exact root (Khatiwada-type)",
     {{"hertz_damped", "exact"}, {"modified_kelvin", "exact"}},
     {0.1000, 0.2000, 0.3000, 0.4000, 0.5000, 0.6000, 0.7000, 0.8000, 0.9000},
     {-0.00, 0.00, 0.00, 0.00, 0.00, 0.00, 0.00, 0.00, 0.00},
     Nine{9.99816, 4.91917, 3.08708, 2.08250, 1.43275, 0.97487, 0.63483, 0.37315, 0.16648}},
    {"Naderpour et al. 2015 Eq. 16, k/v = 22000/15",
     {{"hertz_damped", "naderpour_2015", 22000e3, 15}},
     {0.0690, 0.1545, 0.2522, 0.3572, 0.4678, 0.5855, 0.7081, 0.8283, 0.9307},
     {-30.98, -22.74, -15.94, -10.69, -6.43, -2.42, 1.16, 3.54, 3.41},
     Nine{14.48809, 6.44292, 3.80263, 2.45296, 1.61566, 1.03281, 0.61106, 0.30978, 0.11162}},
    {"Naderpour et al. 2015 Eq. 16, k/v = 30000/10",
     {{"hertz_damped", "naderpour_2015", 30000e3, 10}},
     {0.0665, 0.1503, 0.2474, 0.3532, 0.4656, 0.5860, 0.7115, 0.8334, 0.9346},
     {-33.47, -24.87, -17.54, -11.70, -6.88, -2.34, 1.64, 4.17, 3.84},
     Nine{15.03136, 6.63001, 3.88771, 2.49188, 1.62901, 1.03082, 0.60130, 0.29892, 0.10491}},
    {"Naderpour et al. 2015 Eq. 16, k/v = 22/15 (k in MN/m^1.5)",
     {{"hertz_damped", "naderpour_2015", 22e3, 15}},
     {0.0985, 0.2012, 0.3012, 0.3969, 0.4891, 0.5807, 0.6742, 0.7732, 0.8805},
     {-1.54, 0.60, 0.41, -0.78, -2.18, -3.21, -3.68, -3.35, -2.16},
     Nine{10.15527, 4.88745, 3.07132, 2.10712, 1.49228, 1.05226, 0.71382, 0.43709, 0.20317}},
    {"Naderpour et al. 2015 Eq. 16, k/v = 2.2e7/15 (k in N/m^1.5)",
     {{"hertz_damped", "naderpour_2015", 2.2e7 * 1e3, 15}},
     {0.0484, 0.1177, 0.2083, 0.3190, 0.4465, 0.5902, 0.7397, 0.8721, 0.9607},
     {-51.62, -41.17, -30.57, -20.26, -10.70, -1.63, 5.67, 9.01, 6.75},
     Nine{20.66956, 8.49342, 4.70809, 2.85555, 1.74924, 1.01373, 0.52310, 0.21955, 0.06133}},
    {"approach-only linear, zeta = (1-e^2)/(pi e) [paper Table 4]",
     {{"modified_linear_viscoelastic", "simple"}},
     {0.1475, 0.2711, 0.3765, 0.4706, 0.5582, 0.6428, 0.7271, 0.8134, 0.9037},
     {47.54, 35.53, 25.51, 17.65, 11.63, 7.13, 3.87, 1.67, 0.41},
     Nine{3.15127, 1.52789, 0.96554, 0.66845, 0.47746, 0.33953, 0.23191, 0.14324, 0.06720}},
    {"approach-only linear, zeta = (1-e^2)/(e[e(pi-2)+2]) Mahmoud-Jankowski 2011",
     {{"modified_linear_viscoelastic", "mahmoud_jankowski_2011"}},
     {0.1025, 0.2055, 0.3070, 0.4071, 0.5061, 0.6046, 0.7030, 0.8014, 0.9004},
     {2.49, 2.73, 2.33, 1.77, 1.23, 0.77, 0.42, 0.18, 0.04},
     Nine{4.68271, 2.15409, 1.29493, 0.85483, 0.58348, 0.39728, 0.26029, 0.15447, 0.06973}},
    {"approach-only linear, zeta = exact inversion",
     {{"modified_linear_viscoelastic", "exact"}},
     {0.1000, 0.2000, 0.3000, 0.4000, 0.5000, 0.6000, 0.7000, 0.8000, 0.9000},
     {0.00, 0.00, 0.00, 0.00, -0.00, -0.00, 0.00, 0.00, 0.00},
     Nine{4.80694, 2.22395, 1.33603, 0.87904, 0.59734, 0.40474, 0.26388, 0.15585, 0.07004}},
    {"approach-only linear, zeta = paper Eq. 38 [2(1-e^2)/(e sqrt(pi))]^2",
     {{"modified_linear_viscoelastic", "naderpour_2015_eq38"}},
     {0.0040, 0.0170, 0.0423, 0.0863, 0.1606, 0.2823, 0.4677, 0.7050, 0.9175},
     {-95.99, -91.50, -85.91, -78.42, -67.88, -52.94, -33.18, -11.88, 1.95},
     Nine{124.79021, 29.33544, 11.71522, 5.61499, 2.86479, 1.44866, 0.67586, 0.25783, 0.05675}},
    {"Jankowski nonlinear viscoelastic, xi = sqrt5(1-e^2)/(2 pi e) [paper Eq. 10]",
     {{"jankowski", "jankowski_2005"}},
     {0.1475, 0.2711, 0.3765, 0.4706, 0.5582, 0.6428, 0.7271, 0.8134, 0.9037},
     {47.54, 35.53, 25.51, 17.65, 11.63, 7.13, 3.87, 1.67, 0.41},
     Nine{3.52322, 1.70823, 1.07951, 0.74735, 0.53382, 0.37961, 0.25928, 0.16015, 0.07513}},
    {"Jankowski nonlinear viscoelastic, xi = 9sqrt5/2 (1-e^2)/(e[e(9pi-16)+16]) (2006)",
     {{"jankowski", "jankowski_2006"}},
     {0.0933, 0.1915, 0.2917, 0.3930, 0.4946, 0.5962, 0.6977, 0.7989, 0.8997},
     {-6.68, -4.26, -2.75, -1.76, -1.08, -0.63, -0.32, -0.13, -0.03},
     Nine{5.78245, 2.61715, 1.55075, 1.01057, 0.68182, 0.45938, 0.29811, 0.17537, 0.07854}},
    {"Jankowski nonlinear viscoelastic, xi = exact inversion",
     {{"jankowski", "exact"}},
     {0.1000, 0.2000, 0.3000, 0.4000, 0.5000, 0.6000, 0.7000, 0.8000, 0.9000},
     {0.00, 0.00, 0.00, 0.00, -0.00, -0.00, 0.00, 0.00, 0.00},
     Nine{5.37432, 2.48646, 1.49372, 0.98280, 0.66785, 0.45252, 0.29503, 0.17424, 0.07830}},
    {"Kelvin-Voigt, zeta = Anagnostopoulos, contact to delta=0",
     {{"kelvin_voigt", "anagnostopoulos"}, {"kelvin_voigt", "exact"}},
     {0.1000, 0.2000, 0.3000, 0.4000, 0.5000, 0.6000, 0.7000, 0.8000, 0.9000},
     {-0.00, -0.00, 0.00, 0.00, 0.00, -0.00, 0.00, 0.00, 0.00},
     std::nullopt},
    {"Kelvin-Voigt, zeta = Anagnostopoulos, contact to F=0 (F>=0)",
     {{"kelvin_voigt_no_tension", "anagnostopoulos"},
      {"komodromos", "anagnostopoulos"},
      {"viscous_hertz", "antypov_elliott"}},
     {0.2527, 0.3249, 0.3971, 0.4720, 0.5503, 0.6323, 0.7182, 0.8081, 0.9020},
     {152.73, 62.43, 32.38, 18.00, 10.06, 5.38, 2.60, 1.01, 0.23},
     std::nullopt},
    {"Kelvin-Voigt both phases, zeta = paper Eq. 38, F>=0",
     {{.law = "kelvin_voigt_no_tension", .ratio = &laws::naderpour_2015_eq38}},
     {0.0000, 0.0003, 0.0018, 0.0075, 0.0258, 0.0797, 0.2188, 0.4970, 0.8419},
     {-99.98, -99.86, -99.40, -98.14, -94.84, -86.71, -68.75, -37.88, -6.46},
     std::nullopt}};

/// Jankowski's dashpot kept in restitution, contact until d = 0, xi by the paper's Eq. 10: the force pulls at the end,
/// which no law of the catalogue allows. In stretched time a linear oscillator of ratio z = 2 xi/sqrt(5); never
/// separates for z >= 1.
inline const FormulaRow jankowski_in_both_phases{
    "Jankowski c in both phases, contact to d = 0",
    {},
    {0.0000, 0.0000, 0.0000, 0.0594, 0.1814, 0.3217, 0.4728, 0.6346, 0.8093},
    {-100.00, -100.00, -100.00, -85.15, -63.72, -46.38, -32.45, -20.67, -10.08},
    std::nullopt};

/// The example of the paper's section 5.1: m1 = 100 t, m2 = 150 t, k = 22000 kN/m^1.5, v = 15 m/s.
struct Section51Row {
  double requested;
  std::string_view law, formula;
  double damping;                                                   // a or xi, five decimals
  double restitution, penetration, force, duration, lost, impulse;  // -, m, kN, s, kJ, kN s
};
namespace section_5_1 {
inline constexpr double mass = 60e3, stiffness = 22000e3, speed = 15;  // reduced [kg], [N/m^1.5], [m/s]
inline constexpr double elastic_penetration = 0.899349, elastic_force = 18763.564,
                        elastic_duration = 0.176469;  // m, kN, s
inline constexpr double energy = 6750.000;            // closing, kJ
inline constexpr Section51Row rows[] = {
    {0.3, "hertz_damped", "exact", 3.08708, 0.30000, 0.592582, 19531.03, 0.226945, 6142.500, 1170.000},
    {0.3, "hertz_damped", "naderpour_2015", 3.80263, 0.25217, 0.562166, 20437.25, 0.240351, 6320.755, 1126.957},
    {0.3, "hertz_damped", "lankarani_nikravesh", 0.68250, 0.68422, 0.778214, 16949.77, 0.185726, 3589.898, 1515.802},
    {0.3, "hertz_damped", "ye_2009", 3.73333, 0.25621, 0.564862, 20350.99, 0.239042, 6306.913, 1130.587},
    {0.3, "jankowski", "jankowski_2005", 1.07951, 0.37652, 0.411679, 19514.75, 0.173432, 5793.074, 1238.867},
    {0.3, "jankowski", "exact", 1.49372, 0.30000, 0.343262, 24635.68, 0.173420, 6142.500, 1170.000},
    {0.5, "hertz_damped", "exact", 1.43275, 0.50000, 0.697520, 17444.15, 0.197608, 5062.500, 1350.000},
    {0.5, "hertz_damped", "naderpour_2015", 1.61566, 0.46783, 0.682228, 17651.28, 0.200678, 5272.651, 1321.049},
    {0.5, "hertz_damped", "lankarani_nikravesh", 0.56250, 0.72524, 0.794958, 16991.26, 0.183960, 3199.671, 1552.717},
    {0.5, "hertz_damped", "ye_2009", 1.60000, 0.47044, 0.683487, 17632.96, 0.200413, 5256.102, 1323.400},
    {0.5, "jankowski", "jankowski_2005", 0.53382, 0.55817, 0.564081, 13766.88, 0.174158, 4647.011, 1402.353},
    {0.5, "jankowski", "exact", 0.66785, 0.50000, 0.516541, 14785.65, 0.173875, 5062.500, 1350.000},
    {0.7, "hertz_damped", "exact", 0.63483, 0.70000, 0.784698, 16959.19, 0.185019, 3442.500, 1530.000},
    {0.7, "hertz_damped", "naderpour_2015", 0.61106, 0.70811, 0.788011, 16967.21, 0.184669, 3365.382, 1537.302},
    {0.7, "hertz_damped", "lankarani_nikravesh", 0.38250, 0.79597, 0.823026, 17194.87, 0.181405, 2473.386, 1616.375},
    {0.7, "hertz_damped", "ye_2009", 0.68571, 0.68318, 0.777785, 16949.43, 0.185774, 3599.501, 1514.866},
    {0.7, "jankowski", "jankowski_2005", 0.25928, 0.72710, 0.696950, 14017.88, 0.175054, 3181.491, 1554.386},
    {0.7, "jankowski", "exact", 0.29503, 0.70000, 0.676094, 13762.18, 0.174908, 3442.500, 1530.000},
    {0.9, "hertz_damped", "exact", 0.16648, 0.90000, 0.862713, 17810.41, 0.178520, 1282.500, 1710.000},
    {0.9, "hertz_damped", "naderpour_2015", 0.11162, 0.93071, 0.874108, 18065.72, 0.177825, 903.070, 1737.635},
    {0.9, "hertz_damped", "lankarani_nikravesh", 0.14250, 0.91318, 0.867620, 17915.86, 0.178214, 1121.231, 1721.859},
    {0.9, "hertz_damped", "ye_2009", 0.17778, 0.89392, 0.860440, 17763.85, 0.178665, 1356.114, 1704.529},
    {0.9, "jankowski", "jankowski_2005", 0.07513, 0.90369, 0.829364, 16742.22, 0.175985, 1237.536, 1713.324},
    {0.9, "jankowski", "exact", 0.07830, 0.90000, 0.826651, 16670.99, 0.175966, 1282.500, 1710.000}};
}  // namespace section_5_1

/// A linear spring and dashpot with the ratio of Anagnostopoulos, in contact until d = 0 (it pulls) or until F = 0.
struct KelvinVoigtRow {
  double requested, ratio, coefficient;  // -, -, N s/m
  double restitution_to_zero_penetration, restitution_to_zero_force;
  double penetration, force, force_at_penetration;  // largest [m], largest [N], at the largest penetration [N]
  double duration_to_zero_penetration, duration_to_zero_force;  // s
};
namespace kelvin_voigt {
inline constexpr double mass = 1e5, stiffness = 9.35e7, speed = 0.5;  // reduced [kg], [N/m], [m/s]
inline constexpr KelvinVoigtRow rows[] = {
    {0.4, 0.279998, 1712342.8, 0.400000, 0.472014, 0.01123419, 1239504.5, 1050396.4, 0.10702188, 0.08768649},
    {0.5, 0.215454, 1317619.1, 0.500000, 0.550283, 0.01212990, 1248202.8, 1134145.9, 0.10521207, 0.09066691},
    {0.65, 0.135851, 830805.5, 0.650000, 0.674751, 0.01343186, 1303701.6, 1255878.8, 0.10370247, 0.09470588},
    {0.8, 0.070850, 433288.8, 0.800000, 0.808099, 0.01469930, 1388298.8, 1374384.3, 0.10299991, 0.09835023},
    {1.0, 0.000000, 0.0, 1.000000, 1.000000, 0.01635175, 1528888.5, 1528888.5, 0.10274107, 0.10274107}};
}  // namespace kelvin_voigt

/// The example of the paper's section 5: "755.76 kN", which is 755.76 kg, k = 30000 kN/m^1.5, v = 10 m/s, target 0.7.
struct Section5Row {
  std::string_view formula;                      // of hertz_damped
  double factor, damping;                        // a [-], zeta [kN s/m^2.5]
  double restitution, penetration, force, lost;  // -, m, kN, kJ
  double lost_if_as_requested;                   // the paper's Eq. 18 [kJ]
};
namespace section_5 {
inline constexpr double mass = 755.76, stiffness = 30000e3, speed = 10, requested = 0.7;  // [kg], [N/m^1.5], [m/s], [-]
inline constexpr Section5Row rows[] = {
    {"lankarani_nikravesh", 0.382500, 1147.500, 0.79597, 0.091360, 867.178, 13.84657, 19.27188},
    {"hu_guo", 0.642857, 1928.571, 0.69730, 0.086982, 855.182, 19.41460, 19.27188},
    {"ye_2009", 0.685714, 2057.143, 0.68318, 0.086338, 854.800, 20.15080, 19.27188},
    {"naderpour_2015", 0.601304, 1803.912, 0.71150, 0.087626, 855.897, 18.65871, 19.27188},
    {"exact", 0.634828, 1904.485, 0.70000, 0.087105, 855.292, 19.27188, 19.27188}};
}  // namespace section_5

/// Bilinear law of Muthukumar & DesRoches for k = 1 N/m^1.5, design penetration 1 m, yield ratio 0.1.
struct BilinearRow {
  double requested, loss, stiffness, stiffness_1, stiffness_2, yield;  // -, J, effective, K1 and K2 [N/m], m
  double energy,
      // under the loading curve up to the design penetration [J]; where the design penetration is just reached [-]
      restitution;
};
namespace bilinear {
/// A Hertz spring of 1 N/m^1.5 stops this mass [kg] from this speed [m/s] at the design penetration.
inline constexpr double mass = 0.8, design_speed = 1;
/// The speed that just reaches the design penetration along the loading curve [m/s].
inline double reaching_speed(const BilinearRow& row) { return std::sqrt(2 * row.energy / mass); }
inline constexpr BilinearRow rows[] = {{0.4, 0.336000, 1.0, 4.360000, 0.626667, 0.1, 0.668000, 0.704987},
                                       {0.5, 0.300000, 1.0, 4.000000, 0.666667, 0.1, 0.650000, 0.733799},
                                       {0.6, 0.256000, 1.0, 3.560000, 0.715556, 0.1, 0.628000, 0.769647},
                                       {0.7, 0.204000, 1.0, 3.040000, 0.773333, 0.1, 0.602000, 0.813099},
                                       {0.8, 0.144000, 1.0, 2.440000, 0.840000, 0.1, 0.572000, 0.865015},
                                       {0.9, 0.076000, 1.0, 1.760000, 0.915556, 0.1, 0.538000, 0.926680}};
}  // namespace bilinear

}  // namespace pounding::reference
