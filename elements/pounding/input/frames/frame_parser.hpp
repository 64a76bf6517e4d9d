#pragma once
/// Values that differ between plane and space frames: degrees of freedom, vectors, supports.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/frames/frame.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

/// Dimensions of springs and dashpots on a translation or a rotation.
const Dimension& of_spring(Dof dof);
const Dimension& of_dashpot(Dof dof);

/// A support as specified in the input.
struct SupportWish {
  std::vector<Dof> fixed;
  std::vector<std::pair<Dof, double>> springs, dashpots;  ///< [N/m], [N m]; [N s/m], [N m s]
  std::optional<IsolatorOptions> isolator;
  double delay = 0;  ///< [s]
  std::optional<GroundComponents> motion;
};

/// Reads single values. All functions throw InputError with the location.
class FrameParser {
 public:
  /// `frame` is the whole section. The dimension is given, or 3 if its bays or nodes are three-dimensional, else 2.
  explicit FrameParser(const Input& frame);

  /// 2 in the plane, 3 in space.
  int dimension() const noexcept { return dimension_; }

  /// A degree of freedom such as ux.
  Dof dof(const Input& item) const;
  /// The degree of freedom whose name is the key of a value.
  Dof dof_at_key(const std::string& key, const Input& value) const;
  /// A list of degrees of freedom.
  std::vector<Dof> dofs(const Input& list) const;
  /// [x, z] in the plane, [x, y, z] in space; `example` is used in the message.
  Eigen::Vector3d vector(const Input& node, std::string_view example) const;
  /// `fixed`, `pinned` or `roller`, or a map with restraints, springs, dashpots, delay and motion.
  SupportWish support(const Input& node) const;

 private:
  std::vector<Dof> fixed_by(const Input& spec) const;
  GroundComponents ground(const Input& node) const;
  void read_isolator(const Input& support, const Input& isolator, SupportWish& wish) const;

  int dimension_;
};

}  // namespace pounding
