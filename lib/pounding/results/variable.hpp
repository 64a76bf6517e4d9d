#pragma once
/// Tables of the datasets of a results file. The writer, the reader of an interrupted run, the checks of lengths and
/// the list in the guide follow them: a new dataset is one line of a table, and the line that fills it.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <pounding/results/envelope.hpp>

namespace pounding::tables {

/// A list in an object of class T.
template <class T>
struct Stored {
  const std::vector<double>& (*read)(const T&);
  std::vector<double>& (*change)(T&);
};

template <class T, class Value>
using Computed = Value (*)(const T&);

/// Values of a dataset. Only lists over time that are stored are read when a run resumes; extremes have a second
/// dataset, with their times.
template <class T>
using Source = std::variant<Stored<T>, Computed<T, std::vector<double>>, Computed<T, std::vector<int>>,
                            Computed<T, std::vector<std::string>>, Computed<T, const std::vector<std::byte>&>,
                            Computed<T, Extremes>, Computed<T, double>, Computed<T, long>, Computed<T, std::string>>;

/// A dataset of an object of class T.
template <class T>
struct Variable {
  const char* path;  ///< from the group of the object: "springs/force"
  /// Names of the dimensions, the slowest first: "time floor direction"; empty for a scalar. A list whose only
  /// dimension has its own name is the coordinate of that dimension.
  const char* dims;
  const char* units;
  const char* long_name;
  Source<T> values;
  bool (*present)(const T&) = nullptr;  ///< null: wherever its group is
  /// For forces whose attributes state the loads that they include; null for others.
  const StructureEnvelope& (*loads)(const T&) = nullptr;

  /// True if the values grow with time and are stored.
  bool grows() const { return std::holds_alternative<Stored<T>>(values) && std::string_view(dims).starts_with("time"); }
};

/// A dimension of the variables in its group and in the groups below.
template <class T>
struct Dimension {
  const char* path;  ///< from the group of the object: "springs/spring"
  /// Its labels, or the size of a dimension without coordinates.
  std::variant<Computed<T, std::vector<std::string>>, Computed<T, std::size_t>> extent;
  const char* attribute = nullptr;  ///< attribute of its datasets that repeats the labels; null for none
};

/// A group in the group of an object whose content is conditional or has coordinates that index no dimension.
template <class T>
struct Group {
  const char* path;                     ///< empty for the group of the object
  bool (*present)(const T&) = nullptr;  ///< of the group and the groups below; null: always
  const char* coordinates = nullptr;    ///< names of the variables that are coordinates, not data; null for none
};

/// The datasets of an object. Groups and dimensions are written with the first variable that needs them.
template <class T>
struct Table {
  std::span<const Group<T>> groups;
  std::span<const Dimension<T>> dimensions;
  std::span<const Variable<T>> variables;
  /// Dimensions of a variable of an object with this number of values, if they are not those of its line.
  const char* (*dims)(const Variable<T>&, const T&, std::size_t count) = nullptr;
};

/// Path of the group that contains a path; empty for the group of the object.
inline std::string_view group_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash);
}

/// Name at the end of a path.
inline std::string name_in(std::string_view path) { return std::string(path.substr(path.rfind('/') + 1)); }

/// True if the file of an object has a variable, apart from extremes without values.
template <class T>
bool has(const Table<T>& table, const T& object, const Variable<T>& variable) {
  for (const Group<T>& group : table.groups)
    if (group.present && std::string_view(variable.path).starts_with(group.path) && !group.present(object))
      return false;
  return !variable.present || variable.present(object);
}

/// Calls `visit(path, values)` for each list over time of an object that its file has.
template <class T, class Visit>
void visit_histories(const Table<T>& table, T& object, const std::string& group, const Visit& visit) {
  for (const Variable<T>& variable : table.variables)
    if (variable.grows() && has(table, object, variable))
      visit(group + variable.path, std::get<Stored<T>>(variable.values).change(object));
}

/// Truncates the lists of an object over the time of a group, which is the first of them, to a length.
template <class T>
void cut_histories(const Table<T>& table, T& object, std::string_view group, std::size_t length) {
  std::size_t before = 0;
  for (const Variable<T>& variable : table.variables) {
    if (!variable.grows() || group_of(variable.path) != group) continue;
    std::vector<double>& values = std::get<Stored<T>>(variable.values).change(object);
    if (before == 0) before = values.size();
    values.resize(before == 0 ? 0 : values.size() / before * length);
  }
}

template <class Class, class Value>
Class class_of(Value Class::*);
template <auto member>
using ClassOf = decltype(class_of(member));

/// The list at the end of a chain of members.
template <auto first, auto... others>
inline constexpr Stored<ClassOf<first>> stored{
    [](const ClassOf<first>& object) -> const std::vector<double>& { return ((object.*first).*....*others); },
    [](ClassOf<first>& object) -> std::vector<double>& { return ((object.*first).*....*others); }};

/// The value at the end of a chain of members; integers as long.
template <auto first, auto... others>
inline constexpr auto value = [](const ClassOf<first>& object) {
  const auto& found = ((object.*first).*....*others);
  if constexpr (std::is_same_v<decltype(found), const int&>)
    return static_cast<long>(found);
  else
    return found;
};

}  // namespace pounding::tables
