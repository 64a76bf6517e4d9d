#pragma once
/// Numbers of an input whose missing unit makes them doubtful.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// A doubt for every `pga` of the input, wherever it stands, that has no unit and would be a usual value in g: a bare 0.35 is
/// 0.35 m/s^2, which is 0.036 g.
std::vector<Doubt> bare_accelerations(const Input& input);

}  // namespace pounding
