#pragma once
/// Writes the datasets of an object by its table.

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/text.hpp>
#include <pounding/results/hdf5.hpp>
#include <pounding/results/variable.hpp>

namespace pounding::tables {

/// Dimensions by their path from the group of an object.
using Scales = std::map<std::string, hdf5::Scale, std::less<>>;

/// Writes the group of an object.
template <class T>
class TableWriter {
 public:
  /// `name` of the object is for messages; `scales` are the dimensions of the groups above.
  TableWriter(hid_t place, std::string name, const Table<T>& table, const T& object, Scales scales = {})
      : place_(place), name_(std::move(name)), table_(table), object_(object), scales_(std::move(scales)) {}

  /// Writes the variables, with the groups and dimensions that they need, and returns the dimensions. Throws
  /// std::invalid_argument if a list does not have the length that follows from its dimensions, and std::runtime_error
  /// if HDF5 fails.
  Scales write() {
    describe_group(place_, "");
    for (const Variable<T>& variable : table_.variables)
      if (has(table_, object_, variable))
        std::visit([&](const auto& values) { write(variable, values); }, variable.values);
    return std::move(scales_);
  }

 private:
  void write(const Variable<T>& variable, const Stored<T>& values) { write_values(variable, values.read(object_)); }

  void write(const Variable<T>& variable, Computed<T, Extremes> compute) {
    const Extremes extremes = compute(object_);
    if (extremes.size() == 0) return;
    write_values(variable, paired(extremes.min, extremes.max));
    const std::string path = variable.path, times = path + "_time", long_name = "times of " + name_in(path);
    write_values(Variable<T>{times.c_str(), variable.dims, "s", long_name.c_str(), {}},
                 paired(extremes.t_min, extremes.t_max));
  }

  template <class Value>
  void write(const Variable<T>& variable, Computed<T, Value> compute) {
    write_values(variable, compute(object_));
  }

  static std::vector<double> paired(const std::vector<double>& smallest, const std::vector<double>& largest) {
    std::vector<double> pairs;
    for (std::size_t i = 0; i < smallest.size(); ++i) pairs.insert(pairs.end(), {smallest[i], largest[i]});
    return pairs;
  }

  template <class Values>
  void write_values(const Variable<T>& variable, const Values& values) {
    const std::string_view group = group_of(variable.path);
    const std::string name = name_in(variable.path);
    const hdf5::Label label{name.c_str(), variable.units, variable.long_name};
    const hid_t place = group_at(group);
    const std::size_t count = hdf5::count(values);
    const std::string_view dims = table_.dims ? table_.dims(variable, object_, count) : variable.dims;
    if (dims == name) {  // a coordinate
      hdf5::write(place, label, {count}, values);
      scales_.insert_or_assign(variable.path, hdf5::make_scale(place, label.name));
      return;
    }
    std::vector<const hdf5::Scale*> scales;
    hdf5::Shape shape;
    std::size_t expected = 1;
    for (const std::string_view dim : parts_between(dims, " ")) {
      scales.push_back(&scale_at(group, dim));
      shape.push_back(scales.back()->size);
      expected *= shape.back();
    }
    if (count != expected)
      throw std::invalid_argument(
          fmt::format("{}: {} holds {} values; {} are expected", name_, variable.path, count, expected));
    const hdf5::Handle made = hdf5::write(place, label, shape, values);
    hdf5::attach(made, scales);
    if (!variable.loads) return;
    hdf5::attribute(made, "gravity_included", static_cast<int>(variable.loads(object_).with_gravity));
    hdf5::attribute(made, "included", variable.loads(object_).included);
  }

  hid_t group_at(std::string_view path) {
    if (path.empty()) return place_;
    const auto found = groups_.find(path);
    if (found != groups_.end()) return found->second;
    group_at(group_of(path));
    const hid_t made = groups_.emplace(path, hdf5::group(place_, std::string(path))).first->second;
    describe_group(made, path);
    return made;
  }

  void describe_group(hid_t place, std::string_view path) {
    for (const Group<T>& group : table_.groups)
      if (group.coordinates && path == group.path)
        hdf5::attribute(place, "coordinates", std::string(group.coordinates));
  }

  // The dimension in a group or the groups above, which is written if it is the first use.
  const hdf5::Scale& scale_at(std::string_view group, std::string_view name) {
    const std::string path = group.empty() ? std::string(name) : fmt::format("{}/{}", group, name);
    if (const auto found = scales_.find(path); found != scales_.end()) return found->second;
    for (const Dimension<T>& dimension : table_.dimensions) {
      if (path != dimension.path) continue;
      const auto write_scale = [&](const auto& extent) {
        return hdf5::scale(group_at(group), std::string(name).c_str(), extent(object_));
      };
      hdf5::Scale& made = scales_[path] = std::visit(write_scale, dimension.extent);
      made.attribute = dimension.attribute;
      return made;
    }
    if (group.empty()) throw std::logic_error(fmt::format("the table of {} has no dimension {}", name_, name));
    return scale_at(group_of(group), name);
  }

  hid_t place_;
  std::string name_;
  const Table<T>& table_;
  const T& object_;
  Scales scales_;
  std::map<std::string, hdf5::Handle, std::less<>> groups_;
};

}  // namespace pounding::tables
