// `pounding record` on the command line.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <pounding/core/error.hpp>
#include <program/commands.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace record_command_test {

constexpr double pi = std::numbers::pi;

class RecordCommand : public testing::Test {
 protected:
  void SetUp() override {
    file_ =
        testing::TempDir() + "record_command_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    std::ofstream(file_) << "time,acc (m/s^2)\n0,0\n1,2\n2,0\n";
  }
  void TearDown() override { std::filesystem::remove(file_); }

  static std::string run(const std::string& arguments) {
    CLI::App app;
    program::add_record(app);
    testing::internal::CaptureStdout();
    try {
      app.parse(arguments);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    return testing::internal::GetCapturedStdout();
  }
  static std::string error(const std::string& arguments) {
    return test::refusal<InputError>([&] { run(arguments); });
  }

  std::string file_;
};

TEST_F(RecordCommand, InfoShowsTheMeasures) {
  const std::string text = run("record info " + file_);
  EXPECT_NE(text.find("station                not stated\nchannel                not stated\n"), std::string::npos)
      << text;
  EXPECT_TRUE(test::mentions(text, {"m/s^2"}));
  EXPECT_NE(text.find("points                 3, every 1 s\n"), std::string::npos) << text;
  EXPECT_NE(text.find("PGA                    2 m/s^2 (0.2039 g)\n"), std::string::npos) << text;
  EXPECT_TRUE(test::mentions(text, {"1.072 s", "5 %", "0.4642 s", "95 %", "1.536 s"}));
}

TEST_F(RecordCommand, InfoAsJsonIsInSi) {
  const auto json = nlohmann::json::parse(run("record info --json " + file_));
  EXPECT_EQ(json["npts"], 3);
  EXPECT_EQ(json["dt"], 1.0);
  EXPECT_EQ(json["pga"], 2.0);
  EXPECT_EQ(json["pgd"], 2.0);
  EXPECT_EQ(json["format"], "two columns");
}

TEST_F(RecordCommand, SpectrumOfAStiffOscillatorIsThePeakGroundAcceleration) {
  const std::string csv = file_ + ".out";
  EXPECT_EQ(run("record spectrum " + file_ + " --damping 5% --periods 0.01:1:3 --csv " + csv),
            "spectrum     " + csv + "\n");
  std::ifstream stream(csv);
  std::string names;
  std::getline(stream, names);
  EXPECT_TRUE(test::mentions(names, {"m/s^2"}));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    auto& row = rows.emplace_back(4);
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &row[0], &row[1], &row[2], &row[3]), 4);
  }
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0][0], 0.01);
  EXPECT_NEAR(rows[1][0], 0.1, 1e-12);
  EXPECT_EQ(rows[2][0], 1);
  EXPECT_NEAR(rows[0][3], 2, 0.02);
  EXPECT_NEAR(rows[0][3] / rows[0][1], std::pow(2 * pi / 0.01, 2), 1e-3);
  std::filesystem::remove(csv);
}

TEST_F(RecordCommand, SpectrumIsATableOnTheScreen) {
  const std::string text = run("record spectrum " + file_ + " --periods 0.1:1:4");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6) << text;
  EXPECT_NE(text.find("damping 5 %\n"), std::string::npos) << text;
}

TEST_F(RecordCommand, TakesTheOptionsOfTheInput) {
  std::ofstream(file_) << "# t[s] ns[gal] ew[gal]\n0 1 2\n1 200 400\n2 0 0\n";
  EXPECT_EQ(nlohmann::json::parse(run("record info --json --channel ew " + file_))["pga"], 4.0);
  std::ofstream(file_) << "0 1 2\n-3 0\n";
  const auto values = nlohmann::json::parse(run("record info --json --units m/s^2 --step '500 ms' " + file_));
  EXPECT_EQ(values["npts"], 5);
  EXPECT_EQ(values["dt"], 0.5);
  EXPECT_EQ(values["pga"], 3.0);
  EXPECT_TRUE(test::mentions(run("record spectrum --units g --step 0.5 " + file_), {"0.5 s", "3"}));
  // A cubic: 3 t^2 - t^3 in mm.
  std::ofstream(file_) << "0 0\n0.5 0.625\n1 2\n";
  const auto moved = nlohmann::json::parse(run("record info --json --displacement --units mm " + file_));
  EXPECT_NEAR(moved["pga"].get<double>(), 6e-3, 1e-12);
  EXPECT_NEAR(moved["pgd"].get<double>(), 2e-3, 1e-12);
  EXPECT_NE(run("record info --displacement --units mm " + file_).find("PGD                    0.002 m\n"),
            std::string::npos);
}

TEST_F(RecordCommand, WrongOptionsSayWhatToType) {
  EXPECT_TRUE(test::mentions(error("record info --step 0 " + file_), {"0.01 s", "--step"}));
  EXPECT_TRUE(test::mentions(error("record info --step 5mm " + file_), {"0.5 s", "5mm", "--step"}));
  std::ofstream(file_) << "time,acc (m/s^2)\n0,0\n0.5,2\n1,0\n";
  EXPECT_TRUE(test::mentions(error("record info --step 1 " + file_), {file_, "step", "0.5 s", "2"}));
  for (const std::string bad : {"1", "1:2", "0:1:5", "2:1:5", "0.1:1:2.5", "a:b:c", "0.1:1:1"})
    EXPECT_TRUE(
        test::mentions(error("record spectrum " + file_ + " --periods " + bad), {"--periods", "0.02:4:50", bad}));
  EXPECT_TRUE(test::mentions(error("record spectrum " + file_ + " --damping 5"), {"5 %", "[0, 1)", "--damping"}));
  EXPECT_TRUE(test::mentions(error("record spectrum " + file_ + " --damping 5mm"), {"5 %", "5mm", "--damping"}));
  EXPECT_TRUE(test::mentions(error("record spectrum " + file_ + " --csv no/such/folder/x.csv"),
                             {"no/such/folder/x.csv", "mkdir -p"}));
  EXPECT_TRUE(test::mentions(error("record info none.AT2"), {"none.AT2"}));
}

}  // namespace record_command_test
}  // namespace pounding
