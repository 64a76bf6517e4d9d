#pragma once
/// Keys with a different meaning in an earlier version.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Warnings about keys whose meaning has changed since version 0.2.0: `hardening` of a hinge with a law.
std::vector<Warning> changed_keys(const Input& input);

}  // namespace pounding
