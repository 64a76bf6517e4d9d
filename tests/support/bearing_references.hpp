#pragma once
/// Coupled isolators in OpenSees 3.7.1, written by tests/verification/opensees/bearings.py.

#include <array>

namespace pounding::test {

/// Displacements x, y [m]: absolute peaks, then values at bearing_instants.
struct BearingReference {
  std::array<std::array<double, 2>, 8> values;
};
inline constexpr std::array bearing_instants{2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0};  ///< [s]

/// ElastomericBearingBoucWen, eta = 2, beta = gamma = 0.5; doubt 3.0e-07 of the peak.
inline constexpr BearingReference bouc_wen{{{{0.10949747, 0.093927666},
                                             {-0.023730897, 0.0094607034},
                                             {-0.034731519, 0.024282157},
                                             {-0.053195325, 0.032996436},
                                             {0.016673166, -0.0081070103},
                                             {0.0042066308, 0.0038602803},
                                             {0.0019419418, 0.063029486},
                                             {-0.018038133, -0.009809101}}}};
/// ElastomericBearingBoucWen, eta = 3.5, beta = 0.8, gamma = 0.2; doubt 1.6e-07 of the peak.
inline constexpr BearingReference bouc_wen_sharp{{{{0.10813254, 0.093876532},
                                                   {-0.023889843, 0.010151281},
                                                   {-0.034020047, 0.024357286},
                                                   {-0.053277532, 0.031703635},
                                                   {0.015739322, -0.0073505418},
                                                   {0.0045216023, 0.0050235052},
                                                   {0.0019899685, 0.061263},
                                                   {-0.015602997, -0.0098274723}}}};
/// singleFPBearing, Coulomb friction 0.06; doubt 5.6e-07 of the peak.
inline constexpr BearingReference pendulum{{{{0.075497819, 0.071024463},
                                             {-0.024739496, 0.0085250059},
                                             {-0.020499097, 0.028823296},
                                             {-0.036830104, 0.016308612},
                                             {-0.0157752, 0.0075889055},
                                             {-0.0059426015, 0.021929836},
                                             {0.0023542744, 0.051593585},
                                             {-0.0058481594, -0.015972483}}}};
/// singleFPBearing, VelDependent friction 0.03, 0.08, 20 s/m; doubt 5.9e-06 of the peak.
inline constexpr BearingReference pendulum_rate{{{{0.050901634, 0.049993791},
                                                  {-0.016697179, 0.0038860318},
                                                  {-0.01706401, 0.017989974},
                                                  {-0.016021279, 0.010217239},
                                                  {-0.0033532158, 0.0034489026},
                                                  {-0.0027529462, 0.016736936},
                                                  {0.0053193973, 0.043551922},
                                                  {-0.0042849204, -0.0090498702}}}};

}  // namespace pounding::test
