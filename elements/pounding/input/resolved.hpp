#pragma once
/// Complete model as text.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// Complete model as YAML in SI units, with all defaults and calibrated parameters. It is for information only and
/// cannot be read as an input.
std::string resolved_yaml(const Model& model);

}  // namespace pounding
