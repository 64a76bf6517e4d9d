/// Moment-curvature and N-M interaction against an independent program, which agrees with OpenSees 3.7.1
/// (zeroLengthSection, same steps) to 3e-12, and closed forms.

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/sections/builders.hpp>
#include <pounding/sections/moment_curvature.hpp>
#include "sections/reinforced_column.hpp"
#include "support/messages.hpp"

namespace pounding::sections {
namespace moment_curvature_test {

/// Straight segments to the targets in steps of 0.0005 1/m.
std::vector<double> path_to(const std::vector<double>& targets, std::vector<std::size_t>* ends = nullptr) {
  std::vector<double> path;
  double last = 0;
  for (const double target : targets) {
    const int n = static_cast<int>(std::lround(std::abs(target - last) / 0.0005));
    if (ends)
      for (const int part : {n / 2, n}) ends->push_back(path.size() + static_cast<std::size_t>(part) - 1);
    for (int i = 1; i <= n; ++i) path.push_back(last + (target - last) * i / n);
    last = target;
  }
  return path;
}

struct Reference {
  std::string steel;
  double axial_force;
  std::vector<double> moments;  // in the middle and at the end of each segment
};

TEST(MomentCurvature, CyclesOfAReinforcedColumnFollowTheReference) {
  const std::vector<Reference> references{
      {"steel01",
       0.0,
       {129581.73472233326, 210344.60237471212, -12646.482909427607, -207290.59210674185, 102248.15806311046,
        239122.79762291058, -109766.40666547368, -244770.78776300768, 147501.00836582767, 252115.1238227592,
        -165816.501904579, -252185.0949738893, 176102.40000000002, 257442.11602667003, -134527.9228526175,
        -174873.60000000003}},
      {"steel01",
       -1000000.0,
       {201552.43929454478, 285458.0619860297, -34044.86797958179, -284485.60489804274, 167447.42797987914,
        340666.7152889533, -77726.14795110925, -340036.75917412504, 258701.1576122167, 333482.67710890097,
        -181263.4795903014, -333381.64819116634, 243600.6925067705, 335057.62880111666, -53769.768787526875,
        -191477.93557027233}},
      {"steel01",
       -2000000.0,
       {232628.02470138136, 324232.21700372314, -70037.52325562279, -322424.3559791847, 193458.90824708735,
        375042.5001118245, -138412.81249062152, -374776.9094046175, 296839.6827613368, 350215.0181222522,
        -241367.2486205782, -350003.000749137, 244145.3956369612, 348066.116356092, -75503.0134882672,
        -217501.3931345509}},
      {"steel02",
       0.0,
       {129581.73219713755, 207563.23599064845, -14287.792577378572, -204486.59768202688, 100682.38510959808,
        239199.31065743044, -79765.37877716795, -243820.74445203325, 144192.58711766973, 251054.97364792624,
        -130198.42466139163, -250296.64896516444, 135519.52894054854, 251898.49946771542, -71165.55770313273,
        -140775.2454261633}},
      {"steel02",
       -1000000.0,
       {201552.439256088, 285427.8971221915, -34063.02947683433, -284157.96387085057, 167641.79034246065,
        337936.5532274741, -67546.54745389082, -335119.37875487166, 238295.16736175516, 330538.8102159503,
        -140464.76174995495, -326007.8426931178, 197167.199686577, 326150.4388219309, -6096.956692498919,
        -149720.59083}},
      {"steel02",
       -2000000.0,
       {232627.9310430532, 323720.2921814553, -70751.78130506509, -321618.6598080055, 195000.28835464374,
        373143.4149393633, -135970.98220822721, -368068.87745337706, 261221.91200038232, 347350.04865949875,
        -196685.23313337713, -342283.2862651033, 205078.56361762556, 339584.4992331544, -17284.707468881956,
        -181285.8072338501}},
  };
  std::vector<std::size_t> ends;
  const std::vector<double> path = path_to({0.01, -0.01, 0.02, -0.02, 0.04, -0.04, 0.06, 0}, &ends);
  for (const Reference& reference : references) {
    const FibreSection section = test::reinforced_column(reference.steel);
    const auto curve = moment_curvature(section, reference.axial_force, path);
    ASSERT_EQ(ends.size(), reference.moments.size());
    double largest = 0;
    for (const CurvePoint& point : curve) largest = std::max(largest, std::abs(point.moment));
    for (std::size_t i = 0; i < ends.size(); ++i)
      EXPECT_NEAR(curve[ends[i]].moment, reference.moments[i], 1e-10 * largest)
          << reference.steel << ", N " << reference.axial_force << ", curvature " << curve[ends[i]].curvature;
    EXPECT_EQ(section.forgets_small_reversals(), reference.steel != "steel02");
  }
}

TEST(Interaction, AReinforcedColumnFollowsTheReference) {
  const std::vector<double> forces{0.0,        -500000.0,  -1000000.0, -1500000.0, -2000000.0, -2500000.0,
                                   -3000000.0, -3500000.0, -4000000.0, -4500000.0, -5000000.0};
  const std::vector<double> moments{253578.39469499106, 313938.28693687933, 341796.1482219584, 366272.26704977406,
                                    377675.25086288986, 361382.4669858458,  334094.6383369934, 295623.91373113025,
                                    253322.87623266544, 202257.85679700953, 144482.87023209018};
  const auto diagram = interaction(test::reinforced_column("steel01"), forces, path_to({0.06}));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_EQ(diagram[i].axial_force, forces[i]);
    EXPECT_NEAR(diagram[i].moment, moments[i], 1e-10 * 377675) << forces[i];
  }
}

/// Elastic-perfectly plastic rectangle of 0.2 x 0.4 m.
FibreSection steel_rectangle(int layers) {
  return {{materials::make_material({.law = "steel01", .values = {{"Fy", 250e6}, {"E0", 200e9}, {"b", 0}}})},
          rectangle(0.2, 0.4, 0, layers)};
}

// M/My = (3 - (ky/k)^2)/2 beyond the yield curvature; layers of midpoints converge with their number squared.
TEST(MomentCurvature, ASteelRectangleFollowsTheClosedForm) {
  const double yield_moment = 250e6 * 0.2 * 0.4 * 0.4 / 6, yield_curvature = 2 * 250e6 / 200e9 / 0.4;
  const FibreSection section = steel_rectangle(1000);
  for (const double ratio : {0.5, 1.0, 1.5, 2.0, 5.0, 20.0}) {
    const double expected = ratio <= 1 ? ratio : (3 - 1 / (ratio * ratio)) / 2;
    const std::vector<double> curvatures{ratio * yield_curvature};
    EXPECT_NEAR(moment_curvature(section, 0, curvatures)[0].moment / yield_moment, expected, 3e-6) << ratio;
  }
}

// M/Mp = 1 - (N/Np)^2 of a rectangle, at a curvature of 100 times that of yield.
TEST(Interaction, ASteelRectangleFollowsTheClosedForm) {
  const double plastic_force = 250e6 * 0.2 * 0.4, plastic_moment = 250e6 * 0.2 * 0.4 * 0.4 / 4;
  std::vector<double> forces, curvatures;
  for (const double n : {-0.9, -0.5, 0.0, 0.3, 0.8}) forces.push_back(n * plastic_force);
  for (int i = 1; i <= 20; ++i) curvatures.push_back(i * 0.0625);
  const auto diagram = interaction(steel_rectangle(1000), forces, curvatures);
  for (const InteractionPoint& point : diagram) {
    const double n = point.axial_force / plastic_force;
    EXPECT_NEAR(point.moment / plastic_moment, 1 - n * n, 2e-4) << n;
  }
}

// Square cells and a bar in each corner.
TEST(MomentCurvature, BothAxesOfASquareSectionAreEqual) {
  Fibres fibres = rectangle(0.4, 0.4, 1, 12, 12);
  for (const double z : {-0.16, 0.16}) add_straight_layer(fibres, 2, 2, 3e-4, {-0.16, z}, {0.16, z});
  const FibreSection section{test::column_materials("steel01"), fibres};
  const std::vector<double> path{0.002, 0.005, 0.01, 0.005};
  const auto about_y = moment_curvature(section, -1e6, path), about_z = moment_curvature(section, -1e6, path, Axis::z);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_NEAR(about_y[i].moment, about_z[i].moment, 1e-9 * about_y[1].moment) << path[i];
}

TEST(MomentCurvature, AnAxialForceAboveTheStrengthIsRejected) {
  const std::vector<double> path{0.01};
  const std::string message = test::refusal([&] { moment_curvature(steel_rectangle(20), -30e6, path); });
  EXPECT_TRUE(test::mentions(message, {"kN", "-30000", "compression"})) << message;
}

}  // namespace moment_curvature_test
}  // namespace pounding::sections
