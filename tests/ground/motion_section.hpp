#pragma once
/// Ground motions from input text, with files in a temporary folder of the test.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <pounding/core/error.hpp>
#include <pounding/input/ground_input.hpp>

namespace pounding::test {

class MotionSection : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string(info.test_suite_name()) + "_" + info.name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  GroundMotion read(const std::string& section) const {
    return read_ground_motion(Input::read_text(section, (folder_ / "m.yaml").string()));
  }
  /// The error message without the temporary folder.
  std::string error(const std::string& section) const {
    try {
      read(section);
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
      return text;
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

}  // namespace pounding::test
