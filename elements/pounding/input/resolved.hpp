#pragma once
/// A model as text, with all that was left out.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// A complete model with every default and calibrated parameter filled in, SI, as YAML. It is written from the model
/// alone and is for people: it cannot be read as an input again.
std::string resolved_yaml(const Model& model);

}  // namespace pounding
