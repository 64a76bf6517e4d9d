/// The results file read through HDF5's C interface, and write errors.

#include <pounding/results/results.hpp>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include <pounding/core/error.hpp>
#include <pounding/results/checked_file.hpp>
#include <pounding/results/replaced_file.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace results_test {

namespace fs = std::filesystem;

StructureHistory structure(const std::string& name, const std::vector<std::string>& floors) {
  StructureHistory history;
  history.name = name;
  history.floors = floors;
  return history;
}

/// Two structures of two and one floors, three output times, one link with one impact.
Results small_run() {
  Results run;
  run.version = "0.1.0";
  run.created = "2026-01-02T03:04:05Z";
  run.title = "Türme";
  run.command = "pounding run towers.yaml";
  run.status = "done";
  run.model_yaml = "title: Türme\n";
  run.resolved_yaml = "title: Türme\nanalysis: {tolerance: 1e-4}\n";
  run.time = {0.0, 0.5, 1.0};
  run.ground_acceleration = {0.0, 3.0, -1.0};
  StructureHistory left = structure("tower.A", {"1", "roof"});
  left.displacement = {0, 0, 1, 2, 3, 4};
  left.velocity = {0, 0, 10, 20, 30, 40};
  left.acceleration = {0, 0, 5, 6, 7, 8};
  left.drift = {0, 0, 1, 1, 3, 1};
  left.storey_shear = {0, 0, 9, 9, 9, 9};
  StructureHistory right = structure("ball", {"1"});
  right.displacement = right.velocity = right.acceleration = {0, -1, -2};
  run.structures = {left, right};
  LinkHistory link;
  link.name = "tower.A.2-ball.1";
  link.time = {0, 0.4, 0.45, 0.5};
  link.penetration = {-0.02, 0, 1e-3, 0};
  link.velocity = {0, 0.5, 0, -0.3};
  link.force = {0, 0, 4e6, 0};
  link.energy = {0, 0, 900, 400};
  link.gap = 0.02;
  link.law = "jankowski";
  link.left = {"tower.A", 2};
  link.right = {"ball", 1};
  run.links = {link};
  ImpactRow impact;
  impact.t_start = 0.4;
  impact.t_end = 0.5;
  impact.t_release = 0.49;
  impact.v_approach = 0.5;
  impact.v_separation = 0.3;
  impact.restitution = 0.6;
  impact.peak_force = 4e6;
  impact.t_peak = 0.45;
  impact.peak_penetration = 1e-3;
  impact.impulse = 2e5;
  impact.energy_lost = 400;
  impact.energy_stored = 30;
  ImpactRow at_rest;
  at_rest.t_start = at_rest.t_end = 0.9;
  at_rest.restitution = std::numeric_limits<double>::quiet_NaN();
  run.impacts = {impact, at_rest};
  run.energy.time = run.time;
  run.energy.input = {0, 5, 9};
  run.energy.kinetic = run.energy.strain = run.energy.damping = run.energy.hysteretic = {0, 1, 2};
  run.energy.impact = run.energy.error = {0, 0, 0.5};
  run.integrator = "esdirk4";
  run.solver = {.steps = 120, .rejected = 3, .events = 4, .iterations = 300, .wall_seconds = 0.25};
  run.summary_json = R"({"status": "done"})";
  return run;
}

class ResultsFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "pounding-results-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    directory = pattern;
    path = (directory / "run.h5").string();
  }
  void TearDown() override { fs::remove_all(directory); }

  std::vector<std::string> names_in_directory() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::string refusal(const std::string& where) {
    return test::refusal<InputError>([&] { write_results(small_run(), where); });
  }

  static std::string content(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static std::string whole_or_not(const std::string& file) {
    return test::refusal<InputError>([&] { require_whole(file); });
  }

  fs::path directory;
  std::string path;
};

/// A file opened for reading. The few identifiers of its objects are closed with the process.
class Reader {
 public:
  explicit Reader(const std::string& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    EXPECT_GE(file_, 0) << path;
  }
  ~Reader() { H5Fclose(file_); }

  std::vector<hsize_t> shape(const std::string& name) const {
    const hid_t space = H5Dget_space(open(name));
    std::vector<hsize_t> extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    return extents;
  }

  std::vector<double> values(const std::string& name) const {
    std::vector<double> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(H5Dget_space(open(name)))));
    EXPECT_GE(H5Dread(open(name), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0) << name;
    return read;
  }

  std::string text(const std::string& name) const {
    const hid_t found = open(name), type = H5Dget_type(found);
    EXPECT_EQ(H5Tis_variable_str(type), 0)
        << name << ": reading a damaged heap of variable-length strings does not end";
    std::string read(H5Tget_size(type), '\0');
    EXPECT_GE(H5Dread(found, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0) << name;
    return without_zeros(read);
  }

  std::string text_attribute(const std::string& object, const char* name) const {
    return text_attributes(object, name).at(0);
  }

  std::vector<std::string> text_attributes(const std::string& object, const char* name) const {
    const hid_t found = attribute(object, name), type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    std::vector<char*> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(H5Aget_space(found))));
    EXPECT_GE(H5Aread(found, type, read.data()), 0) << object << ' ' << name;
    std::vector<std::string> texts;
    for (char* one : read) {
      texts.emplace_back(one);
      H5free_memory(one);
    }
    return texts;
  }

  /// One field of /impacts in every row.
  std::vector<double> impact_field(const char* field) const {
    const hid_t row = H5Tcreate(H5T_COMPOUND, sizeof(double));
    H5Tinsert(row, field, 0, H5T_NATIVE_DOUBLE);
    std::vector<double> read(shape("/impacts").at(0));
    EXPECT_GE(H5Dread(open("/impacts"), row, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0) << field;
    return read;
  }

  std::vector<std::string> members(const std::string& group) const {
    const hid_t opened = H5Gopen2(file_, group.c_str(), H5P_DEFAULT);
    std::vector<std::string> names;
    H5Literate(
        opened, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5L_info_t*, void* target) -> herr_t {
          static_cast<std::vector<std::string>*>(target)->emplace_back(name);
          return 0;
        },
        &names);
    return names;
  }

  hid_t open(const std::string& name) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    return dataset;
  }

  hid_t id() const { return file_; }

 private:
  static std::string without_zeros(const std::string& text) { return text.substr(0, text.find_last_not_of('\0') + 1); }

  hid_t attribute(const std::string& object, const char* name) const {
    return H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
  }

  hid_t file_;
};

using Shape = std::vector<hsize_t>;
using Values = std::vector<double>;
using Texts = std::vector<std::string>;

TEST_F(ResultsFile, RootSaysWhatTheFileIs) {
  write_results(small_run(), path);
  const Reader file(path);
  EXPECT_EQ(file.text_attribute("/", "program"), "pounding");
  EXPECT_EQ(file.text_attribute("/", "version"), "0.1.0");
  EXPECT_EQ(file.text_attribute("/", "created"), "2026-01-02T03:04:05Z");
  EXPECT_EQ(file.text_attribute("/", "title"), "Türme");
  EXPECT_EQ(file.text_attribute("/", "command"), "pounding run towers.yaml");
  EXPECT_EQ(file.text_attribute("/", "status"), "done");
  EXPECT_EQ(file.text("/input/model.yaml"), "title: Türme\n");
  EXPECT_EQ(file.text("/input/resolved.yaml"), "title: Türme\nanalysis: {tolerance: 1e-4}\n");
  EXPECT_EQ(file.text("/summary"), R"({"status": "done"})");
}

TEST_F(ResultsFile, MotionIsTimeByFloorByDirection) {
  write_results(small_run(), path);
  const Reader file(path);
  EXPECT_EQ(file.members("/structures"), (Texts{"tower.A", "ball"})) << "the order in the input";
  EXPECT_EQ(file.shape("/structures/tower.A/displacement"), (Shape{3, 2, 1}));
  EXPECT_EQ(file.values("/structures/tower.A/displacement"), (Values{0, 0, 1, 2, 3, 4}));
  EXPECT_EQ(file.values("/structures/tower.A/velocity"), (Values{0, 0, 10, 20, 30, 40}));
  EXPECT_EQ(file.values("/structures/tower.A/acceleration"), (Values{0, 0, 5, 6, 7, 8}));
  EXPECT_EQ(file.shape("/structures/tower.A/drift"), (Shape{3, 2}));
  EXPECT_EQ(file.values("/structures/tower.A/storey_shear"), (Values{0, 0, 9, 9, 9, 9}));
  EXPECT_EQ(file.text_attributes("/structures/tower.A/displacement", "floors"), (Texts{"1", "roof"}));
  EXPECT_EQ(file.text_attributes("/structures/tower.A/displacement", "directions"), (Texts{"x"}));
  EXPECT_EQ(file.shape("/structures/ball/drift"), (Shape{3, 0})) << "a body has no storeys";
  EXPECT_EQ(file.values("/time"), (Values{0, 0.5, 1}));
  EXPECT_EQ(file.values("/ground/acceleration"), (Values{0, 3, -1}));
}

TEST_F(ResultsFile, LinkKeepsItsOwnTimesAndEnds) {
  write_results(small_run(), path);
  const Reader file(path);
  const std::string link = "/links/tower.A.2-ball.1/";
  EXPECT_EQ(file.values(link + "time"), (Values{0, 0.4, 0.45, 0.5}));
  EXPECT_EQ(file.values(link + "penetration"), (Values{-0.02, 0, 1e-3, 0}));
  EXPECT_EQ(file.values(link + "velocity"), (Values{0, 0.5, 0, -0.3}));
  EXPECT_EQ(file.values(link + "force"), (Values{0, 0, 4e6, 0}));
  EXPECT_EQ(file.values(link + "energy"), (Values{0, 0, 900, 400}));
  EXPECT_EQ(file.text_attribute(link, "left"), "tower.A");
  EXPECT_EQ(file.text_attribute(link, "right"), "ball");
  EXPECT_EQ(file.text_attribute(link, "law"), "jankowski");
}

TEST_F(ResultsFile, ImpactsAreOneTable) {
  write_results(small_run(), path);
  const Reader file(path);
  ASSERT_EQ(file.shape("/impacts"), (Shape{2}));
  const std::pair<const char*, double> expected[] = {
      {"t_start", 0.4},           {"t_end", 0.5},       {"t_release", 0.49},  {"v_approach", 0.5},
      {"v_separation", 0.3},      {"restitution", 0.6}, {"peak_force", 4e6},  {"t_peak", 0.45},
      {"peak_penetration", 1e-3}, {"impulse", 2e5},     {"energy_lost", 400}, {"energy_stored", 30}};
  for (const auto& [field, value] : expected) EXPECT_EQ(file.impact_field(field).at(0), value) << field;
  EXPECT_TRUE(std::isnan(file.impact_field("restitution").at(1))) << "a touch at rest";
  EXPECT_EQ(file.text_attributes("/impacts", "units"),
            (Texts{"text", "s", "s", "s", "m/s", "m/s", "1", "N", "s", "m", "N s", "J", "J"}));
  EXPECT_EQ(file.text_attributes("/impacts", "field_long_names").size(), 13u);
}

TEST_F(ResultsFile, EveryDatasetHasUnitsAndLongName) {
  write_results(small_run(), path);
  const Reader file(path);
  std::vector<std::string> incomplete;
  const auto visit = [](hid_t parent, const char* name, const H5O_info_t* info, void* target) -> herr_t {
    if (info->type == H5O_TYPE_DATASET && (H5Aexists_by_name(parent, name, "units", H5P_DEFAULT) <= 0 ||
                                           H5Aexists_by_name(parent, name, "long_name", H5P_DEFAULT) <= 0))
      static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    return 0;
  };
  H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, visit, &incomplete, H5O_INFO_BASIC);
  EXPECT_EQ(incomplete, Texts{});
  EXPECT_EQ(file.text_attribute("/structures/tower.A/acceleration", "units"), "m/s^2");
  EXPECT_EQ(file.text_attribute("/solver/steps", "units"), "1");
}

TEST_F(ResultsFile, EnergyAndSolverComeBack) {
  write_results(small_run(), path);
  const Reader file(path);
  EXPECT_EQ(file.members("/energy"),
            (Texts{"time", "input", "kinetic", "strain", "damping", "hysteretic", "impact", "error"}));
  EXPECT_EQ(file.values("/energy/input"), (Values{0, 5, 9}));
  EXPECT_EQ(file.values("/energy/error"), (Values{0, 0, 0.5}));
  EXPECT_EQ(file.text_attribute("/solver", "integrator"), "esdirk4");
  EXPECT_EQ(file.values("/solver/steps"), Values{120});
  EXPECT_EQ(file.values("/solver/rejected"), Values{3});
  EXPECT_EQ(file.values("/solver/wall_seconds"), Values{0.25});
}

TEST_F(ResultsFile, RunWithoutAnythingIsWritten) {
  write_results(Results{}, path);
  const Reader file(path);
  EXPECT_EQ(file.text_attribute("/", "status"), "running");
  EXPECT_EQ(file.shape("/time"), Shape{0});
  EXPECT_EQ(file.shape("/impacts"), Shape{0});
  EXPECT_EQ(file.members("/links"), Texts{});
}

TEST_F(ResultsFile, StructureWithoutFloorsOrSamplesIsWritten) {
  Results run;
  run.structures = {structure("wall", {}), structure("tower", {"1", "2"})};
  write_results(run, path);
  const Reader file(path);
  EXPECT_EQ(file.shape("/structures/wall/displacement"), (Shape{0, 0, 1}));
  EXPECT_EQ(file.shape("/structures/tower/displacement"), (Shape{0, 2, 1}));
}

TEST_F(ResultsFile, StructureWithoutFloorsHasNothingToReadAtAnyTime) {
  Results run;
  run.time = run.ground_acceleration = {0, 1, 2};
  run.structures = {structure("wall", {})};
  run.structures[0].velocity.reserve(1);  // an allocated but empty vector
  write_results(run, path);
  const Reader file(path);
  EXPECT_EQ(file.shape("/structures/wall/displacement"), (Shape{3, 0, 1}));
  EXPECT_EQ(file.shape("/structures/wall/velocity"), (Shape{3, 0, 1}));
}

TEST_F(ResultsFile, LargeHistoriesAreUnchangedAndInChunksThatAreFull) {
  Results run;
  const std::size_t samples = 20000, floors = 11;
  run.time.resize(samples);
  run.ground_acceleration.resize(samples);
  StructureHistory tower = structure("tower", Texts(floors, "floor"));
  for (std::size_t i = 0; i < samples * floors; ++i) tower.displacement.push_back(std::sin(1e-3 * double(i)));
  tower.velocity = tower.acceleration = tower.drift = tower.storey_shear = tower.displacement;
  run.structures = {tower};
  write_results(run, path);
  const Reader file(path);
  EXPECT_EQ(file.values("/structures/tower/drift"), tower.drift);
  EXPECT_LT(fs::file_size(path), 1.03 * samples * (5 * floors + 2) * sizeof(double))
      << "five histories, the time and the ground";
}

TEST_F(ResultsFile, ZerosInFrontAreReadAndTakeNoRoom) {
  Results run;
  const std::size_t samples = 50000;
  run.time.resize(samples);
  run.ground_acceleration.resize(samples);
  for (std::size_t i = 30000; i < samples; ++i) run.ground_acceleration[i] = double(i);
  run.ground_acceleration[40000] = 0;
  write_results(run, path);
  const Reader file(path);
  EXPECT_EQ(file.values("/time"), run.time);
  EXPECT_EQ(file.values("/ground/acceleration"), run.ground_acceleration);
  EXPECT_LT(fs::file_size(path), 0.8 * samples * sizeof(double))
      << "the times are zero, as is the first half of the ground accelerations";
}

TEST_F(ResultsFile, RunWithoutLinksStandsInTheOtherOne) {
  Results run = small_run(), without_links = small_run();
  without_links.time = {0.0, 0.7, 1.5};
  without_links.title = "without links";
  run.add_no_pounding = group_without_links(std::make_shared<const Results>(without_links));
  for (int times = 0; times < 2; ++times) {
    SCOPED_TRACE("the group can be written again");
    write_results(run, path);
    const Reader file(path);
    EXPECT_EQ(file.values("/time"), run.time);
    EXPECT_EQ(file.values("/no_pounding/time"), without_links.time);
    EXPECT_EQ(file.values("/no_pounding/structures/tower.A/drift"), without_links.structures[0].drift);
    EXPECT_EQ(file.text_attribute("/no_pounding", "title"), "without links");
  }
}

TEST_F(ResultsFile, NewFileReplacesTheEarlierOne) {
  Results run = small_run();
  run.status = "running";
  write_results(run, path);
  EXPECT_EQ(Reader(path).text_attribute("/", "status"), "running");
  write_results(small_run(), path);
  EXPECT_EQ(Reader(path).text_attribute("/", "status"), "done");
  EXPECT_EQ(names_in_directory(), Texts{"run.h5"});
}

TEST_F(ResultsFile, SymbolicLinkStaysALink) {
  const fs::path elsewhere = directory / "elsewhere.h5";
  write_results(Results{}, elsewhere.string());
  fs::create_symlink(elsewhere, path);
  write_results(small_run(), path);
  EXPECT_TRUE(fs::is_symlink(path));
  EXPECT_EQ(Reader(elsewhere.string()).text_attribute("/", "status"), "done");
}

TEST_F(ResultsFile, SymbolicLinkToAFileThatIsNotThereYetStaysALink) {
  const fs::path elsewhere = directory / "elsewhere.h5";
  fs::create_symlink("elsewhere.h5", directory / "between.h5");
  fs::create_symlink(directory / "between.h5", path);
  write_results(small_run(), path);
  EXPECT_TRUE(fs::is_symlink(path));
  EXPECT_TRUE(fs::is_symlink(directory / "between.h5"));
  EXPECT_EQ(Reader(elsewhere.string()).text_attribute("/", "status"), "done");
}

TEST_F(ResultsFile, SymbolicLinkInACircleIsRefused) {
  fs::create_symlink("other.h5", path);
  fs::create_symlink("run.h5", directory / "other.h5");
  EXPECT_TRUE(test::mentions(refusal(path), {path, "-o results.h5"}));
  EXPECT_TRUE(fs::is_symlink(path));
}

TEST_F(ResultsFile, LeftoverOfAKilledRunIsReused) {
  std::ofstream(directory / ".run.h5.tmp") << "half a file";
  write_results(small_run(), path);
  EXPECT_EQ(names_in_directory(), Texts{"run.h5"});
  require_whole(path);
}

TEST_F(ResultsFile, LimitOnTheSizeOfFilesLeavesTheEarlierFile) {
  Results earlier = small_run();
  earlier.status = "running";
  write_results(earlier, path);
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{.rlim_cur = 4096, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tight);
  const std::string text = refusal(path);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(test::mentions(text, {path, "-o", "/other/disk/results.h5"}));
  EXPECT_EQ(Reader(path).text_attribute("/", "status"), "running");
  EXPECT_EQ(names_in_directory(), Texts{"run.h5"});
}

TEST_F(ResultsFile, PlaceOfAnotherRunIsRefusedUntilThatEnds) {
  const FileImage image = results_image(small_run());
  const test::Facts busy{path, "-o other.h5"};
  {
    ReplacedFile one(path);
    one.replace(image);
    EXPECT_TRUE(test::mentions(refusal(path), busy));
    one.replace(image);
    EXPECT_EQ(Reader(path).text_attribute("/", "status"), "done") << "a reader is not rejected";
    EXPECT_TRUE(test::mentions(refusal(path), busy));
  }
  EXPECT_EQ(refusal(path), "taken");
  EXPECT_EQ(names_in_directory(), Texts{"run.h5"});
}

TEST_F(ResultsFile, PlaceThatAnotherRunHasTakenIsLeftToIt) {
  ReplacedFile one(path);
  one.replace(results_image(small_run()));
  write_results(Results{}, path + ".new");
  fs::rename(path + ".new", path);
  EXPECT_THROW(one.replace(results_image(small_run())), InputError);
  EXPECT_EQ(Reader(path).text_attribute("/", "status"), "running");
  fs::remove(path);
  one.replace(results_image(small_run()));
  EXPECT_EQ(Reader(path).text_attribute("/", "status"), "done") << "a removed file is written again";
}

TEST_F(ResultsFile, OnlyResultsAreReplaced) {
  const hid_t foreign = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(foreign);
  const auto size = fs::file_size(path);
  EXPECT_TRUE(test::mentions(refusal(path), {path, "-o", "results.h5"}));
  EXPECT_EQ(fs::file_size(path), size);
  std::ofstream(path, std::ios::trunc).close();
  EXPECT_EQ(refusal(path), "taken") << "an empty file has no content to protect";
  write_results(small_run(), path);
}

TEST_F(ResultsFile, EveryChangedByteIsSeen) {
  write_results(small_run(), path);
  require_whole(path);
  std::string whole = content(path);
  for (std::size_t place = 0; place < whole.size(); place += place < 24 ? 1 : 997) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << place % 8));
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_THROW(require_whole(path), InputError) << place;
  }
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{511}, std::size_t{512}, std::size_t{600}, whole.size() - 1}) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(require_whole(path), InputError) << length;
  }
  std::ofstream(path, std::ios::binary) << whole << '\n';
  EXPECT_THROW(require_whole(path), InputError);
  std::ofstream(path, std::ios::binary) << whole.substr(checked_block_size);
  EXPECT_TRUE(test::mentions(whole_or_not(path), {path})) << "as in files of earlier versions";
  std::ofstream(path, std::ios::binary) << "study of pounding\n" << std::string(494, ' ') << whole.substr(512);
  EXPECT_TRUE(test::mentions(whole_or_not(path), {path, "pounding study show"}));
  std::ofstream(path, std::ios::binary) << whole.substr(0, 1000);
  EXPECT_TRUE(test::mentions(whole_or_not(path), {path, "1000", std::to_string(whole.size())}));
  EXPECT_TRUE(test::mentions(whole_or_not(directory.string()), {directory.string()}));
  EXPECT_TRUE(test::mentions(whole_or_not(path + ".none"), {path + ".none"}));
}

TEST_F(ResultsFile, PlacesThatCannotHoldAFileAreRefusedWithAdvice) {
  EXPECT_TRUE(test::mentions(refusal(directory.string()), {directory.string(), "-o", "/results.h5"}));
  EXPECT_TRUE(test::mentions(refusal("/dev/null"), {"/dev/null", "-o", "results.h5"}));
  EXPECT_TRUE(test::mentions(refusal(""), {"-o", "results.h5"}));
  const std::string missing = (directory / "none").string();
  EXPECT_TRUE(test::mentions(refusal(missing + "/run.h5"), {missing, "-o", "-p", "/run.h5", "results.h5"}));
}

TEST_F(ResultsFile, NamesThatCannotBeGroupsAreRefused) {
  Results run = small_run();
  for (const char* name : {"a/b", "", ".", ".."}) {
    run.links[0].name = name;
    EXPECT_THROW(write_results(run, path), InputError) << name;
  }
  run = small_run();
  run.structures[1].name = "tower.A";
  try {
    write_results(run, path);
    FAIL() << "two structures with the same name";
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"tower.A"}));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(ResultsFile, HistoriesOfWrongLengthAreRefused) {
  Results run = small_run();
  run.structures[0].velocity.pop_back();
  try {
    write_results(run, path);
    FAIL() << "history too short";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"tower.A", "5", "6"}));
  }
  run = small_run();
  run.impacts[0].link = 1;
  EXPECT_THROW(write_results(run, path), std::invalid_argument);
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace results_test
}  // namespace pounding
