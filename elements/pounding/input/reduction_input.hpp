#pragma once
/// The key `reduction`.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads the value of `reduction`. Throws InputError with the location.
Reduction read_reduction(const Input& node);

/// Checks that structures with an explicit reduction can be reduced. `root` is the whole file of the complete model.
/// Throws InputError with the location.
void check_reductions(const Model& model, const Input& root);

}  // namespace pounding
