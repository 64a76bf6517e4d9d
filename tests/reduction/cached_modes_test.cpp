// Cached modes: bitwise identical for the same key, and none for another key; damaged and truncated files, and
// obstructed paths.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/reduction/cached_modes.hpp>

namespace pounding {
namespace cached_modes_test {

namespace fs = std::filesystem;
using petsc::CachedModes;
using petsc::ModesOrigin;

ModesOrigin origin() {
  ModesOrigin o;
  for (SparseMatrix* matrix : {&o.mass, &o.stiffness}) {
    matrix->resize(3, 3);
    for (int i = 0; i < 3; ++i) matrix->insert(i, i) = 2 + i;
  }
  o.damping = {0.1, 0.2, 0};
  o.inputs.links = Eigen::MatrixXd::Random(3, 2);
  o.inputs.parts.resize(3, 0);
  o.inputs.ground = Eigen::MatrixXd::Random(3, 1);
  o.inputs.starts = Eigen::MatrixXd::Zero(3, 2);
  o.inputs.shift = 16;
  return o;
}

ReducedGroup group() {
  ReducedGroup made{
      .modes =
          std::make_shared<const GroupModes>(GroupModes{Eigen::MatrixXd::Random(3, 2), Eigen::VectorXd::Random(2)}),
      .shadow =
          std::make_shared<const ShadowModes>(ShadowModes{Eigen::MatrixXd::Random(2, 1), Eigen::VectorXd::Random(1)})};
  made.made.flexibility_error = 0.5;
  made.made.shadow_flexibility_error = 0.25;
  return made;
}

class CachedModesTest : public testing::Test {
 protected:
  ~CachedModesTest() override { fs::remove_all(folder); }

  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
    return all;
  }
  std::string read() const {
    std::ifstream file(files().at(0), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(files().at(0), std::ios::binary) << bytes; }

  const std::string folder =
      fs::temp_directory_path() /
      fmt::format("kept_{}_{}", getpid(), testing::UnitTest::GetInstance()->current_test_info()->name()) / "modes";
};

void expect_equal(const ReducedGroup& one, const ReducedGroup& other) {
  EXPECT_EQ(one.modes->shapes, other.modes->shapes);
  EXPECT_EQ(one.modes->squares, other.modes->squares);
  ASSERT_EQ(one.shadow != nullptr, other.shadow != nullptr);
  if (one.shadow) {
    EXPECT_EQ(one.shadow->in_modes, other.shadow->in_modes);
    EXPECT_EQ(one.shadow->squares, other.shadow->squares);
  }
  EXPECT_EQ(one.made.flexibility_error, other.made.flexibility_error);
  EXPECT_EQ(one.made.shadow_flexibility_error, other.made.shadow_flexibility_error);
}

TEST_F(CachedModesTest, AreFoundWithTheirBitsByAnyProcess) {
  const ModesOrigin of = origin();
  ReducedGroup made = group();
  EXPECT_FALSE(CachedModes(folder).find(of.bytes()));
  CachedModes(folder).keep(of.bytes(), made);
  expect_equal(CachedModes(folder).find(of.bytes()).value(), made);
  made.shadow.reset();
  CachedModes(folder).keep(of.bytes(), made);
  expect_equal(CachedModes(folder).find(of.bytes()).value(), made);
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(CachedModesTest, AreNotThoseOfAnythingElse) {
  const ModesOrigin of = origin();
  const CachedModes kept(folder);
  kept.keep(of.bytes(), group());
  const auto differs = [&](const char* what, auto change) {
    ModesOrigin other = of;
    change(other);
    EXPECT_FALSE(kept.find(other.bytes())) << what;
  };
  differs("mass", [](ModesOrigin& o) { o.mass.coeffRef(1, 1) = 5; });
  differs("stiffness", [](ModesOrigin& o) { o.stiffness.coeffRef(2, 2) = 5; });
  differs("one entry more", [](ModesOrigin& o) { o.stiffness.coeffRef(0, 2) = 0; });
  differs("damping", [](ModesOrigin& o) { o.damping.modal = 0.05; });
  differs("links", [](ModesOrigin& o) { o.inputs.links(0, 0) += 1e-15; });
  differs("links that yield", [](ModesOrigin& o) { std::swap(o.inputs.links, o.inputs.parts); });
  differs("ground", [](ModesOrigin& o) { o.inputs.ground(1, 0) = 0; });
  differs("start", [](ModesOrigin& o) { o.inputs.starts(1, 0) = 1; });
  differs("contact", [](ModesOrigin& o) { o.inputs.shift = 64; });
  differs("depth", [](ModesOrigin& o) { ++o.depth.ground; });
  differs("shadow", [](ModesOrigin& o) { o.shadow = false; });
}

// A file of another key under its name, as after a checksum collision, is not used.
TEST_F(CachedModesTest, AreComparedBitByBit) {
  ModesOrigin of = origin(), other = of;
  other.inputs.shift = 64;
  const CachedModes kept(folder);
  kept.keep(of.bytes(), group());
  const fs::path own = files().at(0);
  const std::string bytes = read();
  fs::remove(own);
  kept.keep(other.bytes(), group());
  write(bytes);
  EXPECT_FALSE(kept.find(other.bytes()));
}

TEST_F(CachedModesTest, AreMadeAnewWhereAFileIsDamagedOrCut) {
  const ModesOrigin of = origin();
  const ReducedGroup made = group();
  const CachedModes kept(folder);
  kept.keep(of.bytes(), made);
  const std::string whole = read();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
    write(damaged);
    EXPECT_FALSE(kept.find(of.bytes())) << i;
    write(whole.substr(0, i));
    EXPECT_FALSE(kept.find(of.bytes())) << i;
  }
  write(whole + "more");
  EXPECT_FALSE(kept.find(of.bytes()));
  kept.keep(of.bytes(), made);
  expect_equal(kept.find(of.bytes()).value(), made);
}

TEST_F(CachedModesTest, GoWhereTheFolderIsFullByTheirLastUse) {
  std::vector<ModesOrigin> of(4, origin());
  for (std::size_t i = 0; i < of.size(); ++i) of[i].inputs.shift = static_cast<double>(i + 1);
  CachedModes(folder).keep(of[0].bytes(), group());
  const CachedModes kept(folder, 3 * fs::file_size(files().at(0)));
  for (std::size_t i = 0; i < 3; ++i) {
    kept.keep(of[i].bytes(), group());
    for (const fs::path& path : files())
      if (const auto now = fs::file_time_type::clock::now(); now - fs::last_write_time(path) < std::chrono::minutes(30))
        fs::last_write_time(path, now - std::chrono::hours(9 - i));
  }
  std::ofstream(folder + "/of_others.txt") << std::string(10000, ' ');
  EXPECT_TRUE(kept.find(of[0].bytes()));  // the oldest entry is used again
  kept.keep(of[3].bytes(), group());
  EXPECT_TRUE(kept.find(of[0].bytes()));
  EXPECT_FALSE(kept.find(of[1].bytes()));
  EXPECT_TRUE(kept.find(of[2].bytes()));
  EXPECT_TRUE(kept.find(of[3].bytes()));
  EXPECT_TRUE(fs::exists(folder + "/of_others.txt"));
}

TEST_F(CachedModesTest, SayWhereNothingCanBeKept) {
  fs::create_directories(fs::path(folder).parent_path());
  std::ofstream(folder) << "a file";
  try {
    const CachedModes kept(folder);
    FAIL() << "modes in a file";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(folder), std::string::npos) << text;
    EXPECT_NE(text.find("type -pounding_red_cache FOLDER"), std::string::npos) << text;
  }
}

}  // namespace cached_modes_test
}  // namespace pounding
