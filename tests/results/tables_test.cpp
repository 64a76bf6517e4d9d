/// A line of a table drives the writer, the resumed run, the check of lengths and the list in the guide.

#include <pounding/results/tables.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/results/hdf5.hpp>
#include <pounding/results/table_writer.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace tables_test {

using Values = std::vector<double>;

/// An object with two sensors.
struct Sensors {
  std::vector<std::string> names{"a", "b"};
  Values time{0, 1, 2}, pressure{1, 2, 3, 4, 5, 6}, offset{7, 8};
  bool has_pressure = true;
};

constexpr tables::Group<Sensors> groups[] = {{"wet", [](const Sensors& s) { return s.has_pressure; }}};
constexpr tables::Dimension<Sensors> dimensions[] = {{"wet/sensor", tables::value<&Sensors::names>, "sensors"}};
constexpr tables::Variable<Sensors> variables[] = {
    {"time", "time", "s", "time", tables::stored<&Sensors::time>},
    {"wet/pressure", "time sensor", "Pa", "pressure", tables::stored<&Sensors::pressure>},
    {"wet/offset", "sensor", "Pa", "offset", tables::stored<&Sensors::offset>},
};
constexpr tables::Table<Sensors> table{groups, dimensions, variables};

hdf5::Handle written(const Sensors& sensors) {
  hdf5::Handle file = hdf5::memory_file();
  tables::TableWriter(file, "sensors", table, sensors).write();
  return file;
}

/// Histories in the file, read as by a resumed run into an object without histories.
Sensors resumed(hid_t file, bool has_pressure = true) {
  Sensors empty{.time = {}, .pressure = {}, .offset = {}, .has_pressure = has_pressure};
  tables::visit_histories(
      table, empty, "", [&](const std::string& path, Values& values) { hdf5::read_array(file, path.c_str(), values); });
  return empty;
}

TEST(Tables, ALineIsWrittenWithItsShapeAndReadByAResumedRun) {
  const hdf5::Handle file = written({});
  EXPECT_EQ(hdf5::shape(file, "wet/pressure"), (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(hdf5::shape(file, "wet/sensor"), std::vector<std::size_t>{2}) << "scale of the dimension";
  Values offset;
  hdf5::read_array(file, "wet/offset", offset);
  EXPECT_EQ(offset, (Values{7, 8}));
  const Sensors read = resumed(file);
  EXPECT_EQ(read.time, Sensors{}.time);
  EXPECT_EQ(read.pressure, Sensors{}.pressure);
  EXPECT_EQ(read.offset, Values{}) << "a resumed run has it from the model";
}

TEST(Tables, AGroupThatIsAbsentIsNeitherWrittenNorRead) {
  const hdf5::Handle file = written({.has_pressure = false});
  EXPECT_FALSE(hdf5::has(file, "wet"));
  EXPECT_EQ(resumed(file, false).pressure, Values{});
}

TEST(Tables, AListOfAnotherLengthThanItsDimensionsIsRefused) {
  Sensors sensors;
  sensors.pressure.pop_back();
  try {
    written(sensors);
    FAIL() << "list too short";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"sensors", "wet/pressure", "5", "6"}));
  }
}

TEST(Tables, HistoriesOfOneGroupAreTruncatedByRows) {
  LinkHistory link;
  link.tangents = 2;
  link.time = link.penetration = link.velocity = link.force = link.energy = {1, 2, 3};
  link.friction = {1, 2, 3, 4, 5, 6};
  tables::cut_histories(tables::of_link, link, "", 2);
  EXPECT_EQ(link.energy, (Values{1, 2}));
  EXPECT_EQ(link.friction, (Values{1, 2, 3, 4}));
}

/// The lines of the guide about one table.
template <class T>
std::string lines(const std::string& place, const tables::Table<T>& table) {
  std::string text;
  for (const tables::Variable<T>& variable : table.variables)
    text += fmt::format("{:<58} {:<34} {}\n", place + variable.path, variable.dims, variable.units);
  return text;
}

TEST(Tables, AreListedInTheGuide) {
  const std::string list = lines("/", tables::of_results) + lines("/structures/NAME/", tables::of_structure) +
                           lines("/links/NAME/", tables::of_link) + lines("/devices/NAME/", tables::of_device) +
                           lines("/envelopes/structures/NAME/", tables::of_envelope) +
                           lines("/solver/reduction/NAME/", tables::of_reduction) +
                           lines("/checkpoint/", tables::of_checkpoint);
  std::ifstream file(RESULTS_PAGE);
  const std::string page(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(page.find("```text\n" + list + "```"), std::string::npos) << RESULTS_PAGE << " must contain this list:\n"
                                                                      << list;
}

}  // namespace tables_test
}  // namespace pounding
