#pragma once
/// Helpers to run a model in a test.

#include <string>

#include <pounding/run/run.hpp>

#include "support/models.hpp"

namespace pounding::test {

inline Outcome run_text(const std::string& yaml) {
  const Model model = model_of(yaml);
  return run(model);
}

}  // namespace pounding::test
