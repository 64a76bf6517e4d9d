#include "reproduce/report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pounding::reproduce {
namespace {

using nlohmann::json;

template <class List, class Name>
const auto& find_in(const List& list, std::string_view name, Name&& name_of) {
  const auto found = std::ranges::find_if(list, [&](const auto& one) { return name_of(one) == name; });
  if (found == list.end()) throw std::out_of_range(fmt::format("this reproduction does not contain \"{}\"", name));
  return *found;
}

const char* word(Curve::Kind kind) {
  switch (kind) {
    case Curve::Kind::line: return "line";
    case Curve::Kind::thin: return "thin";
    case Curve::Kind::dashed: return "dashed";
    case Curve::Kind::points: return "points";
  }
  return "";
}

// JSON has no NaN; missing numbers are null.
json numbers(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? json(value) : json());
  return list;
}

json panel_json(const Panel& panel) {
  json curves = json::array();
  for (const Curve& c : panel.curves)
    curves.push_back({{"label", c.label}, {"x", c.x}, {"y", c.y}, {"kind", word(c.kind)}});
  return {{"title", panel.title}, {"x_label", panel.x_label}, {"y_label", panel.y_label},
          {"x_log", panel.x_log}, {"y_log", panel.y_log},     {"curves", curves}};
}

json figure_json(const Figure& figure) {
  json columns = json::array(), panels = json::array();
  for (const Column& c : figure.columns)
    columns.push_back({{"name", c.name}, {"unit", c.unit}, {"values", numbers(c.values)}});
  for (const Panel& p : figure.panels) panels.push_back(panel_json(p));
  return {{"name", figure.name},
          {"of_paper", figure.of_paper},
          {"caption", figure.caption},
          {"columns", columns},
          {"panels", panels}};
}

json table_json(const Table& table) {
  json headings = json::array(), rows = json::array();
  for (const Table::Heading& h : table.headings)
    headings.push_back({{"name", h.name}, {"unit", h.unit}, {"decimals", h.decimals}});
  for (const Table::Row& r : table.rows) rows.push_back({{"name", r.name}, {"values", numbers(r.values)}});
  return {{"name", table.name},
          {"title", table.title},
          {"row_header", table.row_header},
          {"headings", headings},
          {"rows", rows}};
}

json item_json(const Item& item) {
  json result{{"name", item.name}, {"title", item.title}, {"sections", item.sections}, {"paragraphs", item.paragraphs}};
  for (const char* list : {"equations", "matrices", "figures", "tables", "verdicts"}) result[list] = json::array();
  for (const Equation& e : item.equations) result["equations"].push_back({{"number", e.number}, {"tex", e.tex}});
  for (const Matrix& m : item.matrices) {
    json rows = json::array();
    for (const auto& row : m.rows) rows.push_back(numbers(row));
    result["matrices"].push_back({{"name", m.name}, {"unit", m.unit}, {"rows", rows}});
  }
  for (const Figure& f : item.figures) result["figures"].push_back(figure_json(f));
  for (const Table& t : item.tables) result["tables"].push_back(table_json(t));
  for (const Verdict& v : item.verdicts)
    result["verdicts"].push_back({{"place", v.place},
                                  {"claim", v.claim},
                                  {"printed", v.printed},
                                  {"ours", v.ours},
                                  {"judgement", word(v.judgement)},
                                  {"reason", v.reason}});
  return result;
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
    list.push_back(item_json(items[i]));
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
