#pragma once
/// The word `reduction`.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads the value of `reduction`. Throws InputError with its place.
Reduction read_reduction(const Input& node);

/// Refuses numbers for what cannot be reduced, at their place in the input of a complete model. `root` is the whole
/// file.
void check_reductions(const Model& model, const Input& root);

}  // namespace pounding
