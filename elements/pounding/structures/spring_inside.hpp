#pragma once
/// Springs that can tell what they were inside the last kept step.

#include <pounding/links/contact.hpp>

namespace pounding {

/// A spring that follows its law inside the last kept step, so that histories are exact at times between the ends of steps.
class SpringInside {
 public:
  /// Force and loss at one instant.
  struct Answer {
    double force = 0;  ///< as Spring::evaluate() gives it [N]
    double lost = 0;   ///< by yielding until then, as Spring::lost() [J]
  };

  virtual ~SpringInside() = default;
  /// At s from 0 to 1 of the step that was kept last, where the deformation is this [m]. Pure.
  virtual Answer inside(const LinkStep& step, double s, double deformation) const noexcept = 0;
};

}  // namespace pounding
