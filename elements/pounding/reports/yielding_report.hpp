#pragma once
/// Yielding parts of a model before any run: for `pounding check`.

#include <limits>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// An undeformed yielding part.
struct YieldingFacts {
  std::string name, law;   ///< law: as in the input; "rigid-plastic" for such a hinge
  bool is_hinge = false;   ///< otherwise a storey or another spring
  double force = 0;        ///< k times the yield deformation [N] or [N m]
  double deformation = 0;  ///< yield deformation [m] or [rad]
  double stiffness = 0;    ///< k; for a rigid-plastic hinge, that of the end of its member [N/m] or [N m/rad]
  double hardening = 0;    ///< ratio b of post-yield to initial stiffness [-]
  /// For a storey: ratio of its yield force to the weight that it carries [-]; otherwise NaN.
  double over_weight = std::numeric_limits<double>::quiet_NaN();
  double at_rest = 0;  ///< ratio of the deformation under gravity to the yield deformation [-]
  /// For a hinge: stiffness of the end of its member in double curvature, elastic and after both ends have yielded [N
  /// m/rad]; otherwise NaN.
  double end_stiffness = std::numeric_limits<double>::quiet_NaN(), end_tangent = end_stiffness;
};

/// Storey of a plane frame with columns that all yield at both ends: a storey mechanism under the sum of their yield
/// moments divided by its height.
struct StoreyMechanism {
  std::string storey;   ///< label of the floor above it
  double shear = 0;     ///< in the weaker direction [N]; NaN if a column stays elastic, which prevents a mechanism
  std::string elastic;  ///< first end of a column without a hinge: "column 1.0 end"; empty for none
};

/// Yielding parts of a structure, in order.
std::vector<YieldingFacts> yielding_facts(const Structure& structure);
/// Storeys of a plane frame with hinges, from the ground up; empty for other structures.
std::vector<StoreyMechanism> storey_mechanisms(const Structure& structure);

/// Tables of both for all structures; empty if nothing yields. Identical parts share a line.
std::string yielding_table(const Model& model);
/// JSON object of both, structures by name, in SI; "{}" if nothing yields.
std::string yielding_json(const Model& model);

}  // namespace pounding
