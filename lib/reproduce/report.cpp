#include "reproduce/report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pounding::reproduce {

// The writer turns NaN into null.
using nlohmann::json;
NLOHMANN_JSON_SERIALIZE_ENUM(Curve::Kind, {{Curve::Kind::line, "line"},
                                           {Curve::Kind::thin, "thin"},
                                           {Curve::Kind::dashed, "dashed"},
                                           {Curve::Kind::points, "points"}})
static void to_json(json& j, Judgement judgement) { j = word(judgement); }
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Column, name, unit, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Curve, label, x, y, kind)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Panel, title, x_label, y_label, x_log, y_log, curves)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Figure, name, of_paper, caption, columns, panels)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Table::Heading, name, unit, decimals)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Table::Row, name, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Table, name, title, row_header, headings, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Matrix, name, unit, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Equation, number, tex)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Verdict, place, claim, printed, ours, judgement, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Item, name, title, sections, paragraphs, equations, matrices, figures, tables,
                                   verdicts)

namespace {

template <class List, class Name>
const auto& find_in(const List& list, std::string_view name, Name&& name_of) {
  const auto found = std::ranges::find_if(list, [&](const auto& one) { return name_of(one) == name; });
  if (found == list.end()) throw std::out_of_range(fmt::format("this reproduction does not contain \"{}\"", name));
  return *found;
}

}  // namespace

const std::string& Figure::add(std::string column, std::string unit, std::vector<double> values) {
  columns.push_back({std::move(column), std::move(unit), std::move(values)});
  return columns.back().name;
}

void Figure::plot(const std::string& label, std::vector<double> x, std::vector<double> y, Curve::Kind kind) {
  Panel& panel = panels.back();
  const auto unit_of = [](const std::string& axis) {
    const auto open = axis.rfind('['), close = axis.rfind(']');
    return open == std::string::npos || close == std::string::npos ? "" : axis.substr(open + 1, close - open - 1);
  };
  const std::string stem = panels.size() == 1 ? label : fmt::format("{}: {}", panel.title, label);
  const std::string abscissa = add(stem + ", x", unit_of(panel.x_label), std::move(x));
  const std::string ordinate = add(stem + ", y", unit_of(panel.y_label), std::move(y));
  panel.curves.push_back({label, abscissa, ordinate, kind});
}

const Column& Figure::column(std::string_view column) const {
  return find_in(columns, column, [](const Column& c) { return c.name; });
}

double Table::at(std::string_view row, std::string_view heading) const {
  const Row& line = find_in(rows, row, [](const Row& r) { return r.name; });
  const Heading& place = find_in(headings, heading, [](const Heading& h) { return h.name; });
  return line.values.at(static_cast<std::size_t>(&place - headings.data()));
}

const Figure& Item::figure(std::string_view figure) const {
  return find_in(figures, figure, [](const Figure& f) { return f.name; });
}

const Table& Item::table(std::string_view table) const {
  return find_in(tables, table, [](const Table& t) { return t.name; });
}

const Verdict& Item::verdict(std::string_view place) const {
  return find_in(verdicts, place, [](const Verdict& v) { return v.place; });
}

std::string_view word(Judgement judgement) {
  switch (judgement) {
    case Judgement::agrees: return "agrees";
    case Judgement::disagrees: return "does not agree";
    case Judgement::cannot_be_checked: return "cannot be checked";
  }
  return "";
}

std::string to_json(const std::vector<Item>& items, const std::vector<double>& seconds) {
  json list = json::array();
  for (std::size_t i = 0; i < items.size(); ++i) {
    list.push_back(items[i]);
    list.back()["seconds"] = seconds.at(i);
  }
  return json{{"items", list}}.dump();
}

std::string to_csv(const Figure& figure) {
  std::string text;
  std::size_t length = 0;
  const char* separator = "";
  for (const Column& column : figure.columns) {
    std::string header = column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
    for (auto quote = header.find('"'); quote != std::string::npos; quote = header.find('"', quote + 2))
      header.insert(quote, 1, '"');
    text += fmt::format("{}\"{}\"", std::exchange(separator, ","), header);
    length = std::max(length, column.values.size());
  }
  text += '\n';
  for (std::size_t i = 0; i < length; ++i) {
    separator = "";
    for (const Column& column : figure.columns) {
      text += std::exchange(separator, ",");
      if (i < column.values.size() && std::isfinite(column.values[i]))
        fmt::format_to(std::back_inserter(text), "{:.9g}", column.values[i]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace pounding::reproduce
