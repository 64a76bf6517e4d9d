#pragma once
/// The text with which a wrong input is refused.

#include <gtest/gtest.h>

#include <string>

#include <pounding/core/error.hpp>
#include "support/models.hpp"

namespace pounding::test {

/// `message` is the whole text after the name of the file: line, column, key, reason.
inline void refused(const std::string& yaml, const std::string& message) {
  try {
    model_of(yaml);
    ADD_FAILURE() << "this was taken:\n" << yaml;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "test.yaml:" + message) << yaml;
  }
}

}  // namespace pounding::test
