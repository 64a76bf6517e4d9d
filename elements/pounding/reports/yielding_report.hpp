#pragma once
/// Parts of a model that yield, as they are before any run: for `pounding check`.

#include <limits>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// A part that yields, undeformed.
struct YieldingFacts {
  std::string name, law;   ///< law: as in the input; "rigid-plastic" for such a hinge
  bool is_hinge = false;   ///< else a storey or another spring
  double force = 0;        ///< k times the yield deformation [N] or [N m]
  double deformation = 0;  ///< at which it first yields [m] or [rad]
  double stiffness = 0;    ///< k; of a rigid-plastic hinge that of the end of its member [N/m] or [N m/rad]
  double hardening = 0;    ///< part of k that is left far behind the yield, b [-]
  /// Of a storey: the force over the weight that the storey carries [-]; else NaN.
  double over_weight = std::numeric_limits<double>::quiet_NaN();
  double at_rest = 0;  ///< part of the yield deformation that gravity takes [-]
  /// Of a hinge: stiffness of the end of its member in double curvature, elastic and after both ends have yielded [N
  /// m/rad]; else NaN.
  double end_stiffness = std::numeric_limits<double>::quiet_NaN(), end_tangent = end_stiffness;
};

/// A storey of a plane frame whose columns all yield at both ends: it sways on its own under the sum of their yield
/// moments over its height.
struct StoreyMechanism {
  std::string storey;  ///< label of the floor above it
  double shear =
      0;  ///< in the weaker direction [N]; NaN where the storey cannot sway, as one of its columns stays elastic
  std::string elastic;  ///< the first end of a column that has no hinge: "column 1.0 end"; empty for none
};

/// The parts of a structure that yield, in their order.
std::vector<YieldingFacts> yielding_facts(const Structure& structure);
/// The storeys of a plane frame with hinges, from the ground up; empty for other structures.
std::vector<StoreyMechanism> storey_mechanisms(const Structure& structure);

/// Tables of both for all structures; empty where nothing yields. Parts that are alike share a line.
std::string yielding_table(const Model& model);
/// Both as one JSON object, structures by their names, in SI; "{}" where nothing yields.
std::string yielding_json(const Model& model);

}  // namespace pounding
