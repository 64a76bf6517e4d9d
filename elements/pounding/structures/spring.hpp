#pragma once
/// A spring that yields: what its force differs by from the linear stiffness that the structure is assembled with.

#include <pounding/core/archive.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// The force on top of k u, as a function of the deformation (LinkMotion::penetration) from the last kept state on.
/// Histories move at kept steps only.
class Spring {
 public:
  virtual ~Spring() = default;

  /// Pure. force is that of the spring minus k times the deformation, so its slope is not positive [N], [N/m].
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// A step was kept.
  virtual void accept(const LinkStep& step) = 0;
  /// Energy that the spring has lost by yielding [J].
  virtual double lost() const noexcept = 0;
  /// Energy that it stores, minus k/2 times the square of its deformation [J].
  virtual double stored_correction() const noexcept = 0;
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
